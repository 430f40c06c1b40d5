"""Checks ``.app`` files of app_manager that can be read, and the files that they name."""
from __future__ import annotations

from typing import List

from rocon_uri.apps.app_file import ALL, KEYS, WHAT_RESOURCES_ARE, AppFile, launch_file_fault
from rocon_uri.grammar import is_rocon_app
from rocon_uri.lint.checked_file import CheckedFile, is_inside
from rocon_uri.lint.finding import ERROR, WARNING, Finding
from rocon_uri.sources.checked import CheckedMapping
from rocon_uri.sources.located import NOWHERE
from rocon_uri.sources.resources import MISSING
from rocon_uri.sources.wording import did_you_mean, near_values, quoted
from rocon_uri.workspace import Workspace

__all__ = ['check_app_file']

_PLUGIN_ORDERS = ['start_plugin_order', 'stop_plugin_order']
_INTERFACE_KEYS = ('published_topics', 'subscribed_topics')


def check_app_file(app: AppFile, package_folder: str, workspace: Workspace) -> List[Finding]:
    """
    Check one app, and the files that it names.

    :param AppFile app: as it was read from its file
    :param str package_folder: where the package is that it is in
    :param Workspace workspace: what it may refer to
    :returns: list of `Finding`
    """
    file = CheckedFile(app.path, package_folder)
    if not is_rocon_app(app.name):
        file.warn('no rocon URI can name app %s: the names of package and file have to be ROS base '
                  'names (a letter, then letters, digits and _)' % quoted(app.name), NOWHERE,
                  'illegal-name')
    source = file.mapping(app.source, 'the app')
    source.warn_of_unknown(KEYS)
    _check_platform(app, file, workspace)
    for key, found in app.resources.items():
        if found.kind is not None:
            is_warning = key == 'icon' and found.kind == MISSING
            file.add(WARNING if is_warning else ERROR, '%s %s %s' % (
                WHAT_RESOURCES_ARE[key], quoted(found.name), found.problem), app.position(key),
                'file-missing' if is_warning else '%s-%s' % (key, found.kind))
    _check_launch(app, file, workspace)
    _check_options(source, file)
    return file.findings + _interface_findings(app, package_folder)


def _check_platform(app: AppFile, file: CheckedFile, workspace: Workspace) -> None:
    registered = workspace.vocabulary.field('hardware_platform')
    if not app.is_registered(workspace.vocabulary):
        meant = near_values(app.platform, (ALL, *registered))
        file.warn('platform %s is not registered%s; it is compared with that of the robot as text'
                  % (quoted(app.platform), did_you_mean(meant)),
                  app.position('platform'), 'unregistered-platform')
    elif app.is_group(workspace.vocabulary):
        file.warn('platform %s is a group, which app_manager does not know: it compares the '
                  'platform with that of the robot as text' % quoted(app.platform),
                  app.position('platform'), 'group-platform')


def _check_launch(app: AppFile, file: CheckedFile, workspace: Workspace) -> None:
    found = app.resources.get('launch')
    fault = found and found.path and launch_file_fault(found, workspace.launch_files)
    if fault and fault.line is not None:
        file.add_in_launch_file(fault)
    elif fault:
        file.error(str(fault), app.position('launch'), fault.kind)


def _check_options(source: CheckedMapping, file: CheckedFile) -> None:
    for key, kinds, expected in (('timeout', (int, float), 'a number of seconds'),
                                 ('allow_parallel', bool, 'true or false'),
                                 ('run_args', (str, list), 'text')):
        value = source.get(key)
        if value is not None and (not isinstance(value, kinds)
                                  or key == 'timeout' and isinstance(value, bool)):
            file.refuse(source.wrong(key, expected))
    plugins = {plugin.required_text('name')
               for plugin in file.mappings(source.sequence('plugins'), 'a plugin',
                                           'a mapping with a name and a type')
               if plugin.required_text('type')}
    orders, keys = source, ['plugin_order']
    if isinstance(source.get('plugin_order'), dict):
        orders, keys = source.mapping('plugin_order'), _PLUGIN_ORDERS
        orders.warn_of_unknown(keys)
    for key in keys:
        for name in orders.sequence(key):
            if plugins and not (isinstance(name, str) and name in plugins):
                file.warn('%s has %s, and there is no such plugin%s' % (
                    key, quoted(str(name)), file.suggestion(str(name), plugins)),
                    orders.value_place(key), 'unknown-name')


def _interface_findings(app: AppFile, package_folder: str) -> List[Finding]:
    """The findings in the interface file, if it is in the same package."""
    path = app.files.get('interface')
    if path is None or not is_inside(path, package_folder):
        return []
    file = CheckedFile(path, package_folder)
    data = file.read()
    if data is not None:
        interface = file.mapping(data, 'the interface', place=(1, 1))
        for key in _INTERFACE_KEYS:
            topics = interface.mapping(key)
            for name in topics:
                file.check_ros_name(topics.key_text(name, 'the name of a topic'), 'name',
                                    topics.key_place(name))
                type_name = topics.text_at(name, 'type of %s')
                if type_name:
                    file.check_type(type_name, quoted(str(name)), topics.value_place(name))
    return file.findings
