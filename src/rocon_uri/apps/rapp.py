"""
A rapp (robot app) as its ``.rapp`` file describes it, and how such a file is read.

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

Other keys are kept as they are. `rocon_uri.rapps` finds rapps, and lets them inherit from their
parents.
"""
from __future__ import annotations

import os
from os import PathLike
from typing import Dict, Iterator, NamedTuple, Optional, Tuple, Union

from capabilities.specs.common import InvalidSpec
from rocon_uri.sources.checked import CheckedMapping, Reading
from rocon_uri.sources.located import Place
from rocon_uri.sources.yaml_data import YamlMapping, value_place
from rocon_uri.sources.yaml_source import read_file

__all__ = ['GROUPS_OF_REMAPPINGS', 'INHERITED_KEYS', 'InvalidRapp', 'KEYS', 'Rapp',
           'RequiredCapability', 'TYPES_OF_REMAPPINGS', 'rapp_from_file_path', 'rapp_from_string']

#: The keys whose values name files, relative to the folder of the rapp.
_FILE_KEYS = ('icon', 'launch', 'public_interface', 'public_parameters')
_TEXT_KEYS = ('display', 'description', 'compatibility', 'parent_name') + _FILE_KEYS

#: The keys of a ``.rapp`` file that are understood.
KEYS = _TEXT_KEYS + ('required_capabilities',)

#: What a rapp inherits from its parent where it says nothing itself.
INHERITED_KEYS = ('display', 'description', 'icon', 'public_interface', 'public_parameters')

#: What a required capability may rename.
TYPES_OF_REMAPPINGS = ('topics', 'services', 'actions', 'parameters')

#: The groups that the names of each type are in.
GROUPS_OF_REMAPPINGS = ('requires', 'provides')


class InvalidRapp(InvalidSpec):
    """
    A rapp that cannot be used: its file is not that of a rapp, or its parent does not exist.

    Parameters and attributes are those of `capabilities.specs.common.InvalidSpec`.

    >>> print(InvalidRapp('launch is a list, expected text', 'dance.rapp', 3, 9))
    dance.rapp:3:9: launch is a list, expected text
    """


class RequiredCapability(NamedTuple):
    """
    A capability that a rapp needs.

    >>> RequiredCapability(name='std_capabilities/Sound', remappings={}).name
    'std_capabilities/Sound'
    """

    #: ``package/name``
    name: str
    #: what the rapp calls the names of the interface, by each of `TYPES_OF_REMAPPINGS` that it
    #: remaps
    remappings: Dict[str, Dict[str, str]]


class Rapp(NamedTuple):
    """
    A robot app; a tuple that does not change. What a rapp does not say is None.

    >>> rapp = rapp_from_string('{compatibility: "rocon:/pr2", launch: dance.launch}', 'ours/dance')
    >>> rapp.launch, rapp.is_implementation, rapp.is_ancestor
    ('dance.launch', True, True)
    """

    #: ``package/name``
    name: str
    #: its file
    path: str
    #: what people call it
    display: Optional[str]
    #: free text
    description: Optional[str]
    #: the file of its icon, as the rapp names it
    icon: Optional[str]
    #: the rocon URI of the robots that it runs on
    compatibility: Optional[str]
    #: its launch file, as the rapp names it
    launch: Optional[str]
    #: the rapp that it inherits from, always with its package
    parent_name: Optional[str]
    #: the file of its topics, services and actions, as the rapp names it
    public_interface: Optional[str]
    #: the file of its parameters, as the rapp names it
    public_parameters: Optional[str]
    #: what the robot has to provide
    required_capabilities: Tuple[RequiredCapability, ...]
    #: what else its file says
    others: Dict[str, object]
    #: the paths of icon, launch, public_interface and public_parameters by key, joined to `path`
    files: Dict[str, str]
    #: what its file says, with positions
    source: YamlMapping

    @property
    def form(self) -> str:
        """``'rapp'``, as opposed to ``'app'``, the other form of an app."""
        return 'rapp'

    @property
    def package(self) -> str:
        """The name of the package that exports it."""
        return self.name.partition('/')[0]

    @property
    def is_implementation(self) -> bool:
        """Can some robot run it? If not, it is virtual: only a parent of others."""
        return self.compatibility is not None and self.launch is not None

    @property
    def is_ancestor(self) -> bool:
        """Does it have no parent?"""
        return self.parent_name is None

    def inheriting(self, parent: Rapp) -> Rapp:
        """
        This rapp, with what its parent has where it has nothing itself.

        :param Rapp parent: the rapp that parent_name names
        :returns: Rapp

        >>> walk = rapp_from_string('display: Walk', 'ours/walk')
        >>> rapp_from_string('parent_name: walk', 'ours/stroll').inheriting(walk).display
        'Walk'
        """
        missing = [key for key in INHERITED_KEYS if getattr(self, key) is None]
        files = {key: parent.files[key] for key in missing if key in parent.files}
        return self._replace(files={**self.files, **files},
                             **{key: getattr(parent, key) for key in missing})

    def position(self, key: str) -> Place:
        """
        Where in its file the value of a key begins.

        :param str key: one of `KEYS`
        :returns: (int, int), line and column from 1; (None, None) if its file does not have the key

        >>> rapp_from_string('launch: dance.launch', 'ours/dance').position('launch')
        (1, 9)
        """
        return value_place(self.source, key)


def rapp_from_file_path(path: Union[str, PathLike[str]], name: str) -> Rapp:
    """
    Read one ``.rapp`` file.

    :param str path: the file
    :param str name: what the rapp is called, ``package/name``
    :returns: Rapp, which has not inherited anything yet
    :raises InvalidRapp: if its content is not that of a rapp
    :raises OSError: if it cannot be read
    """
    return rapp_from_string(read_file(path), name, str(path))


def rapp_from_string(content: Union[str, bytes], name: str, path: str = '<string>') -> Rapp:
    """
    Read one rapp.

    :param content: what its file contains, str or bytes
    :param str name: what the rapp is called, ``package/name``
    :param str path: its file, which errors name and other files are relative to
    :returns: Rapp, which has not inherited anything yet
    :raises InvalidRapp: if the content is not that of a rapp

    >>> rapp_from_string('display: [Dance]', 'ours/dance', 'dance.rapp')
    Traceback (most recent call last):
        ...
    rocon_uri.apps.rapp.InvalidRapp: dance.rapp:1:10: display is a list, expected text
    """
    source = Reading(path, InvalidRapp).load(content, 'the rapp')
    texts = {key: source.text(key, may_be_empty=key == 'description') for key in _TEXT_KEYS}
    parent_name = texts['parent_name']
    if parent_name is not None and '/' not in parent_name:
        texts['parent_name'] = '%s/%s' % (name.partition('/')[0], parent_name)
    folder = os.path.dirname(path)
    return Rapp(
        name=name, path=path,
        required_capabilities=tuple(_required_capabilities(source)),
        others={key: source.get(key) for key in source if key not in KEYS},
        files={key: os.path.normpath(os.path.join(folder, texts[key] or ''))
               for key in _FILE_KEYS if texts[key] is not None},
        source=source.data, **texts)


def _required_capabilities(source: CheckedMapping) -> Iterator[RequiredCapability]:
    for capability in source.reading.mappings(
            source.sequence('required_capabilities'), 'a required capability',
            'a mapping with a name'):
        yield RequiredCapability(name=capability.required_text('name'),
                                 remappings=_remappings(capability))


def _remappings(capability: CheckedMapping) -> Dict[str, Dict[str, str]]:
    """What the rapp calls the names of a capability interface, of each type that it remaps."""
    interface = capability.mapping('interface')
    found: Dict[str, Dict[str, str]] = {}
    for kind in TYPES_OF_REMAPPINGS:
        groups = interface.mapping(kind)
        for group in GROUPS_OF_REMAPPINGS:
            names = groups.mapping(group)
            for key in names:
                name = names.key_text(key, 'the name of a remapping')
                found.setdefault(kind, {})[name] = names.text_at(key, 'the new name of %s')
    return found
