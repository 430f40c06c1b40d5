"""
Feed damaged input to one part of the package for some time.

Examples:
  /usr/bin/python3 test/fuzz --target uri --seconds 1200
  /usr/bin/python3 test/fuzz --target spec_file --seed 17 --seconds 0

Inputs come in batches, each of which has a seed; with --seconds 0 there is only the first. Files
below ROCON_URI_CORPUS, if that is set, are damaged beside those of the project.

Exit status: 0; 1 if a fault was found, which ends it: its seed and the smallest input that shows it
are printed
"""
from __future__ import annotations

import argparse
import random
import sys
import time
from importlib import import_module
from pathlib import Path

TEST = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TEST)]
sys.path.append(str(TEST.parent / 'src'))     # where neither the devel space nor another is on it

from fuzz.batch import TARGETS, run_batch   # noqa: E402, found on the path above

BATCH = 500     # inputs


def main() -> int:
    """Do it, and return the exit status."""
    description = (__doc__ or '').strip()
    parser = argparse.ArgumentParser('test/fuzz', description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--target', choices=TARGETS, required=True, help='what to feed')
    parser.add_argument('--seconds', type=float, default=60, help='for how long (default: 60)')
    parser.add_argument('--seed', type=int, help='of the first batch (default: any)')
    args = parser.parse_args()

    target = import_module('fuzz.' + args.target)
    seed = first = random.randrange(2 ** 32) if args.seed is None else args.seed
    start = time.monotonic()
    tried, fault = run_batch(target, seed, BATCH)
    while not fault and time.monotonic() - start < args.seconds:
        seed += 1
        more, fault = run_batch(target, seed, BATCH)
        tried += more
    print('%s: %d inputs in %d s, seeds %d to %d: %s' % (
        args.target, tried, time.monotonic() - start, first, seed,
        'a FAULT with the last one' if fault else 'no fault'))
    if fault:
        print(fault)
    return 1 if fault else 0


if __name__ == '__main__':
    sys.exit(main())
