"""
Engines of SQLAlchemy: opened by a URL, named without a password, asked in transactions.

The statements of this package are run by the driver's own cursor: the Row objects of SQLAlchemy
alone would make a long answer take 1.28 times as long.
"""
from __future__ import annotations

from contextlib import closing, contextmanager
from typing import TYPE_CHECKING, Iterator

import sqlalchemy
from sqlalchemy.exc import ArgumentError, NoSuchModuleError, SQLAlchemyError
from sqlalchemy.engine.url import make_url

if TYPE_CHECKING:
    from sqlalchemy.engine import Connection, Engine
    from sqlalchemy.engine.interfaces import DBAPICursor

__all__ = ['DatabaseError', 'open_engine', 'raw_connection', 'shown', 'transaction']

#: what PostgreSQL's URLs may start with; SQLAlchemy 2.1 would take psycopg 3 for the second
_POSTGRESQL = ('postgres://', 'postgresql://')


class DatabaseError(OSError):
    """A database cannot be opened or does not answer; nothing of what failed was stored."""


def open_engine(url: str) -> Engine:
    """
    An engine for a URL, whose PostgreSQL is asked through psycopg2.

    :param str url: ``sqlite:///FILE`` or ``postgresql://USER@HOST/DATABASE``
    :returns: `sqlalchemy.engine.Engine`, which has not connected yet
    :raises ValueError: for a text that is no such URL; it does not repeat the text, which may
        have a password
    :raises NotImplementedError: for any other kind of database
    :raises DatabaseError: where the driver is not installed

    >>> open_engine('postgresql://robots@db/fleet').driver
    'psycopg2'
    """
    for start in _POSTGRESQL:
        if url.startswith(start):
            url = 'postgresql+psycopg2://' + url[len(start):]
    try:
        made = make_url(url)
        if made.drivername.partition('+')[0] not in ('sqlite', 'postgresql'):
            raise NotImplementedError("%r is not supported: the database is 'sqlite' or "
                                      "'postgresql'" % made.drivername.partition('+')[0])
        return sqlalchemy.create_engine(made)
    except (ArgumentError, NoSuchModuleError, ValueError):
        pass        # whose texts have the URL
    except ImportError as error:
        raise DatabaseError('the driver of the database is not installed: %s' % error) from None
    raise ValueError('the database is not a URL such as sqlite:///fleet.db or '
                     'postgresql://user@host/fleet')


def shown(engine: Engine) -> str:
    """
    What to call the database of an engine, without user, password and options.

    :param engine: `sqlalchemy.engine.Engine`
    :returns: str

    >>> shown(open_engine('postgresql://robots:secret@db:5433/fleet?sslmode=disable'))
    'postgresql://db:5433/fleet'
    """
    url = engine.url
    host = url.host or ''
    return '%s://%s%s/%s' % (engine.dialect.name, host, ':%d' % url.port if url.port else '',
                             url.database or '')


@contextmanager
def transaction(engine: Engine) -> Iterator[Connection]:
    """
    A transaction, committed at the end of the block.

    A connection that was lost is not used again, nor are the others of the engine's pool.

    :param engine: `sqlalchemy.engine.Engine`
    :returns: context manager, whose value is a `sqlalchemy.engine.Connection`
    :raises DatabaseError: for whatever the database reports; nothing was changed then
    """
    dialect = engine.dialect
    with _errors(engine), engine.begin() as connection:
        try:
            yield connection
        except dialect.dbapi.Error as error:
            if dialect.is_disconnect(error, connection.connection, None):
                connection.invalidate(error)
                engine.dispose()
            raise


@contextmanager
def raw_connection(engine: Engine) -> Iterator[DBAPICursor]:
    """
    A connection in no transaction.

    :param engine: `sqlalchemy.engine.Engine`
    :returns: context manager, whose value is a cursor
    :raises DatabaseError: for whatever the database reports
    """
    with _errors(engine), closing(engine.raw_connection()) as connection:
        yield connection.cursor()


@contextmanager
def _errors(engine: Engine) -> Iterator[None]:
    try:
        yield
    except (engine.dialect.dbapi.Error, SQLAlchemyError) as error:
        cause = getattr(error, 'orig', None) or error       # without SQLAlchemy's own words
        text = ' '.join(str(cause).split()) or type(cause).__name__
        raise DatabaseError('%s: %s' % (shown(engine), text)) from error
