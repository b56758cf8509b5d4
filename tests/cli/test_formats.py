"""Every format, opened by a program that knows it, shows the curves."""
import json
import math
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree

import ezdxf
import jsonschema

from pictures import difference, drawn, from_pgm, from_png, points_on, reduced
from support import SVG, CommandTest, blank, paint_disc, paint_line, png

SCHEMAS = os.path.join(os.environ['INKGRID_SOURCE'], 'docs', 'schema')
DOTS_PER_METRE = 10000  # 10 px a mm, 254 px an inch
SAME = 0.8  # of 255: what two programs that smooth edges differ by, on average over the drawing


def sketch():
    """A cross and, apart from it, a circle and a filled ring: open curves, a junction, a closed curve, a fill; 200 x 120 px."""
    rows = blank(200, 120)
    paint_line(rows, (15, 70), (105, 40), 6)
    paint_line(rows, (50, 15), (75, 105), 5)
    for k in range(400):
        paint_disc(rows, 155 + 30 * math.cos(math.pi * k / 200), 60 + 30 * math.sin(math.pi * k / 200), 2)
    paint_disc(rows, 24, 24, 17)
    paint_disc(rows, 23, 25, 2.5, 255)
    return rows


def run(*words, **more):
    return subprocess.run(words, check=True, capture_output=True, **more).stdout


class FormatTest(CommandTest):
    def make(self, *words, dots_per_metre=0):
        self.put('drawing.png', png(sketch(), dots_per_metre=dots_per_metre))
        self.succeed('drawing.png', '--quiet', '-o', 'graph.json', *words)
        self.graph = json.loads(self.read('graph.json'))

    def check_picture(self, rows, **more):
        self.assertLess(difference(rows, drawn(self.graph, **more)), SAME)

    def pixels_of_pdf(self, resolution):
        return from_pgm(run('pdftoppm', '-gray', '-r', str(resolution), '-W', '200', '-H', '120',
                            self.path('out.pdf')))

    def pixels_of_eps(self, resolution):
        """Ghostscript blackens each pixel that it touches: much finer pixels, and their mean."""
        return reduced(from_pgm(run('gs', '-q', '-dBATCH', '-dNOPAUSE', '-dEPSCrop', '-sDEVICE=pgmraw', '-r%d' % (8 * resolution),
                                    '-sOutputFile=-', self.path('out.eps'))), 8)

    def pixels_of_svg(self, *words):
        return from_png(run('rsvg-convert', '-b', 'white', *words, self.path('out.svg')))


class PicturesOfFormats(FormatTest):
    def test_pictures_that_differ_are_told_apart(self):
        self.make()
        picture = drawn(self.graph)
        moved = [b'\xff' + row[:-1] for row in picture]
        self.assertGreater(difference(moved, picture), 4 * SAME)
        self.assertGreater(difference(drawn(self.graph, width=4), picture), 2 * SAME)

    def test_without_resolution_a_pixel_is_that_of_css(self):
        self.make('-o', 'out.svg', '-o', 'out.pdf', '-o', 'out.eps', '-o', 'out.png')
        self.check_picture(self.pixels_of_svg())
        self.check_picture(self.pixels_of_pdf(96))
        self.check_picture(self.pixels_of_eps(96))
        self.check_picture(from_png(self.read('out.png')))

    def test_with_resolution_the_sheet_has_its_size(self):
        self.make('-o', 'out.svg', '-o', 'out.pdf', '-o', 'out.eps', '-o', 'out.png', dots_per_metre=DOTS_PER_METRE)
        self.check_picture(self.pixels_of_svg('--dpi-x', '254', '--dpi-y', '254'))
        self.check_picture(self.pixels_of_pdf(254))
        self.check_picture(self.pixels_of_eps(254))
        self.check_picture(from_png(self.read('out.png')))

    def test_given_resolution_and_width(self):
        self.make('-o', 'out.svg', '-o', 'out.pdf', '-o', 'out.eps', '-o', 'out.png', '--resolution', '127', '--unit', 'inch',
                  '--stroke-width', '0.03125', dots_per_metre=DOTS_PER_METRE)
        width = 127 / 32
        self.check_picture(self.pixels_of_svg('--dpi-x', '127', '--dpi-y', '127'), width=width)
        self.check_picture(self.pixels_of_pdf(127), width=width)
        self.check_picture(self.pixels_of_eps(127), width=width)
        self.check_picture(from_png(self.read('out.png')), width=width)

    def test_scaled_png(self):
        self.make('-o', 'out.png', '--png-scale', '2')
        self.check_picture(reduced(from_png(self.read('out.png')), 2))

    def test_eps_says_how_large_it_is(self):
        self.make('-o', 'out.eps')
        text = self.read('out.eps').decode('ascii')
        self.assertEqual(re.findall(r'(?m)^%%(?:HiRes)?BoundingBox: (.*)$', text), ['0 0 150 90', '0 0 150 90'])
        self.assertLessEqual(max(map(len, text.splitlines())), 255)

    def test_pdf_is_told_to_be_whole_and_says_what_made_it_and_how_large_it_is(self):
        for dots_per_metre, size in ((0, '150 x 90'), (DOTS_PER_METRE, '56.6929 x 34.0157')):
            self.make('-o', 'out.pdf', dots_per_metre=dots_per_metre)
            told = subprocess.run(['pdfinfo', self.path('out.pdf')], check=True, capture_output=True)
            self.assertEqual(told.stderr, b'')
            self.assertRegex(told.stdout.decode(), r'(?s)Subject: +inkgrid \d.*Pages: +1\n.*Page size: +%s pts' % size)


def curve_paths(root):
    return [path for path in root.iter(SVG + 'path') if path.get('id').startswith('curve-')]


class SvgOptions(FormatTest):
    def root(self, *words, **more):
        self.make('-o', 'out.svg', *words, **more)
        return ElementTree.fromstring(self.read('out.svg'))

    def test_units(self):
        for unit, size in (('mm', ('20mm', '12mm')), ('inch', ('0.7874in', '0.47244in')), ('px', ('200', '120'))):
            root = self.root('--unit', unit, dots_per_metre=DOTS_PER_METRE)
            self.assertEqual((root.get('width'), root.get('height'), root.get('viewBox')), (*size, '0 0 200 120'))

    def test_widths(self):
        measured = [float(path.get('stroke-width')) for path in curve_paths(self.root())]
        self.assertEqual(measured, [round(curve['width'], 3) for curve in self.graph['curves']])
        self.assertGreater(len(set(measured)), 1)
        root = self.root('--stroke-width', '0.2', dots_per_metre=DOTS_PER_METRE)
        self.assertEqual({path.get('stroke-width') for path in curve_paths(root)}, {'2'})


class Dxf(FormatTest):
    def read_back(self, *words, **more):
        """The entities and the file, after the audit of a reader that is strict."""
        self.make('-o', 'out.dxf', *words, **more)
        document = ezdxf.readfile(self.path('out.dxf'))
        audit = document.audit()
        self.assertEqual((audit.errors, audit.fixes), ([], []))
        entities = list(document.modelspace())
        self.assertEqual({entity.dxf.layer for entity in entities}, {'CURVES', 'FILLS'})
        curves = [entity for entity in entities if entity.dxf.layer == 'CURVES']
        self.assertEqual(len(curves), len(self.graph['curves']))
        self.outlines = [{'closed': True, 'points': points} for area in self.graph['fills'] for points in area['outlines']]
        fills = [entity for entity in entities if entity.dxf.layer == 'FILLS']
        self.assertEqual((len(fills), len(self.outlines)), (2, 2))
        return fills + curves, document

    def in_pixels(self, point, scale=1.0):
        return point[0] / scale, self.graph['height'] - point[1] / scale

    def check_polylines(self, entities, scale, flatness):
        for entity, curve in zip(entities, self.outlines + self.graph['curves']):
            self.assertEqual(entity.dxftype(), 'POLYLINE')
            self.assertEqual(entity.is_closed, curve['closed'])
            corners = [self.in_pixels(vertex.dxf.location, scale) for vertex in entity.vertices]
            sides = list(zip(corners, corners[1:] + corners[:1] * curve['closed']))
            for p in points_on(curve, step=1):
                self.assertLess(min(distance(p, a, b) for a, b in sides), flatness + 1e-3)
            dense = points_on(curve, step=0.05)
            for corner in corners:
                self.assertLess(min(math.dist(corner, p) for p in dense), 0.05)

    def test_polylines_in_pixels(self):
        entities, document = self.read_back('--flatness', '0.2')
        self.assertEqual(document.dxfversion, 'AC1009')
        self.check_polylines(entities, 1, 0.2)
        self.assertEqual(tuple(document.header['$EXTMAX']), (200, 120, 0))

    def test_polylines_in_millimetres_and_inches(self):
        for words, scale in (((), 0.1), (('--unit', 'inch'), 1 / 254), (('--resolution', '127'), 0.2)):
            entities, document = self.read_back(*words, dots_per_metre=DOTS_PER_METRE)
            self.check_polylines(entities, scale, 0.05)
            self.assertAlmostEqual(document.header['$EXTMAX'][0], 200 * scale, places=5)

    def test_flatter_polylines_have_more_corners(self):
        coarse, fine = (sum(len(entity.vertices) for entity in self.read_back('--flatness', flatness)[0]) for flatness in ('1', '0.01'))
        self.assertGreater(fine, 4 * coarse)

    def test_splines_are_the_curves(self):
        entities, document = self.read_back('--dxf-curves', 'splines', dots_per_metre=DOTS_PER_METRE)
        self.assertEqual((document.dxfversion, document.units), ('AC1015', ezdxf.units.MM))
        for entity, curve in zip(entities, self.outlines + self.graph['curves']):
            self.assertEqual((entity.dxftype(), entity.dxf.degree, entity.closed), ('SPLINE', 3, curve['closed']))
            controls = [self.in_pixels(p, 0.1) for p in entity.control_points]
            self.assertEqual(len(controls), len(curve['points']))
            for p, q in zip(controls, curve['points']):
                self.assertLess(math.dist(p, q), 1e-4)
            spline, segments = entity.construction_tool(), (len(controls) - 1) // 3
            for k in range(segments):  # the middle of each segment, by the reader and by hand
                middle = [sum(w * q[axis] for w, q in zip((1 / 8, 3 / 8, 3 / 8, 1 / 8), curve['points'][3 * k:])) for axis in (0, 1)]
                self.assertLess(math.dist(self.in_pixels(spline.point(k + 0.5), 0.1), middle), 1e-4)

    def test_unit_of_splines(self):
        for words, unit in (((), 0), (('--unit', 'inch'), 1), (('--unit', 'mm'), 4)):
            self.assertEqual(self.read_back('--dxf-curves', 'splines', *words)[1].units, unit)


def distance(p, a, b):
    along = (b[0] - a[0], b[1] - a[1])
    squared = along[0] ** 2 + along[1] ** 2
    t = max(0.0, min(1.0, ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / squared)) if squared else 0.0
    return math.dist(p, (a[0] + t * along[0], a[1] + t * along[1]))


class Graph(FormatTest):
    def schema(self):
        with open(os.path.join(SCHEMAS, 'graph.schema.json'), encoding='utf-8') as file:
            return json.load(file)

    def test_follows_its_schema(self):
        jsonschema.Draft7Validator.check_schema(self.schema())
        for dots_per_metre in (0, DOTS_PER_METRE):
            self.make(dots_per_metre=dots_per_metre)
            jsonschema.validate(self.graph, self.schema())
            self.assertEqual(self.graph['pixels_per_mm'], dots_per_metre / 1000 or None)

    def test_schema_refuses_what_is_wrong(self):
        self.make()
        for name, value in (('version', 2), ('curves', [{}]), ('fills', [{'id': 1}]), ('width', -1), ('more', 1)):
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate({**self.graph, name: value}, self.schema())

    def test_says_what_the_svg_draws(self):
        self.make('-o', 'out.svg')
        paths = curve_paths(ElementTree.fromstring(self.read('out.svg')))
        self.assertEqual([path.get('id') for path in paths], ['curve-%d' % curve['id'] for curve in self.graph['curves']])
        for path, curve in zip(paths, self.graph['curves']):
            numbers = [float(number) for number in re.findall(r'-?[\d.]+', path.get('d'))]
            expected = [coordinate for point in curve['points'] for coordinate in point]
            self.assertEqual(len(numbers), len(expected))
            self.assertLess(max(abs(a - b) for a, b in zip(numbers, expected)), 6e-4)
            self.assertEqual(path.get('d').endswith('z'), curve['closed'])

    def test_junctions_are_the_ends_of_their_curves_to_the_last_digit(self):
        self.make()
        at = {junction['id']: junction['at'] for junction in self.graph['junctions']}
        ends = [(curve['start'], curve['points'][0]) for curve in self.graph['curves']]
        ends += [(curve['end'], curve['points'][-1]) for curve in self.graph['curves']]
        shared = [(junction, point) for junction, point in ends if junction is not None]
        self.assertEqual(len(shared), 4)
        for junction, point in shared:
            self.assertEqual(at[junction], point)


class ChoiceOfFormat(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('drawing.png', png(sketch()))

    def test_by_extension_whatever_its_case(self):
        self.succeed('drawing.png', '-o', 'a.PDF', '-o', 'a.eps', '-o', 'a.dxf', '-o', 'a.svg', '-o', 'a.json', '-o', 'b.png')
        for name, begin in (('a.PDF', b'%PDF'), ('a.eps', b'%!PS'), ('a.dxf', b'999\n'), ('a.svg', b'<?xml'), ('a.json', b'{'),
                            ('b.png', b'\x89PNG')):
            self.assertTrue(self.read(name).startswith(begin), name)

    def test_by_name(self):
        self.succeed('drawing.png', '--format', 'pdf', '-o', 'odd.svg')
        self.assertTrue(self.read('odd.svg').startswith(b'%PDF'))
        self.succeed('drawing.png', '--format', 'dxf')
        self.assertTrue(self.read('drawing.dxf').startswith(b'999\n'))
        self.assertTrue(self.succeed('drawing.png', '--format', 'eps', '-o', '-').stdout.startswith(b'%!PS'))
        self.assertTrue(self.succeed('-', '--format', 'json', stdin=self.read('drawing.png')).stdout.startswith(b'{'))

    def test_into_a_directory(self):
        os.mkdir(self.path('out'))
        self.succeed('drawing.png', '-o', 'out', '--format', 'dxf')
        self.assertEqual(os.listdir(self.path('out')), ['drawing.dxf'])

    def test_of_several_drawings(self):
        self.put('second.png', png(sketch()))
        self.succeed('drawing.png', 'second.png', '--format', 'pdf')
        self.assertEqual(self.files(), ['drawing.pdf', 'drawing.png', 'second.pdf', 'second.png'])

    def test_no_extension_is_svg(self):
        self.succeed('drawing.png', '-o', 'curves')
        self.check_svg(self.read('curves'))

    def test_unknown(self):
        self.assertIn('svg, pdf, eps, dxf, json, png', self.refuse(1, 'drawing.png', '-o', 'curves.ai'))
        self.assertIn('ai', self.refuse(1, 'drawing.png', '--format', 'ai'))

    def test_over_the_drawing(self):
        self.refuse(1, 'drawing.png', '--format', 'png')
        self.refuse(1, 'drawing.png', '-o', 'a.svg', '-o', 'drawing.png')
        self.refuse(1, 'drawing.png', '-o', 'a.svg', '-o', './a.svg')

    def test_option_out_of_range(self):
        for option, value in (('--unit', 'furlong'), ('--resolution', '0'), ('--stroke-width', '-1'), ('--dxf-curves', 'arcs'),
                              ('--flatness', 'nan'), ('--png-scale', '0')):
            message = self.refuse(1, 'drawing.png', option, value)
            self.assertIn(option[2:] + ' must be ', message)
            self.assertIn("'%s'" % value, message)

    def test_png_that_would_be_too_large_leaves_the_others_unwritten(self):
        self.put('strip.png', png([bytearray(b'\xff') * 4000 for _ in range(3)]))
        self.refuse(1, 'strip.png', '--quiet', '-o', 'a.svg', '-o', 'a.png', '--png-scale', '10')

    def test_same_bytes_again(self):
        for run_number in ('1', '2'):
            self.succeed('drawing.png', *(word for name in ('pdf', 'eps', 'dxf', 'json', 'png')
                                          for word in ('-o', run_number + '.' + name)))
        for name in ('pdf', 'eps', 'dxf', 'json', 'png'):
            self.assertEqual(self.read('1.' + name), self.read('2.' + name), name)


class Documentation(CommandTest):
    def test_examples_follow_their_schemas(self):
        with open(os.path.join(SCHEMAS, '..', 'FORMATS.md'), encoding='utf-8') as page:
            examples = [json.loads(text) for text in re.findall(r'(?s)```json\n(.*?)```', page.read())]
        self.assertEqual([example['format'] for example in examples], ['inkgrid-graph', 'inkgrid-project'])
        for example in examples:
            with open(os.path.join(SCHEMAS, example['format'].split('-')[1] + '.schema.json'), encoding='utf-8') as schema:
                jsonschema.validate(example, json.load(schema))

    def test_options_and_formats_are_those_of_the_help(self):
        with open(os.path.join(SCHEMAS, '..', 'FORMATS.md'), encoding='utf-8') as page:
            documented = set(re.findall(r'(?m)^\| `(--[a-z-]+)', page.read()))
        told = re.search(r'(?s)\nFormats\. .*?\n\n(.*?)\n\n', self.succeed('--help').stdout.decode()).group(1)
        self.assertEqual(set(re.findall(r'(?m)^  (--[a-z-]+)', told)), documented)
        self.assertEqual(re.findall(r'(?m)^  ([a-z]+)$', told), ['svg', 'pdf', 'eps', 'dxf', 'json', 'png'])
