"""Modules that are reachable after the import of their package, and imported when they are used."""
from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Optional

__all__ = ['found_submodule', 'submodule']


def submodule(package: str, name: str) -> ModuleType:
    """
    A module of a package, for the ``__getattr__`` of that.

    :param str package: its name
    :param str name: of the module, without the package
    :returns: module
    :raises AttributeError: if there is none

    >>> submodule('rocon_uri', 'ros_names').__name__
    'rocon_uri.ros_names'
    """
    module = found_submodule(package, name)
    if module is None:
        raise AttributeError('module %r has no attribute %r' % (package, name))
    return module


def found_submodule(package: str, name: str) -> Optional[ModuleType]:
    """Described under `submodule`, but None if there is none."""
    whole_name = '%s.%s' % (package, name)
    if name[:1] != '_':
        try:
            return import_module(whole_name)
        except ModuleNotFoundError as error:
            if error.name != whole_name:    # it is there, and what it needs is not
                raise
    return None
