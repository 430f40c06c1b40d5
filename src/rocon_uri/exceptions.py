"""
Errors: a text that is not a rocon URI, and two patterns that are too complex to compare.

The text of an error is one line fit for a log, whatever the input was. Its parts are attributes.
"""
from __future__ import annotations

from rocon_uri.sources.wording import carets, did_you_mean, near_values, quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Callable, Iterable, List, Optional, Tuple

__all__ = ['PatternTooComplex', 'RoconURIValueError', 'UnregisteredValue']


class RoconURIValueError(ValueError):
    """
    A text that is not a rocon URI, or a part of one that is not legal.

    :param str problem: what is wrong, one clause that names the offending text
    :param str uri: the whole text
    :param str field: ``'concert_name'``, ``'hardware_platform'``, ``'name'``,
        ``'application_framework'``, ``'operating_system'``, ``'rocon_app'``, or ``'uri'`` where
        the fault is in no single one of them
    :param str value: the offending part
    :param span: (int, int), where in ``uri`` the fault starts and ends, counted in characters
        from 0; all of it where left out
    :param candidates: what could have stood there: an iterable of str, or a callable that
        returns one and is called only when the suggestions are looked at
    :param str advice: what to do about it, one clause

    All but the candidates are attributes of the same name.

    >>> error = RoconURIValueError("name '3bob' is not legal", 'rocon:/pr2/3bob', 'name', '3bob',
    ...                            (11, 15))
    >>> print(error)
    name '3bob' is not legal, at character 12 of 'rocon:/pr2/3bob'
    """

    def __init__(self, problem: str, uri: str = '', field: str = 'uri', value: str = '',
                 span: Optional[Tuple[int, int]] = None,
                 candidates: 'Iterable[str] | Callable[[], Iterable[str]]' = (),
                 advice: str = '') -> None:
        super().__init__(problem)
        self.problem = problem
        self.uri = uri
        self.field = field
        self.value = value
        self.span = (0, len(uri)) if span is None else span
        self.advice = advice
        self._candidates = candidates

    @property
    def suggestions(self) -> List[str]:
        """
        What was probably meant: a list of at most three str, the likeliest first.

        Near misses by letters come before those by the parts of a name.
        """
        candidates = self._candidates() if callable(self._candidates) else self._candidates
        return near_values(self.value, candidates)

    def within(self, uri: str, span: Tuple[int, int]) -> 'RoconURIValueError':
        """An error of the same class, placed at a span of a larger text."""
        return type(self)(self.problem, uri, self.field, self.value, span, self._candidates,
                          self.advice)

    def __str__(self) -> str:
        text = self._headline()
        if self.uri:
            text += ', at character %d of %s' % (self.span[0] + 1, quoted(self.uri))
        return text + ('; ' + self.advice if self.advice else '')

    def pretty(self) -> str:
        """
        The error for a person, on several lines: the text, then the URI, the fault underlined.

        >>> error = RoconURIValueError("hardware_platform 'turtelbot2' is not registered",
        ...     'rocon:/turtelbot2', 'hardware_platform', 'turtelbot2', (7, 17), ['turtlebot2'])
        >>> print(error.pretty())
        hardware_platform 'turtelbot2' is not registered (did you mean 'turtlebot2'?)
            rocon:/turtelbot2
                   ^^^^^^^^^^
        """
        lines = [self._headline()]
        if self.uri:
            lines += ['    ' + line for line in self._marked_uri()]
        if self.advice:
            lines.append(self.advice)
        return '\n'.join(lines)

    def _headline(self) -> str:
        return self.problem + did_you_mean(self.suggestions)

    def _marked_uri(self) -> Tuple[str, str]:
        """The part of the URI around the fault, and a line of carets for below it."""
        start, end = self.span
        left, right = max(0, start - 40), min(len(self.uri), end + 30, start + 80)
        before = '...' if left else ''
        shown = ''.join(c if c.isprintable() else '?' for c in self.uri[left:right])
        after = '...' if right < len(self.uri) else ''
        at = start - left
        return before + shown + after, carets(before + shown[:at], shown[at:min(end, right) - left])

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self.problem, self.uri, self.field, self.value, self.span,
                            tuple(self.suggestions), self.advice)


class UnregisteredValue(RoconURIValueError):
    """A value that the vocabulary does not have; a more complete one may."""


class PatternTooComplex(RoconURIValueError):
    """
    Two name patterns that take more work to compare than is allowed.

    Each of them can still be matched with names. If one request was compared with many resources,
    ``undecided`` lists those with which it could not be compared; else it is empty.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.undecided: List[Any] = []
