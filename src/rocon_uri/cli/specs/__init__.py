"""
List, show, check and draw capability specs.

Examples:
  rocon_uri specs list
  rocon_uri specs show std_capabilities/DifferentialMobileBase
  rocon_uri specs check src --format github
  rocon_uri specs graph --output specs.svg

Each of the four has a --help of its own, which says more.

Exit status: 0; 1 if check finds an error; 2 if something given was bad
JSON: one object each, with "errors": [ERROR, ...]
"""
from __future__ import annotations

import argparse
from importlib import import_module

__all__ = ['add_arguments', 'main']

_VERBS = ('list', 'show', 'check', 'graph')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the verb takes: the one of its own."""
    subparsers = parser.add_subparsers(metavar='VERB', title='verbs', prog='rocon_uri specs')
    subparsers.required = True
    for name in _VERBS:
        verb = import_module('%s.%s' % (__name__, name))
        description = (verb.__doc__ or '').strip()
        verb_parser = subparsers.add_parser(
            name, help=description.partition('\n')[0].rstrip('.'), description=description,
            allow_abbrev=False, formatter_class=parser.formatter_class)
        verb.add_arguments(verb_parser)
        # It can also stand before the verb, which this must not undo.
        verb_parser.add_argument('--json', action='store_true', default=argparse.SUPPRESS,
                                 help='print one JSON object')
        verb_parser.set_defaults(specs_main=verb.main)


def main(args: argparse.Namespace) -> int:
    """Do it, and return the exit status."""
    status: int = args.specs_main(args)
    return status
