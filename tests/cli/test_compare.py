"""`inkgrid compare`, against measures worked out here by brute force."""
import importlib.util
import json
import math
import os
import random
import subprocess
import sys
import unittest

from support import CommandTest

USAGE, FILE = 1, 2
STEP = 0.5   # px, between samples
SOURCE = os.environ['INKGRID_SOURCE']
SCORERS = os.environ.get('INKGRID_SCORERS', os.path.join(SOURCE, '..', 'shared', 'eval'))


def svg(polylines, attributes='data-pen="4"'):
    paths = ''.join('<path fill="none" stroke="black" d="M%s"/>' % ' '.join('%r,%r' % p for p in line) for line in polylines)
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 300" %s>%s</svg>' % (attributes, paths)).encode()


class Samples:
    """Points in the middle of equal pieces of each polyline, with direction and length of the piece."""

    def __init__(self, polylines):
        self.rows = []
        for line in polylines:
            sides = [math.dist(p, q) for p, q in zip(line, line[1:])]
            count = max(2, math.ceil(sum(sides) / STEP))
            for k in range(count):
                at = (k + 0.5) * sum(sides) / count
                i = 0
                while at > sides[i]:
                    at -= sides[i]
                    i += 1
                (ax, ay), (bx, by) = line[i], line[i + 1]
                t = at / sides[i]
                self.rows.append((ax + t * (bx - ax), ay + t * (by - ay), math.atan2(by - ay, bx - ax), sum(sides) / count))
        self.length = sum(row[3] for row in self.rows)

    def distances(self, other):
        return [min(math.hypot(x - u, y - v) for u, v, _, _ in other.rows) for x, y, _, _ in self.rows]

    def agreeing(self, other, tolerance):
        """Length of the samples that have one of the other side near with about their tangent."""
        limit = math.cos(math.radians(30))
        return sum(w for x, y, a, w in self.rows
                   if any(abs(math.cos(a - b)) >= limit and math.hypot(x - u, y - v) < tolerance for u, v, b, _ in other.rows))

    def mean(self, distances, cap=math.inf):
        return sum(min(d, cap) * row[3] for d, row in zip(distances, self.rows)) / self.length

    def percentile(self, distances, share):
        passed = 0
        for d, w in sorted((d, row[3]) for d, row in zip(distances, self.rows)):
            passed += w
            if passed >= share * self.length:
                return d

    def within(self, distances, limit):
        return sum(row[3] for d, row in zip(distances, self.rows) if d < limit) / self.length


def harmonic(a, b):
    return 2 * a * b / (a + b) if a + b else 0


def measures(result, truth, tolerance, distance):
    a, b = Samples(result), Samples(truth)
    da, db = a.distances(b), b.distances(a)
    found = {t: (a.agreeing(b, t) / a.length, b.agreeing(a, t) / b.length) for t in (tolerance, tolerance / 2)}
    return {
        'precision': found[tolerance][0], 'recall': found[tolerance][1], 'f1': harmonic(*found[tolerance]),
        'f1_half_tolerance': harmonic(*found[tolerance / 2]),
        'duplicate_ratio': found[tolerance][0] * a.length / (found[tolerance][1] * b.length),
        'without_tangents': {'precision': a.within(da, tolerance), 'recall': b.within(db, tolerance)},
        'chamfer': (a.mean(da, 20) + b.mean(db, 20)) / 2, 'hausdorff95': max(a.percentile(da, 0.95), b.percentile(db, 0.95)),
        'length_ratio': a.length / b.length,
        'benchmark': {'chamfer': (a.mean(da) + b.mean(db)) / 2, 'hausdorff': max(da + db),
                      'f_score': {'precision': a.within(da, distance), 'recall': b.within(db, distance)}},
    }


def wavering(rng, start, steps):
    """A polyline whose turns are random."""
    line, angle = [start], rng.uniform(0, 2 * math.pi)
    for _ in range(steps):
        angle += rng.gauss(0, 0.5)
        line.append((round(line[-1][0] + 9 * math.cos(angle), 2), round(line[-1][1] + 9 * math.sin(angle), 2)))
    return line


def disturbed(rng, polylines, by):
    """Moved points, a lost line and a doubled one."""
    moved = [[(round(x + rng.gauss(0, by), 2), round(y + rng.gauss(0, by), 2)) for x, y in line] for line in polylines]
    return moved[1:] + [[(x + 0.7, y + 0.4) for x, y in moved[-1]]]


class CompareMeasures(CommandTest):
    def compare(self, *words):
        return json.loads(self.succeed('compare', 'result.svg', 'truth.svg', '--json', *words).stdout)

    def check(self, expected, measured, path=''):
        for name, value in expected.items():
            if isinstance(value, dict):
                self.check(value, measured[name], path + name + '.')
            else:
                self.assertAlmostEqual(measured[name], value, delta=2e-3 * max(1, value), msg=path + name)

    def test_are_those_of_brute_force(self):
        rng = random.Random(3)
        for by in (0.4, 1.2, 3):
            truth = [wavering(rng, (rng.uniform(50, 350), rng.uniform(50, 250)), 6) for _ in range(4)]
            result = disturbed(rng, truth, by)
            self.put('truth.svg', svg(truth))
            self.put('result.svg', svg(result))
            with self.subTest(by=by):
                self.check(measures(result, truth, 2, 0.8), self.compare())
                self.check(measures(result, truth, 3.3, 1.2), self.compare('--tolerance', '3.3', '--distance', '3'))

    def test_result_in_another_unit_is_fitted(self):
        rng = random.Random(4)
        truth = [wavering(rng, (200, 150), 6)]
        self.put('truth.svg', svg(truth))
        self.put('result.svg', svg(truth, 'width="120mm" height="90mm"'))
        fitted = self.compare()
        self.assertEqual(len(fitted['notes']), 1)
        self.put('result.svg', svg(truth))
        self.assertEqual(dict(fitted, notes=[]), self.compare())

    def test_result_of_the_program_agrees_with_a_sample(self):
        truth = os.path.join(SOURCE, 'samples', 'truth', 'junctions.gt.svg')
        subprocess.run(['rsvg-convert', os.path.join(SOURCE, 'samples', 'junctions.svg'), '-o', self.path('drawing.png')], check=True)
        self.succeed('drawing.png', '-o', 'result.svg')
        measured = json.loads(self.succeed('compare', 'result.svg', truth, '--json').stdout)
        self.assertGreater(measured['f1'], 0.95)


class CompareText(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('a.svg', svg([[(50, 100), (350, 100)]]))
        self.put('b.svg', svg([[(50, 105), (350, 105)]]))

    def test_names_the_measures(self):
        text = self.succeed('compare', 'a.svg', 'a.svg').stdout.decode()
        self.assertRegex(text, r'(?m)^length +1 +1 +1$')
        for word in ('tolerance 2 px', 'junctions', 'ends', 'duplicate ratio', 'Chamfer', 'Hausdorff', 'segments', 'benchmark'):
            self.assertIn(word, text)

    def test_result_from_standard_input(self):
        self.assertEqual(self.succeed('compare', '-', 'b.svg', stdin=self.read('a.svg')).stdout, self.succeed('compare', 'a.svg', 'b.svg').stdout)

    def test_tolerance_in_pens(self):
        f1 = lambda *words: json.loads(self.succeed('compare', 'a.svg', 'b.svg', '--json', *words).stdout)['f1']
        self.assertEqual((f1(), f1('--tolerance-pens', '1.2'), f1('--tolerance-pens', '1.3')), (0, 0, 1))

    def test_help_lists_the_options(self):
        text = self.succeed('compare', '--help').stdout.decode()
        for name in ('json', 'tolerance', 'tolerance-pens', 'distance', 'help'):
            self.assertRegex(text, r'(?m)^  (-\w, )?--%s\b' % name)
        self.assertLessEqual(max(map(len, text.splitlines())), 80)


class CompareRefusals(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('good.svg', svg([[(50, 100), (350, 100)]]))

    def test_files_that_are_no_svg(self):
        for name, content in (('empty.svg', b''), ('text.svg', b'Dear reader'), ('page.svg', b'<html/>'), ('cut.svg', self.read('good.svg')[:-9]),
                              ('noise.svg', random.Random(1).randbytes(3000)), ('huge.svg', svg([[(0, 0), (1e8, 0)]])),
                              ('sizeless.svg', b'<svg><path d="M0 0L1 1"/></svg>')):
            with self.subTest(name):
                self.put(name, content)
                self.assertIn(name, self.refuse(FILE, 'compare', 'good.svg', name))
                if name != 'sizeless.svg':    # a result takes the size of the truth
                    self.assertIn(name, self.refuse(FILE, 'compare', name, 'good.svg'))

    def test_files_that_are_missing(self):
        self.assertIn('none.svg', self.refuse(FILE, 'compare', 'none.svg', 'good.svg'))
        self.assertIn('none.svg', self.refuse(FILE, 'compare', 'good.svg', 'none.svg'))

    def test_command_lines(self):
        for words in ((), ('good.svg',), ('good.svg', 'good.svg', 'good.svg'), ('good.svg', 'good.svg', '--frobnicate'), ('-', '-'),
                      ('good.svg', 'good.svg', '--tolerance'), ('good.svg', 'good.svg', '--tolerance', '0'),
                      ('good.svg', 'good.svg', '--tolerance', 'wide'), ('good.svg', 'good.svg', '--tolerance-pens', '-1'),
                      ('good.svg', 'good.svg', '--distance', 'nan')):
            with self.subTest(words=words):
                self.refuse(USAGE, 'compare', *words)


@unittest.skipUnless(os.path.exists(os.path.join(SCORERS, 'score.py')) and all(map(importlib.util.find_spec, ('numpy', 'scipy'))),
                     'no scorer beside the project, or nothing to run it with')
class CompareScorer(CommandTest):
    """The measures are those of the scorer that the corpus comes with."""

    NAMES = (('precision',) * 2, ('recall',) * 2, ('f1',) * 2, ('f1_half_tol', 'f1_half_tolerance'), ('duplicate_ratio',) * 2, ('chamfer',) * 2,
             ('hausdorff95',) * 2, ('length_ratio',) * 2, ('segments_ratio',) * 2, ('curves_ratio',) * 2)

    def test_on_the_samples(self):
        folder = os.path.join(SOURCE, 'samples', 'truth')
        for name in sorted(os.listdir(folder)):
            truth = os.path.join(folder, name)
            with open(truth) as file:
                moved = file.read().replace('<g ', '<g transform="rotate(0.3) translate(1.2 -0.7)" ', 1)
            self.put('moved.svg', moved.encode())
            done = subprocess.run([sys.executable, os.path.join(SCORERS, 'score.py'), self.path('moved.svg'), truth, '--json'],
                                  capture_output=True, check=True)
            theirs, ours = json.loads(done.stdout), json.loads(self.succeed('compare', 'moved.svg', truth, '--json').stdout)
            pairs = [(theirs[a], ours[b]) for a, b in self.NAMES]
            pairs += [(theirs[a][k], ours[b][k]) for a, b in (('junctions', 'junctions'), ('endpoints', 'ends')) for k in ('precision', 'recall', 'f1')]
            for their_value, our_value in pairs:
                self.assertAlmostEqual(their_value, our_value, delta=0.005, msg=name)


if __name__ == '__main__':
    unittest.main()
