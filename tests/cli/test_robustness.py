"""bench/robustness: disturbed drawings, mapped back, are the drawing again."""
import csv
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import unittest

from support import PROGRAM, CommandTest, blank, paint_line, png

BENCH = os.path.join(os.environ['INKGRID_SOURCE'], 'bench')
NAMES = ['threshold-10', 'threshold+10', 'size-x0.5', 'size-x2', 'turn-90', 'turn-180', 'turn-270', 'mirror', 'jpeg-60', 'noise']


def script():
    sys.path.insert(0, BENCH)
    loader = importlib.machinery.SourceFileLoader('robustness', os.path.join(BENCH, 'robustness'))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader('robustness', loader))
    loader.exec_module(module)
    return module


@unittest.skipUnless(all(map(importlib.util.find_spec, ('numpy', 'PIL'))), 'Pillow or numpy is missing')
class Robustness(CommandTest):
    def test_matrices_map_back(self):
        """The dark square of the disturbed picture, mapped back, is where it was."""
        import numpy
        from PIL import Image
        picture = Image.new('L', (90, 60), 255)
        picture.paste(0, (70, 8, 74, 12))
        disturbances = list(script().disturbances(picture, 128, 1))
        self.assertEqual([d.name for d in disturbances], NAMES)
        for d in disturbances:
            pixels = numpy.asarray(d.picture or picture, float)
            ys, xs = numpy.nonzero(pixels < 128)
            x, y = xs.mean() + 0.5, ys.mean() + 0.5
            a, b, c, e, f, g = d.matrix
            with self.subTest(d.name):
                self.assertAlmostEqual(a * x + c * y + f, 72, delta=0.6)
                self.assertAlmostEqual(b * x + e * y + g, 10, delta=0.6)

    def test_noise_is_the_same_each_time(self):
        from PIL import Image
        module, picture = script(), Image.new('L', (40, 30), 128)
        self.assertEqual(module.noisy(picture, 7).tobytes(), module.noisy(picture, 7).tobytes())
        self.assertNotEqual(module.noisy(picture, 7).tobytes(), module.noisy(picture, 8).tobytes())

    def test_of_a_simple_drawing(self):
        rows = blank(240, 160)
        for a, b in (((20, 30), (210, 60)), ((60, 20), (90, 140)), ((150, 140), (200, 90))):
            paint_line(rows, a, b)
        os.makedirs(self.path('corpus/set'))
        self.put('corpus/set/drawing.png', png(rows))
        self.put('corpus/set/drawing.gt.svg', b'<svg data-set="clean" data-pen="6"/>')
        command = [sys.executable, '-B', os.path.join(BENCH, 'robustness'), 'corpus', '--out', 'out', '--program', PROGRAM]
        done = subprocess.run(command, cwd=self.directory, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path('out/robustness.csv'), newline='') as file:
            found = {row['disturbance']: float(row['f1']) for row in csv.DictReader(file)}
        self.assertEqual(list(found), NAMES)
        for name, f1 in found.items():
            self.assertGreater(f1, 0.95, name)
        for name in NAMES:
            self.assertIn(name, done.stdout)


if __name__ == '__main__':
    unittest.main()
