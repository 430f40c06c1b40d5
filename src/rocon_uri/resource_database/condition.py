"""A request as an expression of SQLAlchemy, for a table of the user's own."""
from __future__ import annotations

from typing import TYPE_CHECKING, List, Optional, Union

from sqlalchemy import Boolean, and_, bindparam, or_, true
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.functions import FunctionElement

from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.name_pattern import Glob
from rocon_uri.resource_database.functions import check_dialect
from rocon_uri.resource_database.names import in_postgresql, is_too_large, like
from rocon_uri.sources.wording import quoted
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import completed

if TYPE_CHECKING:
    from sqlalchemy.sql.compiler import SQLCompiler
    from sqlalchemy.sql.elements import ColumnElement

    from rocon_uri.field import ValuesField

__all__ = ['condition']


def condition(request: Union[str, RoconURI], *,
              concert_name: Optional[ColumnElement] = None,
              hardware_platform: Optional[ColumnElement] = None,
              name: Optional[ColumnElement] = None,
              application_framework: Optional[ColumnElement] = None,
              operating_system: Optional[ColumnElement] = None) -> ColumnElement:
    """
    The rows of a table that a request is compatible with; `rocon_uri.is_compatible` in SQL.

    A column holds one value, a group, or ``*``, '' or NULL for any. In the column of concerts
    these three mean no concert, and in that of names, which are literal names, any name. A column
    that is left out is not restricted. For a table whose resources have alternatives or patterns
    there is `ResourceDatabase`.

    On SQLite a regular expression needs the function that `register` adds.

    :param request: RoconURI, or str that is parsed
    :param concert_name: the column, or another expression, to compare the field of this name with;
        so are the others
    :returns: `sqlalchemy.sql.ColumnElement`, with everything that is asked for as bound parameters;
        compiling it for neither SQLite nor PostgreSQL is a NotImplementedError
    :raises RoconURIValueError: for a text that is not legal
    :raises PatternTooComplex: for a regular expression with more than 256 atoms once counted
        repetition is written out

    >>> from sqlalchemy import column
    >>> from sqlalchemy.dialects import sqlite
    >>> wanted = condition('rocon:/*/bob', name=column('nick')).compile(dialect=sqlite.dialect())
    >>> 'nick' in str(wanted), 'bob' in str(wanted), 'bob' in str(wanted.params)
    (True, False, True)
    """
    request = parse(request)
    request = parse(request, completed(request.vocabulary))     # with all members of groups
    parts: List[ColumnElement] = []
    if concert_name is not None and request.concert_name:
        parts.append(_any_of(concert_name, [request.concert_name]))
    for column, field in ((hardware_platform, request.hardware_platform),
                          (application_framework, request.application_framework),
                          (operating_system, request.operating_system)):
        if column is not None and not field.is_any:
            parts.append(_any_of(column, _overlapping(field)))
    if name is not None and not request.name.is_any:
        parts.append(_name_condition(name, request))
    return _Condition(and_(*parts) if parts else true())


def _any_of(column: ColumnElement, values: List[str]) -> ColumnElement:
    return or_(column.is_(None), column.in_(['', '*', *values]))


def _overlapping(field: ValuesField) -> List[str]:
    """The values asked for, their members, and the groups that contain any of them."""
    known = field.vocabulary.field(field.field_name)
    return [value for value in known if known.mask(value) & field.mask] + sorted(field.others)


def _name_condition(column: ColumnElement, request: RoconURI) -> ColumnElement:
    pattern = request.name.pattern
    if pattern.literal is not None:
        return _any_of(column, [pattern.literal])
    if isinstance(pattern, Glob):
        return or_(_any_of(column, []), _MatchesGlob(
            column, bindparam(None, like(pattern.text)), bindparam(None, pattern.text)))
    if is_too_large(pattern):
        raise PatternTooComplex(
            'name pattern %s is too large for a database' % quoted(pattern.text), str(request),
            'name', pattern.text, advice='use ResourceDatabase, which compares it itself')
    return or_(_any_of(column, []), _MatchesExpression(
        column, bindparam(None, in_postgresql(pattern)), bindparam(None, pattern.text)))


class _Condition(FunctionElement):  # type: ignore[misc]
    """All of it, which compiles for the two dialects only."""

    name = 'rocon_uri_condition'
    type = Boolean()  # noqa: A003
    inherit_cache = True


class _MatchesGlob(FunctionElement):  # type: ignore[misc]
    """A column, the pattern for LIKE, and that for GLOB."""

    name = 'rocon_uri_glob'
    type = Boolean()  # noqa: A003
    inherit_cache = True


class _MatchesExpression(FunctionElement):  # type: ignore[misc]
    """A column, the expression as PostgreSQL writes it, and as the request does."""

    name = 'rocon_uri_expression'
    type = Boolean()  # noqa: A003
    inherit_cache = True


def _compile_condition(element: _Condition, compiler: SQLCompiler, **options: object) -> str:
    check_dialect(compiler.dialect.name)
    return '(%s)' % compiler.process(element.clauses.clauses[0], **options)


def _compile_match(element: FunctionElement, compiler: SQLCompiler, **options: object) -> str:
    column, for_postgresql, for_sqlite = element.clauses.clauses
    is_glob = isinstance(element, _MatchesGlob)
    if compiler.dialect.name == 'postgresql':
        text = "(%s LIKE %s ESCAPE '!')" if is_glob else '(%s ~ %s)'
        operands = [column, for_postgresql]
    else:
        text = '(%s GLOB %s)' if is_glob else 'rocon_uri_matches(%s, %s)'
        operands = [column, for_sqlite] if is_glob else [for_sqlite, column]
    return text % tuple(compiler.process(operand, **options) for operand in operands)


compiles(_Condition)(_compile_condition)
compiles(_MatchesGlob)(_compile_match)
compiles(_MatchesExpression)(_compile_match)
