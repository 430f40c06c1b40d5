"""
The rules files that packages export or ROCON_URI_RULES names, read into data.

A package adds values to the vocabulary with a rules file and, in its package.xml::

    <export><rocon_uri rules="${prefix}/rules/our_robots.yaml"/></export>

`rocon_uri.vocabulary` makes a vocabulary of the data.
"""
from __future__ import annotations

import os
from typing import List, Mapping, Tuple

from rocon_uri.sources.checked import Reading
from rocon_uri.sources.packages import Package, PackageError, find_packages
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load_file

__all__ = ['read_rules_file', 'rules_paths', 'rules_paths_of_machine']


def read_rules_file(path: str) -> object:
    """
    Read one rules file.

    :param str path: a YAML or JSON file
    :returns: its data, as `rocon_uri.sources.yaml_source.load_file` returns it; whether it fits a
        vocabulary is not checked
    :raises YamlError: `rocon_uri.sources.yaml_data.YamlError`, if it is not YAML or has a
        duplicate key
    :raises OSError: if it cannot be read

    >>> read_rules_file('examples/workspace/cafe_cart/rules/robots.yaml')
    {'hardware_platform': {'robot': ['cafe_cart']}}
    """
    rules: object = load_file(path)
    Reading(path, YamlError).refuse_duplicates(rules)    # one of the two would be lost
    return rules


def rules_paths(packages: Mapping[str, Package]) -> List[str]:
    """The absolute paths of the rules files that packages export, whether they exist or not."""
    return [path for package in packages.values() for path in package.files('rocon_uri', 'rules')]


def rules_paths_of_machine() -> Tuple[List[str], List[PackageError]]:
    """The rules files that packages on the package path export, and ROCON_URI_RULES; errors."""
    try:
        import rospkg       # missing without ROS; it knows what a distribution adds
        folders = rospkg.RosPack().get_ros_paths()
    except ImportError:
        folders = os.environ.get('ROS_PACKAGE_PATH', '').split(os.pathsep)
    faults: List[PackageError] = []
    paths = rules_paths(find_packages(folders, faults))
    paths += filter(None, os.environ.get('ROCON_URI_RULES', '').split(os.pathsep))
    return paths, faults
