"""
Many resources in one index, which answers a request without comparing it with each of them.

Even a million resources are of few kinds: a kind is a concert and the three fields with registered
values. A request is compared with each kind, and within a kind `rocon_uri.name_index` finds names.
"""
from __future__ import annotations

from collections.abc import Mapping, MutableMapping

from rocon_uri.exceptions import PatternTooComplex, RoconURIValueError, UnregisteredValue
from rocon_uri.sources.wording import quoted
from rocon_uri.name_index import NameIndex, NameRequest
from rocon_uri.uri import RoconURI, aligned, is_compatible, parse, with_any_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, Iterable, Iterator, List, Tuple, Type, Union
    from rocon_uri.field import ValuesField
    from rocon_uri.name_pattern import NamePattern
    from rocon_uri.vocabulary import Vocabulary
    Resource = Union[str, RoconURI]
    KindKey = Tuple[ValuesField, ValuesField, ValuesField, str, Vocabulary]
    Resources = MutableMapping[RoconURI, Any]
    Entries = Union[Mapping[Any, Any], Iterable[Resource]]
else:
    Resources = MutableMapping

__all__ = ['ResourceIndex', 'too_complex']


class ResourceIndex(Resources):
    """
    A mapping from resources to the caller's payloads, which answers requests.

    A resource is given as str or RoconURI and comes back as RoconURI. It may itself have
    alternatives, groups and a pattern. As in a dict, resources are in insertion order, and an equal
    resource replaces the payload and keeps its place.

    A request is str or RoconURI too, and matches the resources that `is_compatible` accepts for
    it. An answer takes time in proportion to its length, not to the number of resources; only a
    pattern with neither prefix nor suffix is matched against all names. Patterns need the names
    in order; the first request with a pattern sorts them.

    :param resources: a mapping from resources to payloads, or an iterable of resources, whose
        payload is then None
    :raises RoconURIValueError: for a text that is not legal, as do all methods that take one

    >>> fleet = ResourceIndex(['rocon:/pr2/bob', 'rocon:/kobuki/bob', 'rocon:/pr2/alice'])
    >>> [robot.name.string for robot in fleet.find('rocon:/pr2')], fleet.count('rocon:/*/bob')
    (['bob', 'alice'], 2)
    """

    def __init__(self, resources: Entries = ()) -> None:
        self.clear()
        if isinstance(resources, Mapping):
            self.update(resources)
        else:
            for uri in resources:
                self.add(uri)

    def clear(self) -> None:
        """Remove every resource."""
        self._numbers: Dict[RoconURI, int] = {}     # larger for one that was added later
        self._resources: Dict[int, RoconURI] = {}
        self._payloads: Dict[int, Any] = {}         # only those that are not None
        #: for each kind, its fields as a URI with any name, and its resources
        self._kinds: Dict[KindKey, Tuple[RoconURI, NameIndex]] = {}
        self._next_number = 0

    def add(self, uri: Resource, payload: Any = None) -> None:
        """
        Add a resource, or replace the payload of one that is there.

        :param uri: RoconURI, or str that is parsed
        :param payload: anything
        """
        uri = parse(uri)
        number = self._numbers.setdefault(uri, self._next_number)
        if number == self._next_number:
            self._next_number += 1
            self._resources[number] = uri
            key = _kind_key(uri)
            if key not in self._kinds:
                self._kinds[key] = with_any_name(uri), NameIndex()
            self._kinds[key][1].add(number, uri)
        if payload is None:
            self._payloads.pop(number, None)
        else:
            self._payloads[number] = payload

    def add_all(self, resources: Entries) -> List[RoconURIValueError]:
        """
        Add many resources; a text that is not legal costs only itself.

        :param resources: a mapping from resources to payloads, or an iterable of resources, whose
            payload is then None
        :returns: list of RoconURIValueError, one for each text that is not legal, in their order;
            ``uri`` is the text

        >>> fleet = ResourceIndex()
        >>> [fault.uri for fault in fleet.add_all(['rocon:/pr2/bob', 'rocon:/pr2/bob-2'])]
        ['rocon:/pr2/bob-2']
        """
        entries = resources.items() if isinstance(resources, Mapping) \
            else ((uri, None) for uri in resources)
        faults: List[RoconURIValueError] = []
        for uri, payload in entries:
            try:
                self.add(uri, payload)
            except RoconURIValueError as fault:
                faults.append(fault)
        return faults

    def discard(self, uri: Resource) -> None:
        """
        Remove a resource if it is there.

        :param uri: RoconURI, or str that is parsed
        """
        self.pop(parse(uri), None)

    def find(self, request: Resource) -> Iterator[RoconURI]:
        """
        The resources that match a request, in insertion order.

        Later changes of the index do not change the answer.

        :param request: RoconURI, or str that is parsed
        :returns: iterator of RoconURI
        :raises PatternTooComplex: by the iterator, after all that match, if patterns of resources
            take too much work to compare, one of them or all together; ``undecided`` of the
            error is the list of these resources

        >>> list(ResourceIndex(['rocon:/pr2/bob', 'rocon:/pr2|pc/b*']).find('rocon:/pc'))
        [RoconURI('rocon:/pr2|pc/b*/*/*')]
        """
        numbers: List[int] = []
        undecided = None
        try:
            for found in self._matches(parse(request)):
                numbers += found
        except PatternTooComplex as error:
            undecided = error
        numbers.sort()
        resources = list(map(self._resources.__getitem__, numbers))
        return _with_error_last(resources, undecided) if undecided else iter(resources)

    def count(self, request: Resource) -> int:
        """
        How many resources match a request.

        :param request: RoconURI, or str that is parsed
        :returns: int
        :raises PatternTooComplex: if some are undecided, as described under `find`

        >>> ResourceIndex(['rocon:/pr2/bob', 'rocon:/pr2|pc/b*']).count('rocon:/*/bob')
        2
        """
        return sum(map(len, self._matches(parse(request))))

    def any(self, request: Resource) -> bool:
        """
        Does any resource match a request?

        :param request: RoconURI, or str that is parsed
        :returns: bool
        :raises PatternTooComplex: if none matches and some are undecided, as described under `find`

        >>> ResourceIndex(['rocon:/pr2/bob', 'rocon:/pr2|pc/b*']).any('rocon:/*/alice')
        False
        """
        return any(self._matches(parse(request)))

    def _matches(self, request: RoconURI) -> Iterator[Union[List[int], NameIndex]]:
        """
        The numbers of those that match, kind by kind; then an error if some are undecided.

        Patterns that take more than a little work to compare come last, so that they are not
        compared where `any` needs no more, and leave the budget of the request to all others.
        """
        asked = with_any_name(request)
        name = NameRequest(request.name.pattern)
        hard: Dict[NamePattern, List[int]] = {}
        for kind, names in self._kinds.values():
            requested = asked
            if kind.vocabulary is not asked.vocabulary:
                try:
                    kind, requested = aligned(kind, asked)
                except UnregisteredValue:       # is_compatible accepts it beside four stars
                    yield [number for number in names
                           if is_compatible(self._resources[number], request)]
                    continue
            if not is_compatible(kind, requested):
                continue
            if name.pattern.is_any:
                yield names
            else:
                numbers, undecided = names.numbers(name)
                for pattern, patterned in undecided:
                    hard.setdefault(pattern, []).extend(patterned)
                yield numbers
        left: List[int] = []
        for pattern, numbers in hard.items():
            verdict = name.intersects(pattern)
            if verdict:
                yield numbers
            elif verdict is None:
                left += numbers
        if left:
            raise too_complex(request, [self._resources[number] for number in sorted(left)])

    def __getitem__(self, uri: Resource) -> Any:
        return self._payloads.get(self._numbers[parse(uri)])

    def __setitem__(self, uri: Resource, payload: Any) -> None:
        self.add(uri, payload)

    def __delitem__(self, uri: Resource) -> None:
        uri = parse(uri)
        number = self._numbers.pop(uri)
        self._payloads.pop(number, None)
        uri = self._resources.pop(number)       # an equal one, perhaps of another vocabulary
        key = _kind_key(uri)
        _, names = self._kinds[key]
        names.discard(number, uri)
        if not names:
            del self._kinds[key]

    def popitem(self) -> Tuple[RoconURI, Any]:
        """
        Remove the resource that was added last.

        :returns: (RoconURI, its payload)
        :raises KeyError: if there is none
        """
        for uri in reversed(self._numbers):
            return uri, self.pop(uri)
        raise KeyError('the index is empty')

    def __iter__(self) -> Iterator[RoconURI]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)

    def __repr__(self) -> str:
        return '<ResourceIndex of %d resource%s>' % (len(self), '' if len(self) == 1 else 's')

    def __reduce__(self) -> Tuple[Type[ResourceIndex], Tuple[Dict[RoconURI, Any]]]:
        return type(self), (dict(self),)


def too_complex(request: RoconURI, undecided: List[RoconURI]) -> PatternTooComplex:
    """
    The error for resources whose patterns take too much work to compare.

    :param RoconURI request: what they were compared with
    :param undecided: list of RoconURI, at least one
    :returns: PatternTooComplex
    """
    name = request.name.string
    error = PatternTooComplex(
        'name %s takes too much work to compare with the patterns of %d resources'
        % (quoted(name), len(undecided)), str(request), 'name', name)
    error.undecided = undecided
    return error


def _kind_key(uri: RoconURI) -> KindKey:
    return (uri.hardware_platform, uri.application_framework, uri.operating_system,
            uri.concert_name, uri.vocabulary)


def _with_error_last(found: List[RoconURI],
                     error: PatternTooComplex) -> Iterator[RoconURI]:
    yield from found
    raise error
