"""
Rocon URIs: what a robot says it is, what an app says it runs on.

`parse` reads one, `RoconURI` is what comes back.
"""
from __future__ import annotations

from functools import partial
from operator import attrgetter

from rocon_uri import grammar, name_pattern
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import quoted
from rocon_uri.field import Field, NameField, UnregisteredValue, ValuesField, read_name, read_values
from rocon_uri.grammar import is_literal
from rocon_uri.parts import read_concert_name, read_rocon_app, take_apart
from rocon_uri.vocabulary import Vocabulary, completed, current, precedence

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Callable, Dict, Iterable, Optional, Tuple, Union
    from rocon_uri.name_pattern import NamePattern
    FieldText = Union[str, Field, Iterable[str]]

__all__ = ['RoconURI', 'aligned', 'default_uri_string', 'parse', 'with_any_name']

#: The URI of anything at all.
default_uri_string = 'rocon://'

_MEMO_SIZE = 4096           # URIs remembered for each vocabulary
_MEMO_TEXT_LENGTH = 1024    # characters; longer ones are read anew each time
_LEFT_OUT = ('',) * 5       # what the parts between slashes are where there are fewer


def _slot(name: str, doc: str) -> Any:
    """A property that reads a slot."""
    return property(attrgetter(name), doc=doc)


class RoconURI:
    """
    A set of resources: the product of the sets that its fields stand for.

    It does not change, and can be a key. Two are equal if they have the same alternatives in each
    field, in whatever order, the same name or pattern, concert and app; whether they stand for
    the same resources is what `rocon_uri.relation` says.

    :param text: str, as `parse` takes
    :param vocabulary: as `parse` takes
    :param bool strict: as `parse` takes
    :raises RoconURIValueError: as `parse` does

    >>> uri = RoconURI('rocon:/turtlebot2|pr2/bob#rocon_apps/teleop')
    >>> uri.hardware_platform.list, uri.name.string, uri.rocon_app
    (['turtlebot2', 'pr2'], 'bob', 'rocon_apps/teleop')
    """

    __slots__ = ('_concert_name', '_hardware_platform', '_name', '_pattern',
                 '_application_framework', '_operating_system', '_rocon_app',
                 '_vocabulary', '_read_with_one_slash')

    _concert_name: str
    _hardware_platform: ValuesField
    _name: str
    _pattern: Optional[NamePattern]     # None for a literal name: most have one
    _application_framework: ValuesField
    _operating_system: ValuesField
    _rocon_app: str
    _vocabulary: Vocabulary
    _read_with_one_slash: bool

    def __new__(cls, text: Union[str, 'RoconURI'] = 'rocon:/',
                vocabulary: Optional[Vocabulary] = None, strict: bool = False) -> 'RoconURI':
        return parse(text, vocabulary, strict)

    @classmethod
    def from_fields(cls, concert_name: str = '', hardware_platform: FieldText = '*',
                    name: FieldText = '*', application_framework: FieldText = '*',
                    operating_system: FieldText = '*', rocon_app: str = '',
                    vocabulary: Optional[Vocabulary] = None) -> 'RoconURI':
        """
        A URI from its fields.

        :param str concert_name: '' for none
        :param hardware_platform: str, as in a URI but without percent-escapes; or an iterable of
            the alternatives; or a `Field`
        :param name: str or `Field`
        :param application_framework: like hardware_platform
        :param operating_system: like hardware_platform
        :param str rocon_app: '' for none
        :param vocabulary: as `parse` takes
        :returns: RoconURI
        :raises RoconURIValueError: for a field that is not legal

        >>> str(RoconURI.from_fields(hardware_platform=['pr2', 'kobuki'], name='bob'))
        'rocon:/pr2|kobuki/bob/*/*'
        """
        known = current() if vocabulary is None else vocabulary
        texts = {field: _text(field, value) for field, value in (
            ('concert_name', concert_name), ('hardware_platform', hardware_platform),
            ('name', name), ('application_framework', application_framework),
            ('operating_system', operating_system), ('rocon_app', rocon_app))}

        def read_part(field: str, read: Callable[[str], Any]) -> Any:
            return read(texts[field])
        return _with_more_if_needed(partial(_assemble, read_part), known)

    def replace(self, **fields: Any) -> 'RoconURI':
        """
        This URI with other values in some fields.

        :param fields: those of `from_fields` that change
        :returns: RoconURI
        :raises RoconURIValueError: for a field that is not legal

        >>> str(RoconURI('rocon:/pr2/bob').replace(name='alice', operating_system='focal'))
        'rocon:/pr2/alice/*/focal'
        """
        own: Dict[str, Any] = {field: getattr(self, field) for field in (
            'concert_name', 'hardware_platform', 'name', 'application_framework',
            'operating_system', 'rocon_app', 'vocabulary')}
        own.update(fields)
        return self.from_fields(**own)

    concert_name: str = _slot(
        '_concert_name', 'The concert that the resource is attached to, a str; empty for any.')
    hardware_platform: ValuesField = _slot(
        '_hardware_platform', 'The hardware, as ``turtlebot2``; a `Field`.')
    application_framework: ValuesField = _slot(
        '_application_framework', 'The framework, as ``noetic``; a `Field`.')
    operating_system: ValuesField = _slot(
        '_operating_system', 'The system, as ``focal``; a `Field`.')
    rocon_app: str = _slot('_rocon_app', 'The app that runs there, a str; empty for none.')
    rapp: str = rocon_app   # its old name
    vocabulary: Vocabulary = _slot(
        '_vocabulary', 'What the URI was read with, a `Vocabulary`.')
    read_with_one_slash: bool = _slot(
        '_read_with_one_slash',
        'Was the part after ``//`` taken for the platform, since it is a registered one?')

    @property
    def name(self) -> NameField:
        """The name of the resource or a pattern for names; a `Field`."""
        return NameField(self._name, self._pattern or name_pattern.read(self._name))

    @property
    def sets(self) -> Tuple[Tuple[str, Any], ...]:
        """
        What decides about compatibility: (name, `Field`) of the fields and of the concert.

        The cheap ones come first, the names last.
        """
        concert = self._concert_name or '*'
        return (('hardware_platform', self._hardware_platform),
                ('application_framework', self._application_framework),
                ('operating_system', self._operating_system),
                ('concert_name', NameField(concert, name_pattern.read(concert))),
                ('name', self.name))

    def isdisjoint(self, other: Union[str, 'RoconURI']) -> bool:
        """
        Is there no resource that both stand for?

        :param other: RoconURI, or str that is parsed
        :returns: bool
        :raises RoconURIValueError: for a text that is not legal
        :raises PatternTooComplex: if the two names take too much work to decide

        >>> RoconURI('rocon:/pr2').isdisjoint('rocon:/turtlebot2')
        True
        """
        ours, theirs = aligned(self, other)
        return not all(a.intersects(b) for (_, a), (_, b) in zip(ours.sets, theirs.sets))

    def issubset(self, other: Union[str, 'RoconURI']) -> bool:
        """
        Does the other stand for every resource that this one stands for?

        :param other: RoconURI, or str that is parsed
        :returns: bool
        :raises RoconURIValueError: for a text that is not legal
        :raises PatternTooComplex: if the two names take too much work to decide

        >>> RoconURI('rocon:/pr2/bob').issubset('rocon:/pr2/b*')
        True
        """
        ours, theirs = aligned(self, other, complete=True)
        return all(b.includes(a) for (_, a), (_, b) in zip(ours.sets, theirs.sets))

    def issuperset(self, other: Union[str, 'RoconURI']) -> bool:
        """
        Does this one stand for every resource that the other stands for?

        :param other: RoconURI, or str that is parsed
        :returns: bool
        :raises RoconURIValueError: for a text that is not legal
        :raises PatternTooComplex: if the two names take too much work to decide

        >>> RoconURI('rocon:/robot').issuperset('rocon:/pr2|kobuki')
        True
        """
        return parse(other).issubset(self)

    @property
    def short(self) -> str:
        """The text without the ``*`` that it can do without: ``'rocon:/pr2/bob'``."""
        fields = [self._hardware_platform.string, self._name,
                  self._application_framework.string, self._operating_system.string]
        if self._needs_all_fields():
            return str(self)
        while fields and fields[-1] == '*':
            fields.pop()
        text = 'rocon://' + self._concert_name if self._concert_name else 'rocon:'
        if fields or not self._concert_name:
            text += '/' + '/'.join(fields)
        return text + ('#' + self._rocon_app if self._rocon_app else '')

    def _needs_all_fields(self) -> bool:
        """Would the concert be taken for a platform if not all of the fields were written?"""
        if not self._concert_name:
            return False
        platforms = completed(self._vocabulary).field('hardware_platform')
        return self._concert_name in platforms and not all(
            value in platforms for value in self._hardware_platform)

    def to_rfc3986(self) -> str:
        """
        The text with every character escaped that RFC 3986 does not allow raw.

        It is safe in HTTP and HTML, and parsing it gives an equal URI.

        :returns: str

        >>> RoconURI('rocon:/pr2|kobuki/bob_[0-9]+').to_rfc3986()
        'rocon:/pr2%7Ckobuki/bob_%5B0-9%5D+/*/*'
        """
        scheme, text = 'rocon:', str(self)[len('rocon:'):]
        return scheme + ''.join(c if c.isalnum() or c in _RFC3986_RAW else '%%%02X' % ord(c)
                                for c in text)

    def __str__(self) -> str:
        return 'rocon:%s/%s/%s/%s/%s%s' % (
            self._concert_name and '//' + self._concert_name, self._hardware_platform.string,
            self._name, self._application_framework.string, self._operating_system.string,
            self._rocon_app and '#' + self._rocon_app)

    def __repr__(self) -> str:
        return 'RoconURI(%r)' % str(self)

    def _key(self) -> Tuple[Any, ...]:
        return (self._name, self._hardware_platform, self._application_framework,
                self._operating_system, self._concert_name, self._rocon_app)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, RoconURI):
            return NotImplemented
        return self is other or self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __copy__(self) -> 'RoconURI':
        return self

    def __deepcopy__(self, memo: Dict[int, Any]) -> 'RoconURI':
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        return parse, (str(self),)


_RFC3986_RAW = frozenset('-._~!$()*+,;=:@/#')


def parse(text: Union[str, RoconURI] = 'rocon:/', vocabulary: Optional[Vocabulary] = None,
          strict: bool = False) -> RoconURI:
    """
    Read a rocon URI; specification, sections "Definition" and "Special Operations".

    :param text: str; a RoconURI comes back as it is, or as the vocabulary given reads it
    :param vocabulary: `Vocabulary` to read with; where left out, what is bundled and, once a
        value is met that is not, what packages on this machine and ROCON_URI_RULES add
    :param bool strict: take the text by its letter: what follows ``//`` is a concert even where
        it is a registered platform, and fields start with a slash
    :returns: RoconURI
    :raises RoconURIValueError: if it is not one; says which field, where in the text and why
    :raises TypeError: if it is no text

    >>> parse('rocon:/pr2/bob').hardware_platform.string
    'pr2'
    """
    known = current() if vocabulary is None else vocabulary
    if not isinstance(text, str):
        if not isinstance(text, RoconURI):
            raise TypeError('a rocon URI is a str, not %s' % type(text).__name__)
        if vocabulary is None or text._vocabulary is vocabulary:
            return text
        text = str(text)
    uri: Optional[RoconURI] = None if strict else known.uris_read.get(text)
    if uri is None:
        uri = None if strict else _read_common(text, known)
        if uri is None:
            uri = _with_more_if_needed(partial(_read, text, strict=strict), known)
        if not strict and len(text) <= _MEMO_TEXT_LENGTH:
            memo = uri._vocabulary.uris_read
            if len(memo) >= _MEMO_SIZE:
                memo.clear()
            memo[text] = uri
    return uri


def aligned(a: Union[str, RoconURI], b: Union[str, RoconURI],
            complete: bool = False) -> Tuple[RoconURI, RoconURI]:
    """
    Two URIs as one vocabulary reads them, so that their fields can be compared.

    :param a: RoconURI, or str that is parsed
    :param b: RoconURI, or str that is parsed
    :param bool complete: does the extent of groups matter?
    :returns: (RoconURI, RoconURI)
    :raises RoconURIValueError: for a text that is not legal, or one with a value that the other's
        vocabulary, by which both are read, does not know
    """
    first, second = parse(a), parse(b)
    vocabularies = [first._vocabulary, second._vocabulary]
    if complete:
        vocabularies = [completed(vocabulary) for vocabulary in vocabularies]
    elif vocabularies[0] is vocabularies[1]:
        return first, second
    chosen = max(vocabularies, key=precedence)
    if any(vocabulary.is_open for vocabulary in vocabularies):
        chosen = chosen.opened()
    return parse(first, chosen), parse(second, chosen)


def with_any_name(uri: RoconURI) -> RoconURI:
    """
    All that differs from a URI in nothing but name and app.

    :param RoconURI uri: any
    :returns: RoconURI; the same as from ``replace`` in a tenth of the time

    >>> str(with_any_name(parse('rocon://north/pr2/bob#apps/teleop')))
    'rocon://north/pr2/*/*/*'
    """
    values = uri._hardware_platform, uri._application_framework, uri._operating_system
    return _new(uri._concert_name, values, '*', name_pattern.ANY, '', uri._vocabulary)


def _read_common(text: str, vocabulary: Vocabulary) -> Optional[RoconURI]:
    """
    The common form, a robot with values that were read before; None for any other.

    It takes a tenth of the time of `_read`, so that a new robot is read in less than it takes
    urllib to split its URI.
    """
    fields, _, app = text.partition('#')
    parts = fields.split('/', 5)
    parts += _LEFT_OUT[len(parts):]
    platforms, frameworks, systems = vocabulary.fields_read.values()
    try:
        scheme, platform, name, framework, system = parts
        values = platforms[platform], frameworks[framework], systems[system]
    except (KeyError, ValueError):
        return None
    if scheme != 'rocon:' or not platform or not is_literal(name):
        return None
    if app and not grammar.is_rocon_app(app):
        return None
    return _new('', values, name, None, app, vocabulary)


def _read(text: str, vocabulary: Vocabulary, strict: bool) -> RoconURI:
    if len(text) > grammar.TEXT_LIMIT:
        raise RoconURIValueError('a rocon URI has at most %d characters, this one has more'
                                 % grammar.TEXT_LIMIT, text, value=text)
    parts, vocabulary, with_one_slash = take_apart(text, vocabulary, strict)
    return _assemble(lambda field, read: parts[field].read(read), vocabulary, with_one_slash)


def _with_more_if_needed(read: Callable[[Vocabulary], RoconURI],
                         vocabulary: Vocabulary) -> RoconURI:
    """What is read with a vocabulary, or with the complete one if it does not know a value."""
    try:
        return read(vocabulary)
    except UnregisteredValue:
        if completed(vocabulary) is vocabulary:
            raise
        return read(completed(vocabulary))


def _assemble(read_part: Callable[[str, Callable[[str], Any]], Any], vocabulary: Vocabulary,
              with_one_slash: bool = False) -> RoconURI:
    """A URI of parts that are read in order, so that the first fault is the one reported."""
    concert_name = read_part('concert_name', read_concert_name)
    platform = read_part('hardware_platform',
                         partial(read_values, 'hardware_platform', vocabulary=vocabulary))
    name = read_part('name', read_name)
    framework, system = (
        read_part(field, partial(read_values, field, vocabulary=vocabulary))
        for field in ('application_framework', 'operating_system'))
    app = read_part('rocon_app', read_rocon_app)
    pattern = None if name.pattern.literal else name.pattern
    return _new(concert_name, (platform, framework, system), name.string, pattern, app,
                vocabulary, with_one_slash)


def _new(concert_name: str, values: Tuple[ValuesField, ValuesField, ValuesField], name: str,
         pattern: Optional[NamePattern], rocon_app: str, vocabulary: Vocabulary,
         with_one_slash: bool = False) -> RoconURI:
    uri = object.__new__(RoconURI)
    uri._concert_name = concert_name
    uri._hardware_platform, uri._application_framework, uri._operating_system = values
    uri._name = name
    uri._pattern = pattern
    uri._rocon_app = rocon_app
    uri._vocabulary = vocabulary
    uri._read_with_one_slash = with_one_slash
    return uri


def _text(field: str, value: FieldText) -> str:
    """The text of a field that is given as text, as alternatives or as a Field."""
    if isinstance(value, (str, Field)):
        return str(value)
    alternatives = list(value)
    for alternative in alternatives:
        if not alternative or '|' in alternative:
            raise RoconURIValueError('%s %s is not one alternative' % (field, quoted(alternative)),
                                     alternative, field, alternative)
    return '|'.join(alternatives)
