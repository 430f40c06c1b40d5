"""
Rocon URIs: can this app run on this robot, and if not, why not?

>>> import rocon_uri
>>> rocon_uri.is_compatible('rocon:/kobuki|turtlebot2', 'rocon:/kobuki/bob/noetic/focal')
True
"""
from __future__ import annotations

from rocon_uri.compatibility import Relation, explain, is_compatible, relation
from rocon_uri.exceptions import PatternTooComplex, RoconURIValueError
from rocon_uri.platform import generate_platform_rocon_uri
from rocon_uri.uri import RoconURI, default_uri_string, parse
from rocon_uri.field import Field
from rocon_uri.vocabulary import Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from rocon_uri.resource_index import ResourceIndex

__all__ = ['Field', 'PatternTooComplex', 'Relation', 'ResourceIndex', 'RoconURI',
           'RoconURIValueError', 'Vocabulary', 'default_uri_string', 'explain',
           'generate_platform_rocon_uri', 'is_compatible', 'parse', 'relation']


def __getattr__(name: str) -> object:
    # What few programs need is imported when it is asked for: it would add 4 % to the import.
    if name == 'ResourceIndex':
        from rocon_uri.resource_index import ResourceIndex
        globals()[name] = ResourceIndex
        return ResourceIndex
    raise AttributeError('module %r has no attribute %r' % (__name__, name))
