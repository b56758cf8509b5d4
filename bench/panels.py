"""Panels: a drawing, curves of an SVG file over it, and both side by side."""
import math
import re
import subprocess
import xml.etree.ElementTree as ET
from collections import Counter
from io import BytesIO

import cairo
from PIL import Image

COLOURS = [(31, 119, 180), (230, 85, 13), (44, 160, 44), (148, 103, 189), (140, 86, 75), (214, 39, 159), (23, 162, 184), (127, 127, 0),
           (57, 73, 171), (198, 40, 40)]
JUNCTION, FREE_END, TRUTH = (0.88, 0.12, 0.12), (0.85, 0.1, 0.38), (0.55, 0.85, 0.25, 0.7)
TOKEN = re.compile(r'[A-Za-z]|-?[\d.]+(?:e-?\d+)?')


# ---------------------------------------------------------------- curves
def curves_of_path(data):
    """Lists of cubics; absolute M, L, Q, C and Z are what inkgrid and the ground truths write."""
    tokens, curves, here, command = TOKEN.findall(data), [], None, None
    position = 0

    def point():
        nonlocal position
        position += 2
        return float(tokens[position - 2]), float(tokens[position - 1])

    while position < len(tokens):
        if tokens[position].isalpha():
            command = tokens[position]
            position += 1
        if command in 'zZ':
            if curves and curves[-1] and curves[-1][-1][3] != curves[-1][0][0]:
                curves[-1].append((here, here, curves[-1][0][0], curves[-1][0][0]))
        elif command == 'M':
            here, command = point(), 'L'
            curves.append([])
        elif command == 'L':
            end = point()
            curves[-1].append((here, here, end, end))
            here = end
        elif command == 'Q':
            control, end = point(), point()
            mix = lambda a, b: tuple(x + 2 / 3 * (y - x) for x, y in zip(a, b))
            curves[-1].append((here, mix(here, control), mix(end, control), end))
            here = end
        elif command == 'C':
            curves[-1].append((here, point(), point(), point()))
            here = curves[-1][-1][3]
        else:
            raise ValueError(f'path command {command} is not understood')
    return [curve for curve in curves if curve]


def read_curves(svg, size):
    """Curves in pixels of the drawing, through the viewBox."""
    root = ET.parse(svg).getroot()
    box = [float(v) for v in root.get('viewBox', f'0 0 {size[0]} {size[1]}').replace(',', ' ').split()]
    scale = size[0] / box[2]
    curves = [c for e in root.iter() if e.tag.endswith('path') for c in curves_of_path(e.get('d', ''))]
    return [[[((x - box[0]) * scale, (y - box[1]) * scale) for x, y in segment] for segment in curve] for curve in curves]


def meetings(curves):
    """Points that are ends of one curve, and of three or more."""
    degree = Counter(end for curve in curves for end in (curve[0][0], curve[-1][3]))
    return [p for p, n in degree.items() if n == 1], [p for p, n in degree.items() if n >= 3]


# ---------------------------------------------------------------- pictures
def grey_picture(path):
    picture = Image.open(path)
    if picture.mode in ('RGBA', 'LA', 'P'):
        picture = picture.convert('RGBA')
        picture = Image.alpha_composite(Image.new('RGBA', picture.size, 'white'), picture)
    return picture.convert('L')


def cropped(picture, box, zoom):
    x0, y0, x1, y1 = box
    size = (max(1, round((x1 - x0) * zoom)), max(1, round((y1 - y0) * zoom)))
    return picture.resize(size, Image.NEAREST if zoom >= 2 else Image.LANCZOS, box=box)


def stroke_all(context, curves, width, colour_of):
    context.set_line_width(width)
    for i, curve in enumerate(curves):
        context.set_source_rgba(*colour_of(i))
        context.move_to(*curve[0][0])
        for _, a, b, end in curve:
            context.curve_to(*a, *b, *end)
        context.stroke()


def marks(context, curves, px):
    ends, junctions = meetings(curves)
    joints = [segment[3] for curve in curves for segment in curve[:-1]]
    for points, radius, colour, filled in ((joints, 2, (0.1, 0.1, 0.1), True), (ends, 4.5, FREE_END, False), (junctions, 4, JUNCTION, True)):
        context.set_source_rgb(*colour)
        context.set_line_width(1.8 * px)
        for x, y in points:
            context.new_sub_path()
            context.arc(x, y, radius * px, 0, 2 * math.pi)
            context.fill() if filled else context.stroke()


def with_curves(picture, box, zoom, curves, truth, line=1, mark=1):
    """The cut-out lightened, with the curves over it; lines and marks so many times their usual size."""
    base = cropped(picture, box, zoom).point(lambda g: 255 - (255 - g) * 3 // 10).convert('RGBA')
    data = bytearray(base.tobytes('raw', 'BGRA'))
    surface = cairo.ImageSurface.create_for_data(data, cairo.FORMAT_RGB24, *base.size)
    context = cairo.Context(surface)
    context.scale(zoom, zoom)
    context.translate(-box[0], -box[1])
    context.set_line_cap(cairo.LINE_CAP_ROUND)
    context.set_line_join(cairo.LINE_JOIN_ROUND)
    stroke_all(context, truth, 7 / zoom, lambda i: TRUTH)
    stroke_all(context, curves, 2.2 * line / zoom, lambda i: tuple(v / 255 for v in COLOURS[i % len(COLOURS)]) + (1,))
    marks(context, curves, mark / zoom)
    surface.flush()
    return Image.frombytes('RGBA', base.size, bytes(data), 'raw', 'BGRA').convert('RGB')


def curves_alone(svg, width):
    """The file as a program that knows SVG shows it, on white, so many pixels wide."""
    done = subprocess.run(['rsvg-convert', '--width', str(width), '--background-color', 'white', svg], capture_output=True, check=True)
    return Image.open(BytesIO(done.stdout)).convert('RGB')
