"""The URIs that a verb is given, as arguments and in files, and a report of the bad ones."""
from __future__ import annotations

import sys

from rocon_uri.cli.progress import beside_progress
from rocon_uri.exceptions import RoconURIValueError, UnregisteredValue
from rocon_uri.grammar import VOCABULARY_FIELDS
from rocon_uri.sources.encoding import NOT_UTF8, not_utf8_at
from rocon_uri.sources.wording import quoted, quoted_path
from rocon_uri.uri import parse, parse_once
from rocon_uri.vocabulary import Vocabulary, current

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterable, Iterator, List, Optional, Sequence, Set, Tuple
    from rocon_uri.uri import RoconURI
    Line = Tuple[RoconURI, str, Optional[int]]      # the URI, its text, the line from 1

__all__ = ['GivenURI', 'Report', 'not_utf8', 'say', 'shown_name']

_LINES_NAMED = 5    # of those that have the same fault


def say(text: str) -> None:
    """Tell the user something on stderr, below what was printed so far."""
    with beside_progress():
        sys.stdout.flush()
        print(text, file=sys.stderr)


class GivenURI:
    """A URI and the text that it was read from; file and line (from 1) are None for an argument."""

    __slots__ = ('uri', 'text', 'file', 'line')

    def __init__(self, uri: RoconURI, text: str, file: Optional[str] = None,
                 line: Optional[int] = None) -> None:
        self.uri = uri
        self.text = text
        self.file = file
        self.line = line

    @property
    def label(self) -> str:
        """What to call it among others: the app that asks, or else the text."""
        return self.uri.rocon_app or self.text

    def as_json(self) -> Dict[str, object]:
        """URI, as ``rocon_uri help json`` describes it."""
        uri = self.uri
        return {
            'text': self.text, 'file': self.file, 'line': self.line,
            'uri': str(uri), 'short': uri.short,
            'fields': {
                'concert_name': uri.concert_name,
                'hardware_platform': uri.hardware_platform.list,
                'name': uri.name.string,
                'application_framework': uri.application_framework.list,
                'operating_system': uri.operating_system.list,
                'rocon_app': uri.rocon_app,
            },
            'read_with_one_slash': uri.read_with_one_slash,
        }


class Report:
    """
    What was bad: said on stderr when it is met, and kept where JSON is asked for.

    ``errors`` is a list of ERROR, as ``rocon_uri help json`` describes it. ``status`` is the exit
    status, 0 until something was bad, then 2.
    """

    def __init__(self, json: bool) -> None:
        self.status = 0
        self.errors: List[Dict[str, object]] = []
        self._json = json

    def read(self, text: str, file: Optional[str] = None,
             line: Optional[int] = None) -> Optional[GivenURI]:
        """Read a URI; None for a text that is not legal, which is reported."""
        try:
            return GivenURI(parse(text), text, file, line)
        except RoconURIValueError as error:
            self.bad_uri(error, file, line)
            return None

    def read_file(self, path: str, registered: Optional[Vocabulary] = None) -> Iterator[GivenURI]:
        """Read a file of URIs, as `read_lines` does."""
        for batch in self.read_lines(path, registered):
            for uri, text, line in batch:
                yield GivenURI(uri, text, shown_name(path), line)

    def read_lines(self, path: str, registered: Optional[Vocabulary] = None
                   ) -> Iterator[Iterator[Line]]:
        """
        Read a file of URIs, one a line; ``-`` is standard input.

        Blank lines and comments, which start with ``#``, are skipped. Those that are not legal
        are reported: a fault that many lines have in full where it is met first, and the others
        at the end. Each iterator that is yielded is to be used up before the next; it has what
        can be had without waiting.

        :param Vocabulary registered: the values that are registered; URIs with others are reported,
            and yielded all the same. Without it, they are left out.
        """
        from rocon_uri.cli.lines import read_lines      # here, since few calls name a file
        faults = _FaultsOfFile(self, shown_name(path), registered)
        first = 1
        try:
            for lines in read_lines(path):
                yield faults.legal(lines, first)
                first += len(lines)
        except (OSError, UnicodeError) as error:
            message = 'cannot read %s: %s' % (
                quoted_path(shown_name(path)), getattr(error, 'strerror', None) or error)
            say('rocon_uri: ' + message)
            self.note(message, shown_name(path))
        faults.say_others()

    def bad_uri(self, error: RoconURIValueError, file: Optional[str] = None,
                line: Optional[int] = None) -> None:
        """Report a fault in a URI."""
        fault = not_utf8(error.uri)
        message = '%s is %s' % (quoted(error.uri), fault) if fault else str(error)
        if file is not None:
            say('%s:%s: %s' % (file, line, message))
        else:
            say('rocon_uri: ' + (message if fault else error.pretty()))
        self.note(message, file, line, error.suggestions, error.uri, error.field, error.value,
                  error.span)

    def note(self, message: str, file: Optional[str], line: Optional[int] = None,
             suggestions: Sequence[str] = (), uri: Optional[str] = None,
             field: Optional[str] = None, value: Optional[str] = None,
             span: Optional[Tuple[int, int]] = None) -> None:
        """Keep an ERROR with these members, without saying it."""
        self.status = 2
        if self._json:
            self.errors.append({
                'message': message, 'uri': uri, 'field': field, 'value': value, 'span': span,
                'suggestions': list(suggestions), 'file': file, 'line': line})


def shown_name(path: str) -> str:
    """What a file is called in messages."""
    return '<stdin>' if path == '-' else path


def not_utf8(text: str) -> str:
    """What is wrong with a text that has bytes which are not UTF-8, as surrogates; '' if none."""
    try:
        text.encode('utf-8')
        return ''
    except UnicodeEncodeError as error:
        octets = text.encode('utf-8', 'surrogatepass' if error.object[error.start] < '\udc80'
                             else 'surrogateescape')
        offset = len(text[:error.start].encode('utf-8'))
        return not_utf8_at(octets, offset)


class _FaultsOfFile:
    """
    The faults in the lines of a file: one of each kind is reported in full, the others counted.

    A kind is what `RoconURIValueError.problem` says: of a value, which, and of all else, not.
    """

    def __init__(self, report: Report, file: str, registered: Optional[Vocabulary]) -> None:
        self._report = report
        self._file = file
        self._registered = registered
        self._open = current()                      # the open one once a value is not registered
        self._counts: Dict[str, int] = {}           # of lines, by kind
        self._others: Dict[str, List[int]] = {}     # a few lines of a kind, the first one left out
        self._kinds: Dict[Tuple[str, str], str] = {}    # by field and value that is not registered
        self._unregistered: Set[str] = set()    # texts of fields with a value that is not

    def legal(self, lines: Iterable[str], first: int) -> Iterator[Line]:
        """The URIs in lines, numbered from ``first``; what is not a URI is reported."""
        unregistered = self._unregistered
        registered = self._registered
        for number, line in enumerate(lines, first):
            try:
                uri = self._counted(line, number) if unregistered else None
                if uri is not None:
                    if registered:
                        yield uri, line, number
                    continue
                uri = parse_once(line, registered or current())     # most have no white space
            except RoconURIValueError:
                if line.lstrip()[:1] in ('', '#'):
                    continue
                line = line.strip()
                try:
                    uri = parse_once(line, registered or current())
                except RoconURIValueError as error:
                    self._add(error, number)
                    if not registered:
                        continue
                    try:
                        uri = parse_once(line, self._open)
                    except RoconURIValueError:
                        continue
            yield uri, line, number

    def _add(self, error: RoconURIValueError, number: int) -> None:
        """Report the fault of a line, or count it."""
        if self._is_first(_kind(error), number):
            self._report.bad_uri(error, self._file, number)
        if isinstance(error, UnregisteredValue):
            self._kinds[error.field, error.value] = error.problem
            self._open = self._registered.opened() if self._registered else Vocabulary.open()
            self._unregistered.update(field for field in _fields(error.uri)
                                      if error.value in field.split('|'))

    def _counted(self, text: str, number: int) -> Optional[RoconURI]:
        """
        Count a line whose fault is a value that was not registered before, and return its URI.

        It takes as long as reading a line without a fault, a tenth of what raising an error takes.
        """
        # the fields as _fields has them, without a call where that is not needed
        if self._unregistered.isdisjoint(_fields(text) if '#' in text else text.split('/')):
            return None
        try:
            uri = parse_once(text, self._open)
        except RoconURIValueError:
            return None
        for field in uri.hardware_platform, uri.application_framework, uri.operating_system:
            if field.others:
                value = field.string
                if value not in field.others:
                    value = next(value for value in field if value in field.others)
                kind = self._kinds.get((field.field_name, value))
                if kind is None:
                    return None
                self._count_another(kind, number)
                return uri
        return None

    def _is_first(self, kind: str, number: int) -> bool:
        if kind not in self._counts:
            self._counts[kind] = 1
            return True
        self._count_another(kind, number)
        return False

    def _count_another(self, kind: str, number: int) -> None:
        self._counts[kind] += 1
        if self._counts[kind] <= _LINES_NAMED + 1:
            self._others.setdefault(kind, []).append(number)

    def say_others(self) -> None:
        """Say which other lines have the faults that were reported."""
        for kind, lines in self._others.items():
            more = self._counts[kind] - 1 - len(lines)
            message = '%s: %s, also on line%s %s%s' % (
                self._file, kind, 's' if len(lines) > 1 else '', ', '.join(map(str, lines)),
                ' and %d more' % more if more else '')
            say(message)
            self._report.note(message, self._file)


def _kind(error: RoconURIValueError) -> str:
    if not_utf8(error.uri):
        return NOT_UTF8
    if error.field in VOCABULARY_FIELDS:
        return error.problem
    # names and apps can differ in every line
    return (' ' + error.problem).replace(' ' + quoted(error.value), '', 1).strip()


def _fields(text: str) -> List[str]:
    return text.partition('#')[0].split('/')
