"""
Start a capability and everything that it depends on.

Examples:
  rocon_uri capabilities start std_capabilities/Navigation2D
  rocon_uri capabilities start std_capabilities/Navigation2D ours/slow_navigation

The capability runs until somebody stops it. The command does not wait until its
nodes are up: see status.

Exit status: 0 if it starts or runs already; 1 if the start is refused, or if the
capability is being stopped; 2 if no server answers
JSON: {"result": "started", "starting already", "runs already" or "is being
stopped", "errors": [ERROR, ...]}
"""
from __future__ import annotations

from rocon_uri.cli.capabilities import plan
from rocon_uri.cli.display import print_json

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from rocon_uri.cli.running import RunningServer

__all__ = ['add_arguments', 'main']

#: what the results of StartCapability mean, by number
_RESULTS = ('started', 'starting already', 'runs already', 'is being stopped')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    plan.add_arguments(parser)


def main(server: RunningServer, args: argparse.Namespace) -> int:
    result = _RESULTS[server.call('start_capability', args.capability, args.provider).result]
    if args.json:
        print_json({'result': result, 'errors': []})
    else:
        print('%s: %s' % (args.capability, result))
    return 1 if result == _RESULTS[3] else 0
