"""Clean drawings: every curve is drawn once, as it was meant."""
import cmath
import math

from page import Drawing
from strokes import arc, circle, line, moved, polyline, smooth, smooth_piece


def fox():
    page = Drawing('fox', 1000, 1000, 6)
    both = lambda curve: page.add(curve, moved(curve, mirror=400))
    # head
    both(smooth('272,262 244,166 252,70 | 312,100 358,166'))
    page.add(smooth('358,166 400,158 442,166'))
    both(smooth('272,262 242,306 186,340 | 214,356 248,366 | 236,386 212,400 | 250,412 290,424 352,464 380,502 400,510'))
    both(smooth('280,222 266,172 270,114 | 304,140 326,186'))
    both(smooth('248,366 276,338 318,340 352,384 372,454'))
    both(smooth('292,296 308,314 330,318 352,308'))
    page.add(smooth('372,454 400,446 428,454 420,472 400,482 380,472 o'))
    # chest and front legs
    both(smooth('290,424 276,500 284,560 | 300,556 316,544 | 316,590 330,630 | 346,622 358,610 | 366,670 400,730'))
    both(smooth('277,526 262,620 270,740 288,876 | 254,890 246,918 262,936 300,942 350,942 380,936 388,900 | 390,830 400,730'))
    both(smooth('296,942 296,928 302,916'))
    both(smooth('340,942 340,928 346,916'))
    # back, haunch and tail
    page.add(smooth('523,526 620,590 686,690 700,770 692,838 652,906 600,936 538,936'))
    page.add(smooth('558,716 606,716 644,760 646,820 620,870 574,894'))
    page.add(smooth('692,838 770,886 866,862 922,766 926,650 892,540 860,440 872,320 | 780,380 732,480 740,580 764,670 762,730 738,764 700,770'))
    page.add(smooth('926,650 908,626 894,592 | 884,626 866,652 | 850,616 838,590 | 822,622 800,644 | 786,604 774,574 | 760,590 740,580'))
    return page


def wheel(page, hub, tyre):
    page.add(circle(hub, tyre), circle(hub, tyre - 22))
    axle = page.add(circle(hub, 16))
    for k in range(12):
        ray = cmath.exp(2j * math.pi * (k + 0.57) / 12)
        page.add(line(hub + 16 * ray, hub + (tyre - 22) * ray))
    return axle


def bicycle():
    page = Drawing('bicycle', 1200, 820, 5)
    rear, front, crank, seat, head = 300 + 540j, 890 + 540j, 548 + 548j, 476 + 310j, 806 + 330j
    wheel(page, rear, 200)
    wheel(page, front, 200)
    towards = lambda a, b: (b - a) / abs(b - a)
    for end in (seat, crank):
        page.add(line(rear + 16 * towards(rear, end), end if end == seat else end + 50 * towards(end, rear)))
    for start, end in ((crank + 50 * towards(crank, seat), seat), (seat, 792 + 284j), (head, crank + 50 * towards(crank, head))):
        page.add(line(start, end))
    page.add(circle(crank, 50), circle(crank, 14))
    arm = towards(0j, 3 + 2j)
    for side in (1, -1):
        page.add(line(crank + 14 * side * arm, crank + 92 * side * arm))
        page.add(line(crank + 92 * side * arm - 24, crank + 92 * side * arm + 24))
    page.add(smooth('776,236 792,284 806,330 828,410 850,464 880,527'))
    page.add(smooth('776,236 830,246 880,244 912,262 918,300 892,326 850,322'))
    page.add(line(seat, 452 + 236j))
    page.add(smooth('388,214 430,224 492,212 540,214 556,226 530,236 452,236 404,248 384,232 o'))
    return page


def leaf(page, base, tip, width, bend, veins):
    """Two sides that meet in the tip, a rib between them, and veins that leave the rib."""
    def place(along, across):
        return base + (tip - base) * (along * cmath.exp(1j * bend * (along - 1)) + 1j * across * width / abs(tip - base))
    for side in (1, -1):
        page.add(smooth_piece([place(0, 0), place(0.22, 0.72 * side), place(0.5, side), place(0.8, 0.55 * side), place(1, 0)]))
    rib = page.add(smooth_piece([place(0, 0), place(0.3, 0), place(0.55, 0), place(0.86, 0)]))
    for k in range(veins):
        along = 0.18 + 0.36 * k / (veins - 1)
        for side in (1, -1):
            page.add(smooth_piece([place(along, 0), place(along + 0.08, 0.26 * side), place(along + 0.17, 0.46 * side)]))
    return rib


def plant():
    page = Drawing('plant', 900, 1100, 7)
    page.add(smooth('250,720 | 650,720 | 640,800 | 260,800 | z'))
    page.add(smooth('290,800 312,900 340,1010 | 450,1024 560,1010 | 588,900 610,800'))
    page.add(smooth('303,860 450,876 597,860'))
    page.add(smooth('270,1042 450,1062 630,1042'))
    shoots = [(400, 300 + 560j, 130 + 470j, 62, -0.35, 3), (415, 344 + 420j, 190 + 220j, 66, -0.3, 4), (450, 452 + 380j, 470 + 90j, 72, 0.1, 4),
              (486, 566 + 430j, 720 + 230j, 66, 0.3, 4), (505, 606 + 580j, 790 + 500j, 60, 0.35, 3)]
    for x, base, tip, width, bend, veins in shoots:
        foot = complex(x, 720)
        page.add(smooth_piece([foot, foot + 0.55 * (base - foot) - 30j, base]))
        leaf(page, base, tip, width, bend, veins)
    return page


def window(page, left, top, width, height, columns, rows):
    right, bottom = left + width, top + height
    page.add(polyline(f'{left},{top} {right},{top} {right},{bottom} {left},{bottom} z'))
    for i in range(1, columns):
        x = left + width * i / columns
        page.add(line(complex(x, top), complex(x, bottom)))
    for i in range(1, rows):
        y = top + height * i / rows
        page.add(line(complex(left, y), complex(right, y)))


def house():
    page = Drawing('house', 1100, 900, 4)
    page.add(polyline('210,380 890,380 780,170 320,170 z'))                       # roof, walls, ground
    page.add(polyline('250,380 250,760'), polyline('850,380 850,760'), polyline('60,760 1040,760'))
    for k in range(1, 5):
        y = 170 + 42 * k
        left, right, gap = 320 - 22 * k, 780 + 22 * k, math.sqrt(max(0, 46 ** 2 - (y - 275) ** 2))
        ends = [left, 550 - gap, 550 + gap, right] if gap else [left, right]
        page.add(*(line(complex(a, y), complex(b, y)) for a, b in zip(ends[::2], ends[1::2])))
    page.add(polyline('640,170 640,96 706,96 706,170'), polyline('628,96 718,96'))
    page.add(smooth('672,80 690,56 660,40 676,18 720,24 736,44'))
    window(page, 310, 450, 150, 180, 3, 3)
    window(page, 650, 450, 150, 180, 3, 3)
    page.add(polyline('296,630 474,630'), polyline('636,630 814,630'))
    page.add(polyline('500,760 500,540'), arc(556 + 540j, 56, 180, 360), polyline('612,540 612,760'))
    page.add(polyline('500,540 612,540'), polyline('556,484 556,540'), circle(592 + 660j, 9))
    page.add(circle(550 + 275j, 46), polyline('504,275 596,275'), polyline('550,229 550,321'))
    for x in range(70, 240, 34):
        page.add(polyline(f'{x},760 {x},676 {x + 10},660 {x + 20},676 {x + 20},760'))
    for x in range(90, 216, 34):
        page.add(polyline(f'{x},700 {x + 14},700'), polyline(f'{x},736 {x + 14},736'))
    page.add(polyline('958,760 958,640'))
    page.add(smooth('900,630 870,590 894,548 | 868,500 904,462 | 910,404 976,400 | 1030,404 1040,452 | 1074,490 1046,540 | 1068,590 1022,632 | 990,660 958,640 | 930,656 900,630 | z'))
    page.add(smooth('958,640 957,560 950,500'), smooth('957,590 980,560 992,530'))
    page.add(smooth('500,760 470,800 420,840 340,900'), smooth('612,760 640,800 690,840 780,900'))
    return page


def rays(centre, radius, angles):
    return [line(centre, centre + radius * cmath.exp(1j * math.radians(a))) for a in angles]


def junctions():
    """A page of the ways in which curves meet, 5 x 4 cells of 240 px."""
    page = Drawing('junctions', 1200, 960, 6)
    cell = lambda column, row: complex(120 + 240 * column, 120 + 240 * row)
    page.add(*(line(cell(0, 0) + d, cell(0, 0) - d) for d in (80 + 50j, -70 + 70j)))                                  # X
    page.add(line(cell(1, 0) - 85 - 20j, cell(1, 0) + 85 + 20j), line(cell(1, 0), cell(1, 0) - 20 + 85j))             # T
    page.add(*rays(cell(2, 0), 85, (-90, 30, 150)))                                                                  # Y
    page.add(*rays(cell(3, 0), 90, (10, 82, 154, 226, 298)))                                                         # valence 5
    page.add(*rays(cell(4, 0), 90, (5, 65, 125, 185, 245, 305)))                                                     # valence 6
    for column, degrees in enumerate((45, 30, 20, 15, 10)):                                                          # acute
        page.add(*rays(cell(column, 1) - 90 - 10j, 190, (-degrees / 2 + 5, degrees / 2 + 5)))
    page.add(arc(cell(0, 2) - 90j, 90, 90, 180), arc(cell(0, 2) + 90j, 90, 270, 180))                                # cusp
    page.add(polyline('260,670 300,540 340,670 380,540 420,670 440,560'))                                            # corners
    page.add(circle(cell(2, 2) - 32, 58), circle(cell(2, 2) + 32, 58))                                               # crossing circles
    page.add(circle(cell(3, 2) + 10j, 62), line(cell(3, 2) - 100 - 52j, cell(3, 2) + 100 - 52j))                     # tangent
    page.add(smooth('990,600 1050,560 1080,600 1110,640 1170,600 1110,560 1080,600 1050,640 o'))                      # eight
    page.add(line(20 + 900j, 220 + 900j), [(20 + 770j, 110 + 780j, 90 + 900j, 190 + 900j)])                           # merging
    page.add(line(260 + 780j, 460 + 780j))                                                                           # dead ends
    page.add(*(line(complex(280 + 32 * k, 780), complex(280 + 32 * k, 820 + 22 * (k % 3))) for k in range(6)))
    page.add(smooth_piece([600 + 845j + 13 * k ** 0.9 * cmath.exp(0.8j * k) / 2 for k in range(20)]))   # spiral
    page.add(*(smooth(f'750,{y} 790,{y - 16} 840,{y + 12} 930,{y}') for y in (790, 806, 830, 866)))                  # near one another
    page.add(polyline('1080,760 1112,900 996,808 1164,808 1048,900 z'))                                              # pentagram
    return page


def drawings():
    return [fox(), bicycle(), plant(), house(), junctions()]
