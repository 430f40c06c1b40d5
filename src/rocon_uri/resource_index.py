"""
Many resources, and requests that are answered without asking each of them.

Resources are of few kinds, even where there are a million of them: a kind is the three fields with
registered values, and the concert. A request is compared with each kind, not with each resource.
Within a kind, names are found in order (`rocon_uri.name_index`), and a pattern that many resources
have is compared once.
"""
from __future__ import annotations

from collections.abc import Mapping, MutableMapping
from itertools import chain

from rocon_uri.exceptions import PatternTooComplex, UnregisteredValue
from rocon_uri.sources.wording import quoted
from rocon_uri.name_index import NameIndex, NameRequest
from rocon_uri.uri import RoconURI, aligned, is_compatible, parse, with_any_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import (Any, Collection, Dict, Iterable, Iterator, List, Optional, Tuple, Type,
                        Union)
    from rocon_uri.field import ValuesField
    from rocon_uri.vocabulary import Vocabulary
    Resource = Union[str, RoconURI]
    KindKey = Tuple[ValuesField, ValuesField, ValuesField, str, Vocabulary]
    Resources = MutableMapping[RoconURI, Any]
else:
    Resources = MutableMapping

__all__ = ['ResourceIndex']


class ResourceIndex(Resources):
    """
    A mapping from resources to payloads of the caller's, which requests are matched with.

    A resource is given as str or RoconURI and comes back as RoconURI. It may have alternatives,
    groups and a pattern itself. As in a dict, resources come in the order in which they were
    added, and an equal one replaces the payload and keeps its place.

    A request is str or RoconURI too. It matches the resources with which `is_compatible` says it
    is compatible, and a question costs what its answer is worth, however many resources there
    are; only a pattern that says neither how a name starts nor how it ends is tried on all names.
    What a question about names needs first is built when it is first asked.

    :param resources: a mapping from resources to payloads, or an iterable of resources, whose
        payload is then None
    :raises RoconURIValueError: for a text that is not legal, as do all methods that take one

    >>> fleet = ResourceIndex(['rocon:/pr2/bob', 'rocon:/kobuki/bob', 'rocon:/pr2/alice'])
    >>> [robot.name.string for robot in fleet.find('rocon:/pr2')], fleet.count('rocon:/*/bob')
    (['bob', 'alice'], 2)
    """

    def __init__(self, resources: Union[Mapping[Any, Any], Iterable[Resource]] = ()) -> None:
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
        self._kinds: Dict[KindKey, _Kind] = {}
        self._next_number = 0

    def add(self, uri: Resource, payload: Any = None) -> None:
        """
        Add a resource, or give the one that is there another payload.

        :param uri: RoconURI, or str that is parsed
        :param payload: anything
        """
        uri = parse(uri)
        number = self._numbers.setdefault(uri, self._next_number)
        if number == self._next_number:
            self._next_number += 1
            key = _kind_key(uri)
            kind = self._kinds.get(key)
            if kind is None:
                kind = self._kinds[key] = _Kind(uri)
            kind.resources[number] = self._resources[number] = uri
            kind.names.add(number, uri)
        if payload is None:
            self._payloads.pop(number, None)
        else:
            self._payloads[number] = payload

    def discard(self, uri: Resource) -> None:
        """
        Remove a resource if it is there.

        :param uri: RoconURI, or str that is parsed
        """
        self.pop(parse(uri), None)

    def find(self, request: Resource) -> Iterator[RoconURI]:
        """
        The resources that match a request, in the order in which they were added.

        They are those that were there when this was called, whatever is changed in between.

        :param request: RoconURI, or str that is parsed
        :returns: iterator of RoconURI
        :raises PatternTooComplex: after all others, if there are resources with a pattern that
            takes too much work to compare; these are its ``undecided``, a list of RoconURI

        >>> list(ResourceIndex(['rocon:/pr2/bob', 'rocon:/pr2|pc/b*']).find('rocon:/pc'))
        [RoconURI('rocon:/pr2|pc/b*/*/*')]
        """
        request = parse(request)
        undecided: List[int] = []
        numbers = sorted(chain.from_iterable(self._matches(request, undecided)))
        return _with_error_last(list(map(self._resources.__getitem__, numbers)),
                                self._error(request, undecided))

    def count(self, request: Resource) -> int:
        """
        How many resources match a request.

        :param request: RoconURI, or str that is parsed
        :returns: int
        :raises PatternTooComplex: if that takes too much work to decide for some of them; these
            are its ``undecided``, a list of RoconURI

        >>> ResourceIndex(['rocon:/pr2/bob', 'rocon:/pr2|pc/b*']).count('rocon:/*/bob')
        2
        """
        request = parse(request)
        undecided: List[int] = []
        count = sum(map(len, self._matches(request, undecided)))
        error = self._error(request, undecided)
        if error:
            raise error
        return count

    def any(self, request: Resource) -> bool:
        """
        Does any resource match a request?

        :param request: RoconURI, or str that is parsed
        :returns: bool
        :raises PatternTooComplex: if none is known to match, and for some of them that takes too
            much work to decide; these are its ``undecided``, a list of RoconURI

        >>> ResourceIndex(['rocon:/pr2/bob', 'rocon:/pr2|pc/b*']).any('rocon:/*/alice')
        False
        """
        request = parse(request)
        undecided: List[int] = []
        if any(self._matches(request, undecided)):
            return True
        error = self._error(request, undecided)
        if error:
            raise error
        return False

    def _matches(self, request: RoconURI, undecided: List[int]) -> Iterator[Collection[int]]:
        """The numbers of the resources that match, kind by kind, while the others are noted."""
        asked = with_any_name(request)
        name = NameRequest(request.name.pattern)
        for kind in self._kinds.values():
            uri, requested = kind.uri, asked
            if uri.vocabulary is not asked.vocabulary:
                try:
                    uri, requested = aligned(uri, asked)
                except UnregisteredValue:       # which a comparison with anything at all survives
                    yield [number for number, resource in kind.resources.items()
                           if is_compatible(resource, request)]
                    continue
            if not is_compatible(uri, requested):
                continue
            if name.pattern.is_any:
                yield kind.resources
            else:
                numbers, unknown = kind.names.numbers(name)
                undecided += unknown
                yield numbers

    def _error(self, request: RoconURI, undecided: List[int]) -> Optional[PatternTooComplex]:
        if not undecided:
            return None
        name = request.name.string
        error = PatternTooComplex(
            'name %s takes too much work to compare with the patterns of %d resources'
            % (quoted(name), len(undecided)), str(request), 'name', name)
        error.undecided = [self._resources[number] for number in sorted(undecided)]
        return error

    def __getitem__(self, uri: Resource) -> Any:
        return self._payloads.get(self._numbers[parse(uri)])

    def __setitem__(self, uri: Resource, payload: Any) -> None:
        self.add(uri, payload)

    def __delitem__(self, uri: Resource) -> None:
        uri = parse(uri)
        number = self._numbers.pop(uri)
        self._payloads.pop(number, None)
        del self._resources[number]
        kind = self._kinds.get(_kind_key(uri))
        if kind is None or number not in kind.resources:    # an equal one, of another vocabulary
            kind = next(kind for kind in self._kinds.values() if number in kind.resources)
        kind.names.discard(number, kind.resources.pop(number))
        if not kind.resources:
            del self._kinds[_kind_key(kind.uri)]

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
        return '<ResourceIndex of %d resources>' % len(self)

    def __reduce__(self) -> Tuple[Type[ResourceIndex], Tuple[Dict[RoconURI, Any]]]:
        return type(self), (dict(self),)


def _kind_key(uri: RoconURI) -> KindKey:
    return (uri.hardware_platform, uri.application_framework, uri.operating_system,
            uri.concert_name, uri.vocabulary)


class _Kind:
    """
    The resources with the same fields but the name, and the same concert.

    :param RoconURI uri: one of them
    """

    __slots__ = ('uri', 'resources', 'names')

    def __init__(self, uri: RoconURI) -> None:
        self.uri = with_any_name(uri)       # all that are of this kind
        self.resources: Dict[int, RoconURI] = {}
        self.names = NameIndex(self.resources)


def _with_error_last(found: List[RoconURI],
                     error: Optional[PatternTooComplex]) -> Iterator[RoconURI]:
    yield from found
    if error:
        raise error
