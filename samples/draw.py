#!/usr/bin/env python3
"""Draws every sample: NAME.svg beside this script and truth/NAME.gt.svg, the curves that were meant.  The same bytes each time."""
from pathlib import Path

import clean
import objects
import page
import rough
import special

HERE = Path(__file__).resolve().parent


def main():
    for drawing in [*clean.drawings(), objects.objects(), *special.drawings(), *rough.drawings()]:
        (HERE / f'{drawing.name}.svg').write_text(page.picture(drawing))
        (HERE / 'truth' / f'{drawing.name}.gt.svg').write_text(page.truth(drawing))


if __name__ == '__main__':
    main()
