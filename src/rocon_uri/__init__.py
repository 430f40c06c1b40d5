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
if TYPE_CHECKING:       # type checkers and editors read __init__.pyi
    from typing import List

__all__ = ['Field', 'PatternTooComplex', 'Relation', 'ResourceIndex', 'RoconURI',
           'RoconURIValueError', 'Vocabulary', 'default_uri_string', 'explain',
           'generate_platform_rocon_uri', 'is_compatible', 'parse', 'relation']

# Each module is imported when a name in it is first used, or the module itself: a program that may
# not need this package starts at no cost, and one that only parses does not pay for the rest.
_NAMES = {
    'compatibility': ('Relation', 'explain', 'relation'),
    'exceptions': ('PatternTooComplex', 'RoconURIValueError'),
    'field': ('Field',),
    'platform': ('generate_platform_rocon_uri',),
    'resource_index': ('ResourceIndex',),
    'uri': ('RoconURI', 'default_uri_string', 'is_compatible', 'parse'),
    'version': ('__version__',),
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
        if name in names:
            globals()[name] = getattr(import_module('rocon_uri.' + module_name), name)
            return globals()[name]
    from rocon_uri.sources.submodules import found_submodule
    module = found_submodule(__name__, name)
    if module is not None:
        return module
    message = 'module %r has no attribute %r' % (__name__, name)
    if sys.version_info < (3, 10) and name[:1] != '_':      # later ones say it themselves
        from rocon_uri.sources.wording import did_you_mean, near_misses
        message += did_you_mean(near_misses(name, __all__))
    raise AttributeError(message)


def __dir__() -> List[str]:
    return sorted({*globals(), *__all__})
