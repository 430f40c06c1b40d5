"""How long it takes until something is done, as whole processes."""
import os
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SCRIPT = os.path.join(ROOT, 'scripts', 'rocon_uri')
REPEAT = 60
PAIRS = [
    ('import rocon_uri', ['-c', 'import rocon_uri'], 'import re, enum', 1.4),
    ('from rocon_uri import is_compatible, parse',
     ['-c', 'from rocon_uri import is_compatible, parse'], 'import re, enum', 1.4),
    ('scripts/rocon_uri parse URI', [SCRIPT, 'parse', 'rocon:/pr2/bob/noetic/focal'],
     'import argparse', 1.35),
]


def figures():
    """What this part measures."""
    with tempfile.TemporaryDirectory() as folder:
        # Compiled files, as after an installation, whatever is in the source space.
        environment = dict(os.environ, PYTHONPATH=os.path.join(ROOT, 'src'),
                           PYTHONPYCACHEPREFIX=folder)
        environment.pop('PYTHONDONTWRITEBYTECODE', None)
        for name, arguments, imports, target in PAIRS:
            commands = [sys.executable] + arguments, [sys.executable, '-c', imports]
            for command in commands:
                run(command, environment)
            times = [[run(command, environment) for command in commands] for _ in range(REPEAT)]
            seconds, reference = map(min, zip(*times))
            yield {'name': name, 'ratio': seconds / reference, 'target': target,
                   'reference': "python3 -c '%s'" % imports,
                   'seconds': seconds, 'reference_seconds': reference}


def run(command, environment):
    """Start a process, wait until it has ended, and return how many seconds that took."""
    start = time.perf_counter()
    subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - start
