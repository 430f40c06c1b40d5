"""
Rocon URIs: can this app run on this robot, and if not, why not?

>>> import rocon_uri
>>> rocon_uri.is_compatible('rocon:/kobuki|turtlebot2', 'rocon:/kobuki/bob/noetic/focal')
True
"""
from rocon_uri.compatibility import Relation, explain, is_compatible, relation
from rocon_uri.exceptions import PatternTooComplex, RoconURIValueError
from rocon_uri.platform import generate_platform_rocon_uri
from rocon_uri.uri import RoconURI, default_uri_string, parse
from rocon_uri.field import Field
from rocon_uri.vocabulary import Vocabulary

__all__ = ['Field', 'PatternTooComplex', 'Relation', 'RoconURI', 'RoconURIValueError',
           'Vocabulary', 'default_uri_string', 'explain', 'generate_platform_rocon_uri',
           'is_compatible', 'parse', 'relation']
