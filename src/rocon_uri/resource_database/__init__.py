"""
Requests answered by the database that holds the resources, through SQLAlchemy 1.3 to 2.x.

`ResourceDatabase` keeps resources in tables of its own and gives the answers of
`rocon_uri.ResourceIndex`. `condition` is a request as an expression for a table of the user's own.
Both work on SQLite and on PostgreSQL, with the driver psycopg2.
"""
from rocon_uri.resource_database.condition import condition
from rocon_uri.resource_database.database import ResourceDatabase
from rocon_uri.resource_database.engines import DatabaseError, open_engine
from rocon_uri.resource_database.functions import register
from rocon_uri.resource_database.writing import NotAllAdded

__all__ = ['DatabaseError', 'NotAllAdded', 'ResourceDatabase', 'condition', 'open_engine',
           'register']
