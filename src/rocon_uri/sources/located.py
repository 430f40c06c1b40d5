"""What says FILE:LINE:COLUMN: PROBLEM: errors, warnings and findings."""
from __future__ import annotations

from typing import Optional, Tuple, TypeVar, Union

from rocon_uri.sources.wording import printable

__all__ = ['NOWHERE', 'Fault', 'Located', 'LocatedError', 'Place', 'located', 'with_id']

#: A line and a column, counted from 1; ``None`` for both where they are not known.
Place = Tuple[Optional[int], Optional[int]]

#: the place of a fault that concerns a whole file
NOWHERE: Place = (None, None)


def located(problem: str, file_name: str, line: Optional[int], column: Optional[int]) -> str:
    """
    A problem with its place in front, in the form that editors know: a str of one line.

    :param str problem: what is wrong
    :param str file_name: where the text is from
    :param int line: counted from 1, or ``None`` where it is not known
    :param int column: counted from 1, or ``None``

    >>> located("topic 'scan' has no type", 'laser.yaml', 12, 5)
    "laser.yaml:12:5: topic 'scan' has no type"
    """
    place = file_name if line is None else '%s:%s:%s' % (file_name, line, column)
    return printable('%s: %s' % (place, problem))


class Located:
    """What errors, warnings and findings have in common; ``str`` is FILE:LINE:COLUMN: PROBLEM."""

    #: the kind of fault, in kebab case: a stable name that ``specs check --explain`` explains
    id: str
    #: what is wrong, without the place
    problem: str
    #: where the text is from
    file_name: str
    #: where in it, counted from 1; None where that is not known
    line: Optional[int]
    #: counted from 1, or None
    column: Optional[int]

    @property
    def sentence(self) -> str:
        """The problem and what else there is to say, without the place."""
        return self.problem

    @property
    def place(self) -> Place:
        """The line and the column."""
        return self.line, self.column

    def __str__(self) -> str:
        return located(self.sentence, self.file_name, self.line, self.column)


class LocatedError(Located, Exception):
    """
    An error that knows its place. It can be pickled.

    The parameters are those of `located`, and the attributes have their names. ``more`` are further
    arguments of a subclass, which its ``__init__`` takes by position. ``id`` can be set.

    >>> print(LocatedError("topic 'scan' has no type", 'laser.yaml', 12, 5))
    laser.yaml:12:5: topic 'scan' has no type
    """

    id = 'wrong-value'

    def __init__(self, problem: str, file_name: str, line: Optional[int] = None,
                 column: Optional[int] = None, *more: object) -> None:
        super().__init__(problem, file_name, line, column, *more)
        self.problem = problem
        self.file_name = file_name
        self.line = line
        self.column = column


ErrorT = TypeVar('ErrorT', bound=LocatedError)


def with_id(error: ErrorT, fault_id: str) -> ErrorT:
    """
    An error, once its ``id`` is set.

    >>> with_id(LocatedError("duplicate rapp 'ours/dance'", 'dance.rapp'), 'duplicate-name').id
    'duplicate-name'
    """
    error.id = fault_id
    return error


#: what can be wrong with a file: it cannot be read, or something in it is wrong
Fault = Union[OSError, LocatedError]
