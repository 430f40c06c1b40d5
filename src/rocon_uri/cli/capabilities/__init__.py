"""
Ask a capability server: what there is, what runs, start and stop.

Examples:
  rocon_uri capabilities list
  rocon_uri capabilities status
  rocon_uri capabilities plan std_capabilities/Navigation2D
  rocon_uri capabilities start std_capabilities/Navigation2D
  rocon_uri capabilities stop std_capabilities/Navigation2D
  rocon_uri capabilities watch

Each of the six has a --help of its own, which says more.

Exit status: 0; 1 if the server refuses, or if a capability has failed or is
degraded; 2 if there is no server to ask
JSON: one object each, with "errors": [ERROR, ...]
"""
from __future__ import annotations

import argparse
from importlib import import_module

from rocon_uri.cli.display import print_json
from rocon_uri.cli.packages import PackageReport
from rocon_uri.cli.running import Refused, RunningServer, Unreachable, add_server

__all__ = ['add_arguments', 'main']

_VERBS = ('list', 'status', 'plan', 'start', 'stop', 'watch')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the verb takes: the one of its own."""
    subparsers = parser.add_subparsers(metavar='VERB', title='verbs',
                                       prog='rocon_uri capabilities')
    subparsers.required = True
    for name in _VERBS:
        verb = import_module('%s.%s' % (__name__, name))
        description = (verb.__doc__ or '').strip()
        verb_parser = subparsers.add_parser(
            name, help=description.partition('\n')[0].rstrip('.'), description=description,
            allow_abbrev=False, formatter_class=parser.formatter_class)
        verb.add_arguments(verb_parser)
        add_server(verb_parser)
        # It can also stand before the verb, which this must not undo.
        verb_parser.add_argument('--json', action='store_true', default=argparse.SUPPRESS,
                                 help='print one JSON object')
        verb_parser.set_defaults(capabilities_main=verb.main)


def main(args: argparse.Namespace) -> int:
    """Do it, and return the exit status."""
    report = PackageReport(args.json)
    try:
        status: int = args.capabilities_main(RunningServer(args.server), args)
        return status
    except Unreachable as error:
        report.bad(str(error))
        status = report.status
    except Refused as error:
        report.bad(str(error))
        status = 1      # it is the answer
    if args.json:
        print_json({'errors': report.errors})
    return status
