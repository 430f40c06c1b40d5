"""
What a process takes that finds all resources of a database and keeps none.

    python3 benchmark/streamed.py URL

Prints the megabytes that it had at most, and by how many it grew while it found them.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / 'src'))

from rocon_uri.resource_database import ResourceDatabase, open_engine  # noqa: E402


def megabytes(key):
    """What Linux says of this process: VmRSS now, VmHWM at most."""
    with open('/proc/self/status') as file:
        return next(int(line.split()[1]) / 1024 for line in file if line.startswith(key))


def main(url):
    """Find them."""
    fleet = ResourceDatabase(open_engine(url), create=False)
    fleet.any('rocon:/')
    before = megabytes('VmRSS')
    for _ in fleet.find('rocon:/'):
        pass
    print(megabytes('VmHWM'), megabytes('VmHWM') - before)


if __name__ == '__main__':
    main(sys.argv[1])
