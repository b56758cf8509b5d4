"""A drawing and its two SVG texts: the picture, and the curves that were meant."""
from dataclasses import dataclass, field

from strokes import number, path_data, visible


@dataclass
class Drawing:
    name: str
    width: int
    height: int
    pen: float                 # px
    kind: str = 'clean'        # or 'oversketched', as the scorers tell them apart
    paper: str = '#fff'        # a colour, or SVG elements that paint the page
    ink: str = '#111'
    curves: list = field(default_factory=list)   # (curve, width) that were meant
    strokes: list = None       # (curve, width, colour, opacity) that are seen; None: the curves themselves
    fills: list = field(default_factory=list)    # SVG elements on top that are no curves: dots, blots
    ink_filter: str = ''       # SVG filter element with the id 'ink'

    def add(self, *curves, width=None):
        self.curves += [(curve, width or self.pen) for curve in curves]
        return curves[0]


def stroke(curve, width, colour=None, opacity=1.0):
    return (f'<path stroke-width="{number(width)}"' + (f' stroke="{colour}"' if colour else '') +
            (f' stroke-opacity="{opacity:.2f}"' if opacity < 1 else '') + f' d="{path_data(curve)}"/>')


def document(drawing, attributes, parts):
    size = f'width="{drawing.width}" height="{drawing.height}" viewBox="0 0 {drawing.width} {drawing.height}"'
    return '\n'.join([f'<svg xmlns="http://www.w3.org/2000/svg" {size}{attributes}>', *filter(None, parts), '</svg>', ''])


def group(colour, elements, extra=''):
    head = f'<g fill="none" stroke="{colour}" stroke-linecap="round" stroke-linejoin="round"{extra}>'
    return '\n'.join([head, *elements, '</g>'])


def picture(drawing):
    seen = drawing.strokes or [(curve, width, None, 1.0) for curve, width in drawing.curves]
    plain = drawing.paper.startswith('#')
    paper = f'<rect width="100%" height="100%" fill="{drawing.paper}"/>' if plain else drawing.paper
    extra = ' filter="url(#ink)"' if drawing.ink_filter else ''
    return document(drawing, '', [drawing.ink_filter, paper, group(drawing.ink, [stroke(*s) for s in seen], extra), *drawing.fills])


def truth(drawing):
    attributes = f' data-set="{drawing.kind}" data-pen="{number(drawing.pen)}"'
    return document(drawing, attributes, [group('#000', [stroke(run, width) for curve, width in drawing.curves for run in visible(curve, drawing.width, drawing.height)])])
