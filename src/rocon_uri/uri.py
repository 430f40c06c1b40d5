"""Rocon URIs, what robots are and apps run on: `parse` reads one and returns a `RoconURI`."""
from __future__ import annotations

from rocon_uri.exceptions import UnregisteredValue
from rocon_uri.field import NameField
from rocon_uri.name_pattern import ANY, read as read_pattern
from rocon_uri.parts import needs_all_fields
from rocon_uri.reading import Reading, made, read, read_common, read_fields
from rocon_uri.vocabulary import Vocabulary, completed, current, precedence

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Optional, Tuple, Union
    from rocon_uri.reading import FieldText
    Resource = Union[str, 'RoconURI']

__all__ = ['RoconURI', 'aligned', 'comparable', 'default_uri_string', 'is_compatible', 'parse',
           'parse_once', 'with_any_name']

#: The URI that matches every resource.
default_uri_string = 'rocon://'

# Texts that a vocabulary remembers, and characters of one. A longer text is read anew each time;
# when the memo is full it starts again with nothing.
_MEMO_SIZE = 4096
_MEMO_TEXT_LENGTH = 1024


class _Unset:
    """What an argument is that is left out, as help() and the documentation show it."""

    def __repr__(self) -> str:
        return 'unchanged'


_UNSET: Any = _Unset()


class RoconURI(Reading):
    """
    A set of resources: the product of the sets that its fields match.

    It is immutable and hashable. Two are equal if they have the same alternatives in each field,
    in any order, and the same name or pattern, concert and app. Whether they match the same
    resources is what `rocon_uri.relation` says. The constructor is `parse`.

    >>> uri = RoconURI('rocon:/turtlebot2|pr2/bob#rocon_apps/teleop')
    >>> uri.hardware_platform.list, uri.name.string, uri.rocon_app
    (['turtlebot2', 'pr2'], 'bob', 'rocon_apps/teleop')
    """

    __slots__ = ()

    def __new__(cls, rocon_uri_string: Resource = 'rocon:/',
                vocabulary: Optional[Vocabulary] = None, strict: bool = False) -> 'RoconURI':
        return parse(rocon_uri_string, vocabulary, strict)

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
        :param application_framework: as hardware_platform
        :param operating_system: as hardware_platform
        :param str rocon_app: '' for none
        :param vocabulary: as `parse` takes
        :returns: RoconURI
        :raises RoconURIValueError: for a field that is not legal

        >>> str(RoconURI.from_fields(hardware_platform=['pr2', 'kobuki'], name='bob'))
        'rocon:/pr2|kobuki/bob/*/*'
        """
        return _sealed(read_fields(
            (concert_name, hardware_platform, name, application_framework, operating_system,
             rocon_app), current() if vocabulary is None else vocabulary))

    def replace(self, *, concert_name: str = _UNSET, hardware_platform: FieldText = _UNSET,
                name: FieldText = _UNSET, application_framework: FieldText = _UNSET,
                operating_system: FieldText = _UNSET, rocon_app: str = _UNSET,
                vocabulary: Optional[Vocabulary] = _UNSET) -> 'RoconURI':
        """
        This URI with other values in some fields, which are given as in `from_fields`.

        >>> str(RoconURI('rocon:/pr2/bob').replace(name='alice', operating_system='focal'))
        'rocon:/pr2/alice/*/focal'
        """
        return self.from_fields(
            self.concert_name if concert_name is _UNSET else concert_name,
            self.hardware_platform if hardware_platform is _UNSET else hardware_platform,
            self.name_text if name is _UNSET else name,
            self.application_framework if application_framework is _UNSET
            else application_framework,
            self.operating_system if operating_system is _UNSET else operating_system,
            self.rocon_app if rocon_app is _UNSET else rocon_app,
            self.vocabulary if vocabulary is _UNSET else vocabulary)

    @property
    def rapp(self) -> str:
        """The old name of ``rocon_app``."""
        return self.rocon_app

    @property
    def name(self) -> NameField:
        """The name of the resource or a pattern for names; a `Field`."""
        return NameField(self.name_text, self.name_pattern or read_pattern(self.name_text))

    @property
    def sets(self) -> Tuple[Tuple[str, Any], ...]:
        """The five sets that are compared, as (name, `Field`), the cheapest first, names last."""
        concert = self.concert_name or '*'
        return (('hardware_platform', self.hardware_platform),
                ('application_framework', self.application_framework),
                ('operating_system', self.operating_system),
                ('concert_name', NameField(concert, read_pattern(concert))),
                ('name', self.name))

    def isdisjoint(self, other: Resource) -> bool:
        """
        Is there no resource that both match?

        :param other: RoconURI, or str that is parsed
        :returns: bool
        :raises RoconURIValueError: for a text that is not legal
        :raises PatternTooComplex: if the two names take too much work to decide

        >>> RoconURI('rocon:/pr2').isdisjoint('rocon:/turtlebot2')
        True
        """
        return not is_compatible(*aligned(self, other))

    def issubset(self, other: Resource) -> bool:
        """
        Does the other match every resource that this one matches? Described under `isdisjoint`.

        >>> RoconURI('rocon:/pr2/bob').issubset('rocon:/pr2/b*')
        True
        """
        ours, theirs = aligned(self, other, complete=True)
        return all(b.includes(a) for (_, a), (_, b) in zip(ours.sets, theirs.sets))

    def issuperset(self, other: Resource) -> bool:
        """
        Does this one match every resource that the other matches? Described under `isdisjoint`.

        >>> RoconURI('rocon:/robot').issuperset('rocon:/pr2|kobuki')
        True
        """
        return parse(other).issubset(self)

    @property
    def short(self) -> str:
        """The text without the ``*`` fields at its end: ``'rocon:/pr2/bob'``."""
        if needs_all_fields(self.concert_name, self.hardware_platform, self.vocabulary):
            return str(self)
        text, mark, app = str(self).partition('#')
        while text.endswith('/*'):
            text = text[:-len('/*')]
        return (text if text != 'rocon:' else 'rocon:/') + mark + app

    def to_rfc3986(self) -> str:
        """
        The text, a str, with every character escaped that RFC 3986 does not allow raw.

        It is safe in HTTP and HTML, and parsing it gives an equal URI.

        >>> RoconURI('rocon:/pr2|kobuki/bob_[0-9]+').to_rfc3986()
        'rocon:/pr2%7Ckobuki/bob_%5B0-9%5D+/*/*'
        """
        from urllib.parse import quote      # slow to import, and nothing else needs it
        return quote(str(self), safe='!$()*+,;=:@/#')

    def __str__(self) -> str:
        return 'rocon:%s/%s/%s/%s/%s%s' % (
            self.concert_name and '//' + self.concert_name, self.hardware_platform.string,
            self.name_text, self.application_framework.string, self.operating_system.string,
            self.rocon_app and '#' + self.rocon_app)

    def __repr__(self) -> str:
        return 'RoconURI(%r)' % str(self)

    def _key(self) -> Tuple[object, ...]:
        return (self.name_text, self.hardware_platform, self.application_framework,
                self.operating_system, self.concert_name, self.rocon_app)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, RoconURI):
            return NotImplemented
        return self is other or self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __copy__(self, memo: object = None) -> 'RoconURI':
        return self

    __deepcopy__ = __copy__

    def __reduce__(self) -> Tuple[object, ...]:
        return parse, (str(self),)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError('a rocon URI cannot be changed; replace(%s=...) makes another' % name)

    def __delattr__(self, name: str) -> None:
        raise AttributeError('a rocon URI cannot be changed')


def parse(rocon_uri_string: Resource = 'rocon:/', vocabulary: Optional[Vocabulary] = None,
          strict: bool = False) -> RoconURI:
    """
    Read a rocon URI; specification, sections "Definition" and "Special Operations".

    :param rocon_uri_string: str; a RoconURI is returned as it is, or read again with the given
        vocabulary
    :param vocabulary: `Vocabulary` to read with. The default is the bundled one, and from the
        first value on that it does not have, also what the packages on this machine and
        ROCON_URI_RULES add.
    :param bool strict: take the text literally: what follows ``//`` is a concert even where
        it is a registered platform, and the fields start with a slash
    :returns: RoconURI
    :raises RoconURIValueError: for a text that is not legal; says which field, where and why
    :raises TypeError: for what is neither a str nor a RoconURI

    >>> parse('rocon:/pr2/bob').hardware_platform.string
    'pr2'
    """
    text, known = rocon_uri_string, current() if vocabulary is None else vocabulary
    if not isinstance(text, str):
        if not isinstance(text, RoconURI):
            raise TypeError('a rocon URI is a str, not %s' % type(text).__name__)
        if vocabulary is None or text.vocabulary is vocabulary:
            return text
        text = str(text)
    if strict:
        return _sealed(read(text, known, strict))
    uri: Optional[RoconURI] = known.uris_read.get(text)
    if uri is None:
        uri = _sealed(read_common(text, known) or read(text, known, strict))
        if len(text) <= _MEMO_TEXT_LENGTH:
            memo = uri.vocabulary.uris_read
            if len(memo) >= _MEMO_SIZE:
                memo.clear()
            memo[text] = uri
    return uri


def parse_once(text: str, vocabulary: Vocabulary) -> RoconURI:
    """As `parse`, but the URI is not remembered, which takes a third of the time of a new text."""
    return _sealed(read_common(text, vocabulary) or read(text, vocabulary, strict=False))


def is_compatible(rocon_uri_a: Resource, rocon_uri_b: Resource) -> bool:
    """
    Do two URIs match a common resource; can this app run on this robot?

    Where the four fields of one are all ``*``, the other may have values that are not registered.

    :param rocon_uri_a: RoconURI, or str that is parsed
    :param rocon_uri_b: RoconURI, or str that is parsed
    :returns: bool; the same for (b, a)
    :raises RoconURIValueError: for a text that is not legal
    :raises PatternTooComplex: if the two names take too much work to decide

    >>> is_compatible('rocon:/kobuki|turtlebot2', 'rocon:/kobuki/bob/noetic/bookworm')
    True
    """
    a, b = rocon_uri_a, rocon_uri_b
    if type(a) is not RoconURI or type(b) is not RoconURI or a.vocabulary is not b.vocabulary:
        a, b = _remembered(a, b) or comparable(a, b)
    if not (a.hardware_platform.mask & b.hardware_platform.mask
            and a.application_framework.mask & b.application_framework.mask
            and a.operating_system.mask & b.operating_system.mask):
        # values that only an open vocabulary accepts have no bits
        return a.vocabulary.is_open and all(
            x.intersects(y) for (_, x), (_, y) in zip(a.sets, b.sets))
    if a.concert_name and b.concert_name and a.concert_name != b.concert_name:
        return False
    if a.name_text == b.name_text:
        return True
    ours, theirs = a.name_pattern, b.name_pattern
    if ours is None:
        return theirs is not None and (theirs is ANY or theirs.matches(a.name_text))
    if ours is ANY or theirs is ANY:        # most requests leave the name open
        return True
    return ours.matches(b.name_text) if theirs is None else ours.intersects(theirs)


def _remembered(a: Resource, b: Resource) -> Optional[Tuple[RoconURI, RoconURI]]:
    """Two texts that were both read before; None for others. It takes a third of `comparable`."""
    if type(a) is str and type(b) is str:
        remembered = current().uris_read
        first, second = remembered.get(a), remembered.get(b)
        if first is not None and second is not None:
            return first, second
    return None


def comparable(a: Resource, b: Resource) -> Tuple[RoconURI, RoconURI]:
    """
    Two URIs as `is_compatible` compares them, whose parameters and errors these are.

    The vocabulary is an open one if one URI needs it and the four fields of the other are ``*``.
    """
    try:
        return aligned(a, b)
    except UnregisteredValue:
        any_value = Vocabulary.open()
        pair = parse(a, any_value), parse(b, any_value)
        if not any(all(field.is_any for name, field in uri.sets if name != 'concert_name')
                   for uri in pair):
            raise
        return pair


def aligned(a: Resource, b: Resource, complete: bool = False) -> Tuple[RoconURI, RoconURI]:
    """
    Two URIs as one vocabulary reads them, so that their fields can be compared.

    :param bool complete: read both with all that packages add to the groups
    :raises RoconURIValueError: for a text that is not legal, or that has a value which the
        vocabulary of the other, with which both are read, does not have
    """
    first, second = parse(a), parse(b)
    if first.vocabulary is second.vocabulary and not complete:
        return first, second
    vocabularies = [completed(uri.vocabulary) if complete else uri.vocabulary
                    for uri in (first, second)]
    chosen = max(vocabularies, key=precedence)
    if any(vocabulary.is_open for vocabulary in vocabularies):
        chosen = chosen.opened()
    return parse(first, chosen), parse(second, chosen)


def with_any_name(uri: RoconURI) -> RoconURI:
    """
    The same URI with any name, and without an app; in a tenth of the time that `replace` takes.

    >>> str(with_any_name(parse('rocon://north/pr2/bob#apps/teleop')))
    'rocon://north/pr2/*/*/*'
    """
    return _sealed(made(uri.concert_name, uri.hardware_platform, '*', ANY,
                        uri.application_framework, uri.operating_system, '', uri.vocabulary))


def _sealed(reading: Reading) -> RoconURI:
    reading.__class__ = RoconURI
    return reading  # type: ignore[return-value]
