"""Whatever is given: one sentence, the right exit code, nothing half-written."""
import os
import random
import signal
import subprocess
import time
import unittest

from support import PROGRAM, CommandTest, blank, cross, lattice, paint_line, pgm, png

USAGE, FILE = 1, 2


class FilesThatAreNoDrawing(CommandTest):
    def test_missing(self):
        self.assertIn('nowhere.png', self.refuse(FILE, 'nowhere.png'))

    def test_directory(self):
        os.mkdir(self.path('folder.png'))
        self.assertIn('folder.png', self.refuse(FILE, 'folder.png'))

    def test_empty(self):
        self.refuse(FILE, self.put('empty.png', b''))

    def test_empty_standard_input(self):
        self.refuse(FILE, '-')

    def test_truncated(self):
        whole = png(cross())
        for part in (4, 20, 40, len(whole) // 2):
            with self.subTest(bytes=part):
                self.refuse(FILE, self.put('short.png', whole[:part]))

    def test_truncated_pixels_of_a_pgm(self):
        self.refuse(FILE, self.put('short.pgm', pgm(cross())[:-5000]))

    def test_text_named_png(self):
        self.assertIn('letter.png', self.refuse(FILE, self.put('letter.png', b'Dear reader,\n' * 40)))

    def test_noise_named_png(self):
        self.refuse(FILE, self.put('noise.png', random.Random(7).randbytes(5000)))

    def test_header_that_promises_too_much(self):
        self.refuse(FILE, self.put('huge.pgm', b'P5 400000 400000 255\n' + b'\0' * 100))

    def test_good_drawings_after_a_bad_one_are_made(self):
        self.put('bad.png', b'nothing')
        self.put('good.png', png(cross()))
        done = self.run_program('bad.png', 'good.png', '--quiet')
        self.assertEqual(done.returncode, FILE)
        self.assertRegex(done.stderr.decode(), r'\Ainkgrid: [^\n]*bad\.png[^\n]*\n\Z')
        self.assertEqual(self.files(), ['bad.png', 'good.png', 'good.svg'])


class DrawingsThatAreOdd(CommandTest):
    """A valid file is a valid drawing, however odd."""

    def vectorize(self, rows, *options):
        self.put('odd.pgm', pgm(rows))
        done = self.succeed('odd.pgm', *options)
        return self.check_svg(self.read('odd.svg')), done.stderr.decode()

    def test_renamed_drawing_is_read_by_content(self):
        self.put('really-a-png.jpg', png(cross()))
        self.succeed('really-a-png.jpg')
        self.assertGreater(self.check_svg(self.read('really-a-png.svg')), 0)

    def test_one_pixel(self):
        for grey in (0, 128, 255):
            self.vectorize(blank(1, 1, grey))

    def test_one_row_and_one_column(self):
        for rows in (blank(300, 1), blank(300, 1, 0), blank(1, 300), blank(1, 300, 0)):
            self.vectorize(rows)
        dashed = blank(300, 1)
        for x in range(300):
            dashed[0][x] = 0 if x // 20 % 2 else 255
        self.vectorize(dashed)

    def test_blank_paper_is_an_empty_drawing_with_a_warning(self):
        for grey in (255, 230, 128):
            curves, message = self.vectorize(blank(200, 100, grey))
            self.assertEqual(curves, 0)
            self.assertRegex(message, r'\Ainkgrid: [^\n]+\n\Z')
            self.assertEqual(self.succeed('odd.pgm', '--quiet').stderr, b'')

    def test_all_black(self):
        self.vectorize(blank(200, 100, 0))
        self.vectorize(blank(200, 100, 0), '--threshold', '128')

    def test_pure_noise(self):
        noise = random.Random(1)
        self.vectorize([bytearray(noise.randbytes(100)) for _ in range(80)])

    def test_wide_strip(self):
        strip = blank(20000, 24)
        for x in range(20000):
            for y in range(10, 15):
                strip[y][x] = 0
        curves, _ = self.vectorize(strip)
        self.assertGreater(curves, 0)

    def test_specks(self):
        rows = blank(100, 100)
        for x, y in ((10, 10), (50, 20), (30, 70)):
            rows[y][x] = 0
        self.vectorize(rows)

    def test_ink_along_the_frame_of_the_image(self):
        rows = blank(120, 80)
        for a, b in (((0, 0), (120, 0)), ((120, 0), (120, 80)), ((120, 80), (0, 80)), ((0, 80), (0, 0))):
            paint_line(rows, a, b)
        curves, _ = self.vectorize(rows)
        self.assertGreater(curves, 0)


class OutputsThatCantBe(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('drawing.png', png(cross()))

    def test_directory_that_is_missing(self):
        self.refuse(FILE, 'drawing.png', '-o', 'missing/out.svg')

    def test_output_below_a_file(self):
        self.refuse(FILE, 'drawing.png', '-o', 'drawing.png/out.svg')

    def test_report_that_cant_be_written(self):
        self.refuse(FILE, 'drawing.png', '--report', 'missing/report.json')

    def test_stages_below_a_file(self):
        self.put('letter.txt', b'Dear reader')
        self.refuse(FILE, 'drawing.png', '--stages', 'letter.txt')
        self.refuse(FILE, 'drawing.png', '--stages', 'drawing.png/stages')

    def test_name_that_is_too_long(self):
        self.refuse(FILE, 'drawing.png', '-o', 'x' * 300 + '.svg')

    def test_report_in_place_of_a_directory(self):
        os.mkdir(self.path('folder'))
        self.refuse(FILE, 'drawing.png', '--report', 'folder')

    def test_full_device(self):
        self.assertIn('/dev/full', self.refuse(FILE, 'drawing.png', '--quiet', '-o', '/dev/full'))
        self.assertTrue(os.path.exists('/dev/full'))

    def test_full_standard_output(self):
        with open('/dev/full', 'wb') as full:
            done = subprocess.run([PROGRAM, 'drawing.png', '-q', '-o', '-'], stdout=full, stderr=subprocess.PIPE, cwd=self.directory)
        self.assertEqual(done.returncode, FILE)
        self.assertRegex(done.stderr.decode(), r'\Ainkgrid: [^\n]+\n\Z')

    def test_unwritable_output_is_told_before_the_drawing_is_read(self):
        message = self.refuse(FILE, 'nowhere.png', '-o', 'missing/out.svg')
        self.assertIn('missing/out.svg', message)

    @unittest.skipIf(os.geteuid() == 0 and not os.path.exists('/usr/bin/setpriv'), 'root may write everywhere')
    def test_read_only_directory(self):
        os.chmod(self.directory, 0o555)
        self.addCleanup(os.chmod, self.directory, 0o755)
        words = [PROGRAM, 'drawing.png']
        if os.geteuid() == 0:
            words = ['setpriv', '--reuid=65534', '--regid=65534', '--clear-groups', *words]
        done = subprocess.run(words, capture_output=True, cwd=self.directory)
        self.assertEqual(done.returncode, FILE, done.stderr)
        self.assertEqual(self.files(), ['drawing.png'])

    def test_interrupted_run_leaves_nothing(self):
        self.put('drawing.png', png(lattice()))
        for delay in (0.02, 0.3):
            running = subprocess.Popen([PROGRAM, 'drawing.png'], cwd=self.directory, stderr=subprocess.PIPE)
            time.sleep(delay)
            running.send_signal(signal.SIGINT)
            running.communicate()
            self.assertEqual(running.returncode, -signal.SIGINT)
            self.assertEqual(self.files(), ['drawing.png'])


class CommandLinesThatContradict(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('drawing.png', png(cross()))

    def test_nothing_to_do(self):
        self.refuse(USAGE)

    def test_unknown_option(self):
        self.assertIn('--frobnicate', self.refuse(USAGE, 'drawing.png', '--frobnicate'))

    def test_option_without_value(self):
        self.assertIn('threshold', self.refuse(USAGE, 'drawing.png', '--threshold'))

    def test_option_given_twice(self):
        self.assertIn('snap', self.refuse(USAGE, 'drawing.png', '--snap', '20', '--snap', '30'))

    def test_empty_name(self):
        for option in ('-o', '--output', '--format', '--project', '--save-project', '--mask', '--report', '--stages'):
            with self.subTest(option=option):
                self.assertIn('name is missing', self.refuse(USAGE, 'drawing.png', option, ''))

    def test_value_out_of_range(self):
        for option, value in (('--threshold', '256'), ('--threshold', '-1'), ('--reach', 'wide'), ('--spacing', '0'), ('--spacing', 'nan'),
                              ('--coverage-bins', '2.5'), ('--preset', 'tidy'), ('--threads', '-2')):
            with self.subTest(option=option, value=value):
                message = self.refuse(USAGE, 'drawing.png', option, value)
                self.assertIn(option[2:], message)
                self.assertIn("'%s'" % value, message)

    def test_output_over_the_drawing(self):
        for output in ('drawing.png', './drawing.png', self.path('drawing.png')):
            self.refuse(USAGE, 'drawing.png', '-o', output)

    def test_output_over_the_drawing_through_a_link(self):
        os.symlink('drawing.png', self.path('link.svg'))
        self.refuse(USAGE, 'drawing.png', '-o', 'link.svg')

    def test_drawing_named_svg(self):
        self.put('drawing.svg', png(cross()))
        self.refuse(USAGE, 'drawing.svg')

    def test_output_over_the_mask(self):
        self.put('mask.svg', png(cross()))
        self.refuse(USAGE, 'drawing.png', '--mask', 'mask.svg', '-o', 'mask.svg')

    def test_report_over_output_or_drawing(self):
        self.refuse(USAGE, 'drawing.png', '--report', 'drawing.svg')
        self.refuse(USAGE, 'drawing.png', '--report', 'drawing.png')
        self.refuse(USAGE, 'drawing.png', '-o', '-', '--report', '-')

    def test_output_in_place_of_the_directory_of_the_stages(self):
        self.refuse(USAGE, 'drawing.png', '--stages', 'why', '-o', 'why')
        self.refuse(USAGE, 'drawing.png', '--stages', 'drawing.png')

    def test_two_drawings_into_one_file(self):
        self.put('other.png', png(cross()))
        self.refuse(USAGE, 'drawing.png', 'other.png', '-o', 'out.svg')
        self.refuse(USAGE, 'drawing.png', 'other.png', '-o', '-')

    def test_two_drawings_that_would_have_one_name(self):
        self.put('drawing.jpg', png(cross()))
        self.refuse(USAGE, 'drawing.png', 'drawing.jpg')
        self.refuse(USAGE, 'drawing.png', 'drawing.png')

    def test_one_report_for_two_drawings(self):
        self.put('other.png', png(cross()))
        for option in ('--report', '--stages', '--mask'):
            self.refuse(USAGE, 'drawing.png', 'other.png', option, 'x')

    def test_drawing_and_mask_both_from_standard_input(self):
        self.refuse(USAGE, '-', '--mask', '-', stdin=png(cross()))

    def test_mask_of_another_size(self):
        rows = [bytearray(b'\x80\x00\x80' * 50) for _ in range(40)]
        message = self.refuse(USAGE, 'drawing.png', '--quiet', '--mask', self.put('mask.png', png(rows, colour=True)))
        self.assertIn('mask', message)

    def test_mask_without_a_scribble(self):
        rows = [bytearray(b'\xff\xff\xff' * 160) for _ in range(120)]
        self.assertIn('mask.png', self.refuse(FILE, 'drawing.png', '--mask', self.put('mask.png', png(rows, colour=True))))

    def test_mask_that_is_missing(self):
        self.assertIn('no-mask.png', self.refuse(FILE, 'drawing.png', '--mask', 'no-mask.png'))


if __name__ == '__main__':
    unittest.main()
