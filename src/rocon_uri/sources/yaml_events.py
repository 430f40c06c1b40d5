"""
Makes the data of `rocon_uri.sources.yaml_source` from the events of PyYAML's parser.

It imports yaml, and is itself imported only when YAML is read.
"""
from __future__ import annotations

import re
from typing import Any, Callable, Dict, List, Tuple, Union

import yaml
from yaml.events import (
    AliasEvent, MappingEndEvent, MappingStartEvent, ScalarEvent, SequenceEndEvent, StreamEndEvent)

from rocon_uri.sources.wording import quoted
from rocon_uri.sources.yaml_data import (
    MAX_DEPTH, MAX_SIZE, Position, YamlError, YamlMapping, YamlSequence, end_position)
from rocon_uri.sources.yaml_scalars import CORE, TAGGED, Scalar, plain

__all__ = ['Reader', 'Value']

Event = Any     # of PyYAML's parser; which attributes it has depends on its class
Value = Union[Scalar, YamlMapping, YamlSequence]

_MAX_OTHER_KEYS = 100       # keys of a mapping that are not text, merged ones included
_UNFINISHED = YamlSequence(0, 0, [])    # an anchored collection, while it is being read
_unreadable = re.compile(
    '[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]').search
_unreadable_escape = re.compile('[\ud800-\udfff]').search


class Reader:
    """
    Reads one text: turns the parser's events into data as they come.

    Nested collections are nested calls, so that the state of each is in local variables.
    """

    next_event: Callable[[], Event]     # of the parser

    def __init__(self, text: str, file_name: str) -> None:
        self.text = text
        self.file_name = file_name
        self.anchors: Dict[str, Value] = {}
        self.left_to_add = MAX_SIZE     # what aliases and merges may still add

    def document(self) -> Value:
        """The data of the only document."""
        try:
            if hasattr(yaml, 'CSafeLoader'):
                self.next_event = yaml.CSafeLoader(self.text).get_event
            else:
                self.next_event = self._without_surrogates(yaml.SafeLoader(self.text).get_event)
            self.next_event()           # the start of the stream
            event = self.next_event()
            if event.__class__ is StreamEndEvent:
                return None
            data = self._node(self.next_event(), 0)
            self.next_event()           # the end of the document
            event = self.next_event()
            if event.__class__ is not StreamEndEvent:
                raise self._error('a second document starts here, where one is expected', event)
            return data
        except YamlError:
            raise
        # The parser in Python also raises the errors of int() and chr().
        except (yaml.YAMLError, ValueError, OverflowError) as error:
            self._check_what_was_read_ahead(error)
            raise self._parser_error(error) from error

    def _mapping(self, start: Event, depth: int) -> YamlMapping:
        """The mapping whose start event this is."""
        next_event, scalar = self.next_event, self._scalar
        mark = start.start_mark
        positions: Dict[object, Tuple[int, int, int, int]] = {}
        mapping = YamlMapping(mark.line, mark.column, positions)
        merged: List[YamlMapping] = []
        repeated: List[Tuple[object, object, Position]] = []
        others = 0
        while True:
            event = next_event()
            if event.__class__ is ScalarEvent:
                key = scalar(event)
            elif event.__class__ is MappingEndEvent:
                break
            else:
                key = self._key(event, depth)
            value_event = next_event()
            if value_event.__class__ is ScalarEvent:
                value: Value = scalar(value_event)
            else:
                value = self._node(value_event, depth)
            if key == '<<' and event.__class__ is ScalarEvent and event.implicit[0]:
                merged += self._merged(value, value_event)
                continue
            if key.__class__ is not str:
                others += 1
                self._check_other_keys(others, event)
            mark, value_mark = event.start_mark, value_event.start_mark
            if key in mapping:
                repeated.append((key, mapping[key], (mark.line + 1, mark.column + 1)))
            mapping[key] = value
            positions[key] = mark.line, mark.column, value_mark.line, value_mark.column
        if repeated:
            mapping.repeated = repeated
        if merged:
            others += sum(key.__class__ is not str for source in merged for key in source)
            self._check_other_keys(others, start)
            mapping.merge(merged)
        return mapping

    def _sequence(self, start: Event, depth: int) -> YamlSequence:
        """The sequence whose start event this is."""
        mark = start.start_mark
        positions: List[Tuple[int, int]] = []
        sequence = YamlSequence(mark.line, mark.column, positions)
        while True:
            event = self.next_event()
            if event.__class__ is SequenceEndEvent:
                return sequence
            sequence.append(self._node(event, depth))
            mark = event.start_mark
            positions.append((mark.line, mark.column))

    def _node(self, event: Event, depth: int) -> Value:
        """The data that begins with this event, inside ``depth`` collections."""
        if event.__class__ is ScalarEvent:
            return self._scalar(event)
        if event.__class__ is AliasEvent:
            return self._alias(event, depth)
        if depth == MAX_DEPTH:
            raise self._error('nested deeper than %d' % MAX_DEPTH, event)
        kind, read = (('map', self._mapping) if event.__class__ is MappingStartEvent
                      else ('seq', self._sequence))
        if event.tag not in (None, '!', CORE + kind):
            raise self._tag_error(event)
        if event.anchor is None:
            return read(event, depth + 1)
        self._open_anchor(event)
        data = self.anchors[event.anchor] = read(event, depth + 1)
        return data

    def _scalar(self, event: Event) -> Scalar:
        """The value of a scalar."""
        is_plain, is_quoted_or_block = event.implicit
        value: Scalar = event.value
        if not is_quoted_or_block:
            if not is_plain and event.tag not in TAGGED:
                raise self._tag_error(event)
            try:
                value = plain(event.value) if is_plain else TAGGED[event.tag](event.value)
            except (KeyError, ValueError, OverflowError):
                kind = 'a number' if is_plain else _shown_tag(event.tag)
                raise self._error('%s cannot be read as %s' % (quoted(event.value), kind),
                                  event) from None
        if event.anchor is not None:
            self._open_anchor(event)
            self.anchors[event.anchor] = value
        return value

    def _key(self, event: Event, depth: int) -> Scalar:
        """The key that an alias refers to; a collection cannot be one."""
        if event.__class__ is AliasEvent:
            key = self._alias(event, depth)
            if not isinstance(key, (YamlMapping, YamlSequence)):
                return key
        raise self._error('a collection cannot be a key, text is expected', event)

    def _check_other_keys(self, count: int, event: Event) -> None:
        """Refuse many numbers as keys: they can be chosen so that all have the same hash."""
        if count > _MAX_OTHER_KEYS:
            raise self._error('more than %d keys that are not text' % _MAX_OTHER_KEYS, event)

    def _merged(self, value: Value, event: Event) -> List[YamlMapping]:
        """The mappings that a merge key merges; those that win come last."""
        sources: List[Any] = value[::-1] if isinstance(value, YamlSequence) else [value]
        for source in sources:
            if not isinstance(source, YamlMapping):
                raise self._error("'<<' merges a mapping or a list of mappings, nothing else",
                                  event)
            self._add(len(source), event)
        return sources

    def _open_anchor(self, event: Event) -> None:
        """Note the anchor of a node, before its content is read."""
        if event.anchor in self.anchors:
            raise self._error('anchor %s is defined twice' % quoted('&' + event.anchor), event)
        self.anchors[event.anchor] = _UNFINISHED

    def _alias(self, event: Event, depth: int) -> Value:
        """The data that an alias refers to, if that is not too much."""
        name = quoted('*' + event.anchor)
        if event.anchor not in self.anchors:
            raise self._error('alias %s has no anchor before it' % name, event)
        data = self.anchors[event.anchor]
        if data is _UNFINISHED:
            raise self._error('alias %s is inside the node that it refers to' % name, event)
        self._measure(data, event, depth)
        return data

    def _measure(self, data: Value, event: Event, depth: int) -> None:
        """Count what an alias adds, and check how deep it is nested where it stands."""
        if isinstance(data, (YamlMapping, YamlSequence)):
            if depth == MAX_DEPTH:
                raise self._error('nested deeper than %d' % MAX_DEPTH, event)
            for item in data:
                self._measure(item, event, depth + 1)
            if isinstance(data, YamlMapping):
                for item in data.values():
                    self._measure(item, event, depth + 1)
        self._add(1 + (len(data) if isinstance(data, str) else 0), event)

    def _add(self, size: int, event: Event) -> None:
        """Count what an alias or a merge adds."""
        self.left_to_add -= size
        if self.left_to_add < 0:
            raise self._error('aliases add more than 1 MiB', event)

    def _without_surrogates(self, get_event: Callable[[], Event]) -> Callable[[], Event]:
        r"""The parser in Python lets ``"\ud800"`` through; libyaml does not."""
        def next_event() -> Event:
            event = get_event()
            if _unreadable_escape(getattr(event, 'value', '')):
                raise self._error('found invalid Unicode character escape code', event)
            return event
        return next_event

    def _tag_error(self, event: Event) -> YamlError:
        return self._error('tag %s is not one of the core types, and no other is read'
                           % quoted(_shown_tag(event.tag)), event)

    def _error(self, problem: str, event: Event) -> YamlError:
        mark = event.start_mark
        return YamlError(problem, self.file_name, mark.line + 1, mark.column + 1)

    def _check_what_was_read_ahead(self, error: Exception) -> None:
        """
        Refuse what is wrong before the place at which the parser gave up because of the depth.

        libyaml reads ahead of its events and, from 0.2.6 on, gives up at a depth of 1,000.
        """
        if getattr(error, 'problem', None) == 'exceeded maximum nesting depth':
            Reader(self.text[:error.problem_mark.index], self.file_name).document()  # type: ignore

    def _parser_error(self, error: Exception) -> YamlError:
        """The error of the parser, on one line."""
        unreadable = _unreadable(self.text)
        mark = getattr(error, 'problem_mark', None) or getattr(error, 'context_mark', None)
        if mark is None and unreadable is not None:
            return YamlError('character U+%04X is not allowed' % ord(unreadable.group()),
                             self.file_name, *end_position(self.text[:unreadable.start()]))
        parts = [getattr(error, 'problem', None), getattr(error, 'context', None)]
        problem = ' '.join(part for part in parts if part) or 'cannot be read: %s' % error
        line, column = (1, 1) if mark is None else (mark.line + 1, mark.column + 1)
        return YamlError(problem, self.file_name, line, column)


def _shown_tag(tag: str) -> str:
    """The tag as people write it."""
    return '!!' + tag[len(CORE):] if tag.startswith(CORE) else tag
