"""Curves for drawings: points are complex numbers, a curve is a list of cubic Bezier segments (p0, p1, p2, p3).  Standard library only."""
import cmath
import math


# ---------------------------------------------------------------- curves through points
def points(text):
    """'10,20 30,40' -> [10+20j, 30+40j]"""
    return [complex(*map(float, pair.split(','))) for pair in text.split()]


def solved(matrix, right):
    """Gaussian elimination with pivoting; small systems only."""
    n = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    result = [0.0] * n
    for k in reversed(range(n)):
        result[k] = (rows[k][n] - sum(rows[k][i] * result[i] for i in range(k + 1, n))) / rows[k][k]
    return result


def velocity(theta, phi):
    """Length of a handle over a third of the chord's, Hobby 1986, 'Smooth, easy to compute interpolating splines'."""
    wave = math.sqrt(2) * (math.sin(theta) - math.sin(phi) / 16) * (math.sin(phi) - math.sin(theta) / 16) * (math.cos(theta) - math.cos(phi))
    return (2 + wave) / (3 * (1 + (math.sqrt(5) - 1) / 2 * math.cos(theta) + (3 - math.sqrt(5)) / 2 * math.cos(phi)))


def smooth_piece(z, closed=False):
    """Hobby's spline through z: mock curvature is continuous, free ends curl as their neighbours."""
    n = len(z)
    if n == 2 and not closed:
        return line(z[0], z[1])
    segments = n if closed else n - 1
    chord = [z[(k + 1) % n] - z[k] for k in range(segments)]
    length = [abs(c) for c in chord]
    turn = [cmath.phase(chord[k % segments] / chord[k - 1]) if closed or 0 < k < n - 1 else 0.0 for k in range(n)]
    matrix, right = [[0.0] * n for _ in range(n)], [0.0] * n
    for k in range(n):
        row = matrix[k]
        if not closed and k in (0, n - 1):
            other = 1 if k == 0 else n - 2
            row[k], row[other] = 1, 1
            right[k] = -turn[1] if k == 0 else 0
            continue
        before, after = length[k - 1], length[k % segments]
        row[(k - 1) % n] += 1 / before
        row[k] += 2 / before + 2 / after
        row[(k + 1) % n] += 1 / after
        right[k] = -2 * turn[k] / before - turn[(k + 1) % n] / after
    theta = solved(matrix, right)
    result = []
    for k in range(segments):
        a, b = z[k], z[(k + 1) % n]
        out, into = theta[k], -turn[(k + 1) % n] - theta[(k + 1) % n]
        result.append((a, a + cmath.exp(1j * out) * chord[k] * velocity(out, into), b - cmath.exp(-1j * into) * chord[k] * velocity(into, out), b))
    return result


def smooth(text):
    """Through the points of the text; '|' makes the point before it a corner, a final 'o' closes the curve smoothly, 'z' with a corner."""
    words = text.replace('|', ' | ').split()
    ring = words[-1] == 'o'
    if ring:
        return smooth_piece(points(' '.join(words[:-1])), closed=True)
    if words[-1] == 'z':
        words[-1] = next(w for w in words if w != '|')
    pieces = [points(piece) for piece in ' '.join(words).split('|')]
    curve = []
    for i, piece in enumerate(pieces):
        run = pieces[i - 1][-1:] + piece if i else piece
        curve += smooth_piece(run) if len(run) > 1 else []
    return curve


def line(a, b):
    return [(a, a + (b - a) / 3, b - (b - a) / 3, b)]


def polyline(text):
    """Straight from point to point; a final 'z' closes it."""
    closed = text.endswith('z')
    z = points(text.rstrip('z '))
    return [segment for a, b in zip(z, z[1:] + z[:1] if closed else z[1:]) for segment in line(a, b)]


def arc(centre, radius, start, end, squash=1.0):
    """From one angle to another, in degrees, growing clockwise (y is down); `squash` scales the height."""
    count = max(1, math.ceil(abs(end - start) / 90))
    step = math.radians(end - start) / count
    handle = 4 / 3 * math.tan(step / 4)
    result = []
    for i in range(count):
        a, b = math.radians(start) + i * step, math.radians(start) + (i + 1) * step
        p, q = cmath.exp(1j * a), cmath.exp(1j * b)
        result.append(tuple(centre + radius * complex(w.real, w.imag * squash) for w in (p, p + handle * 1j * p, q - handle * 1j * q, q)))
    return result


def circle(centre, radius, squash=1.0):
    return closed_exactly(arc(centre, radius, 0, 360, squash))


def closed_exactly(curve):
    return curve[:-1] + [curve[-1][:3] + (curve[0][0],)]


# ---------------------------------------------------------------- curves moved, sampled, turned round
def moved(curve, scale=1, shift=0j, mirror=None):
    """`mirror`: the x of a vertical axis."""
    flip = (lambda p: complex(2 * mirror - p.real, p.imag)) if mirror is not None else (lambda p: p)
    return [tuple(scale * flip(p) + shift for p in segment) for segment in curve]


def at(segment, t):
    p, q, r, s = segment
    return (1 - t) ** 3 * p + 3 * (1 - t) ** 2 * t * q + 3 * (1 - t) * t * t * r + t ** 3 * s


def part(segment, t0, t1):
    """The segment from t0 to t1, by de Casteljau's construction."""
    mix = lambda points, t: [a + t * (b - a) for a, b in zip(points, points[1:])]
    def halves(points, t):
        rows = [points]
        while len(rows[-1]) > 1:
            rows.append(mix(rows[-1], t))
        return tuple(row[0] for row in rows), tuple(row[-1] for row in reversed(rows))
    return halves(halves(segment, t1)[0], t0 / t1 if t1 else 0)[1]


def visible(curve, width, height):
    """The runs of the curve that lie on the page."""
    on_page = lambda p: 0 <= p.real <= width and 0 <= p.imag <= height
    runs, open_run = [], False
    for segment in curve:
        places = [0.0]
        for i in range(64):
            low, high = i / 64, (i + 1) / 64
            if on_page(at(segment, low)) != on_page(at(segment, high)):
                entering = on_page(at(segment, high))
                for _ in range(40):
                    middle = (low + high) / 2
                    low, high = (low, middle) if on_page(at(segment, middle)) == entering else (middle, high)
                places.append(high)
        for t0, t1 in zip(places, places[1:] + [1.0]):
            inside = on_page(at(segment, (t0 + t1) / 2))
            if inside and not open_run:
                runs.append([])
            if inside:
                runs[-1].append(segment if (t0, t1) == (0, 1) else part(segment, t0, t1))
            open_run = inside
    return runs


def sampled(curve, step):
    """Points about `step` apart along the curve, both ends among them."""
    fine = [curve[0][0]] + [at(segment, i / 24) for segment in curve for i in range(1, 25)]
    length = [0.0]
    for a, b in zip(fine, fine[1:]):
        length.append(length[-1] + abs(b - a))
    count = max(2, round(length[-1] / step))
    result, k = [], 0
    for i in range(count + 1):
        target = length[-1] * i / count
        while k + 2 < len(length) and length[k + 1] < target:
            k += 1
        span = length[k + 1] - length[k] or 1
        result.append(fine[k] + (fine[k + 1] - fine[k]) * (target - length[k]) / span)
    return result


def is_closed(curve):
    return abs(curve[0][0] - curve[-1][3]) < 1e-6


def corner_pieces(curve, degrees=35):
    """Split where the direction turns by more than `degrees`."""
    def direction(a, b):
        return b - a if abs(b - a) > 1e-9 else 1
    pieces = [[curve[0]]]
    for before, segment in zip(curve, curve[1:]):
        turn = abs(cmath.phase(direction(segment[0], segment[1]) / direction(before[2], before[3])))
        if math.degrees(turn) > degrees:
            pieces.append([])
        pieces[-1].append(segment)
    return pieces


# ---------------------------------------------------------------- SVG
def number(value):
    return f'{value:.1f}'.removesuffix('.0').replace('-0', '-0' if abs(value) >= 0.05 else '0')


def pair(p):
    return f'{number(p.real)},{number(p.imag)}'


def path_data(curve):
    text = 'M' + pair(curve[0][0])
    for p, q, r, s in curve:
        straight = abs(q - p - (s - p) / 3) + abs(s - r - (s - p) / 3) < 1e-6
        text += 'L' + pair(s) if straight else 'C' + ' '.join(map(pair, (q, r, s)))
    return text + ('Z' if is_closed(curve) else '')
