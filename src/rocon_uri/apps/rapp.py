"""
A rapp (robot app) as a ``.rapp`` file describes it: `Rapp`, and how one is read.

::

    display:          Random Walker
    compatibility:    rocon:/kobuki|turtlebot2
    launch:           random_walker.launch
    parent_name:      our_rapps/walker          # or walker, in the same package
    required_capabilities:
      - name: std_capabilities/DifferentialMobileBase
        interface:
          topics:
            requires: {/cmd_vel: walker/commands/velocity}

What a rapp says beyond what is known here is kept, not judged. `rocon_uri.rapps` finds rapps, and
has them inherit from their parents.
"""
from __future__ import annotations

import os
from collections import namedtuple

from capabilities.specs.common import InvalidSpec
from rocon_uri.sources.wording import shown
from rocon_uri.sources.yaml_data import YamlError, YamlMapping, YamlSequence
from rocon_uri.sources.yaml_source import load, read_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, Iterator, Optional, Tuple, Union

__all__ = ['GROUPS_OF_REMAPPINGS', 'INHERITED_KEYS', 'InvalidRapp', 'KEYS', 'Rapp',
           'RequiredCapability', 'TYPES_OF_REMAPPINGS', 'rapp_from_file_path', 'rapp_from_string']

#: The keys whose values are the names of files, relative to the folder of the one that says it.
_FILE_KEYS = ('icon', 'launch', 'public_interface', 'public_parameters')
_TEXT_KEYS = ('display', 'description', 'compatibility', 'parent_name') + _FILE_KEYS

#: What a ``.rapp`` file may say and is understood.
KEYS = _TEXT_KEYS + ('required_capabilities',)

#: What a rapp has from its parent where it says nothing itself.
INHERITED_KEYS = ('display', 'description', 'icon', 'public_interface', 'public_parameters')

#: What a required capability may rename.
TYPES_OF_REMAPPINGS = ('topics', 'services', 'actions', 'parameters')

#: The groups that the names of each type are in.
GROUPS_OF_REMAPPINGS = ('requires', 'provides')


class InvalidRapp(InvalidSpec):
    """
    A rapp that cannot be used: a file that is not one, a parent that is not there.

    Parameters and attributes are those of `capabilities.specs.common.InvalidSpec`.

    >>> print(InvalidRapp('launch is a list, expected text', 'dance.rapp', 3, 9))
    dance.rapp:3:9: launch is a list, expected text
    """


#: A capability interface that a rapp needs: its name (str, ``package/name``), and a dict of what
#: the rapp calls the names of that interface by each of `TYPES_OF_REMAPPINGS`.
RequiredCapability = namedtuple('RequiredCapability', 'name remappings')


class Rapp(namedtuple('Rapp', 'name path display description icon compatibility launch parent_name '
                              'public_interface public_parameters required_capabilities others '
                              'files source')):
    """
    A robot app; a tuple that does not change.

    - ``name``: str, ``package/name``; ``path``: str, its file
    - ``display``, ``description``, ``icon``, ``compatibility``, ``launch``, ``parent_name``,
      ``public_interface``, ``public_parameters``: str, ``None`` where it has none;
      ``parent_name`` always has its package
    - ``required_capabilities``: tuple of `RequiredCapability`
    - ``others``: dict of what else the file says
    - ``files``: dict of the paths that icon, launch, public_interface and public_parameters come to
    - ``source``: `rocon_uri.yaml_source.YamlMapping`, what the file itself says, with positions

    >>> rapp = rapp_from_string('{compatibility: "rocon:/pr2", launch: dance.launch}', 'ours/dance')
    >>> rapp.launch, rapp.is_implementation, rapp.is_ancestor
    ('dance.launch', True, True)
    """

    __slots__ = ()

    @property
    def package(self) -> str:
        """The name of the package that exports it."""
        return str(self.name.partition('/')[0])

    @property
    def is_implementation(self) -> bool:
        """Can it be started on some robot? Otherwise it is virtual, a parent only."""
        return self.compatibility is not None and self.launch is not None

    @property
    def is_ancestor(self) -> bool:
        """Is it without a parent?"""
        return self.parent_name is None

    def inheriting(self, parent: Rapp) -> Rapp:
        """
        This rapp with what its parent has and it has not.

        :param Rapp parent: the rapp that parent_name names
        :returns: Rapp

        >>> walk = rapp_from_string('display: Walk', 'ours/walk')
        >>> rapp_from_string('parent_name: walk', 'ours/stroll').inheriting(walk).display
        'Walk'
        """
        missing = [key for key in INHERITED_KEYS if getattr(self, key) is None]
        files = dict(self.files)
        files.update((key, parent.files[key]) for key in missing if key in parent.files)
        return self._replace(files=files, **{key: getattr(parent, key) for key in missing})

    def position(self, key: str) -> Tuple[Optional[int], Optional[int]]:
        """
        Where in its file the value of a key begins.

        :param str key: one of `KEYS`
        :returns: (int, int), line and column from 1; (None, None) for what is not in the file

        >>> rapp_from_string('launch: dance.launch', 'ours/dance').position('launch')
        (1, 9)
        """
        return self.source.value_position(key) if key in self.source else (None, None)


def rapp_from_file_path(path: str, name: str) -> Rapp:
    """
    Read one ``.rapp`` file.

    :param str path: the file
    :param str name: what the rapp is called, ``package/name``
    :returns: Rapp, which has nothing yet of its parent
    :raises InvalidRapp: if its content is not that of a rapp
    :raises OSError: if it cannot be read
    """
    return rapp_from_string(read_file(path), name, path)


def rapp_from_string(content: Union[str, bytes], name: str, path: str = '<string>') -> Rapp:
    """
    Read one rapp.

    :param content: what its file holds, str or bytes
    :param str name: what the rapp is called, ``package/name``
    :param str path: its file, which errors name and other files are relative to
    :returns: Rapp, which has nothing yet of its parent
    :raises InvalidRapp: if the content is not that of a rapp

    >>> rapp_from_string('display: [Dance]', 'ours/dance', 'dance.rapp')
    Traceback (most recent call last):
        ...
    rocon_uri.apps.rapp.InvalidRapp: dance.rapp:1:10: display is a list, expected text
    """
    try:
        source = load(content, path)
        if not isinstance(source, YamlMapping):
            raise YamlError('found %s, expected a rapp, which is a mapping' % shown(source), path,
                            *getattr(source, 'position', (1, 1)))
        return _rapp(source, name, path)
    except YamlError as error:
        raise InvalidRapp(error.problem, path, error.line, error.column) from None


def _rapp(source: YamlMapping, name: str, path: str) -> Rapp:
    _refuse_repeated_keys(source, path)
    texts = {key: _text(source, key, path) for key in _TEXT_KEYS}
    parent_name = texts['parent_name']
    if parent_name is not None and '/' not in parent_name:
        texts['parent_name'] = '%s/%s' % (name.partition('/')[0], parent_name)
    folder = os.path.dirname(path)
    return Rapp(
        name=name, path=path, required_capabilities=tuple(_required_capabilities(source, path)),
        others={key: value for key, value in source.items() if key not in KEYS},
        files={key: os.path.normpath(os.path.join(folder, texts[key] or ''))
               for key in _FILE_KEYS if texts[key] is not None},
        source=source, **texts)


def _text(mapping: YamlMapping, key: Any, path: str, what: str = '') -> Optional[str]:
    """The text that a key has, None if it has none."""
    value = mapping.get(key)
    if value is None:
        return None
    if not isinstance(value, str) or not value and key != 'description':
        raise YamlError('%s is %s, expected text' % (what or key, shown(value)), path,
                        *mapping.value_position(key))
    return value


def _required_capabilities(source: YamlMapping, path: str) -> Iterator[RequiredCapability]:
    items = source.get('required_capabilities')
    if items is None:
        return
    if not isinstance(items, YamlSequence):
        raise YamlError('required_capabilities is %s, expected a list' % shown(items), path,
                        *source.value_position('required_capabilities'))
    for index, item in enumerate(items):
        if not isinstance(item, YamlMapping):
            raise YamlError('a required capability is %s, expected a mapping with a name'
                            % shown(item), path, *items.item_position(index))
        _refuse_repeated_keys(item, path)
        name = _text(item, 'name', path)
        if name is None:
            raise YamlError('a required capability has no name', path, *item.position)
        yield RequiredCapability(name, _remappings(item, path))


def _remappings(capability: YamlMapping, path: str) -> Dict[str, Dict[str, str]]:
    """What the rapp calls the names of a capability interface, of each type that it remaps."""
    interface = _mapping(capability, 'interface', path)
    found: Dict[str, Dict[str, str]] = {}
    for kind in TYPES_OF_REMAPPINGS:
        grouped = _mapping(interface, kind, path)
        for group in GROUPS_OF_REMAPPINGS:
            names = _mapping(grouped, group, path)
            for name in names:
                new_name = _text(names, name, path, shown(name))
                if not isinstance(name, str) or new_name is None:
                    raise YamlError('%s: %s, expected a name and what to call it' % (
                        shown(name), shown(new_name)), path, *names.key_position(name))
                found.setdefault(kind, {})[name] = new_name
    return found


def _mapping(mapping: Any, key: str, path: str) -> Any:
    """The mapping that a key has, an empty one if there is nothing: also ``[]``, as people do."""
    value = mapping.get(key)
    if value is None or value == []:
        return {}
    if not isinstance(value, YamlMapping):
        raise YamlError('%s is %s, expected a mapping' % (key, shown(value)), path,
                        *mapping.value_position(key))
    _refuse_repeated_keys(value, path)
    return value


def _refuse_repeated_keys(mapping: YamlMapping, path: str) -> None:
    """One of the two would be lost."""
    for key, _, (line, column) in mapping.repeated:
        raise YamlError('%s is repeated' % shown(key), path, line, column)
