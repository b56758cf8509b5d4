"""bench/ablation and bench/pictures, on drawings of a few strokes."""
import csv
import importlib.util
import os
import re
import subprocess
import sys
import unittest

from support import PROGRAM, CommandTest, blank, cross, paint_line, png

BENCH = os.path.join(os.environ['INKGRID_SOURCE'], 'bench')


def broken_line():
    """A stroke of 6 px with 3 px of paper in it."""
    rows = blank(240, 80)
    for a, b in (((20, 40), (100, 40)), ((109, 40), (220, 40))):
        paint_line(rows, a, b)
    return png(rows)


class BenchTest(CommandTest):
    def bench(self, script, *words, exit_code=0):
        done = subprocess.run([sys.executable, '-B', os.path.join(BENCH, script), *words, '--program', PROGRAM], cwd=self.directory,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return done


class HelpOfBenches(CommandTest):
    def test_of_scripts_that_build_what_they_need(self):
        for name in 'rerun', 'rounding':
            with self.subTest(name=name):
                done = subprocess.run([os.path.join(BENCH, name), '--help'], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ''))
                self.assertTrue(done.stdout.startswith(f'bench/{name} '), done.stdout)


class Ablation(BenchTest):
    def setUp(self):
        super().setUp()
        truth = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 80" data-pen="6" fill="none" stroke="black"><path d="M20 40H220"/></svg>'
        for group in ('clean', 'rough'):
            os.makedirs(self.path(f'corpus/{group}'))
            for name in ('a', 'b', 'c'):
                self.put(f'corpus/{group}/{name}.png', broken_line())
                self.put(f'corpus/{group}/{name}.gt.svg', truth)

    def rows(self):
        with open(self.path('out/ablation.csv'), newline='') as file:
            return list(csv.DictReader(file))

    def test_a_step_that_is_off_shows(self):
        done = self.bench('ablation', 'corpus', '--out', 'out', '--set', 'clean', '--every', '2', '--step', 'gaps')
        self.assertEqual([(row['step'], row['name']) for row in self.rows()], [('all', 'a'), ('all', 'c'), ('gaps', 'a'), ('gaps', 'c')])
        self.assertGreater(float(self.rows()[0]['segments_ratio']), 0)
        self.assertGreater(float(self.rows()[2]['segments_ratio']), float(self.rows()[0]['segments_ratio']), 'a stroke more')
        table = [line for line in done.stdout.splitlines() if line.startswith('|')]
        self.assertEqual(len({line.count('|') for line in table}), 1)
        self.assertRegex(table[-1], r'^\| gaps are not bridged \| \d\.\d{4} \([+-]\d\.\d{4}\) \|')

    def test_every_step_has_options_that_the_program_takes(self):
        self.bench('ablation', 'corpus', '--out', 'out', '--only', '/a')
        steps = {row['step']: row['set'] for row in self.rows()}
        self.assertGreater(len(steps), 10)
        self.assertEqual([steps['slim'], steps['bundles']], ['clean', 'rough'])
        self.assertEqual([row['problem'] for row in self.rows() if row['problem']], [])

    def test_without_a_truth_there_is_nothing_to_do(self):
        os.makedirs(self.path('empty'))
        self.assertIn('no drawing', self.bench('ablation', 'empty', exit_code=1).stderr)


@unittest.skipUnless(all(map(importlib.util.find_spec, ('cairo', 'PIL'))), 'Pillow or pycairo is missing')
class Pictures(BenchTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path('drawings'))
        self.put('drawings/cross.png', png(cross()))
        self.put('drawings/broken & line.png', broken_line())

    def test_a_page_shows_every_drawing(self):
        from PIL import Image
        self.bench('pictures', 'drawings', '--out', 'out', '--gallery', 'gallery.png')
        text = self.read('out/index.html').decode()
        self.assertEqual(re.findall(r'<h2>(.*?) <span>', text), ['broken &amp; line', 'cross'])
        for file in re.findall(r'src="(.*?)"', text):
            self.assertTrue(os.path.exists(self.path('out/' + file.replace('&amp;', '&'))), file)
        before, over = (Image.open(self.path(f'out/cross-{part}.png')) for part in ('input', 'over'))
        self.assertEqual(before.size, over.size)
        coloured = lambda picture: sum(max(p) - min(p) > 60 for p in picture.convert('RGB').getdata())
        self.assertEqual(coloured(before), 0)
        self.assertGreater(coloured(over), 1000)
        gallery = Image.open(self.path('gallery.png'))
        self.assertGreater(coloured(gallery), 100)
        self.assertEqual(gallery.convert('RGB').getpixel((0, 0)), (255, 255, 255))

    def test_what_fails_is_told_and_the_others_are_shown(self):
        self.put('drawings/cut.png', png(cross())[:100])
        self.bench('pictures', 'drawings', '--out', 'out', exit_code=1)
        text = self.read('out/index.html').decode()
        self.assertRegex(text, r'<h2>cut <span>[^<]*truncated or damaged')
        self.assertEqual(text.count('<figure>'), 6)


if __name__ == '__main__':
    unittest.main()
