"""
The rules that the packages on this machine export, and those that ROCON_URI_RULES names.

A package adds values to the vocabulary with a file of rules and, in its package.xml::

    <export><rocon_uri rules="${prefix}/rules/our_robots.yaml"/></export>

Whatever is wrong with one file is logged, with the line, and costs only what that file says.
"""
from __future__ import annotations

import os

from rocon_uri.vocabulary import RulesError, Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Iterator, Tuple

__all__ = ['read_rules', 'with_exported_rules']


def read_rules(vocabulary: Vocabulary, path: str) -> Vocabulary:
    """
    A vocabulary with what one file of rules adds.

    :param Vocabulary vocabulary: what there is already
    :param str path: a YAML or JSON file: fields at the top, nested groups below
    :returns: Vocabulary
    :raises YamlError: `rocon_uri.yaml_source.YamlError`, if there is a fault in it; says where
    :raises OSError: if it cannot be read
    """
    from rocon_uri.yaml_source import YamlError, load_file      # loads yaml
    rules = load_file(path)
    _refuse_repeated_keys(rules, path)
    try:
        return vocabulary if rules is None else vocabulary.extended(rules)
    except RulesError as error:
        line, column = _position(rules, error.path)
        raise YamlError(error.problem, path, line, column) from None


def _refuse_repeated_keys(rules: Any, path: str) -> None:
    """One of the two would be lost."""
    from rocon_uri.yaml_source import YamlError, YamlMapping
    if isinstance(rules, YamlMapping):
        for key, _, (line, column) in rules.repeated:
            raise YamlError('%r is there twice' % (key,), path, line, column)
    if isinstance(rules, (dict, list)):
        for below in rules.values() if isinstance(rules, dict) else rules:
            _refuse_repeated_keys(below, path)


def _position(rules: Any, path: Tuple[Any, ...]) -> Tuple[int, int]:
    """Where in a file the place is that a path of keys and indices leads to."""
    line, column = 1, 1
    for key in path:
        if isinstance(rules, dict):
            line, column = rules.key_position(key)      # type: ignore[attr-defined]
        else:
            line, column = rules.item_position(key)
        rules = rules[key]
    return line, column


def with_exported_rules(vocabulary: Vocabulary) -> Vocabulary:
    """
    A vocabulary with all that can be found on this machine.

    :param Vocabulary vocabulary: what there is already
    :returns: Vocabulary
    """
    for path in _paths():
        try:
            vocabulary = read_rules(vocabulary, path)
        except (OSError, ValueError) as error:
            _warn('rules left out: %s', error)
    return vocabulary


def _paths() -> Iterator[str]:
    for manifest in _manifests_with_rules():
        for path in manifest.get_export('rocon_uri', 'rules'):
            yield os.path.join(os.path.dirname(manifest.filename), path)
    for path in os.environ.get('ROCON_URI_RULES', '').split(os.pathsep):
        if path:
            yield path


def _manifests_with_rules() -> Iterator[Any]:
    try:
        import rospkg       # not there without ROS
    except ImportError:
        return
    packages = rospkg.RosPack()
    for package in sorted(packages.list()):
        path = os.path.join(packages.get_path(package), 'package.xml')
        try:
            # Few packages export rules, and to parse the manifests of all takes seconds.
            with open(path, 'rb') as manifest_file:
                if b'rocon_uri' not in manifest_file.read():
                    continue
            yield packages.get_manifest(package)
        except Exception as error:      # whatever rospkg finds wrong with somebody's package
            _warn('rules of package %s left out: %s', package, error)


def _warn(text: str, *details: Any) -> None:
    import logging      # costs more than the rest of the package, and few need it
    logging.getLogger('rocon_uri').warning(text, *details)
