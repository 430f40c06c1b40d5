"""
Show the grammar of a rocon URI as EBNF, with the vocabulary in it.

Example:
  rocon_uri rules | less

The values that packages on this machine and ROCON_URI_RULES add are in it.

Exit status: 0
JSON: {"ebnf": TEXT, "errors": []}
"""
from __future__ import annotations

import argparse

from rocon_uri.cli.display import print_json
from rocon_uri.grammar import VOCABULARY_FIELDS, ebnf
from rocon_uri.vocabulary import complete

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """It takes nothing."""


def main(args: argparse.Namespace) -> int:
    text = ebnf({field: complete().field(field) for field in VOCABULARY_FIELDS})
    if args.json:
        print_json({'ebnf': text, 'errors': []})
    else:
        print(text, end='')
    return 0
