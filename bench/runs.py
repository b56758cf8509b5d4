"""What the scripts here share: the drawings of a corpus, the program run on them, and tables."""
import csv
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import xml.etree.ElementTree as ET
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PICTURES = ('.png', '.jpg', '.jpeg', '.webp', '.tif', '.tiff', '.bmp')
NUMBER = re.compile(r'-?[\d.]+(?:e[-+]?\d+)?')
MEASURES = ('f1', 'f1_half_tolerance', 'duplicate_ratio', 'junction_f1', 'end_f1', 'segments_ratio')   # of inkgrid compare
MARGIN = 0.5      # sides of the drawing that a control point may lie outside


def add_run_arguments(parser, out):
    parser.add_argument('corpus', type=Path)
    parser.add_argument('--out', type=Path, default=Path(out), help=f'default: {out}')
    parser.add_argument('--jobs', type=int, default=2, help='drawings at a time (default 2)')
    parser.add_argument('--only', default='', metavar='TEXT', help='only drawings with TEXT in SET/NAME')
    parser.add_argument('--program', type=Path, default=ROOT / 'build' / 'inkgrid', help='default: build/inkgrid of this project')
    parser.add_argument('--timeout', type=float, default=600, metavar='S', help='seconds a drawing (default 600)')


def add_thinning_arguments(parser):
    parser.add_argument('--set', action='append', help='only this set; may be given several times')
    parser.add_argument('--every', type=int, default=1, metavar='K', help='only every K-th drawing of a set')


def check(parser, options):
    for path in (options.program, options.corpus):
        if not path.exists():
            parser.error(f'{path} does not exist')
    if options.every < 1:
        parser.error('--every takes a positive number')


def selected(options):
    todo = drawings(options.corpus, options.only)
    groups = options.set or sorted({group for group, _, _ in todo})
    return [d for group in groups for d in [d for d in todo if d[0] == group][::options.every]]


def truth_of(picture):
    """The ground truth beside a picture, whether it is there or not."""
    return picture.with_name(picture.stem + '.gt.svg')


def drawings(corpus, only):
    """(set, name, picture) of every drawing with ground truth and of those in real/."""
    found = []
    for picture in sorted(corpus.glob('*/*')):
        known = picture.parent.name == 'real' or truth_of(picture).exists()
        if picture.suffix.lower() in PICTURES and known and only in f'{picture.parent.name}/{picture.stem}':
            found.append((picture.parent.name, picture.stem, picture))
    return found


def problem_of(exit_code, svg, complaint, timed_out):
    if timed_out:
        return 'too slow'
    if exit_code:
        return (complaint.strip().splitlines() or [f'exit {exit_code}'])[-1][:160]
    try:
        text = svg.read_text()
        root = ET.fromstring(text)
    except (OSError, ET.ParseError, UnicodeDecodeError) as error:
        return f'{type(error).__name__}: {error}'[:160]
    paths = [e.get('d', '') for e in root.iter() if e.tag.endswith('path')]
    if any('nan' in d or 'inf' in d for d in paths):
        return 'a coordinate that is no number'
    side = max(float(v) for v in root.get('viewBox').split()[2:])
    if any(not -MARGIN * side < float(v) < (1 + MARGIN) * side for d in paths for v in NUMBER.findall(d)):
        return 'a curve far outside the drawing'
    return '' if paths else 'no curve'


def run(program, picture, svg, extra, timeout):
    """One row of runs.csv, without its names.  wait4 gives the memory and CPU time of this very process."""
    svg.parent.mkdir(parents=True, exist_ok=True)
    svg.unlink(missing_ok=True)
    late = threading.Event()
    start = time.monotonic()
    with tempfile.TemporaryFile('w+', errors='replace') as complaint:
        process = subprocess.Popen([program, *extra, '-o', svg, picture], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=complaint)
        timer = threading.Timer(timeout, lambda: (late.set(), process.kill()))
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        timer.cancel()
        complaint.seek(0)
        problem = problem_of(process.returncode, svg, complaint.read(), late.is_set())
    if problem and svg.exists():
        svg.replace(svg.with_suffix('.bad'))    # not to be scored
    return dict(exit=process.returncode, seconds=round(time.monotonic() - start, 3), cpu_seconds=round(usage.ru_utime + usage.ru_stime, 3),
                peak_mb=round(usage.ru_maxrss / 1024), problem=problem)


def measured(program, svg, truth):
    """MEASURES of a result, or the problem that there is with it."""
    done = subprocess.run([program, 'compare', svg, truth, '--json'], capture_output=True, text=True)
    if done.returncode:
        return dict(problem=done.stderr.strip())
    found = json.loads(done.stdout)
    return dict({key: found.get(key) for key in MEASURES}, junction_f1=found['junctions']['f1'], end_f1=found['ends']['f1'])


def in_parallel(work, items, jobs, name):
    """Yields what `work` makes of each item, in order, and tells a terminal how far it is."""
    with ThreadPoolExecutor(jobs) as pool:
        for done, (item, result) in enumerate(zip(items, pool.map(work, items)), 1):
            if sys.stderr.isatty():
                print(f'\r{done} of {len(items)}  {name(item)}'.ljust(70)[:70], end='', file=sys.stderr)
            yield result
    if sys.stderr.isatty():
        print('\r' + ' ' * 70 + '\r', end='', file=sys.stderr)


def write_csv(path, columns, rows):
    with open(path, 'w', newline='') as file:
        writer = csv.DictWriter(file, columns, extrasaction='ignore')
        writer.writeheader()
        writer.writerows(rows)


def mean(values):
    known = [v for v in values if v is not None]
    return statistics.fmean(known) if known else None


def shown(value, width, places):
    return ('-' if value is None else f'{value:.{places}f}').rjust(width)
