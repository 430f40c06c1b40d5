"""
Find the resources that requests are compatible with.

Examples:
  rocon_uri match 'rocon:/robot/*/ros' --in fleet.txt
  rocon_uri match --matrix --requests-in apps.txt --in fleet.txt
  rocon_uri match --matrix --requests-in apps.txt --in fleet.txt --html fleet.html
  rocon_uri match --why 'rocon:/robot/*/ros' rocon:/pr2/bob/noetic
  rocon_uri match --in fleet.txt --into sqlite:///fleet.db
  rocon_uri match 'rocon:/robot/*/ros' --in sqlite:///fleet.db

A FILE has one URI a line; blank lines and comments, which start with #, are
skipped. Bad lines are reported with their number, and skipped; a fault that many
lines have is reported once. Standard input is -.
Prints the compatible resources as written in FILE, one a line; if there are several
requests, the app or the text of the request comes first. With --matrix prints every
resource, after a column for each request: x if it fits, . if it does not, ? for
name patterns that are too complex to compare. With --html, FILE becomes a page for
a browser, which filters, sorts and says for each pair which field does not fit. If
nothing is found, stderr names the nearest resource and the fields that exclude it.
With --why, says what check says about REQUEST and one URI. With --into, stores the
URIs of FILE in a database and prints nothing.

URL is a database, sqlite:///PATH or postgresql://USER@HOST/NAME. Others on this
machine can see a password in an argument; PostgreSQL reads ~/.pgpass as well.

Exit status: 0 if anything was found, 1 if nothing was, 2 if a request, a line, a
file or a database was bad or two name patterns were too complex to compare. With
--into, 0 if all was stored, 2 if a line was bad (the others are stored) or the
database was.
JSON: {"requests": [URI, ...], "resources": [URI and in it "requests": [TEXT, ...],
...], "errors": [ERROR, ...]}, a line for each resource; "requests" in it has the
texts of those that it is compatible with, and resources without one are only there
with --matrix
"""
from __future__ import annotations

import sys
from argparse import Namespace

from rocon_uri.cli import check
from rocon_uri.cli.completion import offer, uris
from rocon_uri.cli.databases import is_url, open_fleet
from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.given import GivenURI, Report, say, shown_name
from rocon_uri.cli.matches import Matches
from rocon_uri.cli.matrix import print_matrix, print_table, write_page
from rocon_uri.uri import RoconURI

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    offer(uris, parser.add_argument(
        'requests', metavar='REQUEST', nargs='*', help='a URI, as what an app runs on'))
    parser.add_argument('--requests-in', metavar='FILE',
                        help='take requests from a file, after those given as arguments')
    parser.add_argument('--in', dest='resources_in', metavar='FILE|URL',
                        help='the resources to find them among, as robots')
    parser.add_argument('--into', metavar='URL', help='store the resources of FILE there')
    parser.add_argument('--why', action='store_true',
                        help='compare a REQUEST with a URI given after it, as check does')
    parser.add_argument('--matrix', action='store_true', help='show requests against resources')
    parser.add_argument('--format', choices=('text', 'csv', 'tsv'), default='text',
                        help='how the matrix is printed (default: text)')
    parser.add_argument('--html', metavar='FILE',
                        help='write the matrix as a page that filters, sorts and says why')


def main(args: argparse.Namespace) -> int:
    error = _wrong_use(args)
    if error:
        say('rocon_uri match: error: ' + error)
        return 2
    if args.why:
        return check.main(Namespace(a=args.requests[0], b=args.requests[1], json=args.json))
    report = Report(args.json)
    if args.into is not None:
        fleet = open_fleet(args.into, report, create=True)
        if fleet:
            fleet.store(args.resources_in)
        return report.status
    requests = [given for given in map(report.read, args.requests) if given]
    if args.requests_in is not None:
        requests.extend(report.read_file(args.requests_in))
    matches = Matches(requests, args.resources_in, report, args.matrix)
    fleet, only = None, len(requests) == 1 and not args.matrix
    if is_url(args.resources_in):
        fleet = open_fleet(args.resources_in, report, create=False)
        matches.path = fleet.name if fleet else ''
        matches.batches = fleet.lines(requests[0].uri if only else RoconURI()) if fleet else []
    if args.html is not None:
        write_page(matches, args.html, report)
        if args.json:
            print_json({'requests': [request.as_json() for request in requests], 'resources': [],
                        'errors': report.errors})
    elif args.json:
        _print_json(matches, report)
    elif args.matrix and args.format != 'text':
        print_table(matches, args.format)
    elif args.matrix:
        print_matrix(matches)
    elif args.requests_in is None and len(args.requests) == 1:
        write = sys.stdout.write
        for (_, text, _), _ in matches:
            write(text + '\n')
    else:
        _print_pairs(matches)
    if not matches.found and not matches.undecided:
        if fleet and only and not report.status:
            matches.look_at(fleet.nearest_lines(requests[0].uri))
        if matches.nearest():
            say('rocon_uri: note: ' + matches.nearest())
    return report.status or (0 if matches.found else 1)


def _wrong_use(args: argparse.Namespace) -> str:
    if args.why:
        others = args.requests_in, args.resources_in, args.into, args.html, args.matrix or None
        if len(args.requests) == 2 and set(others) == {None} and args.format == 'text':
            return ''
        return '--why takes a REQUEST and a URI to compare it with, and no file or matrix'
    if args.html is not None and args.format != 'text':
        return 'give --html or --format'
    if not args.matrix and (args.html is not None or args.format != 'text'):
        return '--html and --format need --matrix'
    if args.resources_in is None:
        return 'the following arguments are required: --in'
    if args.into is not None:
        if args.requests or args.requests_in is not None or args.matrix or args.json \
                or is_url(args.resources_in):
            return '--into takes --in FILE, and nothing else'
        return '' if is_url(args.into) else '--into takes a URL such as sqlite:///fleet.db'
    if not args.requests and args.requests_in is None:
        return 'give a REQUEST, or a file of them with --requests-in'
    if args.requests_in == args.resources_in == '-':
        return 'requests and resources cannot both be standard input'
    return ''


def _print_pairs(matches: Matches) -> None:
    width = max((len(request.label) for request in matches.requests), default=0)
    paint = painter()
    labels = [paint(request.label.ljust(width), 'cyan') + '  ' for request in matches.requests]
    write = sys.stdout.write
    for (_, text, _), verdicts in matches:
        for label, verdict in zip(labels, verdicts):
            if verdict:
                write(label + text + '\n')


def _print_json(matches: Matches, report: Report) -> None:
    """Print the object as it comes, since there may be more resources than fit into memory."""
    import json     # here, since most calls do not need it
    print('{"requests": %s,' % json.dumps([request.as_json() for request in matches.requests]))
    print(' "resources": [', end='')
    separator = '\n  '
    for (uri, text, number), verdicts in matches:
        entry = GivenURI(uri, text, shown_name(matches.path), number).as_json()
        entry['requests'] = [request.text
                             for request, verdict in zip(matches.requests, verdicts) if verdict]
        print(separator + json.dumps(entry), end='')
        separator = ',\n  '
    print('],\n "errors": %s}' % json.dumps(report.errors))
