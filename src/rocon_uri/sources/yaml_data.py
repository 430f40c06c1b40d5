"""Plain data read from YAML that knows its lines, and the limits of what is read."""
from __future__ import annotations

import re
from typing import Dict, List, Optional, Sequence, Tuple

from rocon_uri.sources.located import NOWHERE, LocatedError, Place

__all__ = ['MAX_DEPTH', 'MAX_SIZE', 'YamlError', 'YamlMapping', 'YamlSequence', 'end_position',
           'key_place', 'place_below', 'place_of', 'split_lines', 'value_place']

Position = Tuple[int, int]

MAX_SIZE = 2 ** 20      # bytes of a file, characters of a text, and what aliases may add
MAX_DEPTH = 100         # collections in one another

#: the lines of a text, as YAML counts them
split_lines = re.compile('\r\n|[\r\n\x85\u2028\u2029]').split


class YamlError(LocatedError, ValueError):
    """
    A text that is not YAML, or more of it than is read. Its attributes are those of `LocatedError`.

    >>> print(YamlError('nested deeper than 100', 'laser.yaml', 1, 101))
    laser.yaml:1:101: nested deeper than 100
    """

    id = 'not-yaml'


class _Positioned:
    __slots__ = ()
    _start: Position    # counted from 0, as the parser counts: few are asked for

    @property
    def position(self) -> Position:
        """Where it begins: (line, column)."""
        return self._start[0] + 1, self._start[1] + 1


class YamlMapping(_Positioned, dict):   # type: ignore[type-arg]    # Python 3.8 has no dict[...]
    """
    A mapping read from YAML, in the order of the file: a ``dict`` that knows its positions.

    Keys are ``str``, ``int``, ``float``, ``bool`` or ``None``. A key that was not read but put in
    later has no position.

    >>> from rocon_uri.sources.yaml_source import load
    >>> mapping = load('a: b', 'f')
    >>> mapping.key_position('a'), mapping.value_position('a')
    ((1, 1), (1, 4))
    """

    __slots__ = ('_start', '_positions', 'repeated')

    def __init__(self, line: int, column: int,
                 positions: Optional[Dict[object, Tuple[int, int, int, int]]] = None) -> None:
        self._start = line, column
        self._positions = {} if positions is None else positions
        #: what was lost to duplicate keys, each (key, its earlier value, position of the duplicate)
        self.repeated: Sequence[Tuple[object, object, Position]] = ()

    def key_position(self, key: object) -> Position:
        """Where the key stands (the last one, if it is repeated); KeyError if it was not read."""
        line, column, _, _ = self._positions[key]
        return line + 1, column + 1

    def value_position(self, key: object) -> Position:
        """Where its value, or the alias for it, begins; KeyError if the key was not read."""
        _, _, line, column = self._positions[key]
        return line + 1, column + 1

    def merge(self, sources: List[YamlMapping]) -> None:
        """Put the keys of others before its own, as a merge key does. The last of equals wins."""
        own, own_positions = dict(self), self._positions.copy()
        self.clear()
        self._positions.clear()
        for source in sources:
            self.update(source)
            self._positions.update(source._positions)
        self.update(own)
        self._positions.update(own_positions)


class YamlSequence(_Positioned, list):      # type: ignore[type-arg]
    """
    A sequence read from YAML: a ``list`` that knows its positions.

    >>> from rocon_uri.sources.yaml_source import load
    >>> load('[a, b]', 'f').item_position(1)
    (1, 5)
    """

    __slots__ = ('_start', '_positions')

    def __init__(self, line: int, column: int, positions: List[Position]) -> None:
        super().__init__()
        self._start = line, column
        self._positions = positions

    def item_position(self, index: int) -> Position:
        """Where an item, or the alias for it, begins; IndexError if it was not read."""
        line, column = self._positions[index]
        return line + 1, column + 1


def end_position(text: str) -> Position:
    """The line and column, counted from 1, at which this text ends."""
    lines = split_lines(text)
    return len(lines), len(lines[-1]) + 1


def place_of(collection: object) -> Place:
    """Where a collection begins; `NOWHERE` if it was not read from a text."""
    if isinstance(collection, (YamlMapping, YamlSequence)):
        return collection.position
    return NOWHERE


def key_place(mapping: object, key: object) -> Place:
    """Where a key stands; `NOWHERE` if it was not read from a text."""
    try:
        return mapping.key_position(key) if isinstance(mapping, YamlMapping) else NOWHERE
    except KeyError:    # put in since
        return NOWHERE


def place_below(data: object, path: Sequence[object]) -> Place:
    """
    Where in the text that data was read from a path of keys and indices leads.

    >>> from rocon_uri.sources.yaml_source import load
    >>> place_below(load('a: [b, c]', 'f'), ['a', 1])
    (1, 8)
    """
    place: Place = (1, 1)
    for key in path:
        place = key_place(data, key) if isinstance(data, dict) else value_place(data, key)
        data = data[key]    # type: ignore[index]
    return place


def value_place(collection: object, key: object) -> Place:
    """
    Where a value of a mapping, or an item of a sequence, begins; `NOWHERE` if it was not read.

    >>> from rocon_uri.sources.yaml_source import load
    >>> value_place(load('a: b', 'f'), 'a'), value_place({'a': 'b'}, 'a')
    ((1, 4), (None, None))
    """
    try:
        if isinstance(collection, YamlMapping):
            return collection.value_position(key)
        if isinstance(collection, YamlSequence) and isinstance(key, int):
            return collection.item_position(key)
    except LookupError:     # put in since
        pass
    return NOWHERE
