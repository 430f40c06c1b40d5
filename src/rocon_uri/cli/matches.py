"""Which of many resources fit which requests, as fast as they are read; and which is nearest."""
from __future__ import annotations

from itertools import islice

from rocon_uri.cli.given import shown_name
from rocon_uri.cli.progress import beside_progress
from rocon_uri.compatibility import explain
from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.sources.wording import near_misses, quoted
from rocon_uri.uri import is_compatible, with_any_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterable, Iterator, List, Optional, Tuple
    from rocon_uri.cli.given import GivenURI, Line, Report
    from rocon_uri.compatibility import Explanation
    from rocon_uri.uri import RoconURI
    Verdicts = List[Optional[bool]]

__all__ = ['Matches']

_KINDS_KEPT = 10000         # of resources; when there are more it starts again with none
_KINDS_COMPARED = 1000      # with each request, to find the nearest
_NAMES_COMPARED = 1000      # of resources of one kind


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
                        if len(kinds) >= _KINDS_KEPT:
                            kinds.clear()
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

    def look_at(self, batches: Iterable[Iterator[Line]]) -> None:
        """Take further resources that no request is compatible with, among which is the nearest."""
        self.batches = batches
        for _ in self:
            pass

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
        place = shown_name(self.path) if number is None else '%s:%s' % (
            shown_name(self.path), number)
        return 'nothing found%s; the nearest is %s: %s, excluded by %s' % (
            ' for %s' % quoted(request.text) if len(self.requests) > 1 else '',
            place, quoted(text),
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
        self._others: List[Line] = [line]       # resources that no request is compatible with
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
