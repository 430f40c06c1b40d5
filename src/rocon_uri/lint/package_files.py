"""The files in a package, whether anything names them or not."""
from __future__ import annotations

import os
from typing import List

from rocon_uri.sources.packages import MANIFEST
from rocon_uri.sources.walk import walk

__all__ = ['package_files']


def package_files(folder: str) -> List[str]:
    """
    The files in a package, without those in hidden folders and those of a package within it.

    :param str folder: the folder of the package
    :returns: list of str, their paths, by folder and name

    >>> [path for path in package_files('examples/workspace/cafe_cart') if path.endswith('.yaml')]
    ['examples/workspace/cafe_cart/rules/robots.yaml']
    """
    paths: List[str] = []
    for below, folders, files in walk(folder):
        if below != folder and MANIFEST in files:
            folders.clear()
            continue
        paths += [os.path.join(below, name) for name in files]
    return paths
