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

from rocon_uri.cli.subverbs import add_subverbs, without_verb

__all__ = ['add_arguments', 'main']

VERBS = ('list', 'show', 'check', 'graph')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_subverbs(parser, __name__, VERBS)


def main(args: argparse.Namespace) -> int:
    if args.verb_main is None:
        return without_verb('specs', VERBS)
    status: int = args.verb_main(args)
    return status
