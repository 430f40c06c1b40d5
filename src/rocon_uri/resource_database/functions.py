"""The function that SQLite lacks: does a regular expression match a name?"""
from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Callable, Optional

from sqlalchemy import event

from rocon_uri import name_pattern

if TYPE_CHECKING:
    import sqlite3

    from sqlalchemy.engine import Engine

__all__ = ['add_functions', 'check_dialect', 'register']

#: regular expressions that are kept ready: compiling one anew for each name takes 20 times as long
_READY = 16


def register(engine: Engine) -> None:
    """
    Give SQLite the function that `condition` needs for regular expressions.

    Every connection of the engine that is opened from then on has it. For PostgreSQL, which needs
    none, nothing is done.

    :param engine: `sqlalchemy.engine.Engine`
    :raises NotImplementedError: for another dialect, which the error names

    >>> from rocon_uri.resource_database import open_engine
    >>> register(open_engine('sqlite:///fleet.db'))
    """
    check_dialect(engine.dialect.name)
    if engine.dialect.name == 'sqlite' and not event.contains(engine, 'connect', add_functions):
        event.listen(engine, 'connect', add_functions)


def check_dialect(name: str) -> None:
    """
    Refuse what is neither SQLite nor PostgreSQL.

    :param str name: the name of SQLAlchemy's dialect
    :raises NotImplementedError: for another dialect, which the error names
    """
    if name not in ('sqlite', 'postgresql'):
        raise NotImplementedError("dialect '%s' is not supported: use SQLite or PostgreSQL" % name)


def add_functions(connection: sqlite3.Connection, _record: object = None) -> None:
    """
    Add the function to one connection.

    :param connection: `sqlite3.Connection`
    """
    connection.create_function('rocon_uri_matches', 2, _matches, deterministic=True)


def _matches(pattern: str, name: Optional[str]) -> Optional[bool]:
    return None if name is None else _matcher(pattern)(name)


@lru_cache(_READY)
def _matcher(pattern: str) -> Callable[[str], bool]:
    return name_pattern.read(pattern).matches
