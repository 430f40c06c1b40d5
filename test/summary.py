"""
The last lines of test/run: what ran, on which Python, how it ended, how long it took, and what was
left out.

  /usr/bin/python3 test/summary.py STEPS [VERSION ...]

STEPS is the file in which test/run notes its steps; the versions are those of the Pythons that it
found beside the system's.
"""
from __future__ import annotations

import glob
import os
import sys
from collections import Counter
from typing import Iterator, List, NamedTuple, Tuple
from xml.etree import ElementTree

LEFT_OUT = 75       # the exit status of a step that could not install what it needs
PYTHONS = ['3.%d' % minor for minor in range(8, 14)]


class Step(NamedTuple):
    """One step of test/run."""

    name: str
    #: its junit reports, a pattern for paths; '' if it has none
    reports: str
    #: the exit status
    status: int
    seconds: int


class Counts(NamedTuple):
    """How the tests of a step ended."""

    passed: int
    failed: List[str]
    #: why each that was skipped was skipped
    skipped: List[str]


def steps_in(path: str) -> List[Step]:
    """The steps that test/run noted in this file."""
    with open(path, encoding='utf-8') as file:
        lines = [line.rstrip('\n').split('\t') for line in file]
    return [Step(name, reports, int(status), int(seconds))
            for name, reports, status, seconds in lines]


def counts_of(step: Step) -> Counts:
    """What the reports of a step say."""
    cases = [case for path in sorted(glob.glob(step.reports)) for case in _cases(path)]
    failed = [name for name, ended, _ in cases if ended in ('failure', 'error')]
    skipped = [why for _, ended, why in cases if ended == 'skipped']
    return Counts(len(cases) - len(failed) - len(skipped), failed, skipped)


def _cases(path: str) -> Iterator[Tuple[str, str, str]]:
    """The name of each test in a report, the tag that says how it ended, and why."""
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        yield path, 'error', str(error)
        return
    for case in root.iter('testcase'):
        name = '%s.%s' % (case.get('classname'), case.get('name'))
        other = [child for child in case if child.tag in ('failure', 'error', 'skipped')]
        yield (name, other[0].tag, other[0].get('message', '')) if other else (name, 'passed', '')


def main(path: str, *versions: str) -> int:
    """Print the summary, and return the exit status of test/run."""
    failed = []
    total: Counter[str] = Counter()
    print('== summary')
    for step in steps_in(path):
        counts = counts_of(step)
        is_left_out = step.status == LEFT_OUT and not os.environ.get('CI')
        if counts.failed or step.status and not is_left_out:
            failed.append(step.name)
        _print_step(step, counts, is_left_out)
        total.update(passed=counts.passed, failed=len(counts.failed), skipped=len(counts.skipped))
    absent = [version for version in PYTHONS
              if version not in versions and version != '%d.%d' % sys.version_info[:2]]
    if absent:
        print('not found: Python %s' % ', '.join(absent))
    print('%(passed)d passed, %(failed)d failed, %(skipped)d skipped' % total)
    print('FAILED: %s' % '; '.join(failed) if failed else 'PASSED')
    return 1 if failed else 0


def _print_step(step: Step, counts: Counts, is_left_out: bool) -> None:
    if step.reports and not is_left_out:
        ended = '%d passed, %d failed, %d skipped' % (
            counts.passed, len(counts.failed), len(counts.skipped))
    else:
        ended = 'left out, PyPI cannot be reached' if is_left_out else 'done'
    if step.status and not is_left_out:
        ended += ', exit status %d' % step.status
    print('%-34s %s, %d:%02d' % (step.name, ended, *divmod(step.seconds, 60)))
    for name in counts.failed:
        print('    failed: %s' % name)
    for why, number in sorted(Counter(counts.skipped).items()):
        print('    skipped %d: %s' % (number, why))


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
