"""
What strangers wrote, read key by key: each refusal has its place and says what was expected.

A `Reading` is of one file. It reads the file, and decides what becomes of a fault: it raises the
first one. The collections in the file are asked for what should be in them:

>>> from rocon_uri.sources.yaml_data import YamlError
>>> reading = Reading('dance.rapp', YamlError)
>>> rapp = reading.load('{launch: [dance.launch], iocn: dance.png}', 'the rapp')
>>> rapp.text('launch')
Traceback (most recent call last):
    ...
rocon_uri.sources.yaml_data.YamlError: dance.rapp:1:10: launch is a list, expected text
>>> print(rapp.unknown_key('iocn', ['launch', 'icon']).sentence)
unknown key 'iocn' in the rapp (did you mean 'icon'?)

A subclass of `Reading` that collects faults overrides `Reading.refuse`. What it has refused is read
as if nothing were there.

``what`` is always what an error calls the thing; ``%s`` in it is its key or its place in a list.
"""
from __future__ import annotations

import re
from typing import Any, Callable, Dict, Iterator, Optional, Sequence, Union

from rocon_uri.sources.located import NOWHERE, LocatedError, Place
from rocon_uri.sources.wording import did_you_mean, near_misses, shown
from rocon_uri.sources.yaml_data import YamlError, key_place, place_of, value_place
from rocon_uri.sources.yaml_source import load

__all__ = ['CheckedMapping', 'CheckedSequence', 'Reading', 'is_text']

_MAX_SUSPECTS = 100     # unknown keys that are compared with a missing one

_find_surrogate = re.compile('[\ud800-\udfff]').search


class Reading:
    """
    One file that is read, and what becomes of its faults: the first one is raised.

    :param str file_name: the file, as errors name it
    :param error: what to raise: a subclass of `LocatedError`, or what makes one of
        (problem, file_name, line, column)
    """

    def __init__(self, file_name: str, error: Callable[..., LocatedError]) -> None:
        self.file_name = file_name
        self._error = error

    def fault(self, problem: str, place: Place = NOWHERE) -> LocatedError:
        """The error to raise for what is wrong."""
        return self._error(problem, self.file_name, *place)

    def refuse(self, fault: LocatedError) -> None:
        """
        Deal with a fault: raise it.

        :param LocatedError fault: one that `fault` made
        :raises LocatedError: always
        """
        raise fault

    def warn(self, problem: str, place: Place = NOWHERE) -> None:
        """Note what is odd and does no harm. Here it is ignored."""

    def expectation(self, found: object, known: Sequence[str]) -> str:
        """The end of an error: what was probably meant, or else all that could have been."""
        meant = did_you_mean(near_misses(found, known)) if isinstance(found, str) else ''
        return meant or ' (expected %s)' % ', '.join(known)

    def data(self, content: Union[str, bytes]) -> Any:
        """
        What a text holds, read as YAML.

        :returns: as `rocon_uri.sources.yaml_source.load`
        """
        try:
            return load(content, self.file_name)
        except YamlError as error:
            self.refuse(self.fault(error.problem, error.place))
            return None

    def load(self, content: Union[str, bytes], what: str, expected: str = 'a mapping'
             ) -> CheckedMapping:
        """The mapping that a text holds. Parameters as in `mapping`."""
        return self.mapping(self.data(content), what, (1, 1), expected)

    def mapping(self, data: object, what: str, place: Place = NOWHERE,
                expected: str = 'a mapping') -> CheckedMapping:
        """
        Data as a mapping, in which no key may be repeated.

        :param data: plain data
        :param str what: what errors call it
        :param place: where errors say that it is, if it does not know that itself
        :param str expected: what errors say that they expected
        :returns: `CheckedMapping`, an empty one if it was refused
        """
        if not isinstance(data, dict):
            known_place = place if place_of(data) == NOWHERE else place_of(data)
            self.refuse(self.fault('%s is %s, expected %s' % (what, shown(data), expected),
                                   known_place))
            data = {}
        mapping = CheckedMapping(self, data, what)
        mapping.refuse_duplicates()
        return mapping

    def refuse_duplicates(self, data: object) -> None:
        """Refuse data in which some mapping, at whatever depth, has a key twice."""
        if isinstance(data, dict):
            CheckedMapping(self, data, '').refuse_duplicates()
        if isinstance(data, (dict, list)):
            for below in data.values() if isinstance(data, dict) else data:
                self.refuse_duplicates(below)


class _Checked:
    """What a mapping and a sequence have in common: something is read from them by a key."""

    __slots__ = ('reading', 'data')

    #: what is read, untouched
    data: Any

    def __init__(self, reading: Reading, data: object) -> None:
        self.reading = reading
        self.data = data

    @property
    def place(self) -> Place:
        """Where it begins."""
        return place_of(self.data)

    def value_place(self, key: object) -> Place:
        """Where the value of a key, or an item, begins."""
        return value_place(self.data, key)

    def get(self, key: Any) -> Any:
        """The value of a key, or an item, unread."""
        return self.data[key]

    def wrong(self, key: object, expected: str, what: str = '') -> LocatedError:
        """The error to raise for the value of a key where something else is expected."""
        return self.reading.fault('%s is %s, expected %s' % (
            self._called(key, what), shown(self.get(key)), expected), self.value_place(key))

    def text(self, key: object, what: str = '', may_be_empty: bool = False) -> Optional[str]:
        """
        The text that a key has.

        :returns: str; None if there is nothing, or if it was refused
        """
        value = self.get(key)
        if value is None or is_text(value) or may_be_empty and value == '':
            return value    # type: ignore[no-any-return]
        self.reading.refuse(self.wrong(key, 'text', what))
        return None

    def text_at(self, key: object, what: str = '') -> str:
        """The text that must stand at a key that is there; '' if it was refused."""
        value = self.get(key)
        if is_text(value):
            return value    # type: ignore[no-any-return]
        self.reading.refuse(self.wrong(key, 'text', what))
        return ''

    def mapping(self, key: object, what: str = '', expected: str = 'a mapping',
                or_empty_list: bool = True) -> CheckedMapping:
        """
        The mapping that a key has. Its keys may be repeated.

        :param bool or_empty_list: is ``[]`` read as an empty one, as people write it?
        :returns: `CheckedMapping`; an empty one if there is nothing, or if it was refused
        """
        value = self.get(key)
        if not isinstance(value, dict):
            if value is not None and not (or_empty_list and value == []):
                self.reading.refuse(self.wrong(key, expected, what))
            value = {}
        return CheckedMapping(self.reading, value, what or str(key), key)

    def keys_once(self, key: object, what: str = '', expected: str = 'a mapping'
                  ) -> CheckedMapping:
        """The mapping that a key has, as `mapping` gives it, in which no key may be repeated."""
        mapping = self.mapping(key, what, expected)
        mapping.refuse_duplicates()
        return mapping

    def sequence(self, key: object, what: str = '', expected: str = 'a list') -> CheckedSequence:
        """
        The list that a key has.

        :returns: `CheckedSequence`; an empty one for nothing or ``{}``, or if it was refused
        """
        value = self.get(key)
        if not isinstance(value, (list, tuple)):
            if value is not None and value != {}:
                self.reading.refuse(self.wrong(key, expected, what))
            value = []
        return CheckedSequence(self.reading, value)

    def _called(self, key: object, what: str) -> str:
        return what.replace('%s', shown(key)) if what else str(key)


class CheckedSequence(_Checked):
    """
    A list that is read item by item.

    :param Reading reading: what becomes of faults
    :param data: list or tuple
    """

    __slots__ = ()

    def __len__(self) -> int:
        return len(self.data)

    def mappings(self, what: str, expected: str = 'a mapping') -> Iterator[CheckedMapping]:
        """The items, each of which must be a mapping that is not empty, with no repeated key."""
        for index, item in enumerate(self.data):
            if isinstance(item, dict):
                yield self.keys_once(index, what)
            else:
                self.reading.refuse(self.wrong(index, expected, what))

    def texts(self, what: str) -> Iterator[str]:
        """The items, each of which must be text."""
        for index in range(len(self.data)):
            text = self.text_at(index, what)
            if text:
                yield text


class CheckedMapping(_Checked):
    """
    A mapping that is read key by key.

    :param Reading reading: what becomes of faults
    :param dict data: plain data
    :param str what: what errors call it
    :param key: what ``%s`` in that stands for, if it is there. Errors then also call what is
        within by it: ``type of topic 'scan'``
    """

    __slots__ = ('_what', '_key')

    def __init__(self, reading: Reading, data: Dict[Any, Any], what: str,
                 key: object = None) -> None:
        super().__init__(reading, data)
        self._what = what
        self._key = key

    def __iter__(self) -> Iterator[Any]:
        return iter(self.data)

    def __contains__(self, key: object) -> bool:
        return key in self.data

    @property
    def title(self) -> str:
        """What errors call it."""
        return self._called(self._key, self._what)

    def get(self, key: object) -> Any:
        """The value of a key, unread; None if there is none."""
        return self.data.get(key)

    def key_place(self, key: object) -> Place:
        """Where a key stands."""
        return key_place(self.data, key)

    def key_text(self, key: object, what: str) -> str:
        """A key, which must be text; '' if it was refused."""
        if is_text(key):
            return key      # type: ignore[return-value]
        self.reading.refuse(self.reading.fault(
            '%s is %s, expected text' % (what, shown(key)), self.key_place(key)))
        return ''

    def required(self, key: str, known: Sequence[str] = ()) -> Any:
        """
        The value that a key must have, unread.

        :param str key: which
        :param known: the keys that are known, to find the one that was misspelt
        :returns: None if it was refused
        """
        value = self.data.get(key)
        if value is None:
            unknown = [name for name in self.data if isinstance(name, str) and name not in known]
            for near in near_misses(key, unknown[:_MAX_SUSPECTS] if known else ()):
                self.reading.refuse(self.reading.fault('unknown key %s, and %s has no %s%s' % (
                    shown(near), self.title, key, did_you_mean([key])), self.key_place(near)))
                return None
            self.reading.refuse(self.reading.fault(
                '%s has no %s' % (self.title, key),
                self.key_place(key) if key in self.data else self.place))
        return value

    def required_text(self, key: str, known: Sequence[str] = ()) -> str:
        """The text that a key must have; '' if it was refused. Parameters as in `required`."""
        return '' if self.required(key, known) is None else self.text(key) or ''

    def refuse_duplicates(self, harmless: Sequence[str] = ()) -> None:
        """Refuse to have a key twice, since one of the two would be lost, but for harmless ones."""
        for key, _, place in getattr(self.data, 'repeated', ()):
            problem = 'duplicate key %s%s' % (shown(key), self._within(' in '))
            if key in harmless:
                self.reading.warn(problem + ', the last one counts', place)
            else:
                self.reading.refuse(self.reading.fault(problem, place))

    def unknown_key(self, key: object, known: Sequence[str], kind: str = 'key') -> LocatedError:
        """The error to raise for a key that is not known; ``kind`` is what such a key is."""
        return self.reading.fault('unknown %s %s in %s%s' % (
            kind, shown(key), self.title, self.reading.expectation(key, known)),
            self.key_place(key))

    def warn_of_unknown(self, known: Sequence[str]) -> None:
        """Note the keys that are not known."""
        for key in self.data:
            if key not in known:
                unknown = self.unknown_key(key, known)
                self.reading.warn(unknown.problem, unknown.place)

    def _called(self, key: object, what: str) -> str:
        return super()._called(key, what) + ('' if what else self._within(' of '))

    def _within(self, preposition: str) -> str:
        """What to say of something in it: where it is, if it has a name of its own."""
        return preposition + self.title if '%s' in self._what else ''


def is_text(value: object) -> bool:
    """Is it a text that says something, and that a file can hold?"""
    return isinstance(value, str) and value != '' and (
        value.isascii() or not _find_surrogate(value))
