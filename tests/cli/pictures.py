"""Pictures as rows of grey bytes: read from files, and drawn from the curves of a graph."""
import math
import re
import struct
import zlib


def from_pgm(data):
    width, height = map(int, re.match(rb'P5\s(?:#.*\n)*(\d+)\s(\d+)\s255\s', data).groups())
    pixels = data[len(data) - width * height:]
    return [pixels[width * y:width * (y + 1)] for y in range(height)]


def from_png(data):
    """8 bits a channel; a row of greys is that of the first channel over white."""
    width, height, depth, colour = struct.unpack('>IIBB', data[16:26])
    assert depth == 8
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    rows = unfiltered(zlib.decompress(chunks(data, b'IDAT')), width * channels, height, channels)
    if channels in (1, 3):
        return [row[::channels] for row in rows]
    return [bytes(255 - a + g * a // 255 for g, a in zip(row[::channels], row[channels - 1::channels])) for row in rows]


def chunks(data, wanted):
    found, at = b'', 8
    while at < len(data):
        length, kind = struct.unpack('>I4s', data[at:at + 8])
        if kind == wanted:
            found += data[at + 8:at + 8 + length]
        at += length + 12
    return found


def unfiltered(data, length, height, step):
    """PNG, section 9: each row was written as differences from its neighbours."""
    rows, above = [], bytearray(length)
    for y in range(height):
        kind, row = data[y * (length + 1)], bytearray(data[y * (length + 1) + 1:(y + 1) * (length + 1)])
        for x in range(length):
            a, b, c = row[x - step] if x >= step else 0, above[x], above[x - step] if x >= step else 0
            row[x] = row[x] + (0, a, b, (a + b) // 2, paeth(a, b, c))[kind] & 255
        rows.append(bytes(row))
        above = row
    return rows


def paeth(a, b, c):
    return min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]


def reduced(rows, factor):
    """Each pixel the mean of factor x factor ones."""
    return [bytes(sum(sum(row[x:x + factor]) for row in rows[y:y + factor]) // factor ** 2 for x in range(0, len(rows[0]), factor))
            for y in range(0, len(rows), factor)]


def points_on(curve, step=0.25):
    """Points of a curve of the graph, at most about `step` apart."""
    controls = curve['points']
    found = [tuple(controls[0])]
    for i in range(0, len(controls) - 1, 3):
        p = controls[i:i + 4]
        count = 1 + int(sum(math.dist(a, b) for a, b in zip(p, p[1:])) / step)
        for k in range(1, count + 1):
            t = k / count
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3)
            found.append(tuple(sum(w * q[axis] for w, q in zip(weights, p)) for axis in (0, 1)))
    return found


def covered(outlines, x, y, samples=4):
    """The part of a pixel that is inside, by the crossings of rays to the left."""
    inside = 0
    for k in range(samples):
        level = y + (k + 0.5) / samples
        crossings = [p[0] + (level - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
                     for points in outlines for p, q in zip(points, points[1:]) if (p[1] > level) != (q[1] > level)]
        inside += sum(sum(c < x + (i + 0.5) / samples for c in crossings) % 2 for i in range(samples))
    return inside / samples ** 2


def fill(ink, outlines):
    xs, ys = zip(*(p for points in outlines for p in points))
    for y in range(max(0, int(min(ys))), min(len(ink), int(max(ys)) + 1)):
        for x in range(max(0, int(min(xs))), min(len(ink[0]), int(max(xs)) + 1)):
            ink[y][x] = max(ink[y][x], covered(outlines, x, y))


def drawn(graph, width=None):
    """Black strokes on white, by the distance of each pixel to the curves, of their measured widths or of one width; and fills."""
    ink = [[0.0] * graph['width'] for _ in range(graph['height'])]
    for area in graph['fills']:
        fill(ink, [points_on({'points': points}) for points in area['outlines']])
    for curve in graph['curves']:
        radius = (width or curve['width']) / 2
        for px, py in points_on(curve):
            for y in range(max(0, int(py - radius - 1)), min(graph['height'], int(py + radius + 2))):
                for x in range(max(0, int(px - radius - 1)), min(graph['width'], int(px + radius + 2))):
                    ink[y][x] = max(ink[y][x], min(1.0, radius + 0.5 - math.hypot(x + 0.5 - px, y + 0.5 - py)))
    return [bytes(round(255 - 255 * value) for value in row) for row in ink]


def difference(a, b):
    """Mean over all pixels, 0 to 255; infinite between pictures of different sizes."""
    if (len(a), len(a[0])) != (len(b), len(b[0])):
        return math.inf
    return sum(abs(p - q) for r, s in zip(a, b) for p, q in zip(r, s)) / (len(a) * len(a[0]))
