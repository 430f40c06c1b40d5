"""
Validate URIs and show their fields.

Examples:
  rocon_uri parse 'rocon:/turtlebot2|pr2/bob*/ros' rocon:/kobuki#rocon_apps/teleop
  rocon_uri parse --quiet --in fleet.txt

Prints each URI with its canonical text, which has all fields, its short one, and
its fields; concert_name and rocon_app where they are set. A note says so if //
was read as /, as in rocon://turtlebot2/bob, and if the name is a value of another
field, as in rocon:/pc/kitkat; the same note about other URIs is only counted.

A FILE has one URI a line, as for match; standard input is -. With --quiet prints
what is not legal, and nothing else.

Exit status: 0 if all are legal, else 2; the legal ones are shown in any case.
JSON: {"uris": [URI, ...], "errors": [ERROR, ...]}
"""
from __future__ import annotations

from rocon_uri.cli.completion import offer, uris
from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.given import Report, say
from rocon_uri.cli.notes import Notes

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict, Iterator, List
    from rocon_uri.cli.given import GivenURI

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    offer(uris, parser.add_argument('uris', metavar='URI', nargs='*', help='what to read'))
    parser.add_argument('--in', dest='uris_in', metavar='FILE',
                        help='read the URIs in a file, after those given as arguments')
    parser.add_argument('-q', '--quiet', action='store_true', help='show the bad ones only')


def main(args: argparse.Namespace) -> int:
    if not args.uris and args.uris_in is None:
        say('rocon_uri parse: error: give a URI, or a file of them with --in')
        return 2
    report = Report(args.json)
    notes = Notes()
    legal: List[Dict[str, object]] = []
    is_first = True
    for given in _read(args, report):
        if args.json:
            legal.append(given.as_json())
        elif not args.quiet:
            _show(given, is_first)
            is_first = False
        notes.mention(given)
    notes.say_others()
    if args.json:
        print_json({'uris': legal, 'errors': report.errors})
    return report.status


def _read(args: argparse.Namespace, report: Report) -> Iterator[GivenURI]:
    yield from filter(None, map(report.read, args.uris))
    if args.uris_in is not None:
        yield from report.read_file(args.uris_in)


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
