"""Rough drawings: each curve is searched for with several wobbly strokes of varying grey and width, which stop short or run on."""
import math
import random

from page import Drawing
from strokes import arc, circle, corner_pieces, is_closed, line, polyline, sampled, smooth

GRADIENT = ('<defs><linearGradient id="light" x1="0" y1="0" x2="1" y2="1"><stop offset="0" stop-color="#fdfcf8"/><stop offset="0.6" stop-color="#e4e0d6"/>'
            '<stop offset="1" stop-color="#b9b3a6"/></linearGradient></defs><rect width="100%" height="100%" fill="url(#light)"/>')

CREAM = ('<defs><filter id="grain" x="0" y="0" width="100%" height="100%"><feTurbulence type="fractalNoise" baseFrequency="0.8" numOctaves="3" seed="7"/>'
         '<feColorMatrix values="0.10 0 0 0 0.86  0.10 0 0 0 0.83  0.12 0 0 0 0.73  0 0 0 0 1"/></filter></defs>'
         '<rect width="100%" height="100%" fill="#f3ecd8"/><rect width="100%" height="100%" filter="url(#grain)"/>')

# Graphite catches on the tooth of the paper: noise thins the strokes.
GRAPHITE = ('<defs><filter id="ink" x="0" y="0" width="100%" height="100%"><feTurbulence type="fractalNoise" baseFrequency="0.6" numOctaves="2" seed="11"/>'
            '<feColorMatrix values="0 0 0 0 0  0 0 0 0 0  0 0 0 0 0  -3.2 0 0 0 2.3" result="tooth"/>'
            '<feComposite in="SourceGraphic" in2="tooth" operator="in"/></filter></defs>')


def spline_through(z):
    """Catmull-Rom."""
    slope = [(z[min(i + 1, len(z) - 1)] - z[max(i - 1, 0)]) / 2 for i in range(len(z))]
    return [(a, a + s / 3, b - t / 3, b) for a, b, s, t in zip(z, z[1:], slope, slope[1:])]


def wave(chance, cycles):
    """A smooth random function of 0..1, about -1..1."""
    parts = [(chance.uniform(0.3, 1), chance.uniform(0.3, cycles), chance.uniform(0, 2 * math.pi)) for _ in range(3)]
    total = sum(size for size, _, _ in parts)
    return lambda t: sum(size * math.sin(2 * math.pi * turns * t + phase) for size, turns, phase in parts) / total * 1.4


def run_on(z, start, end):
    """Points before and after, straight on; negative lengths cut away instead."""
    def lengthened(points, extra):
        if extra > 0:
            return points + [points[-1] + extra * (points[-1] - points[-2]) / abs(points[-1] - points[-2])]
        while len(points) > 4 and abs(points[-1] - points[-2]) < -extra:
            extra += abs(points[-1] - points[-2])
            points = points[:-1]
        return points
    return lengthened(lengthened(z, end)[::-1], start)[::-1]


def wobbly(curve, chance, amount, overshoot):
    """One hand-drawn stroke along the curve; a closed curve is begun anywhere and overlaps its beginning."""
    step = 16
    z = sampled(curve, step)
    if is_closed(curve):
        k = chance.randrange(len(z) - 1)
        z = z[k:-1] + z[:k + 1] + z[k + 1:k + 1 + chance.randrange(1, 2 + len(z) // 8)]
    count = len(z)
    drift, shake = wave(chance, 1.2), wave(chance, 2 + count * step / 120)
    offset = chance.uniform(-0.6, 0.6)
    result = []
    for i, p in enumerate(z):
        ahead = z[min(i + 1, count - 1)] - z[max(i - 1, 0)]
        normal = 1j * ahead / (abs(ahead) or 1)
        t = i / (count - 1)
        result.append(p + normal * amount * (offset + 0.7 * drift(t) + 0.25 * shake(t)))
    if not is_closed(curve):
        result = run_on(result, chance.uniform(-0.6, 1) * overshoot, chance.uniform(-0.6, 1) * overshoot)
    return spline_through(result)


def sketch(page, passes, wobble, greys, opacity, overshoot=3.0):
    """Fills page.strokes; lengths in pens."""
    chance = random.Random(page.name)
    page.strokes = []
    for curve, width in page.curves:
        for _ in range(chance.randint(*passes)):
            for piece in corner_pieces(curve) if chance.random() < 0.8 else [curve]:
                grey = chance.randint(*greys)
                page.strokes.append((wobbly(piece, chance, wobble * page.pen, overshoot * page.pen), width * chance.uniform(0.75, 1.3),
                                     f'#{grey:02x}{grey:02x}{grey:02x}', chance.uniform(*opacity)))
    return page


def teapot():
    page = Drawing('rough-teapot', 1100, 850, 3.5, 'oversketched')
    page.add(smooth('380,300 300,360 260,470 290,600 370,680 | 500,694 640,680 | 720,600 750,470 710,360 630,300'))
    page.add(arc(505 + 300j, 125, 0, 360, 0.22))
    page.add(smooth('388,286 420,236 505,216 590,236 622,286'))
    page.add(circle(505 + 194j, 22))
    page.add(smooth('276,420 210,410 190,350 150,300 110,280 | 96,306 | 130,330 150,400 180,500 268,540'))
    page.add(smooth('728,390 800,330 890,350 910,430 860,520 736,560'))
    page.add(smooth('740,430 800,384 856,400 860,440 820,490 748,514'))
    page.add(smooth('274,430 400,462 505,468 620,462 738,430'))
    page.add(smooth('272,520 400,560 505,566 620,560 744,520'))
    page.add(smooth('120,752 340,776 560,782 740,776'))
    page.add(smooth('830,640 840,720 880,764 | 960,764 | 1000,720 1010,640'), arc(920 + 640j, 90, 0, 360, 0.2))
    page.add(smooth('1005,668 1060,660 1066,720 992,730'))
    return sketch(page, (3, 5), 1.6, (20, 90), (0.6, 1))


def bird():
    page = Drawing('rough-bird', 1000, 900, 3, 'oversketched', paper=GRADIENT)
    page.add(smooth('238,250 270,190 340,170 410,200 450,270 540,340 650,420 740,520'))
    page.add(smooth('238,250 226,310 240,400 290,500 380,580 500,610 620,590 740,520'))
    page.add(smooth('238,250 | 150,276 | 232,296'), smooth('152,276 200,274 236,272'))
    page.add(circle(306 + 250j, 20), circle(302 + 247j, 8))
    page.add(smooth('390,350 370,420 420,500 520,540 640,540 | 600,480 520,410 450,360 390,350 | z'))
    page.add(smooth('402,420 480,430 556,466'), smooth('424,474 500,474 588,510'))
    page.add(smooth('740,520 840,540 930,600 | 820,610 | 850,660 | 740,610 640,585'))
    page.add(smooth('740,540 800,570 870,598'))
    page.add(smooth('420,596 412,680 400,750'), smooth('500,612 506,690 500,760'))
    page.add(smooth('60,760 260,742 500,764 720,750 960,780'), smooth('60,806 260,790 500,812 720,800 960,830'))
    page.add(smooth('700,750 760,690 850,680 | 800,740 700,750 | z'), smooth('716,740 770,710 826,694'))
    page.add(smooth('244,360 300,350 330,300 360,260'))
    return sketch(page, (2, 4), 1.6, (30, 110), (0.55, 0.95))


def box(page, corner, right, back, up):
    a, b, c = corner, corner + right, corner + right + back
    for start, end in ((a, b), (b, c), (a, a + up), (b, b + up), (c, c + up), (a + up, b + up), (b + up, c + up),
                       (a + up, a + up + back), (a + up + back, c + up)):
        page.add(line(start, end))


def solids():
    page = Drawing('rough-solids', 1200, 850, 4, 'oversketched')
    box(page, 90 + 620j, 250 + 60j, 150 - 120j, -270j)
    page.add(arc(680 + 300j, 120, 0, 360, 0.3), arc(680 + 640j, 120, 0, 180, 0.3), line(560 + 300j, 560 + 640j), line(800 + 300j, 800 + 640j))
    page.add(circle(1000 + 560j, 130), arc(1000 + 560j, 130, 0, 180, 0.3))
    page.add(polyline('400,700 500,470 600,760'), line(500 + 470j, 560 + 660j))
    page.add(polyline('400,700 600,760'))
    page.add(smooth('880,220 960,130 1080,150 1120,240 1040,300 960,260 1000,200'))
    page.add(line(30 + 760j, 330 + 780j), line(700 + 790j, 1160 + 740j))
    return sketch(page, (3, 4), 1.5, (10, 100), (0.6, 1), overshoot=6)


def pencil():
    page = Drawing('pencil', 1000, 850, 3.5, 'oversketched', paper=CREAM, ink_filter=GRAPHITE)
    page.add(smooth('330,250 290,330 220,420 190,540 240,660 360,710 480,660 520,540 480,420 400,330 350,250'))
    page.add(smooth('340,262 336,220 356,170 380,150'), smooth('348,212 400,140 480,130 530,160 | 470,214 400,226 348,212 | z'), smooth('356,208 420,178 496,160'))
    page.add(smooth('260,560 262,610 300,650'))
    page.add(circle(650 + 610j, 84), circle(806 + 640j, 76))
    page.add(smooth('644,546 650,430 700,320 770,240'), smooth('806,580 800,470 790,340 770,240'))
    page.add(smooth('770,240 850,200 930,240 950,310 | 860,330 800,300 770,240 | z'), smooth('782,248 850,264 924,298'))
    page.add(smooth('620,552 644,566 672,552'), smooth('780,586 806,596 830,584'))
    page.add(smooth('606,620 612,650 640,668'))
    page.add(smooth('80,720 180,712 240,700'), smooth('490,700 540,706 580,700'), smooth('880,700 920,710 960,704'))
    return sketch(page, (1, 2), 0.5, (50, 95), (0.8, 1), overshoot=1.5)


def drawings():
    return [teapot(), bird(), solids(), pencil()]
