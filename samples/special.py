"""Clean drawings that are hard for one reason each: pens of many widths, small details, ink beyond the page, light ink on dark paper."""
import cmath
import math

from page import Drawing
from strokes import arc, circle, line, moved, polyline, smooth


def pens():
    page = Drawing('pens', 1200, 900, 8)
    for radius, width in ((420, 40), (368, 26), (330, 17), (302, 11), (280, 7), (264, 4), (252, 2.5), (243, 1.5)):
        page.add(arc(470 + 520j, radius, 180, 360), width=width)
    for x, width in ((140, 1.5), (230, 2.5), (320, 4), (410, 7), (500, 11), (600, 17), (720, 26)):
        page.add(smooth(f'{x - 40},560 {x},620 {x - 50},690 {x - 10},760 {x - 40},830'), width=width)
    page.add(smooth('960,600 1040,520 1130,600 1060,700 960,760 1000,850 1120,840'), width=32)
    page.add(smooth('930,850 1010,680 1150,690'), width=5)
    page.add(smooth('1160,560 1020,600 940,680'), width=2)
    page.add(line(960 + 60j, 1150 + 400j), width=14)
    page.add(line(940 + 260j, 1160 + 160j), width=3)
    page.add(line(960 + 400j, 1120 + 60j), width=1.5)
    page.add(circle(1050 + 230j, 62), width=6)
    return page


def scallops(page, top, rows):
    """Rows of feathers, each row half a feather beside the one above."""
    for row in range(rows):
        y, count = top + 44 * row, 5 - row % 2
        left = 450 - 29 * count
        for k in range(count):
            page.add(smooth(f'{left + 58 * k},{y} {left + 58 * k + 8},{y + 32} {left + 58 * k + 29},{y + 46} {left + 58 * k + 50},{y + 32} {left + 58 * k + 58},{y}'))


def details():
    """An owl."""
    page = Drawing('details', 900, 1000, 3)
    both = lambda *curves: [page.add(curve, moved(curve, mirror=450)) for curve in curves]
    page.add(smooth('244,120 | 300,150 380,156 450,150 520,156 600,150 656,120 | 666,220 700,330 716,500 690,680 600,790 450,820 300,790 210,680 184,500 200,330 234,220 244,120 | z'))
    for radius in (86, 74, 40, 14):
        both(circle(356 + 270j, radius))
    for k in range(20):
        ray = cmath.exp(2j * math.pi * k / 20)
        both(line(356 + 270j + 48 * ray, 356 + 270j + 66 * ray))
    both(circle(366 + 258j, 4))
    page.add(smooth('450,306 | 474,334 450,378 | 426,334 450,306 | z'))
    page.add(line(450 + 306j, 450 + 352j))
    scallops(page, 420, 6)
    both(smooth('206,380 250,440 276,560 262,660 226,716'))
    for k in range(12):
        y = 452 + 20 * k
        both(line(complex(202 + abs(k - 6), y + 8), complex(246 - abs(k - 7), y - 6)))
    for x in (330, 372, 414):
        both(smooth(f'{x - 16},812 {x - 20},846 {x},858 {x + 18},846 {x + 14},{816 if x < 400 else 820}'))
    page.add(smooth('60,866 240,858 450,862 700,856 850,868'), smooth('60,912 240,906 450,914 700,904 850,910'))
    for x, y, r in ((120, 888, 7), (250, 884, 4), (520, 888, 9), (640, 880, 4), (780, 888, 6)):
        page.add(circle(complex(x, y), r))
    for x in (160, 300, 420, 560, 700):
        page.add(smooth(f'{x},898 {x + 20},892 {x + 46},896'))
    page.fills = [f'<circle cx="{x}" cy="{y}" r="{r}"/>' for x, y, r in
                  ((356, 270, 7), (544, 270, 7), (420, 200, 3), (450, 190, 3), (480, 200, 3), (435, 215, 2), (465, 215, 2), (390, 724, 3), (420, 736, 3), (450, 740, 4), (480, 736, 3), (510, 724, 3))]
    return page


def border():
    """A landscape that goes on beyond the page."""
    page = Drawing('border', 1100, 750, 6)
    page.add(smooth('-40,300 120,210 260,130 330,200 420,260'), smooth('330,200 480,60 560,20 690,150 860,290 960,330 1140,360'))
    page.add(smooth('476,63 510,96 540,80 | 566,112 590,84 | 626,88'))
    page.add(arc(960 - 20j, 130, 0, 180))
    for degrees in (20, 55, 90, 125, 160):
        ray = cmath.exp(1j * math.radians(degrees))
        page.add(line(960 - 20j + 156 * ray, 960 - 20j + 260 * ray))
    page.add(smooth('-30,440 200,380 420,400 700,470 900,450 1130,400'))
    page.add(smooth('-30,560 160,600 420,560 640,600 860,680 1130,640'))
    page.add(smooth('300,790 380,680 520,600 520,540 440,490 470,440 500,412'), smooth('520,790 560,700 660,620 620,540 510,490 500,450 530,416'))
    for x, y, s in ((90, 520, 1), (190, 500, 0.8), (800, 560, 1.2), (1084, 560, 1.1), (980, 520, 0.9)):
        page.add(smooth(f'{x},{y} | {x - 34 * s},{y - 10 * s} {x - 30 * s},{y - 70 * s} {x},{y - 130 * s} | {x + 30 * s},{y - 70 * s} {x + 34 * s},{y - 10 * s} {x},{y} | z'))
        page.add(line(complex(x, y - 76 * s), complex(x, y + 34 * s)))
    page.add(line(2 - 20j, 2 + 420j), line(-20 + 748j, 240 + 748j), smooth('1060,-20 1085,60 1110,90'))
    return page


def rocket():
    """Light ink on dark paper."""
    sky = ('<defs><radialGradient id="sky"><stop offset="0" stop-color="#33405e"/><stop offset="1" stop-color="#171c2b"/></radialGradient></defs>'
           '<rect width="100%" height="100%" fill="url(#sky)"/>')
    page = Drawing('light-on-dark', 1000, 1000, 6, paper=sky, ink='#f4efdc')
    turn = cmath.exp(0.5j)
    place = lambda curve: moved(curve, turn, 500 + 480j)
    body = [smooth('0,-330 64,-230 90,-90 84,60 54,180 | -54,180 | -84,60 -90,-90 -64,-230 0,-330 | z'), smooth('-62,-234 0,-214 62,-234'),
            circle(-90j, 44), circle(-90j, 28), smooth('84,60 140,110 156,220 | 110,190 62,156'), smooth('-84,60 -140,110 -156,220 | -110,190 -62,156'),
            smooth('0,30 12,80 0,128 | -12,80 0,30 | z'), polyline('-36,180 -46,206 46,206 36,180'), smooth('-68,130 0,146 68,130')]
    flame = [smooth('-36,206 -58,262 -34,310 | -24,330 0,400 | 24,330 34,310 | 58,262 36,206'), smooth('-14,206 -24,250 0,296 | 24,250 14,206')]
    page.add(*(place(curve) for curve in body + flame))
    page.add(circle(180 + 200j, 84), moved(arc(0j, 150, -18, 198, 0.28), cmath.exp(-0.35j), 180 + 200j))
    page.add(smooth('110,154 170,176 250,154'), smooth('101,228 180,250 256,234'))
    for x, y, r in ((820, 760, 34), (150, 620, 26), (860, 140, 24), (420, 120, 18), (620, 880, 22), (90, 430, 14), (930, 480, 16)):
        c = complex(x, y)
        tips = [c + r * w * cmath.exp(0.25j * math.pi * k) for k, w in enumerate((1, 0.3) * 4)]
        page.add([segment for a, b in zip(tips, tips[1:] + tips[:1]) for segment in line(a, b)])
    page.fills = [f'<circle cx="{x}" cy="{y}" r="3.5" fill="#f4efdc"/>' for x, y in ((320, 80), (720, 90), (70, 800), (250, 900), (940, 900), (700, 700), (300, 380))]
    return page


def drawings():
    return [pens(), details(), border(), rocket()]
