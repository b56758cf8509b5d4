"""How much memory the program takes at its peak, on two threads: so much a pixel and a vertex of the mesh, and no more."""
import json
import os
import subprocess
import unittest

from support import PROGRAM, CommandTest, blank, lattice, paint_line, png

# What is asked for is 5 kB a vertex, and as much as here a pixel and at least.
BYTES_A_VERTEX, BYTES_A_PIXEL, BYTES_AT_LEAST = 1500, 16, 20e6


@unittest.skipUnless(os.environ['INKGRID_OPTIMISED'] == '1', 'not the program that is installed')
class Memory(CommandTest):
    def check(self, rows, *options):
        self.put('drawing.png', png(rows))
        process = subprocess.Popen([PROGRAM, 'drawing.png', '--quiet', '--threads', '2', '--report', 'report.json', *options], cwd=self.directory)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        vertices, pixels, peak = json.loads(self.read('report.json'))['vertices'], len(rows) * len(rows[0]), usage.ru_maxrss * 1024
        self.assertLess(peak, BYTES_A_VERTEX * vertices + BYTES_A_PIXEL * pixels + BYTES_AT_LEAST)

    def test_a_connected_net(self):
        self.check(lattice())

    def test_a_net_with_bundles_looked_for(self):
        self.check(lattice(), '--preset', 'rough')

    def test_a_page_of_almost_only_paper(self):
        rows = blank(3000, 2000)
        paint_line(rows, (900, 900), (1400, 1100), 5)
        for preset in 'clean', 'rough':
            with self.subTest(preset=preset):
                self.check(rows, '--preset', preset)
