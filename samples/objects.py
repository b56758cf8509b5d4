"""A page of small objects, each in a box of 100 x 100."""
import cmath
import math

from page import Drawing
from strokes import arc, circle, line, moved, polyline, smooth


def star():
    return [polyline('50,6 61,38 95,38 68,58 78,92 50,72 22,92 32,58 5,38 39,38 z')]


def heart():
    return [smooth('50,30 | 56,14 78,8 94,26 88,54 66,78 50,94 | 34,78 12,54 6,26 22,8 44,14 | z')]


def cup():
    return [smooth('14,34 | 16,60 24,82 34,90 | 62,90 | 72,82 80,60 82,34 | z'), smooth('81,42 96,40 96,62 76,68'),
            smooth('36,22 32,16 40,10 36,2'), smooth('56,22 52,16 60,10 56,2')]


def key():
    return [circle(28 + 28j, 20), circle(28 + 28j, 8), line(42.14 + 42.14j, 92 + 92j), line(72 + 72j, 84 + 60j), line(84 + 84j, 94 + 74j)]


def envelope():
    return [polyline('6,22 94,22 94,80 6,80 z'), polyline('6,22 50,56 94,22'), polyline('6,80 39,47.5'), polyline('94,80 61,47.5')]


def umbrella():
    return [smooth('6,50 16,20 50,6 84,20 94,50 | 80,42 64,50 | 50,42 36,50 | 20,42 6,50 | z'), polyline('50,6 50,0'),
            smooth('50,42 50,82 56,94 68,92 70,82'), smooth('50,6 38,24 36,50'), smooth('50,6 62,24 64,50')]


def mushroom():
    return [smooth('6,52 16,18 50,4 84,18 94,52 | 72,58 50,60 28,58 6,52 | z'), smooth('38,59.4 40,76 34,94 | 50,97 66,94 | 60,76 62,59.4'),
            circle(34 + 32j, 8), circle(62 + 26j, 6), circle(76 + 44j, 4.5)]


def fish():
    return [smooth('4,52 22,30 50,30 72,46 | 96,26 | 90,52 | 96,78 | 72,58 | 50,74 22,74 4,52 | z'), circle(22 + 47j, 4),
            smooth('36,34 44,52 36,72'), smooth('52,46 60,52 52,58')]


def sun():
    spokes = [cmath.exp(1j * math.pi * k / 5) for k in range(10)]
    return [circle(50 + 50j, 20), *(line(50 + 50j + 29 * d, 50 + 50j + 46 * d) for d in spokes)]


def cloud():
    return [smooth('20,78 | 4,74 6,52 22,50 | 24,28 50,22 58,38 | 76,30 86,46 80,56 | 98,58 96,78 80,78 | z')]


def moon():
    return [smooth('62,8 26,14 14,50 32,86 72,92 | 46,80 38,50 46,22 62,8 | z'), polyline('78,22 78,38'), polyline('70,30 86,30')]


def anchor():
    return [circle(50 + 14j, 9), polyline('50,23 50,92'), polyline('30,36 70,36'), smooth('10,62 20,84 50,92 80,84 90,62'),
            polyline('4,72 10,62 20,70'), polyline('96,72 90,62 80,70')]


def balloon():
    return [smooth('50,70 26,54 22,26 50,6 78,26 74,54 50,70 | z'), polyline('50,70 44,78 56,78 z'), smooth('50,78 44,86 54,92 50,100'), arc(48 + 32j, 15, 180, 250)]


def pencil():
    return [polyline('12,88 18,66 74,10 90,26 34,82 z'), polyline('18,66 34,82'), polyline('64,20 80,36'), polyline('26,74 72,28')]


def bolt():
    return [polyline('58,4 20,56 46,56 38,96 80,40 54,40 z')]


def bell():
    return [smooth('12,76 | 24,64 24,30 50,14 76,30 76,64 88,76 | z'), smooth('40,76 44,90 56,90 60,76'), smooth('44,16 46,6 54,6 56,16')]


def candle():
    return [polyline('36,94 36,48 64,48 64,94'), polyline('18,94 82,94'), polyline('50,48 50,36'), smooth('50,36 38,26 50,4 | 62,26 50,36 | z'), smooth('36,56 44,62 48,74 54,58 64,54')]


def apple():
    return [smooth('50,34 34,24 12,34 10,60 28,92 50,90 72,92 90,60 88,34 66,24 50,34 | z'), smooth('50,34 50,20 58,8'), smooth('52,22 66,6 86,10 | 76,24 52,22 | z')]


def scissors():
    return [circle(24 + 80j, 14), circle(76 + 80j, 14), line(31.1 + 67.9j, 70 + 4j), line(68.9 + 67.9j, 30 + 4j)]


def boat():
    return [smooth('4,70 | 96,70 | 86,88 76,92 | 24,92 | 14,88 4,70 | z'), polyline('48,70 48,4'), smooth('48,8 70,28 84,60 | 48,60'), smooth('48,16 30,36 16,60 | 48,60')]


OBJECTS = (star, heart, cup, key, envelope, umbrella, mushroom, fish, sun, cloud, moon, anchor, balloon, pencil, bolt, bell, candle, apple, scissors, boat)


def objects():
    page = Drawing('objects', 1300, 1050, 5)
    for i, draw in enumerate(OBJECTS):
        corner = complex(50 + 255 * (i % 5) - 5, 50 + 250 * (i // 5))
        page.add(*(moved(curve, 1.85, corner) for curve in draw()))
    return page
