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
from itertools import islice

from rocon_uri.cli import check
from rocon_uri.cli.databases import is_url, open_fleet
from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.given import GivenURI, Report, say, shown_name
from rocon_uri.cli.matrix import print_matrix, print_table, write_page
from rocon_uri.cli.progress import beside_progress
from rocon_uri.compatibility import explain
from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.sources.wording import near_misses, quoted
from rocon_uri.uri import RoconURI, is_compatible, with_any_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict, Iterable, Iterator, List, Optional, Tuple
    from rocon_uri.cli.given import Line
    from rocon_uri.compatibility import Explanation
    Verdicts = List[Optional[bool]]

__all__ = ['add_arguments', 'main']

_KINDS_COMPARED = 1000      # of resources, with each request, to find the nearest
_NAMES_COMPARED = 1000      # of resources of one kind


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('requests', metavar='REQUEST', nargs='*',
                        help='a URI, as what an app runs on')
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
    if is_url(args.resources_in):
        fleet = open_fleet(args.resources_in, report, create=False)
        only = len(requests) == 1 and not args.matrix
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
    if not matches.found and not matches.undecided and not is_url(args.resources_in) \
            and matches.nearest():
        say('rocon_uri: note: ' + matches.nearest())
    return report.status or (0 if matches.found else 1)


def _wrong_use(args: argparse.Namespace) -> str:
    if args.why:
        if len(args.requests) == 2 and args.requests_in is args.resources_in is args.into is None:
            return ''
        return '--why takes a REQUEST and a URI to compare it with, and no file'
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


class Matches:
    """
    Which resources which requests are compatible with; iterate it once.

    :param requests: list of GivenURI
    :param path: str, the file of resources
    :param Report report: gets the faults of lines, and the undecided pairs after all others
    :param bool every: also the resources that no request is compatible with

    Iteration gives each resource, as a `Line`, with a list of what is said of it to each request:
    a bool, or None for undecided. ``found`` says whether there was a True among those so far,
    ``undecided`` lists the resources with a None.
    """

    def __init__(self, requests: List[GivenURI], path: str, report: Report, every: bool) -> None:
        self.requests = requests
        self.found = False
        self.undecided: List[Tuple[Line, Verdicts]] = []
        self.path = path
        self.batches: Iterable[Iterator[Line]] = report.read_lines(path)
        self._report = report
        self._every = every
        self._kinds: Dict[Tuple[object, ...], _Kind] = {}

    def __iter__(self) -> Iterator[Tuple[Line, Verdicts]]:
        uris = [request.uri for request in self.requests]
        nothing: Verdicts = [False] * len(uris)
        kinds, every = self._kinds, self._every
        for batch in self.batches:
            with beside_progress():
                for line in batch:
                    uri = line[0]
                    # fields are remembered, so that equal ones are mostly the same object
                    key = (id(uri.hardware_platform), id(uri.application_framework),
                           id(uri.operating_system), uri.concert_name)
                    kind = kinds.get(key)
                    if kind is None:
                        kind = kinds[key] = _Kind(line, uris, nothing)
                    verdicts = kind.verdicts
                    if verdicts is None:
                        verdicts = kind.verdicts_for(line)
                        if None in verdicts:
                            self.undecided.append((line, verdicts))
                    if verdicts is not nothing and True in verdicts:
                        self.found = True
                        yield line, verdicts
                    elif every:
                        yield line, verdicts
        for (uri, text, number), verdicts in self.undecided:
            for request, verdict in zip(self.requests, verdicts):
                if verdict is None:
                    self._report.bad_uri(_undecided(request, uri, text), shown_name(self.path),
                                         number)

    def nearest(self) -> str:
        """What to say if nothing was found: the nearest resource, and what excludes it."""
        if not self.requests or not self._kinds:
            return '' if self._report.status else 'nothing found: there are no %s' % (
                'resources' if self.requests else 'requests')
        excluded: List[Tuple[int, bool, GivenURI, Explanation, Line]] = []
        for request in self.requests:
            for kind in islice(self._kinds.values(), _KINDS_COMPARED):
                line = kind.nearest(request.uri)
                explanation = explain(request.uri, line[0])
                fields = [field.field for field in explanation.fields if not field.is_compatible]
                excluded.append((len(fields), 'hardware_platform' in fields, request, explanation,
                                 line))
        *_, request, explanation, (_, text, number) = min(excluded, key=lambda found: found[:2])
        return 'nothing found%s; the nearest is %s:%s: %s, excluded by %s' % (
            ' for %s' % quoted(request.text) if len(self.requests) > 1 else '',
            shown_name(self.path), number, quoted(text),
            ' and '.join('%s (%s, requested %s)' % (field.field, quoted(field.b), quoted(field.a))
                         for field in explanation.fields if not field.is_compatible))


class _Kind:
    """
    The resources that differ in their names only, and what they are asked for.

    :param line: one of them
    :param requests: list of RoconURI
    :param nothing: list of a False for each request
    """

    def __init__(self, line: Line, requests: List[RoconURI], nothing: Verdicts) -> None:
        self.uri = line[0]      # it keeps the fields that the kind is found by
        self._nothing = nothing
        self._others: List[Line] = [line]       # some that no request is compatible with
        anyone = with_any_name(self.uri)
        self._requests = [(place, request) for place, request in enumerate(requests)
                          if is_compatible(with_any_name(request), anyone)]
        self._patterns = [(place, request.name_pattern) for place, request in self._requests
                          if request.name_pattern is not None]
        self._places: Dict[str, List[int]] = {}     # of the requests for one name, by that name
        for place, request in self._requests:
            if request.name_pattern is None:
                self._places.setdefault(request.name_text, []).append(place)
        #: list of bool, what is said to each request of all of them; None if that needs the name
        self.verdicts: Optional[Verdicts] = None
        if not self._requests:
            self.verdicts = nothing
        elif all(request.name_text == '*' for _, request in self._requests):
            self.verdicts = self._with(place for place, _ in self._requests)

    def verdicts_for(self, line: Line) -> Verdicts:
        """What is said of one of them to each request."""
        uri = line[0]
        name, undecided = uri.name_text, []
        if uri.name_pattern is None:
            fitting = self._places.get(name, [])
            for place, pattern in self._patterns:
                if pattern.matches(name):
                    fitting = [*fitting, place]
        else:
            fitting = []
            for place, request in self._requests:
                try:
                    if is_compatible(request, uri):
                        fitting.append(place)
                except PatternTooComplex:
                    undecided.append(place)
        if fitting or undecided:
            return self._with(fitting, undecided)
        if len(self._others) < _NAMES_COMPARED:
            self._others.append(line)
        return self._nothing

    def _with(self, fitting: Iterable[int], undecided: Iterable[int] = ()) -> Verdicts:
        verdicts: Verdicts = list(self._nothing)
        for place in fitting:
            verdicts[place] = True
        for place in undecided:
            verdicts[place] = None
        return verdicts

    def nearest(self, request: RoconURI) -> Line:
        """The one whose name is nearest to that of a request."""
        names = {line[0].name_text: line for line in reversed(self._others)}
        return next((names[name] for name in near_misses(request.name_text, names)),
                    self._others[0])


def _undecided(request: GivenURI, resource: RoconURI, text: str) -> PatternTooComplex:
    return PatternTooComplex(
        'undecided for request %s: name patterns %s and %s are too complex to compare' % tuple(map(
            quoted, (request.text, request.uri.name_text, resource.name_text))),
        text, 'name', resource.name_text,
        advice='use simpler ones, without large counts')


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
