"""
Show the vocabulary, the values that fields may have, as a tree.

Example:
  rocon_uri fields operating_system

The members of a group are below it, indented. A group covers all its members, so
linux covers ubuntu and ubuntu covers focal. The tree has the values that packages
on this machine and ROCON_URI_RULES add.

Exit status: 0; 2 for a field that has no vocabulary.
JSON: {"fields": {FIELD: {VALUE: {...}, ...}, ...}, "errors": []}, where each value
leads to its members, {} for none
"""
from __future__ import annotations

from rocon_uri.cli.display import painter, print_json
from rocon_uri.grammar import VOCABULARY_FIELDS
from rocon_uri.vocabulary import complete

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict
    from rocon_uri.field_vocabulary import FieldVocabulary
    Tree = Dict[str, 'Tree']

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('field', metavar='FIELD', nargs='?', choices=VOCABULARY_FIELDS,
                        help='one of %s; all of them where left out' % ', '.join(VOCABULARY_FIELDS))


def main(args: argparse.Namespace) -> int:
    fields = [complete().field(name)
              for name in ([args.field] if args.field else VOCABULARY_FIELDS)]
    if args.json:
        print_json({'fields': {field.name: _tree(field) for field in fields}, 'errors': []})
        return 0
    for index, field in enumerate(fields):
        if index:
            print()
        _show(field)
    return 0


def _show(field: FieldVocabulary) -> None:
    paint = painter()
    print(paint(field.name, 'bold'))
    waiting = [(value, 1) for value in reversed(field.children())]
    while waiting:
        value, depth = waiting.pop()
        members = field.children(value)
        print('  ' * depth + (paint(value, 'cyan') if members else value))
        waiting.extend((member, depth + 1) for member in reversed(members))


def _tree(field: FieldVocabulary) -> Tree:
    tree: Tree = {}
    waiting = [(value, tree) for value in reversed(field.children())]
    while waiting:
        value, group = waiting.pop()
        group[value] = {}
        waiting.extend((member, group[value]) for member in reversed(field.children(value)))
    return tree
