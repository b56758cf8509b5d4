"""What `cmake --install` puts into place is enough to build a program with the library."""
import os
import subprocess
import tempfile
import unittest

BUILD = os.environ['INKGRID_BUILD']
SOURCE = os.environ['INKGRID_SOURCE']


def run(*words):
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError('%s:\n%s' % (' '.join(words), done.stdout))
    return done.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix='inkgrid-install-')
        cls.addClassCleanup(scratch.cleanup)
        cls.prefix = os.path.join(scratch.name, 'prefix')
        cls.example = os.path.join(scratch.name, 'example')
        run('cmake', '--install', BUILD, '--prefix', cls.prefix)

    def test_program(self):
        self.assertRegex(run(os.path.join(self.prefix, 'bin', 'inkgrid'), '--version'), r'^inkgrid \d')

    def test_manual_page_is_what_the_program_prints(self):
        with open(os.path.join(self.prefix, 'share', 'man', 'man1', 'inkgrid.1'), encoding='utf-8') as page:
            self.assertEqual(page.read(), run(os.path.join(self.prefix, 'bin', 'inkgrid'), '--man'))

    def test_public_headers_need_only_the_standard_library(self):
        include = os.path.join(self.prefix, 'include')
        for name in sorted(os.listdir(os.path.join(include, 'inkgrid'))):
            run('c++', '-std=c++20', '-Wall', '-fsyntax-only', '-x', 'c++', '-I', include,
                '-include', 'inkgrid/' + name, '/dev/null')
            with open(os.path.join(include, 'inkgrid', name), encoding='utf-8') as header:
                for line in header:
                    if line.startswith('#include'):
                        self.assertRegex(line, r'^#include (<[a-z_]+>|"inkgrid/\w+\.h")$')

    def test_ten_line_example(self):
        run('cmake', '-S', os.path.join(SOURCE, 'examples', 'ten_lines'), '-B', self.example, '-DCMAKE_PREFIX_PATH=' + self.prefix)
        run('cmake', '--build', self.example)
        said = run(os.path.join(self.example, 'ten_lines'))
        self.assertRegex(said, r'\Aa curve [\d.]+ px wide from \([\d.]+, [\d.]+\) to \([\d.]+, [\d.]+\)\n\Z')
        width, *ends = [float(word.strip('(),')) for word in said.split() if word.strip('(),').replace('.', '').isdigit()]
        self.assertAlmostEqual(width, 5, delta=1)
        self.assertAlmostEqual(min(ends[0], ends[2]), 20, delta=4)
        self.assertAlmostEqual(max(ends[0], ends[2]), 180, delta=4)
        self.assertAlmostEqual(ends[1], 50.5, delta=0.6)
        self.assertAlmostEqual(ends[3], 50.5, delta=0.6)


if __name__ == '__main__':
    unittest.main()
