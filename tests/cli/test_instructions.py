"""How many instructions each stage takes on a small drawing, counted by callgrind, which other work on the machine does not change."""
import math
import os
import re
import shutil
import subprocess
import unittest

from support import PROGRAM, CommandTest, blank, paint_disc, paint_line, png

# Millions, of the function that is the stage with all that it calls.  Where a stage costs more and is worth it, this is the place to say
# so.
CLEAN = {
    'binarise': 26,
    'find_fills': 39,
    'grain_of': 0.94,
    'measure_ink': 27,
    'slimming_of': 42,
    'slim_ink': 15.4,
    'build_band': 52,
    'solve_field': 95,
    'comb_charts': 21,
    'label_strokes': 97,
    'solve_grid_map': 154,
    'trace_isolines': 32,
    'chain_strokes': 4.5,
    'follow_ridges': 81,
    'drop_uncovered': 4.4,
    'drop_spurs': 6.3,
    'turn_in_blots': 10.4,
    'meet_in_blots': 12.5,
    'follow_strokes': 3.3,
    'attach_ends': 3.7,
    'drop_doubles': 4.1,
    'join_crossings': 2.8,
    'join_arms': 2.6,
    'mark_leftovers': 2.8,
    'fit_outlines': 16,
    'fit_curves': 73,
    'PROGRAM TOTALS': 846,
}
# With bundles looked for: all but threshold, fills and ink runs twice.
ROUGH = {
    'find_flanks': 31.4,  # of the first pass, and of the refined chains
    'join_flanking': 16,
    'drop_zigzags': 5.7,
    'find_bundles': 15.8,
    'join_bundles': 18,
    'closed_ink': 35,
    'PROGRAM TOTALS': 1012,
}
MOST = 1.3   # times that


def drawing():
    """A ring, lines that cross it and each other, a zigzag and a blot: 320 x 240 px."""
    rows = blank(320, 240)
    for k in range(720):
        paint_disc(rows, 110 + 70 * math.cos(k / 360 * math.pi), 120 + 80 * math.sin(k / 360 * math.pi), 2.5)
    for a, b in (((15, 40), (300, 200)), ((30, 215), (290, 30)), ((110, 10), (118, 230)), ((215, 110), (310, 118))):
        paint_line(rows, a, b, 5)
    for k in range(6):
        paint_line(rows, (200 + 15 * k, 150 + 60 * (k % 2)), (215 + 15 * k, 210 - 60 * (k % 2)), 4)
    paint_disc(rows, 275, 75, 17)
    return rows


@unittest.skipUnless(shutil.which('valgrind'), 'valgrind is missing')
@unittest.skipUnless(os.environ['INKGRID_OPTIMISED'] == '1', 'not the program that is installed')
class Instructions(CommandTest):
    def counted(self, preset):
        """Instructions of each function that is a stage, and of the program."""
        self.put('drawing.png', png(drawing()))
        subprocess.run(['valgrind', '--tool=callgrind', '--callgrind-out-file=costs', PROGRAM, 'drawing.png', '--preset', preset,
                        '--threads', '1'], cwd=self.directory, check=True, capture_output=True, timeout=300)
        text = subprocess.run(['callgrind_annotate', '--inclusive=yes', '--threshold=100', 'costs'], cwd=self.directory, check=True,
                              capture_output=True, text=True).stdout
        counts = {}
        for number, name in re.findall(r'^ *([\d,]+) .*?(?::inkgrid::(?=\w+\()|(?=PROGRAM))(PROGRAM TOTALS|\w+)', text, re.MULTILINE):
            counts.setdefault(name, int(number.replace(',', '')))
        return counts

    def check(self, preset, expected):
        counts = self.counted(preset)
        for stage, millions in expected.items():
            with self.subTest(stage=stage):
                self.assertLess(counts[stage] / 1e6, MOST * millions)
                self.assertGreater(counts[stage] / 1e6, millions / 2, 'so much less that the number here guards nothing')

    def test_no_stage_takes_many_more_than_it_did(self):
        self.check('clean', CLEAN)

    def test_nor_do_those_that_look_for_bundles(self):
        self.check('rough', ROUGH)
