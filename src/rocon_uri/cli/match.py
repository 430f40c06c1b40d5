"""
Find the resources that requests are compatible with.

Examples:
  rocon_uri match 'rocon:/robot/*/ros' --in fleet.txt
  rocon_uri match --matrix --requests-in apps.txt --in fleet.txt

A FILE has one URI a line; blank lines and lines whose first character is # are
skipped. Bad lines are reported with their number, and skipped. Standard input is -.
Prints the compatible resources as written in FILE, one a line; if there are several
requests, the app or the text of the request comes first. With --matrix prints every
resource, after a column for each request: x if it fits, . if it does not, ? for name
patterns that are too complex to compare.

Exit status: 0 if anything was found, 1 if nothing was, 2 if a request, a line or a
file was bad or two name patterns were too complex to compare.
JSON: {"requests": [URI, ...], "resources": [URI and in it "requests": [TEXT, ...],
...], "errors": [ERROR, ...]}, a line for each resource; "requests" in it has the
texts of those that it is compatible with, and resources without one are only there
with --matrix
"""
from __future__ import annotations

from itertools import chain

from rocon_uri.cli.display import painter
from rocon_uri.cli.given import Report, say
from rocon_uri.cli.progress import beside_progress
from rocon_uri.compatibility import LEGEND, MARKS, UNDECIDED
from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.sources.wording import quoted
from rocon_uri.resource_index import ResourceIndex

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict, Iterable, Iterator, List, Optional, Tuple
    from rocon_uri.cli.given import GivenURI
    from rocon_uri.uri import RoconURI
    Verdicts = List[Optional[bool]]

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('requests', metavar='REQUEST', nargs='*',
                        help='a URI, as what an app runs on')
    parser.add_argument('--requests-in', metavar='FILE',
                        help='take requests from a file, after those given as arguments')
    parser.add_argument('--in', dest='resources_in', metavar='FILE', required=True,
                        help='the resources to find them among, as robots')
    parser.add_argument('--matrix', action='store_true', help='show requests against resources')


def main(args: argparse.Namespace) -> int:
    if not args.requests and args.requests_in is None:
        say('rocon_uri match: error: give a REQUEST, or a file of them with --requests-in')
        return 2
    if args.requests_in == args.resources_in == '-':
        say('rocon_uri match: error: requests and resources cannot both be standard input')
        return 2
    report = Report(args.json)
    requests = [given for given in map(report.read, args.requests) if given]
    if args.requests_in is not None:
        requests.extend(chain.from_iterable(report.read_file(args.requests_in)))
    matches = Matches(requests, report.read_file(args.resources_in), report, args.matrix)
    if args.json:
        _print_json(matches, report)
    elif args.matrix:
        _print_matrix(matches)
    elif args.requests_in is None and len(args.requests) == 1:
        for resource, _ in matches:
            print(resource.text)
    else:
        _print_pairs(matches)
    return report.status or (0 if matches.found else 1)


class Matches:
    """
    Which resources which requests are compatible with; iterate it once.

    :param requests: list of GivenURI
    :param resources: iterable of lists of GivenURI
    :param Report report: gets the undecided pairs, after all others
    :param bool every: also the resources that no request is compatible with

    Iteration gives each resource with a list of what is said of it to each request: a bool, or
    None for undecided. ``found`` says whether there was a True among those so far.
    """

    def __init__(self, requests: List[GivenURI], resources: Iterable[List[GivenURI]],
                 report: Report, every: bool) -> None:
        self.requests = requests
        self.found = False
        self._resources = resources
        self._report = report
        self._every = every

    def __iter__(self) -> Iterator[Tuple[GivenURI, Verdicts]]:
        undecided = []
        nothing: Verdicts = [False] * len(self.requests)
        for batch in self._resources:
            verdicts = self._verdicts(batch)
            with beside_progress():
                for resource in batch:
                    found = verdicts.get(resource.uri, nothing)
                    if True in found or self._every:
                        yield resource, found
                    if None in found:
                        undecided.append((resource, found))
        for resource, found in undecided:
            for request, verdict in zip(self.requests, found):
                if verdict is None:
                    self._report.bad_uri(_undecided(request, resource), resource.file,
                                         resource.line)

    def _verdicts(self, resources: List[GivenURI]) -> Dict[RoconURI, Verdicts]:
        """What is said of resources, but not of those that no request may be compatible with."""
        index = ResourceIndex(resource.uri for resource in resources)
        verdicts: Dict[RoconURI, Verdicts] = {}

        def note(uri: RoconURI, place: int, verdict: Optional[bool]) -> None:
            verdicts.setdefault(uri, [False] * len(self.requests))[place] = verdict
        for place, request in enumerate(self.requests):
            try:
                for uri in index.find(request.uri):
                    note(uri, place, True)
                    self.found = True
            except PatternTooComplex as error:
                for uri in error.undecided:
                    note(uri, place, None)
        return verdicts


def _undecided(request: GivenURI, resource: GivenURI) -> PatternTooComplex:
    return PatternTooComplex(
        'undecided for request %s: name patterns %s and %s are too complex to compare' % tuple(map(
            quoted, (request.text, request.uri.name.string, resource.uri.name.string))),
        resource.text, 'name', resource.uri.name.string,
        advice='use simpler ones, without large counts')


def _print_pairs(matches: Matches) -> None:
    width = max((len(request.label) for request in matches.requests), default=0)
    paint = painter()
    for resource, verdicts in matches:
        for request, verdict in zip(matches.requests, verdicts):
            if verdict:
                print('%s  %s' % (paint(request.label.ljust(width), 'cyan'), resource.text))


def _print_matrix(matches: Matches) -> None:
    paint = painter()
    print(paint(LEGEND + UNDECIDED, 'faint'))
    for index, request in enumerate(matches.requests):
        print('| ' * index + paint(request.label, 'bold'))
    marks = {fits: paint(mark, style)
             for (fits, mark), style in zip(MARKS.items(), ('green', 'faint', 'red'))}
    for resource, verdicts in matches:
        print('%s  %s' % (' '.join(marks[verdict] for verdict in verdicts), resource.text))


def _print_json(matches: Matches, report: Report) -> None:
    """Print the object as it comes, since there may be more resources than fit into memory."""
    import json     # here, since most calls do not need it
    print('{"requests": %s,' % json.dumps([request.as_json() for request in matches.requests]))
    print(' "resources": [', end='')
    separator = '\n  '
    for resource, verdicts in matches:
        entry = resource.as_json()
        entry['requests'] = [request.text
                             for request, verdict in zip(matches.requests, verdicts) if verdict]
        print(separator + json.dumps(entry), end='')
        separator = ',\n  '
    print('],\n "errors": %s}' % json.dumps(report.errors))
