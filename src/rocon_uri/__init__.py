"""
Rocon URIs: can this app run on this robot, and if not, why not?

>>> import rocon_uri
>>> rocon_uri.is_compatible('rocon:/kobuki|turtlebot2', 'rocon:/kobuki/bob/noetic/focal')
True
"""
from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import List

    from rocon_uri.compatibility import Relation, explain, relation
    from rocon_uri.exceptions import PatternTooComplex, RoconURIValueError
    from rocon_uri.field import Field
    from rocon_uri.platform import generate_platform_rocon_uri
    from rocon_uri.resource_index import ResourceIndex
    from rocon_uri.uri import RoconURI, default_uri_string, is_compatible, parse
    from rocon_uri.vocabulary import Vocabulary

__all__ = ['Field', 'PatternTooComplex', 'Relation', 'ResourceIndex', 'RoconURI',
           'RoconURIValueError', 'Vocabulary', 'default_uri_string', 'explain',
           'generate_platform_rocon_uri', 'is_compatible', 'parse', 'relation']

# Each module is imported when a name in it is first used: a program that may not need this
# package starts at no cost, and one that only parses does not pay for the rest.
_NAMES = {
    'compatibility': ('Relation', 'explain', 'relation'),
    'exceptions': ('PatternTooComplex', 'RoconURIValueError'),
    'field': ('Field',),
    'platform': ('generate_platform_rocon_uri',),
    'resource_index': ('ResourceIndex',),
    'uri': ('RoconURI', 'default_uri_string', 'is_compatible', 'parse'),
    'vocabulary': ('Vocabulary',),
}

# In a devel space the messages are in another folder than the sources. This does what
# pkgutil.extend_path does, whose import takes longer than all that is imported here.
for _entry in sys.path:
    _folder = os.path.join(_entry, __name__)
    if _folder not in __path__ and os.path.isfile(os.path.join(_folder, '__init__.py')):
        __path__.append(_folder)


def __getattr__(name: str) -> object:
    from importlib import import_module
    for module_name, names in _NAMES.items():
        if name == module_name or name in names:
            module = import_module('rocon_uri.' + module_name)
            globals()[name] = module if name == module_name else getattr(module, name)
            return globals()[name]
    raise AttributeError('module %r has no attribute %r' % (__name__, name))


def __dir__() -> List[str]:
    return sorted({*globals(), *__all__})
