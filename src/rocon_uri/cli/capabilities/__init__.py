"""
Ask a capability server what it knows and what runs; start and stop capabilities.

Examples:
  rocon_uri capabilities list
  rocon_uri capabilities status
  rocon_uri capabilities plan std_capabilities/Navigation2D
  rocon_uri capabilities start std_capabilities/Navigation2D
  rocon_uri capabilities stop std_capabilities/Navigation2D
  rocon_uri capabilities watch

Each verb has its own --help, which says more.

Exit status: 0; 1 if the server refuses, or if a capability has failed or is
degraded; 2 if no server answers
JSON: each verb prints an object with "errors": [ERROR, ...]
"""
from __future__ import annotations

import argparse

from rocon_uri.cli.display import print_json
from rocon_uri.cli.packages import PackageReport
from rocon_uri.cli.running import Refused, RunningServer, Unreachable, add_server
from rocon_uri.cli.subverbs import add_subverbs, without_verb

__all__ = ['add_arguments', 'main']

VERBS = ('list', 'status', 'plan', 'start', 'stop', 'watch')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_subverbs(parser, __name__, VERBS, add_server)


def main(args: argparse.Namespace) -> int:
    if args.verb_main is None:
        return without_verb('capabilities', VERBS)
    report = PackageReport(args.json)
    try:
        status: int = args.verb_main(RunningServer(args.server), args)
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
