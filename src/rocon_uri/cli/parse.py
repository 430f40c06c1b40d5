"""
Validate URIs and show their fields.

Example:
  rocon_uri parse 'rocon:/turtlebot2|pr2/bob*/ros' rocon:/kobuki#rocon_apps/teleop

Prints each URI with its canonical text, which has all fields, its short one, and
its fields; concert_name and rocon_app where they are set. A note says so if //
was read as /, as in rocon://turtlebot2/bob, and if the name is a value of another
field, as in rocon:/pc/kitkat.

Exit status: 0 if all are legal, else 2; the legal ones are shown in any case.
JSON: {"uris": [URI, ...], "errors": [ERROR, ...]}
"""
from __future__ import annotations

from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.given import Report

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import List
    from rocon_uri.cli.given import GivenURI

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('uris', metavar='URI', nargs='+', help='what to read')


def main(args: argparse.Namespace) -> int:
    report = Report(args.json)
    legal: List[GivenURI] = []
    for text in args.uris:
        given = report.read(text)
        if given:
            if not args.json:
                _show(given, is_first=not legal)
            given.mention_one_slash()
            given.mention_misplaced_name()
            legal.append(given)
    if args.json:
        print_json({'uris': [given.as_json() for given in legal], 'errors': report.errors})
    return report.status


def _show(given: GivenURI, is_first: bool) -> None:
    uri, paint = given.uri, painter()
    rows = [('canonical', str(uri)), ('short', uri.short), ('concert_name', uri.concert_name)]
    rows += [(field, getattr(uri, field).string) for field in (
        'hardware_platform', 'name', 'application_framework', 'operating_system')]
    rows.append(('rocon_app', uri.rocon_app))
    if not is_first:
        print()
    print(paint(given.text, 'bold'))
    for label, value in rows:
        if value:
            print('  %s  %s' % (paint(label.ljust(21), 'cyan'), value))
