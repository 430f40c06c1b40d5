"""
Show what a start of a capability would do, and start nothing.

Examples:
  rocon_uri capabilities plan std_capabilities/Navigation2D
  rocon_uri capabilities plan std_capabilities/Navigation2D ours/slow_navigation

Shows the capabilities in the order in which they would start, their providers,
and which of them run already.

Exit status: 0; 1 if the start would be refused; 2 if no server answers
JSON: {"steps": [{"capability", "provider", "running": BOOL}, ...],
"faults": [TEXT, ...], "errors": [ERROR, ...]}
"""
from __future__ import annotations

from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.given import say
from rocon_uri.cli.packages import one_line
from rocon_uri.cli.running import capability_names

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from rocon_uri.cli.running import RunningServer

__all__ = ['add_arguments', 'add_capability', 'main']


def add_capability(parser: argparse.ArgumentParser) -> None:
    """Let a verb take a capability."""
    argument = parser.add_argument('capability', metavar='CAPABILITY', help='package/Name')
    argument.completer = capability_names   # type: ignore[attr-defined]    # for argcomplete


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_capability(parser)
    parser.add_argument('provider', metavar='PROVIDER', nargs='?', default='',
                        help='package/name (default: the default provider)')


def main(server: RunningServer, args: argparse.Namespace) -> int:
    plan = server.call('plan_capability', args.capability, args.provider)
    steps = [{'capability': capability, 'provider': provider, 'running': running}
             for capability, provider, running in zip(plan.capabilities, plan.providers,
                                                      plan.running)]
    if args.json:
        print_json({'steps': steps, 'faults': list(plan.faults), 'errors': []})
        return 1 if plan.faults else 0
    paint = painter()
    for step in steps:
        print('%s %s by %s' % (
            paint('runs  ', 'faint') if step['running'] else paint('starts', 'green'),
            one_line(step['capability']), one_line(step['provider'])))
    for fault in plan.faults:
        say('rocon_uri: ' + one_line(fault))
    return 1 if plan.faults else 0
