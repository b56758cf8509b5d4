"""What the command does when all is well."""
import json
import os
import pty
import re
import stat
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from support import PROGRAM, SVG, CommandTest, blank, cross, fur, lattice, on_ruled_paper, paint_line, pgm, png, screened

TABLE = {
    'preset': 'auto', 'threshold': 'auto', 'faintest': 'auto', 'soften': 'auto', 'fills': 'layer', 'bundles': 'auto', 'reach': 'auto', 'spacing': 'auto', 'tolerance': 0.12, 'mesh-size': 0.25,
    'degenerate-angle': 30, 'degenerate-ratio': 0.1, 'degenerate-fraction': 0.01, 'field-rounds': 100, 'label-length': 4,
    'label-ratio': 0.48, 'snap': 25, 'snap-sigma': 0.1, 'damping': 0.0001, 'merge-difference': 0.5, 'gap': 'auto', 'details': 20, 'coverage-bins': 4, 'threads': 0,
}

FORMAT_OPTIONS = {'unit': 'auto', 'resolution': 'auto', 'stroke-width': 'measured', 'dxf-curves': 'polylines', 'flatness': 0.05,
                  'png-scale': 1}
PROGRAM_OPTIONS = ['output', 'format', 'project', 'save-project', 'mask', 'report', 'stages', 'quiet', 'help', 'version', 'man']


class Outputs(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('drawing.png', png(cross()))

    def test_beside_the_drawing(self):
        os.mkdir(self.path('sub'))
        self.put('sub/a.b.png', png(cross()))
        self.succeed('sub/a.b.png')
        self.assertEqual(sorted(os.listdir(self.path('sub'))), ['a.b.png', 'a.b.svg'])
        self.assertGreater(self.check_svg(self.read('sub/a.b.svg')), 1)

    def test_named_file(self):
        self.succeed('drawing.png', '-o', 'result.svg')
        self.assertEqual(self.files(), ['drawing.png', 'result.svg'])

    def test_directory(self):
        os.mkdir(self.path('out'))
        self.succeed('drawing.png', '-o', 'out')
        self.assertEqual(os.listdir(self.path('out')), ['drawing.svg'])

    def test_several_drawings(self):
        self.put('second.pgm', pgm(cross()))
        self.succeed('drawing.png', 'second.pgm')
        self.assertEqual(self.files(), ['drawing.png', 'drawing.svg', 'second.pgm', 'second.svg'])
        self.assertEqual(self.read('drawing.svg'), self.read('second.svg'))

    def test_standard_input_goes_to_standard_output(self):
        self.succeed('drawing.png')
        done = self.succeed('-', stdin=self.read('drawing.png'))
        self.assertEqual(done.stdout, self.read('drawing.svg'))

    def test_standard_input_to_a_file(self):
        done = self.succeed('-', '-o', 'out.svg', stdin=self.read('drawing.png'))
        self.assertEqual(done.stdout, b'')
        self.check_svg(self.read('out.svg'))

    def test_file_to_standard_output(self):
        done = self.succeed('drawing.png', '-o', '-')
        self.check_svg(done.stdout)
        self.assertEqual(self.files(), ['drawing.png'])

    def test_old_result_is_replaced_and_keeps_its_mode(self):
        self.put('drawing.svg', b'old')
        os.chmod(self.path('drawing.svg'), 0o640)
        self.succeed('drawing.png')
        self.check_svg(self.read('drawing.svg'))
        self.assertEqual(stat.S_IMODE(os.stat(self.path('drawing.svg')).st_mode), 0o640)

    def test_link_stays_a_link(self):
        self.put('real.svg', b'old')
        os.symlink('real.svg', self.path('link.svg'))
        self.succeed('drawing.png', '-o', 'link.svg')
        self.assertTrue(os.path.islink(self.path('link.svg')))
        self.check_svg(self.read('real.svg'))

    def test_fresh_result_has_the_mode_of_any_new_file(self):
        self.succeed('drawing.png', preexec_fn=lambda: os.umask(0o027))
        self.assertEqual(stat.S_IMODE(os.stat(self.path('drawing.svg')).st_mode), 0o640)

    def test_failed_run_keeps_the_old_result(self):
        self.put('bad.png', b'no drawing')
        self.put('bad.svg', b'old')
        self.refuse(2, 'bad.png')
        self.assertEqual(self.read('bad.svg'), b'old')

    def test_drawing_whose_name_starts_with_a_dash(self):
        self.put('-x.png', png(cross()))
        self.succeed('--', '-x.png')
        self.assertIn('-x.svg', self.files())

    def test_same_bytes_with_one_thread_and_two(self):
        self.succeed('drawing.png', '-o', 'one.svg', '--threads', '1')
        self.succeed('drawing.png', '-o', 'two.svg', '--threads', '2')
        self.assertEqual(self.read('one.svg'), self.read('two.svg'))


class Fur(CommandTest):
    def test_strokes_that_taper_into_each_other_are_drawn(self):
        # Of these both ends of a chain led to one tip, over more than there was of it.
        for seed in 19, 34, 86, 118, 120:
            with self.subTest(seed=seed):
                self.put('fur.png', png(fur(seed)))
                self.succeed('fur.png', '-o', 'fur.svg')
                self.assertIn(b'<path', self.read('fur.svg'))


class Svg(CommandTest):
    def root(self, *options, **drawing):
        self.put('drawing.png', png(cross(), **drawing))
        self.succeed('drawing.png', *options)
        return ElementTree.fromstring(self.read('drawing.svg'))

    def test_size_in_pixels(self):
        root = self.root()
        self.assertEqual((root.get('viewBox'), root.get('width'), root.get('height')), ('0 0 160 120', '160', '120'))

    def test_size_in_millimetres(self):
        root = self.root(dots_per_metre=10000)
        self.assertEqual((root.get('viewBox'), root.get('width'), root.get('height')), ('0 0 160 120', '16mm', '12mm'))

    def test_strokes_have_about_their_width(self):
        for path in self.root().iter(SVG + 'path'):
            self.assertAlmostEqual(float(path.get('stroke-width')), 6, delta=2)

    def test_metadata_tells_version_and_options(self):
        text = self.root('--snap', '30').find(SVG + 'metadata').text
        self.assertRegex(text, r'^inkgrid \d+\.\d+\.\d+ --snap 30 \(')
        self.assertIn('threshold', text)


class Told(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('drawing.png', png(cross()))

    def test_auto_says_what_it_chose(self):
        message = self.succeed('drawing.png').stderr.decode().splitlines()[0]
        self.assertRegex(message, r'^inkgrid: (clean|rough) drawing: threshold [\d.]+, stroke width [\d.]+ px, reach [\d.]+, spacing [\d.]+$')

    def test_softening_is_told(self):
        self.put('screened.png', png(screened()))
        self.assertRegex(self.succeed('screened.png').stderr.decode().splitlines()[0], r', softened by [\d.]+ px$')
        self.succeed('screened.png', '--soften', '1.5')
        self.assertIn(b', softened by 1.5 px)', self.read('screened.svg'))
        self.assertNotIn('softened', self.succeed('screened.png', '--soften', '0').stderr.decode())

    def test_lines_of_the_paper_that_are_left_out_are_told(self):
        self.put('ruled.png', png(on_ruled_paper(cross())))
        self.assertRegex(self.succeed('ruled.png').stderr.decode().splitlines()[0], ', without the lines of the paper$')
        self.succeed('drawing.png')
        self.assertEqual(self.read('ruled.svg').count(b'<path'), self.read('drawing.svg').count(b'<path'))
        self.assertNotIn('the paper', self.succeed('ruled.png', '--faintest', '0.1').stderr.decode())
        self.assertGreater(self.read('ruled.svg').count(b'<path'), 10)

    def test_given_preset_says_nothing(self):
        self.assertNotIn(b'spacing', self.succeed('drawing.png', '--preset', 'clean').stderr)

    def test_quiet(self):
        self.assertEqual(self.succeed('drawing.png', '--quiet').stderr, b'')

    def test_given_values_are_used(self):
        self.succeed('drawing.png', '--report', 'report.json', '--threshold', '100', '--reach', '0.5', '--spacing', '2', '--gap', '3')
        report = json.loads(self.read('report.json'))
        self.assertEqual((report['threshold'], report['reach'], report['spacing'], report['gap']), (100, 0.5, 2, 3))


class Report(CommandTest):
    def test_has_every_field(self):
        self.put('drawing.png', png(cross()))
        self.succeed('drawing.png', '--report', 'report.json', '--snap', '30')
        report = json.loads(self.read('report.json'))
        self.assertEqual(report['options'], {**TABLE, 'snap': 30})
        for field in ('threshold', 'stroke_width', 'ink_pixels', 'reach', 'spacing', 'gap', 'vertices', 'triangles', 'components', 'curves', 'segments'):
            self.assertGreater(report[field], 0, field)
        for field in ('holes', 'field_rounds', 'degenerate_fraction', 'singularities', 'cuts', 'cut_integers', 'snapping_integers',
                      'alignment_energy', 'snapping_energy', 'fallback_components', 'nodes', 'edges'):
            self.assertGreaterEqual(report[field], 0, field)
        self.assertEqual(report['components'], 1)
        self.assertIs(report['inverted'], False)
        self.assertIn(report['preset'], ('clean', 'rough'))
        self.assertEqual(report['curves'], self.check_svg(self.read('drawing.svg')))
        self.assertTrue(report['seconds'])
        self.assertTrue(all(seconds >= 0 for seconds in report['seconds'].values()))
        self.assertIsInstance(report['warnings'], list)

    def test_warnings_are_those_that_are_said(self):
        self.put('blank.pgm', b'P5 40 30 255\n' + b'\xff' * 1200)
        done = self.succeed('blank.pgm', '--report', 'report.json', '--preset', 'clean')
        warnings = json.loads(self.read('report.json'))['warnings']
        self.assertGreater(len(warnings), 0)
        self.assertEqual(done.stderr.decode(), ''.join('inkgrid: %s\n' % warning for warning in warnings))

    def test_to_standard_output(self):
        self.put('drawing.png', png(cross()))
        done = self.succeed('drawing.png', '--report', '-')
        self.assertIn('stroke_width', json.loads(done.stdout))


class Stages(CommandTest):
    def test_pictures_of_every_stage(self):
        self.put('drawing.png', png(cross()))
        self.succeed('drawing.png', '--stages', 'deep/stages')
        names = sorted(os.listdir(self.path('deep/stages')))
        self.assertEqual(names, ['1-ink.png', '2-strokes.png', '3-band.png', '4-field.png', '5-labels.png', '6-grid.png', '7-chains.png', '8-curves.png'])
        for name in names:
            self.assertTrue(self.read('deep/stages/' + name).startswith(b'\x89PNG'))


class Mask(CommandTest):
    """Two strokes of 6 px become one component of the band when their gap is less than twice the reach."""

    def components(self, gap, colour=None):
        rows = blank(160, 120)
        for side in (-1, 1):
            y = 60 + side * (3 + gap / 2)
            paint_line(rows, (20, y), (140, y))
        self.put('drawing.png', png(rows))
        mask = ['--mask', self.put('mask.png', png([bytearray(colour * 160) for _ in range(120)], colour=True))] if colour else []
        self.succeed('drawing.png', '--threshold', '128', '--reach', '0.3', '--spacing', '1', '--report', 'report.json', *mask)
        return json.loads(self.read('report.json'))['components']

    def test_orange_doubles_the_reach(self):
        self.assertEqual(self.components(gap=6), 2)
        self.assertEqual(self.components(gap=6, colour=bytes([255, 150, 0])), 1)

    def test_purple_halves_the_reach(self):
        self.assertEqual(self.components(gap=3), 1)
        self.assertEqual(self.components(gap=3, colour=bytes([160, 32, 240])), 2)


class Help(CommandTest):
    def test_lists_every_option(self):
        text = self.succeed('--help').stdout.decode()
        for name in [*TABLE, *FORMAT_OPTIONS, *PROGRAM_OPTIONS]:
            self.assertRegex(text, r'(?m)^  (-\w, )?--%s\b' % name)
        for name, default in [*TABLE.items(), *FORMAT_OPTIONS.items()]:
            entry = re.search(r'(?ms)^  --%s\b.*?(?=^  --|^\S)' % name, text).group(0)
            self.assertIn('default %s' % default, ' '.join(entry.split()))

    def test_fits_a_terminal(self):
        self.assertLessEqual(max(map(len, self.succeed('--help').stdout.decode().splitlines())), 80)

    def test_version(self):
        self.assertRegex(self.succeed('--version').stdout.decode(), r'\Ainkgrid \d+\.\d+\.\d+\n\Z')

    def test_help_wins_over_a_missing_drawing(self):
        self.assertEqual(self.succeed('-h').stdout, self.succeed('--help').stdout)


class Manual(CommandTest):
    def test_structure(self):
        lines = self.succeed('--man').stdout.decode().splitlines()
        self.assertRegex(lines[0], r'^\.TH INKGRID 1 ')
        sections = [line[4:] for line in lines if line.startswith('.SH ')]
        self.assertEqual(sections, ['NAME', 'SYNOPSIS', 'DESCRIPTION', 'OPTIONS', 'FORMATS', 'PARAMETERS', 'COMPARE', 'EXIT STATUS',
                                    'EXAMPLES'])
        self.assertEqual(lines[lines.index('.SH NAME') + 1].split()[:2], ['inkgrid', '\\-'])
        for line in lines:
            if line.startswith('.'):
                self.assertIn(line.split()[0], ('.TH', '.SH', '.TP', '.B', '.br', '.nf', '.fi'))
            self.assertNotIn("'", line[:1])

    def test_describes_every_option_as_the_help_does(self):
        page = self.succeed('--man').stdout.decode().replace('\\-', '-')
        method, compare = page.split('.SH COMPARE')
        options = len(TABLE) + len(FORMAT_OPTIONS) + len(PROGRAM_OPTIONS)
        for part, command, count in ((method, ('--help',), options), (compare, ('compare', '--help'), 5)):
            described = re.findall(r'(?m)^\.TP\n\.B (-.*)\n(.*)\.$', part)
            text = ' '.join(self.succeed(*command).stdout.decode().split())
            self.assertEqual(len(described), count)
            for flags, meaning in described:
                self.assertIn('%s %s' % (flags, meaning), text)


class Progress(CommandTest):
    def test_of_a_long_run_on_a_terminal(self):
        self.put('drawing.png', png(lattice()))
        ours, theirs = pty.openpty()
        with subprocess.Popen([PROGRAM, 'drawing.png', '-q'], cwd=self.directory, stderr=theirs) as running:
            os.close(theirs)
            said = b''
            try:
                while piece := os.read(ours, 4096):
                    said += piece
            except OSError:  # the end, as Linux tells it
                pass
        os.close(ours)
        self.assertEqual(running.returncode, 0)
        self.assertRegex(said, rb'^(\rinkgrid: [a-z ]+ \d+ %\x1b\[K)+\r\x1b\[K$')

    def test_is_silent_where_standard_error_is_no_terminal(self):
        self.put('drawing.png', png(cross()))
        self.assertNotIn(b'\r', self.succeed('drawing.png').stderr)


if __name__ == '__main__':
    unittest.main()
