"""Verbs that have verbs of their own, each a module as those in `rocon_uri.cli`."""
from __future__ import annotations

import argparse
import sys
from importlib import import_module

from rocon_uri.cli.parsers import described, overview

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Iterable

__all__ = ['add_subverbs', 'without_verb']


def add_subverbs(parser: argparse.ArgumentParser, package: str, names: Iterable[str],
                 add_shared: Callable[[argparse.ArgumentParser], None] = lambda parser: None
                 ) -> None:
    """
    Let a verb take the name of one of its own verbs, and its arguments.

    The ``main`` of the one that is chosen becomes ``verb_main``, which is None without one.

    :param parser: that of the verb
    :param str package: the package in which each verb is a module
    :param names: iterable of str, the names of the verbs
    :param add_shared: adds the arguments that all of them take
    """
    subparsers = parser.add_subparsers(metavar='VERB', title='verbs', prog=parser.prog)
    parser.set_defaults(verb_main=None)
    for name in names:
        verb = import_module('%s.%s' % (package, name))
        description = described(verb.__doc__)
        verb_parser = subparsers.add_parser(
            name, help=description.partition('\n')[0].rstrip('.'), description=description)
        verb.add_arguments(verb_parser)
        add_shared(verb_parser)
        # It can also stand before the verb, which this must not undo.
        verb_parser.add_argument('--json', action='store_true', default=argparse.SUPPRESS,
                                 help='print one JSON object')
        verb_parser.set_defaults(verb_main=verb.main)


def without_verb(verb: str, names: Iterable[str]) -> int:
    """Say which verbs a verb has, since none was chosen; return the exit status."""
    print(overview(names, verb), file=sys.stderr)
    return 2
