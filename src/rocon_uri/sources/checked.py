"""
What strangers wrote, read key by key: each refusal has its place and says what was expected.

A `Reading` reads one file, and decides what becomes of a fault: it raises the first one. A
`CheckedMapping` is asked for what should be in it:

>>> from rocon_uri.sources.yaml_data import YamlError
>>> reading = Reading('dance.rapp', YamlError)
>>> rapp = reading.load('{launch: [dance.launch], iocn: dance.png}', 'the rapp')
>>> rapp.text('launch')
Traceback (most recent call last):
    ...
rocon_uri.sources.yaml_data.YamlError: dance.rapp:1:10: launch is a list, expected text
>>> print(rapp.unknown_key('iocn', ['launch', 'icon']).problem)
unknown key 'iocn' in the rapp (did you mean 'icon'?)

A subclass of `Reading` that collects faults overrides `Reading.refuse`. What it has refused is read
as if nothing were there.

``what`` is always what an error calls the thing, and ``expected`` what it says in place of 'a
mapping' or 'a list'. ``%s`` in ``what`` is the key.
"""
from __future__ import annotations

import re
from typing import Any, Callable, Iterator, List, Optional, Sequence, Union

from rocon_uri.sources.located import NOWHERE, LocatedError, Place, with_id
from rocon_uri.sources.wording import did_you_mean, expectation, near_misses, shown
from rocon_uri.sources.yaml_data import YamlError, key_place, place_of, value_place
from rocon_uri.sources.yaml_source import load

__all__ = ['CheckedMapping', 'Reading']

_MAX_SUSPECTS = 100     # unknown keys that are compared with a missing one

_find_surrogate = re.compile('[\ud800-\udfff]').search


class Reading:
    """
    One file that is read, and what becomes of its faults: the first one is raised.

    :param str file_name: the file, as errors name it
    :param error: makes the error to raise of (problem, file_name, line, column)
    """

    def __init__(self, file_name: str, error: Callable[..., LocatedError]) -> None:
        self.file_name = file_name
        self._error = error

    def fault(self, problem: str, place: Place = NOWHERE, fault_id: str = 'wrong-value'
              ) -> LocatedError:
        """The error to raise for what is wrong; ``fault_id`` becomes its ``id``."""
        return with_id(self._error(problem, self.file_name, *place), fault_id)

    def refuse(self, fault: LocatedError) -> None:
        """Deal with a fault: raise it."""
        raise fault

    def warn(self, problem: str, place: Place, fault_id: str) -> None:
        """Note what is odd and does no harm. Here it is ignored."""

    def has_room(self) -> bool:
        """Is a further unknown key noted? Its near misses take long to find."""
        return True

    def expectation(self, found: object, known: Sequence[str]) -> str:
        """The end of an error: what was probably meant, or else all that could have been."""
        return expectation(found, known)

    def data(self, content: Union[str, bytes]) -> object:
        """What a text holds, read as YAML; None if it was refused."""
        try:
            return load(content, self.file_name)
        except YamlError as error:
            self.refuse(self.fault(error.problem, error.place, error.id))
            return None

    def load(self, content: Union[str, bytes], what: str, expected: str = 'a mapping'
             ) -> CheckedMapping:
        """The mapping that a text holds."""
        return self.mapping(self.data(content), what, expected, (1, 1))

    def mapping(self, data: object, what: str, expected: str = 'a mapping',
                place: Place = NOWHERE) -> CheckedMapping:
        """
        Data as a mapping, in which no key may be repeated; an empty one if it was refused.

        ``place`` is what errors say of data that does not know its own place.
        """
        if not isinstance(data, dict):
            own_place = place_of(data)
            self.refuse(self.fault('%s is %s, expected %s' % (what, shown(data), expected),
                                   place if own_place == NOWHERE else own_place))
            data = {}
        mapping = CheckedMapping(self, data, what)
        mapping.refuse_duplicates()
        return mapping

    def mappings(self, items: Sequence[object], what: str, expected: str = 'a mapping'
                 ) -> Iterator[CheckedMapping]:
        """The items of a list as mappings, without those that were refused."""
        for index, item in enumerate(items):
            mapping = self.mapping(item, what, expected, value_place(items, index))
            if isinstance(item, dict):
                yield mapping

    def text(self, value: object, what: str, place: Place) -> str:
        """A value as text that says something, and that a file can hold; '' if it was refused."""
        if isinstance(value, str) and value != '' and (
                value.isascii() or not _find_surrogate(value)):
            return value
        self.refuse(self.fault('%s is %s, expected text' % (what, shown(value)), place))
        return ''

    def refuse_duplicates(self, data: object) -> None:
        """Refuse data in which a mapping, at whatever depth, has a key twice."""
        if isinstance(data, dict):
            CheckedMapping(self, data, '').refuse_duplicates()
        if isinstance(data, (dict, list)):
            for below in data.values() if isinstance(data, dict) else data:
                self.refuse_duplicates(below)


class CheckedMapping:
    """
    A mapping that is read key by key.

    Where ``key``, its own key, is its name, errors call what is in it by that name too: ``type of
    topic 'scan'``.
    """

    __slots__ = ('reading', 'data', '_what', '_key')

    def __init__(self, reading: Reading, data: object, what: str,
                 key: object = None) -> None:
        self.reading = reading
        self.data: Any = data
        self._what = what
        self._key = key

    def __iter__(self) -> Iterator[Any]:
        return iter(self.data)

    @property
    def title(self) -> str:
        """What errors call it."""
        return _called(self._what, self._key)

    @property
    def place(self) -> Place:
        """Where it begins."""
        return place_of(self.data)

    def key_place(self, key: object) -> Place:
        """Where a key stands."""
        return key_place(self.data, key)

    def value_place(self, key: object) -> Place:
        """Where the value of a key begins."""
        return value_place(self.data, key)

    def get(self, key: object) -> Any:
        """The value of a key, unread; None if there is none."""
        return self.data.get(key)

    def wrong(self, key: object, expected: str, what: str = '') -> LocatedError:
        """The error to raise for the value of a key where something else is expected."""
        return self.reading.fault('%s is %s, expected %s' % (
            self._value_called(key, what), shown(self.get(key)), expected), self.value_place(key))

    def text(self, key: str, may_be_empty: bool = False) -> Optional[str]:
        """The text that a key may have; None if there is nothing, or if it was refused."""
        value = self.data.get(key)
        if value is None or value == '' and may_be_empty:
            return value    # type: ignore[no-any-return]
        return self.text_at(key) or None

    def text_at(self, key: object, what: str = '') -> str:
        """The text that a key has; '' if it was refused."""
        value = self.data[key]
        if value.__class__ is str and value and value.isascii():    # as nearly all are
            return value
        return self.reading.text(value, self._value_called(key, what), self.value_place(key))

    def key_text(self, key: object, what: str) -> str:
        """A key, which must be text; '' if it was refused."""
        return self.reading.text(key, what, self.key_place(key))

    def mapping(self, key: object, what: str = '', expected: str = 'a mapping',
                is_checked: bool = True) -> CheckedMapping:
        """
        The mapping that a key may have; an empty one for nothing or ``[]``, or if it was refused.

        A repeated key in it is refused if ``is_checked``.
        """
        value = self.data.get(key)
        if not isinstance(value, dict):
            if value is not None and value != []:
                self.reading.refuse(self.wrong(key, expected, what))
            value = {}
        mapping = CheckedMapping(self.reading, value, what or str(key), key)
        if is_checked:
            mapping.refuse_duplicates()
        return mapping

    def sequence(self, key: object, expected: str = 'a list') -> List[object]:
        """The list that a key may have, unread; empty for nothing or ``{}``, or if refused."""
        value = self.data.get(key)
        if isinstance(value, (list, tuple)):
            return value    # type: ignore[return-value]
        if value is not None and value != {}:
            self.reading.refuse(self.wrong(key, expected))
        return []

    def required(self, key: str, known: Sequence[str] = ()) -> object:
        """
        The value that a key must have, unread; None if it was refused.

        A key that is not among those known may be this one, misspelt.
        """
        value = self.data.get(key)
        if value is not None:
            return value
        unknown = [name for name in self.data if isinstance(name, str) and name not in known]
        for near in near_misses(key, unknown[:_MAX_SUSPECTS] if known else ()):
            self.reading.refuse(self.reading.fault('unknown key %s, and %s has no %s%s' % (
                shown(near), self.title, key, did_you_mean([key])), self.key_place(near),
                'missing-key'))
            return None
        self.reading.refuse(self.reading.fault(
            '%s has no %s' % (self.title, key),
            self.key_place(key) if key in self.data else self.place, 'missing-key'))
        return None

    def required_text(self, key: str, known: Sequence[str] = ()) -> str:
        """The text that a key must have; '' if it was refused."""
        return '' if self.required(key, known) is None else self.text_at(key)

    def refuse_duplicates(self, harmless: Sequence[str] = ()) -> None:
        """Refuse a repeated key, since one of its values would be lost; warn of harmless ones."""
        for key, _, place in getattr(self.data, 'repeated', ()):
            problem = 'duplicate key %s%s' % (shown(key), self._within(' in '))
            if key in harmless:
                self.reading.warn(problem + ', the last one counts', place, 'duplicate-key')
            else:
                self.reading.refuse(self.reading.fault(problem, place, 'duplicate-key'))

    def unknown_key(self, key: object, known: Sequence[str], kind: str = 'key') -> LocatedError:
        """The error to raise for a key that is not known; ``kind`` is what such a key is."""
        return self.reading.fault('unknown %s %s in %s%s' % (
            kind, shown(key), self.title, self.reading.expectation(key, known)),
            self.key_place(key), 'unknown-key')

    def warn_of_unknown(self, known: Sequence[str]) -> None:
        """Note the keys that are not known."""
        for key in self.data:
            if key not in known and self.reading.has_room():
                unknown = self.unknown_key(key, known)
                self.reading.warn(unknown.problem, unknown.place, unknown.id)

    def _value_called(self, key: object, what: str) -> str:
        return _called(what, key) if what else str(key) + self._within(' of ')

    def _within(self, preposition: str) -> str:
        """The end of what errors call something in it, if it has a name of its own."""
        return preposition + self.title if '%s' in self._what else ''


def _called(what: str, key: object) -> str:
    return what.replace('%s', shown(key))
