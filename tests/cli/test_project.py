"""Projects: what was asked of a drawing, kept in a file and taken up again."""
import base64
import json
import math
import os

import jsonschema

from support import CommandTest, cross, png

SCHEMA = os.path.join(os.environ['INKGRID_SOURCE'], 'docs', 'schema', 'project.schema.json')
PURPLE, ORANGE = (160, 32, 240), (255, 150, 0)
USAGE, FILE = 1, 2


def scribbled(scribbles):
    """The mask image, 160 x 120 px, that says the same as scribbles."""
    rows = [bytearray(b'\xff' * 480) for _ in range(120)]
    for scribble in scribbles:
        colour = {'less': PURPLE, 'more': ORANGE, 'erase': (255, 255, 255)}[scribble['kind']]
        points = scribble['points']
        for y in range(120):
            for x in range(160):
                if any(distance((x + 0.5, y + 0.5), a, b) <= scribble['radius'] for a, b in zip(points[:1] + points, points)):
                    rows[y][3 * x:3 * x + 3] = bytes(colour)
    return rows


def distance(p, a, b):
    along = (b[0] - a[0], b[1] - a[1])
    squared = along[0] ** 2 + along[1] ** 2
    t = max(0.0, min(1.0, ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / squared)) if squared else 0.0
    return math.dist(p, (a[0] + t * along[0], a[1] + t * along[1]))


class ProjectTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.put('drawing.png', png(cross(), dots_per_metre=10000))

    def project(self, **more):
        return {'format': 'inkgrid-project', 'version': 1,
                'drawing': {'name': 'drawing.png', 'data': base64.b64encode(self.read('drawing.png')).decode()}, **more}

    def put_project(self, name='p.json', **more):
        return self.put(name, json.dumps(self.project(**more)).encode())

    def result(self, *words):
        return self.succeed(*words, '--quiet', '-o', '-').stdout


class Projects(ProjectTest):
    def test_of_a_drawing_gives_what_the_drawing_gives(self):
        for words in ((), ('--preset', 'rough', '--spacing', '2'), ('--format', 'dxf')):
            self.assertEqual(self.result('--project', self.put_project(), *words), self.result('drawing.png', *words))

    def test_options_are_those_of_the_command_line(self):
        given = self.result('drawing.png', '--spacing', '1.5', '--preset', 'rough', '--tolerance', '0.3', '--threshold', '100')
        options = {'spacing': 1.5, 'preset': 'rough', 'tolerance': 0.3, 'threshold': 100}
        self.assertEqual(self.result('--project', self.put_project(options=options)), given)
        self.assertNotEqual(self.result('drawing.png'), given)

    def test_options_that_are_given_come_first(self):
        self.put_project(options={'spacing': 1.5, 'tolerance': 0.3})
        self.assertEqual(self.result('--project', 'p.json', '--spacing', '2', '--threshold', '90'),
                         self.result('drawing.png', '--spacing', '2', '--tolerance', '0.3', '--threshold', '90'))

    def test_scribbles_are_a_mask(self):
        scribbles = [{'kind': 'more', 'radius': 11.5, 'points': [[20, 50], [60, 70], [60, 71]]},
                     {'kind': 'less', 'radius': 9, 'points': [[80, 100], [80.5, 20]]},
                     {'kind': 'erase', 'radius': 6, 'points': [[75, 60]]}]
        self.put('mask.png', png(scribbled(scribbles), colour=True))
        self.put_project(scribbles=scribbles)
        words = ('--reach', '0.4', '--spacing', '1', '--report', 'report.json')
        given = self.result('drawing.png', '--mask', 'mask.png', *words)
        triangles = json.loads(self.read('report.json'))['triangles']
        self.assertEqual(self.result('--project', 'p.json', *words), given)
        self.result('drawing.png', *words)
        self.assertNotEqual(json.loads(self.read('report.json'))['triangles'], triangles)

    def test_mask_in_the_project(self):
        mask = png(scribbled([{'kind': 'more', 'radius': 20, 'points': [[40, 60]]}]), colour=True)
        self.put('mask.png', mask)
        self.put_project(mask={'name': 'mask.png', 'data': base64.b64encode(mask).decode()})
        self.assertEqual(self.result('--project', 'p.json'), self.result('drawing.png', '--mask', 'mask.png'))

    def test_hand_edits(self):
        self.assertEqual(self.check_svg(self.result('drawing.png')), 4)
        self.put_project(edits=[{'kind': 'delete', 'at': [40, 60]}, {'kind': 'join', 'at': [80, 40], 'to': [80, 80]}])
        self.assertEqual(self.check_svg(self.result('--project', 'p.json')), 2)

    def test_edit_that_finds_no_curve_is_a_warning(self):
        self.put_project(edits=[{'kind': 'delete', 'at': [5, 5]}, {'kind': 'split', 'at': [5, 5], 'tolerance': 2}])
        done = self.succeed('--project', 'p.json', '-o', '-')
        self.assertIn('2 hand edits found no curve', done.stderr.decode())
        self.assertEqual(self.check_svg(done.stdout), 4)

    def test_result_is_named_after_the_project(self):
        self.put_project('my.project.json')
        self.succeed('--project', 'my.project.json')
        self.assertEqual(self.files(), ['drawing.png', 'my.project.json', 'my.project.svg'])

    def test_from_standard_input(self):
        self.put_project()
        done = self.succeed('--project', '-', '--quiet', stdin=self.read('p.json'))
        self.assertEqual(done.stdout, self.result('drawing.png'))


class SavedProjects(ProjectTest):
    def saved(self, *words):
        done = self.succeed(*words, '--quiet', '--save-project', 'saved.json', '-o', '-')
        project = json.loads(self.read('saved.json'))
        with open(SCHEMA, encoding='utf-8') as schema:
            jsonschema.validate(project, json.load(schema))
        return done.stdout, project

    def test_gives_the_same_again(self):
        self.put('mask.png', png(scribbled([{'kind': 'more', 'radius': 20, 'points': [[40, 60]]}]), colour=True))
        for words in ((), ('--preset', 'rough', '--snap', '30'), ('--mask', 'mask.png')):
            first, _ = self.saved('drawing.png', *words)
            self.assertEqual(self.result('--project', 'saved.json'), first)

    def test_holds_drawing_and_options(self):
        _, project = self.saved('drawing.png', '--snap', '30', '--preset', 'auto')
        self.assertEqual(base64.b64decode(project['drawing']['data']), self.read('drawing.png'))
        self.assertEqual(project['options'], {'snap': 30})

    def test_names_no_directory(self):
        _, project = self.saved(self.path('drawing.png'))
        self.assertEqual(project['drawing']['name'], 'drawing.png')

    def test_of_a_project_keeps_what_it_holds(self):
        held = {'scribbles': [{'kind': 'less', 'radius': 4.5, 'points': [[1, 2], [0.1, -3]]}],
                'edits': [{'kind': 'join', 'at': [1, 2], 'to': [3, 4], 'tolerance': 5}]}
        self.put_project(options={'snap': 20, 'reach': 0.5}, **held)
        _, project = self.saved('--project', 'p.json', '--snap', '30')
        self.assertEqual({name: project[name] for name in held}, held)
        self.assertEqual(project['options'], {'snap': 30, 'reach': 0.5})

    def test_same_bytes_again(self):
        self.saved('drawing.png')
        before = self.read('saved.json')
        self.saved('drawing.png')
        self.assertEqual(self.read('saved.json'), before)

    def test_schema_is_one_and_refuses_what_is_wrong(self):
        with open(SCHEMA, encoding='utf-8') as file:
            schema = json.load(file)
        jsonschema.Draft7Validator.check_schema(schema)
        for wrong in ({'version': 2}, {'more': 1}, {'edits': [{'kind': 'join', 'at': [1, 2]}]}, {'scribbles': [{'kind': 'less'}]}):
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate({**self.project(), **wrong}, schema)


class ProjectsThatAreWrong(ProjectTest):
    def test_missing(self):
        self.assertIn('none.json', self.refuse(FILE, '--project', 'none.json', '-o', 'out.svg'))

    def test_no_project(self):
        for content in (b'', b'{', b'nonsense', b'[1, 2]', b'{"format": "inkgrid-graph", "version": 1}', png(cross()), b'[' * 100000):
            self.assertIn("'p.json'", self.refuse(FILE, '--project', self.put('p.json', content)))

    def test_unknown_version(self):
        self.assertIn('version', self.refuse(FILE, '--project', self.put_project(version=99)))

    def test_huge_numbers(self):
        text = json.dumps(self.project(scribbles=[{'kind': 'less', 'radius': 'R', 'points': [[1, 1]]}]))
        for number in ('1e999', '-1e999', '1e300', '9' * 400):
            self.put('p.json', text.replace('"R"', number).encode())
            self.refuse(FILE, '--project', 'p.json')

    def test_truncated(self):
        whole = json.dumps(self.project()).encode()
        for part in (10, len(whole) // 2, len(whole) - 1):
            self.refuse(FILE, '--project', self.put('p.json', whole[:part]))

    def test_truncated_base64(self):
        data = base64.b64encode(self.read('drawing.png')).decode()
        for cut in (1, 2, 3):
            self.assertIn('base64', self.refuse(FILE, '--project', self.put_project(drawing={'name': 'x', 'data': data[:-cut]})))
        message = self.refuse(FILE, '--project', self.put_project(drawing={'name': 'x.png', 'data': data[:len(data) // 8 * 4]}))
        self.assertIn("'p.json': 'x.png'", message)

    def test_mask_of_another_size(self):
        mask = base64.b64encode(png([bytearray(PURPLE * 30)] * 20, colour=True)).decode()
        self.assertIn('mask', self.refuse(USAGE, '--project', self.put_project(mask={'name': 'm.png', 'data': mask})))

    def test_option_out_of_range(self):
        self.assertIn('spacing must be', self.refuse(FILE, '--project', self.put_project(options={'spacing': 1e6})))

    def test_beside_a_drawing(self):
        self.refuse(USAGE, 'drawing.png', '--project', self.put_project())

    def test_saved_over_what_is_read(self):
        self.put_project()
        self.refuse(USAGE, '--project', 'p.json', '--save-project', 'p.json')
        self.refuse(USAGE, '--project', 'p.json', '--format', 'json')
        self.refuse(USAGE, 'drawing.png', '--save-project', 'drawing.png')
        self.refuse(USAGE, 'drawing.png', '--save-project', 'drawing.svg')

    def test_saved_of_several_drawings(self):
        self.put('other.png', png(cross()))
        self.refuse(USAGE, 'drawing.png', 'other.png', '--save-project', 'p.json')

    def test_saved_where_nothing_can_be_written(self):
        self.refuse(FILE, 'drawing.png', '--save-project', 'missing/p.json')
