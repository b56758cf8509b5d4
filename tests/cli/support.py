"""Drawings made in memory, and the program run on them."""
import os
import random
import re
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

PROGRAM = os.environ['INKGRID']
SVG = '{http://www.w3.org/2000/svg}'


def blank(width, height, grey=255):
    return [bytearray([grey]) * width for _ in range(height)]


def paint_disc(rows, x, y, radius, grey=0):
    for j in range(max(0, int(y - radius)), min(len(rows), int(y + radius) + 2)):
        for i in range(max(0, int(x - radius)), min(len(rows[0]), int(x + radius) + 2)):
            if (i + 0.5 - x) ** 2 + (j + 0.5 - y) ** 2 <= radius * radius:
                rows[j][i] = grey


def paint_line(rows, a, b, width=6, grey=0):
    steps = 1 + int(2 * max(abs(b[0] - a[0]), abs(b[1] - a[1])))
    for k in range(steps + 1):
        paint_disc(rows, a[0] + (b[0] - a[0]) * k / steps, a[1] + (b[1] - a[1]) * k / steps, width / 2, grey)


def screened():
    """Three grey strokes as a printer of two tones has them, by the ordered matrix of 4 x 4."""
    rows = blank(200, 150)
    for a, b in (((20, 30), (180, 45)), ((30, 120), (170, 60)), ((60, 15), (90, 135))):
        paint_line(rows, a, b, 8, 110)
    matrix = ((0, 8, 2, 10), (12, 4, 14, 6), (3, 11, 1, 9), (15, 7, 13, 5))
    return [bytearray(255 if grey > 16 * matrix[y % 4][x % 4] + 8 else 0 for x, grey in enumerate(row)) for y, row in enumerate(rows)]


def cross():
    """Two strokes that cross in the middle of 160 x 120 px."""
    rows = blank(160, 120)
    paint_line(rows, (20, 60), (140, 60))
    paint_line(rows, (80, 15), (80, 105))
    return rows


def on_ruled_paper(rows):
    """A picture on paper that is ruled every 8 px."""
    return [bytearray(min(grey, 200 if y % 8 == 4 else 255) for grey in row) for y, row in enumerate(rows)]


def lattice():
    """Enough work for some seconds: 24 strokes that cross, 1200 x 900 px."""
    rows = blank(1200, 900)
    for k in range(12):
        paint_line(rows, (20, 30 + 70 * k), (1180, 60 + 68 * k), 5)
        paint_line(rows, (40 + 95 * k, 10), (70 + 94 * k, 890), 5)
    return rows


def fur(seed):
    """70 short strokes that taper, one over the other: 300 x 220 px."""
    chance, rows = random.Random(seed), blank(300, 220)
    for _ in range(70):
        x, y, length = chance.uniform(20, 250), chance.uniform(20, 195), chance.uniform(25, 35)
        for k in range(61):
            t = k / 60
            paint_disc(rows, x + length * t, y - 12 * t * (1 - t) + 12 * t * t, 1.75 - 1.6 * t)
    return rows


def png(rows, colour=False, dots_per_metre=0):
    """The bytes of a PNG file; rows of grey bytes, or of RGB bytes with `colour`."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    width = len(rows[0]) // (3 if colour else 1)
    header = struct.pack('>IIBBBBB', width, len(rows), 8, 2 if colour else 0, 0, 0, 0)
    resolution = chunk(b'pHYs', struct.pack('>IIB', dots_per_metre, dots_per_metre, 1)) if dots_per_metre else b''
    pixels = zlib.compress(b''.join(b'\0' + bytes(row) for row in rows))
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + resolution + chunk(b'IDAT', pixels) + chunk(b'IEND', b'')


def pgm(rows):
    return b'P5 %d %d 255\n' % (len(rows[0]), len(rows)) + b''.join(bytes(row) for row in rows)


class CommandTest(unittest.TestCase):
    """Each test runs in a directory of its own."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix='inkgrid-test-')
        self.addCleanup(scratch.cleanup)
        self.directory = scratch.name

    def path(self, name):
        return os.path.join(self.directory, name)

    def put(self, name, content):
        with open(self.path(name), 'wb') as file:
            file.write(content)
        return name

    def read(self, name):
        with open(self.path(name), 'rb') as file:
            return file.read()

    def files(self):
        return sorted(os.listdir(self.directory))

    def run_program(self, *words, stdin=b'', **more):
        return subprocess.run([PROGRAM, *words], input=stdin, capture_output=True, cwd=self.directory, timeout=300, **more)

    def succeed(self, *words, **more):
        done = self.run_program(*words, **more)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return done

    def refuse(self, code, *words, **more):
        """The run fails with this exit code, one sentence and no change of the directory; the sentence."""
        before = {name: self.content(name) for name in self.files()}
        done = self.run_program(*words, **more)
        message = done.stderr.decode()
        self.assertEqual(done.returncode, code, message)
        self.assertEqual(done.stdout, b'')
        self.assertRegex(message, r'\Ainkgrid: [^\n]+\n\Z')
        self.assertEqual(before, {name: self.content(name) for name in self.files()})
        return message

    def content(self, name):
        return self.read(name) if os.path.isfile(self.path(name)) else None

    def check_svg(self, text):
        """Well-formed, finite, closed paths end where they began, fills are closed; the number of its curves."""
        root = ElementTree.fromstring(text)
        self.assertEqual(root.tag, SVG + 'svg')
        fills = root.findall(".//%sg[@id='fills']/%spath" % (SVG, SVG))
        for number, path in enumerate(fills, 1):
            self.assertEqual(path.get('id'), 'fill-%d' % number)
            for part in re.findall('M[^M]*', path.get('d')):
                self.assertTrue(part.strip().endswith('z'))
                self.check_path(part.strip())
        curves = [path for path in root.iter(SVG + 'path') if path not in fills]
        for number, path in enumerate(curves, 1):
            self.assertEqual(path.get('id'), 'curve-%d' % number)
            self.check_path(path.get('d'))
        return len(curves)

    def check_path(self, data):
        self.assertRegex(data, r'\AM\S+( C\S+ \S+ \S+)+( z)?\Z')
        points = [tuple(map(float, pair)) for pair in re.findall(r'(-?[\d.]+),(-?[\d.]+)', data)]
        self.assertEqual(len(points) % 3, 1)
        if data.endswith('z'):
            self.assertEqual(points[0], points[-1])
