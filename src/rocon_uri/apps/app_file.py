"""
The other form of an app: the ``.app`` file of the package app_manager, and how one is read.

::

    platform:   pr2                     # a hardware platform, or all
    interface:  our_apps/dance.interface
    launch:     our_apps/dance.launch   # or run: our_apps/dance, an executable
    display:    Dance
    icon:       our_apps/dance.png

Each file is named ``package/file``, and found anywhere in that package. `rocon_uri.apps.installed`
finds the apps.
"""
from __future__ import annotations

import os
from dataclasses import replace
from typing import Dict, NamedTuple, Optional, Tuple, Union

from capabilities.specs.common import InvalidSpec
from rocon_uri.apps.rapp import RequiredCapability
from rocon_uri.sources.resources import Resource, Resources
from rocon_uri.sources.checked import CheckedMapping, Reading
from rocon_uri.sources.launch_file import LaunchFault, LaunchFiles
from rocon_uri.sources.located import Place
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.sources.wording import cannot_be_read, shown
from rocon_uri.sources.yaml_data import YamlError, YamlMapping, value_place
from rocon_uri.sources.yaml_source import load, read_file
from rocon_uri.vocabulary import Vocabulary

__all__ = ['ALL', 'AppFile', 'InvalidApp', 'KEYS', 'WHAT_RESOURCES_ARE', 'app_from_file_path',
           'app_from_string', 'interface_problem', 'launch_file_fault']

#: the platform of an app that runs on every robot
ALL = 'all'

_TEXT_KEYS = ('display', 'description', 'platform', 'interface', 'launch', 'run', 'icon')

#: The keys of a ``.app`` file that are understood.
KEYS = _TEXT_KEYS + ('run_args', 'clients', 'plugins', 'plugin_order', 'timeout', 'allow_parallel')


#: What errors call the files that the keys name.
WHAT_RESOURCES_ARE = {'interface': 'interface file', 'launch': 'launch file', 'run': 'executable',
                      'icon': 'icon'}


class InvalidApp(InvalidSpec):
    """
    A ``.app`` or ``.installed`` file that cannot be used.

    Parameters and attributes are those of `capabilities.specs.common.InvalidSpec`.

    >>> print(InvalidApp('the app has no platform', 'dance.app', 1, 1))
    dance.app:1:1: the app has no platform
    """


class AppFile(NamedTuple):
    """
    An app of app_manager; a tuple that does not change. What the file does not say is None.

    >>> app = app_from_string('{platform: pr2, interface: ours/a.interface, launch: ours/a.launch}',
    ...                       'ours/a')
    >>> app.compatibility, app.launch, app.display
    ('rocon:/pr2', 'ours/a.launch', 'ours/a')
    """

    #: ``package/name``
    name: str
    #: its file
    path: str
    #: what people call it; its name, where it does not say
    display: str
    #: free text
    description: Optional[str]
    #: what it runs on: a hardware platform, or `ALL`
    platform: str
    #: the file of its topics, a resource name
    interface: str
    #: its launch file, a resource name; None if it has an executable
    launch: Optional[str]
    #: its executable, a resource name; None if it has a launch file
    run: Optional[str]
    #: the file of its icon, a resource name
    icon: Optional[str]
    #: what the resource names stand for, by ``interface``, ``launch``, ``run`` and ``icon``
    resources: Dict[str, Resource]
    #: what its file says, with positions
    source: YamlMapping

    @property
    def form(self) -> str:
        """``'app'``, as opposed to ``'rapp'``, the other form of an app."""
        return 'app'

    @property
    def package(self) -> str:
        """The name of the package that it is in."""
        return self.name.partition('/')[0]

    @property
    def compatibility(self) -> Optional[str]:
        """The rocon URI of its platform; None where no such URI is legal."""
        if self.platform == ALL:
            return 'rocon:/'
        return 'rocon:/' + self.platform if is_legal_base_name(self.platform) else None

    @property
    def is_implementation(self) -> bool:
        """Can some robot run it? Always: a virtual app has no such form."""
        return True

    @property
    def required_capabilities(self) -> Tuple[RequiredCapability, ...]:
        """What the robot has to provide: nothing can be said in a ``.app`` file."""
        return ()

    @property
    def files(self) -> Dict[str, str]:
        """The paths of the interface file and so on by key; of those that are found."""
        return {key: found.path for key, found in self.resources.items() if found.path is not None}

    def is_registered(self, vocabulary: Vocabulary) -> bool:
        """
        Is its platform `ALL`, or a registered value or group?

        :param Vocabulary vocabulary: the values that are registered
        :returns: bool
        """
        return self.platform == ALL or self.platform in vocabulary.field(
            'hardware_platform')

    def is_group(self, vocabulary: Vocabulary) -> bool:
        """
        Is its platform a registered group, which app_manager compares as text?

        :param Vocabulary vocabulary: the values that are registered
        :returns: bool
        """
        return self.is_registered(vocabulary) and self.platform != ALL and bool(
            vocabulary.field('hardware_platform').children(self.platform))

    def position(self, key: str) -> Place:
        """
        Where in its file the value of a key begins.

        :param str key: one of `KEYS`
        :returns: (int, int), line and column from 1; (None, None) if its file does not have the key
        """
        return value_place(self.source, key)


def app_from_file_path(path: str, name: str, resources: Optional[Resources] = None) -> AppFile:
    """
    Read one ``.app`` file.

    :param str path: the file
    :param str name: what the app is called, ``package/name``
    :param resources: `Resources` of the packages that it may refer to
    :returns: `AppFile`
    :raises InvalidApp: if its content is not that of an app
    :raises OSError: if it cannot be read
    """
    return app_from_string(read_file(path), name, path, resources)


def app_from_string(content: Union[str, bytes], name: str, path: str = '<string>',
                    resources: Optional[Resources] = None) -> AppFile:
    """
    Read one app.

    :param content: what its file contains, str or bytes
    :param str name: what the app is called, ``package/name``
    :param str path: its file, which errors name
    :param resources: `Resources` of the packages that it may refer to
    :returns: `AppFile`
    :raises InvalidApp: if the content is not that of an app

    >>> app_from_string('{platform: pr2, interface: ours/a.interface}', 'ours/a', 'a.app')
    Traceback (most recent call last):
        ...
    rocon_uri.apps.app_file.InvalidApp: a.app:1:1: the app has no launch and no run, expected one \
of them
    """
    source = Reading(path, InvalidApp).load(content, 'the app')
    texts = {key: source.text(key, may_be_empty=True) or None for key in _TEXT_KEYS}
    platform = source.required_text('platform', KEYS)
    interface = source.required_text('interface', KEYS)
    if not texts['launch'] and not texts['run']:
        raise source.reading.fault('the app has no launch and no run, expected one of them',
                                   source.place, 'missing-key')
    if texts['launch'] and texts['run']:
        raise source.reading.fault('the app has both launch and run, expected one of them',
                                   source.key_place('run'))
    _check_clients(source)
    resources = resources or Resources({})
    found = {key: (resources.find_executable if key == 'run' else resources.find)(text)
             for key, text in texts.items()
             if text is not None and key in WHAT_RESOURCES_ARE}
    return AppFile(
        name=name, path=path, platform=platform, interface=interface,
        display=texts['display'] or name, description=texts['description'],
        launch=texts['launch'], run=texts['run'], icon=texts['icon'], resources=found,
        source=source.data)


def launch_file_fault(launch: Resource, launch_files: LaunchFiles) -> Optional[LaunchFault]:
    """
    What is against a launch file that a resource name stands for.

    :param Resource launch: one that exists
    :param LaunchFiles launch_files: what was read already
    :returns: `LaunchFault`, None if nothing is
    """
    folder, file = os.path.split(str(launch.path))
    fault = launch_files.look_at(file, folder).fault
    return fault and replace(fault, name=launch.name)


def interface_problem(interface: Resource) -> Optional[str]:
    """
    What is against an interface file that a resource name stands for: app_manager reads it too.

    :param Resource interface: one that exists
    :returns: str, None if nothing is
    """
    path = str(interface.path)
    try:
        data = load(read_file(path), path)
    except OSError as error:
        return cannot_be_read(error)
    except YamlError as error:
        place = '' if error.line is None else ' (line %s, column %s)' % error.place
        return 'cannot be read: %s%s' % (error.problem, place)
    return None if isinstance(data, dict) or not data else 'is %s, expected a mapping' % shown(data)


def _check_clients(source: CheckedMapping) -> None:
    """app_manager refuses an app whose clients have another form."""
    for client in source.reading.mappings(source.sequence('clients'), 'a client',
                                          'a mapping with a type and a manager'):
        client.required('type', ('type', 'manager', 'app'))
        client.required('manager', ('type', 'manager', 'app'))
        for key in 'manager', 'app':
            client.mapping(key, is_checked=False)
