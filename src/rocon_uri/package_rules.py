"""
The vocabulary that a set of packages brings along: the rules that they export, on top of all else.

`rocon_uri.exported_rules` finds those of the packages on ``ROS_PACKAGE_PATH``; here the packages
are given.
"""
from __future__ import annotations

import os

from rocon_uri.exported_rules import rules_path, with_rules
from rocon_uri.vocabulary import Vocabulary, complete, current

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, List, Mapping, Tuple

__all__ = ['rules_file_index_from_package_index', 'vocabulary_from_package_index']


def rules_file_index_from_package_index(package_index: Mapping[str, Any]) -> Dict[str, List[str]]:
    """
    The files of rules that packages export, whether they exist or not.

    :param package_index: mapping of package names to catkin_pkg packages, as
        `capabilities.discovery.package_index_from_package_path` gives it
    :returns: dict of package name to a list of paths; packages without any are left out
    """
    index: Dict[str, List[str]] = {}
    for name, package in package_index.items():
        folder = os.path.dirname(package.filename)
        for export in package.exports:
            rules = export.attributes.get('rules') if export.tagname == 'rocon_uri' else None
            if rules:
                index.setdefault(name, []).append(os.path.normpath(rules_path(folder, rules)))
    return index


def vocabulary_from_package_index(
        package_index: Mapping[str, Any]) -> Tuple[Vocabulary, List[Exception]]:
    """
    What this machine knows, and what these packages add.

    :param package_index: as `rules_file_index_from_package_index` takes it
    :returns: (`Vocabulary`, list of `YamlError` and `OSError`); a file with a fault adds nothing

    >>> vocabulary, errors = vocabulary_from_package_index({})
    >>> 'kobuki' in vocabulary.field('hardware_platform')
    True
    """
    paths = [path for below in rules_file_index_from_package_index(package_index).values()
             for path in below]
    return with_rules(complete() if paths else current(), paths)
