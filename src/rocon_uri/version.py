"""The version: that of package.xml in a clone, else the one that was installed."""
from __future__ import annotations

import os

__all__ = ['__version__']


def _read_version() -> str:
    source = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    manifest = os.path.join(os.path.dirname(source), 'package.xml')
    if os.path.basename(source) == 'src' and os.path.isfile(manifest):
        from xml.etree import ElementTree
        root = ElementTree.parse(manifest).getroot()
        if root.findtext('name') == 'rocon_uri':
            return root.findtext('version', '')
    from importlib.metadata import PackageNotFoundError, version
    try:
        return version('rocon_uri')
    except PackageNotFoundError:    # a copy of the package, without what installing adds
        return 'unknown'


#: as in ``1.2.3``
__version__ = _read_version()
