"""
Measure rocon_uri, each figure beside a reference on the same machine in the same run.

    python3 benchmark [--json FILE] [PART...]

A part is a module ``bench_PART.py`` here, with a function ``figures()`` that yields dicts:

name                        what is measured
ratio                       of it to the reference
target                      what the ratio may be at most; None if it is only shown
reference                   what it is measured with
seconds, reference_seconds  what the ratio is of, where it is of times
sizes, times                how much there was, and the seconds that each took, of a growth
details                     str: what else there is to know, may be left out
"""
import argparse
import importlib
import json
import os
import platform
import sys
import time
from glob import glob

from measure import with_unit

FOLDER = os.path.dirname(os.path.abspath(__file__))


def main():
    """Run the parts that are asked for, and return 1 if a target is missed."""
    parts = sorted(os.path.basename(path)[len('bench_'):-len('.py')]
                   for path in glob(os.path.join(FOLDER, 'bench_*.py')))
    parser = argparse.ArgumentParser(prog='benchmark', description='Measure rocon_uri.')
    parser.add_argument('parts', metavar='PART', nargs='*',
                        help='one of %s; all where left out' % ', '.join(parts))
    parser.add_argument('--json', metavar='FILE', help='write the figures there too')
    args = parser.parse_args()
    unknown = set(args.parts) - set(parts)
    if unknown:
        parser.error('no such part: %s' % ', '.join(sorted(unknown)))
    sys.path.insert(0, os.path.join(os.path.dirname(FOLDER), 'src'))
    figures = []
    for part in args.parts or parts:
        print('%s\n%-62s %9s %9s' % (part, '', 'ratio', 'at most'))
        for figure in importlib.import_module('bench_' + part).figures():
            figure.update(part=part, met=figure['target'] is None
                          or figure['ratio'] <= figure['target'])
            figures.append(figure)
            show(figure)
        print()
    missed = [figure['name'] for figure in figures if not figure['met']]
    print('missed: ' + '; '.join(missed) if missed else 'every target is met')
    if args.json:
        with open(args.json, 'w') as file:
            json.dump(dict(where(), figures=figures), file, indent=2)
    return 1 if missed else 0


def where():
    """What the figures depend on: the machine, and when it was."""
    processor = platform.processor()
    if os.path.exists('/proc/cpuinfo'):
        with open('/proc/cpuinfo') as file:
            processor = dict(line.split('\t: ', 1) for line in file.read().splitlines()
                             if '\t: ' in line).get('model name', processor)
    return {'python': platform.python_version(), 'machine': platform.machine(),
            'processor': ' '.join(processor.split()), 'processors': os.cpu_count(),
            'load': os.getloadavg()[0], 'date': time.strftime('%Y-%m-%d')}


def show(figure):
    """Print a figure, on two lines."""
    target = '' if figure['target'] is None else '%.6g' % figure['target']
    print('%-62s %9.3f %9s  %s' % (figure['name'], figure['ratio'], target,
                                   '' if not target else 'met' if figure['met'] else 'MISSED'))
    notes = ['to ' + figure['reference']]
    if 'seconds' in figure:
        notes.append('%s to %s' % tuple(map(
            with_unit, (figure['seconds'], figure['reference_seconds']))))
    if 'details' in figure:
        notes.append(figure['details'])
    print('    ' + '; '.join(notes), flush=True)


if __name__ == '__main__':
    raise SystemExit(main())
