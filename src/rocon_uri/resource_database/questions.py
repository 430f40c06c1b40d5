"""From a request to the statement that answers it."""
from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Callable, Collection, Dict, List, NamedTuple, Optional, Tuple

from rocon_uri.name_index import LITTLE_WORK, NameRequest
from rocon_uri.resource_database.dialects import Condition
from rocon_uri.resource_database.names import is_too_large
from rocon_uri.uri import RoconURI

if TYPE_CHECKING:
    from rocon_uri.name_pattern import NamePattern
    from rocon_uri.resource_database.dialects import Dialect
    from rocon_uri.resource_database.known import Known
    Pairs = List[Tuple[int, str]]

__all__ = ['Question', 'question']


_FEW_KINDS = 300     # each of which is looked up, in 3 us


class Question(NamedTuple):
    """The resources that match a request, in parts that have none in common."""

    #: what follows the columns of a SELECT, for each part; none where nothing can match
    parts: List[str]
    #: the values of the parameters in all parts, by name
    parameters: Dict[str, object]
    #: tells whether a literal name that was found matches; None where the database knows
    check: Optional[Callable[[str], bool]] = None
    #: asks for those whose pattern takes too much work to compare; None where there are none
    undecided: Optional[Question] = None

    def select(self, ordered: bool = False) -> str:
        """A statement for their texts."""
        if ordered:
            return self._union('resource.uri, resource.id') + ' ORDER BY 2'
        return self._union('resource.uri')

    def select_any(self) -> str:
        """A statement that gives a row if there are any."""
        return self._union('1') + ' LIMIT 1'

    def select_count(self) -> str:
        """A statement for their number."""
        return 'SELECT ' + ' + '.join('(SELECT count(*) %s)' % part for part in self.parts)

    def _union(self, columns: str) -> str:
        return ' UNION ALL '.join('SELECT %s %s' % (columns, part) for part in self.parts)


def question(request: RoconURI, known: Known, dialect: Dialect) -> Question:
    """
    What to ask a database.

    :param RoconURI request: the request
    :param Known known: what is known of the database
    :param Dialect dialect: of the database
    :returns: Question
    """
    fitting = known.kinds_that_fit(request)
    if fitting == []:
        return Question(parts=[], parameters={})
    kinds = Condition('', {}) if fitting is None else dialect.kinds(fitting)
    live = '(resource.expires IS NULL OR resource.expires > %s)' % dialect.now
    name = NameRequest(request.name.pattern, _verdicts(request.name_text))
    if name.pattern.is_any:
        return Question(parts=[_where(kinds.text, live)], parameters=kinds.parameters)
    names = dialect.names(name.pattern, kinds.text,
                          fitting is not None and len(fitting) <= _FEW_KINDS)
    meeting, unknown = _pairs(known, known.kinds if fitting is None else set(fitting), name)
    parts = [_where('resource.is_pattern = 0', names.text, live)]
    parameters = {**kinds.parameters, **names.parameters}
    patterned = 'FROM %s WHERE resource.is_pattern = 1 AND ' + live
    if meeting:
        pairs = dialect.pairs(meeting)
        parts.append(patterned % pairs.text)
        parameters.update(pairs.parameters)
    undecided = dialect.pairs(unknown) if unknown else None
    return Question(
        parts=parts, parameters=parameters,
        check=name.pattern.matches if is_too_large(name.pattern) else None,
        undecided=undecided and Question(parts=[patterned % undecided.text],
                                         parameters=undecided.parameters))


def _where(*conditions: str) -> str:
    return 'FROM rocon_uri_resource AS resource WHERE ' + ' AND '.join(filter(None, conditions))


def _pairs(known: Known, allowed: Collection[int], name: NameRequest) -> Tuple[Pairs, Pairs]:
    """
    The kinds and patterns of resources that match, and of those for which it is unknown.

    As in ResourceIndex, patterns that take more than a little work to compare come last.
    """
    meeting: Pairs = []
    hard: List[Tuple[NamePattern, Pairs]] = []
    for pattern, kinds in known.patterns.items():
        pairs = [(kind, pattern.text) for kind in kinds if kind in allowed]
        verdict = name.intersects(pattern, LITTLE_WORK) if pairs else False
        if verdict:
            meeting += pairs
        elif verdict is None:
            hard.append((pattern, pairs))
    unknown: Pairs = []
    for pattern, pairs in hard:
        verdict = name.intersects(pattern)
        if verdict is not False:
            (unknown if verdict is None else meeting).extend(pairs)
    return meeting, unknown


@lru_cache(64)
def _verdicts(name: str) -> Dict[NamePattern, bool]:
    """The verdicts on patterns from earlier requests with this name."""
    return {}
