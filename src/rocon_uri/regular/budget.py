"""How much work the comparison of name patterns may take."""
from __future__ import annotations

from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.sources.wording import quoted

__all__ = ['REQUEST_WORK_LIMIT', 'WORK_LIMIT', 'Budget', 'too_complex']

#: The work that one comparison may take; more raises `PatternTooComplex`. The product of two short
#: patterns can have more states than memory holds. Work is counted instead of states, since one
#: state can hold thousands of positions. A unit takes 0.1 to 0.2 us and at most 20 bytes, so the
#: limit is about 0.1 s and 12 MB.
WORK_LIMIT = 600000

#: The work that all comparisons of one request with an index may take, about 1 s: hundreds of
#: patterns that take 10 ms each would otherwise keep everybody waiting.
REQUEST_WORK_LIMIT = 10 * WORK_LIMIT


class Budget:
    """
    The work that a comparison may take, and has taken.

    :param int limit: in the units of `WORK_LIMIT`; 0 allows only what needs no automata
    """

    __slots__ = ('limit', 'spent')

    def __init__(self, limit: int = WORK_LIMIT) -> None:
        self.limit = limit
        self.spent = 0


def too_complex(one: str, other: str) -> PatternTooComplex:
    """The error for two patterns, given as text, whose comparison takes too much work."""
    return PatternTooComplex(
        'name patterns %s and %s are too complex to compare' % (quoted(one), quoted(other)),
        field='name', value=one, advice='use simpler ones, without large counts')
