"""
The rules that the packages on this machine export, and those that ROCON_URI_RULES names.

A package adds values to the vocabulary with a file of rules and, in its package.xml::

    <export><rocon_uri rules="${prefix}/rules/our_robots.yaml"/></export>

Whatever is wrong with one file is logged, with the line, and costs only what that file says.
"""
from __future__ import annotations

import os

from rocon_uri.sources.wording import quoted
from rocon_uri.field_vocabulary import RulesError
from rocon_uri.vocabulary import Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, Iterable, Iterator, List, Tuple

__all__ = ['read_rules', 'rules_path', 'with_exported_rules', 'with_rules']

_END_OF_SEARCH = frozenset(('package.xml', 'manifest.xml', 'rospack_nosubdirs'))


def read_rules(vocabulary: Vocabulary, path: str) -> Vocabulary:
    """
    A vocabulary with what one file of rules adds.

    :param Vocabulary vocabulary: what there is already
    :param str path: a YAML or JSON file: fields at the top, nested groups below
    :returns: Vocabulary
    :raises YamlError: `rocon_uri.yaml_source.YamlError`, if there is a fault in it; says where
    :raises OSError: if it cannot be read
    """
    from rocon_uri.sources.yaml_data import YamlError      # loads yaml
    from rocon_uri.sources.yaml_source import load_file      # loads yaml
    rules = load_file(path)
    _refuse_repeated_keys(rules, path)
    try:
        return vocabulary if rules is None else vocabulary.extended(rules)
    except RulesError as error:
        line, column = _position(rules, error.path)
        raise YamlError(error.problem, path, line, column) from None


def with_rules(vocabulary: Vocabulary,
               paths: Iterable[str]) -> Tuple[Vocabulary, List[Exception]]:
    """
    A vocabulary with what files of rules add; one with a fault adds nothing.

    :param Vocabulary vocabulary: what there is already
    :param paths: iterable of str
    :returns: (Vocabulary, list of `YamlError` and `OSError`)
    """
    errors: List[Exception] = []
    for path in paths:
        try:
            vocabulary = read_rules(vocabulary, path)
        except (OSError, ValueError) as error:
            errors.append(error)
    return vocabulary, errors


def rules_path(folder: str, rules: str) -> str:
    """
    The file that a package means by the ``rules`` of its export.

    :param str folder: the package's
    :param str rules: as it is written there
    :returns: str

    >>> rules_path('/opt/our_package', '${prefix}/rules/our_robots.yaml')
    '/opt/our_package/rules/our_robots.yaml'
    """
    return os.path.join(folder, rules.replace('${prefix}', folder))


def _refuse_repeated_keys(rules: Any, path: str) -> None:
    """One of the two would be lost."""
    from rocon_uri.sources.yaml_data import YamlError, YamlMapping
    if isinstance(rules, YamlMapping):
        for key, _, (line, column) in rules.repeated:
            raise YamlError('%s is there twice' % quoted(str(key)), path, line, column)
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
    vocabulary, errors = with_rules(vocabulary, _paths())
    for error in errors:
        _warn('rules left out: %s', error)
    return vocabulary


def _paths() -> Iterator[str]:
    for paths in _exported_paths().values():
        yield from paths
    for path in os.environ.get('ROCON_URI_RULES', '').split(os.pathsep):
        if path:
            yield path


def _exported_paths() -> Dict[str, List[str]]:
    """The files of rules by package; one that is found first hides those of its name."""
    exported: Dict[str, List[str]] = {}
    from xml.etree import ElementTree       # here, since it costs more than a known value may
    for folder in _package_folders(_ros_paths()):
        manifest = os.path.join(folder, 'package.xml')
        # rospkg itself gives up at the first manifest that is no XML, and loads rosdep to read one.
        try:
            package = ElementTree.fromstring(_manifest(manifest))
        except Exception as error:      # whatever is wrong with somebody's package
            _warn('rules of a package left out: %s: %s', manifest, error)
            continue
        rules = (export.get('rules') for export in package.iterfind('export/rocon_uri'))
        exported.setdefault((package.findtext('name') or folder).strip(), [
            rules_path(folder, path) for path in rules if path])
    return exported


def _ros_paths() -> List[str]:
    """The folders with packages below them."""
    try:
        import rospkg       # not there without ROS; it knows what a distribution adds
    except ImportError:
        return [path for path in os.environ.get('ROS_PACKAGE_PATH', '').split(os.pathsep) if path]
    return list(rospkg.RosPack().get_ros_paths())


def _manifest(path: str) -> bytes:
    """The content of a package.xml; OSError or ValueError for what is not read, as a FIFO."""
    from rocon_uri.sources.yaml_data import MAX_SIZE       # which a known value does not need
    from rocon_uri.sources.yaml_source import read_file       # which a known value does not need
    content = read_file(path)
    if len(content) > MAX_SIZE:
        raise ValueError('larger than 1 MiB, which is all that is read')
    if '<!ENTITY' in content.decode('utf-8'):   # of which not every expat bounds the expansion
        raise ValueError('it declares entities, and those are not read')
    return content


def _package_folders(ros_paths: List[str]) -> Iterator[str]:
    """The folders with a package.xml, found as rospkg finds them, but none of them twice."""
    visited = set()
    for ros_path in ros_paths:
        for folder, subfolders, files in os.walk(ros_path, followlinks=True):
            place = os.path.realpath(folder)
            is_new = place not in visited and 'CATKIN_IGNORE' not in files
            visited.add(place)
            if is_new and 'package.xml' in files:
                yield folder
            if (is_new and _END_OF_SEARCH.isdisjoint(files)
                    and not folder.startswith('/usr/share/')):
                subfolders[:] = sorted(name for name in subfolders if name[0] != '.')
            else:
                subfolders.clear()


def _warn(text: str, *details: Any) -> None:
    import logging      # costs more than the rest of the package, and few need it
    logging.getLogger('rocon_uri').warning(text, *details)
