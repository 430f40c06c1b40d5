"""
Stop a capability, after everything that depends on it.

Example:
  rocon_uri capabilities stop std_capabilities/Navigation2D

The capability is stopped even if clients use it. The command waits until its
nodes have ended, which takes up to 20 seconds if they ignore SIGINT.

Exit status: 0 if it has ended; 1 if it does not run; 2 if no server answers
JSON: {"result": "stopped", "errors": [ERROR, ...]}
"""
from __future__ import annotations

from rocon_uri.cli.capabilities.plan import add_capability
from rocon_uri.cli.display import print_json

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from rocon_uri.cli.running import RunningServer

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_capability(parser)


def main(server: RunningServer, args: argparse.Namespace) -> int:
    stopped = server.call('stop_capability', args.capability).successful
    result = 'stopped' if stopped else 'not stopped'
    if args.json:
        print_json({'result': result, 'errors': []})
    else:
        print('%s: %s' % (args.capability, result))
    return 0 if stopped else 1
