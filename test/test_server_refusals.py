"""What cannot work is refused by a server in the words of a plan, for each kind of fault."""
from __future__ import annotations

import shutil

import pytest
from made_packages import make_package
from robot import INTERFACE, PROVIDER, eventually, sleeper
from test_reasons import CASES, workspace

from capabilities.discovery import (
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from capabilities.planning.providers import error_text, plan_start
from rocon_uri.sources.launch_file import LaunchFiles


@pytest.fixture(scope='module')
def packages(tmp_path_factory):
    """A folder with a package for each kind of fault, in which the capability Need has it."""
    folder = tmp_path_factory.mktemp('faulty')
    for kind, (providers, _) in CASES.items():
        workspace(folder / 'made', providers)
        package = folder / 'packages' / kind.replace('-', '_')
        shutil.move(str(folder / 'made' / 'ours'), str(package))
        for path in [package / 'package.xml', *package.glob('specs/*')]:
            path.write_text(path.read_text().replace('ours/', package.name + '/').replace(
                '<name>ours<', '<name>%s<' % package.name))
        if kind != 'launch-outside':
            shutil.rmtree(str(folder / 'made' / 'ours_two'))
        else:
            shutil.move(str(folder / 'made' / 'ours_two'), str(folder / 'packages'))
    make_package(
        folder / 'packages', 'sound', [('capability_interface', 'Base.yaml'),
                                       ('capability_provider', 'base.yaml')],
        Base_yaml=INTERFACE % 'Base', base_yaml=PROVIDER % ('base', 'sound/Base')
        + 'launch_file: base.launch', base_launch='<launch>%s</launch>' % sleeper('base'))
    return folder / 'packages'


@pytest.fixture(scope='module')
def faulty_server(robot, packages):
    """A server of those packages."""
    server = robot.server({'nodelet_manager': False})
    server.package_path = str(packages)
    with server:
        yield server


@pytest.mark.parametrize('kind', CASES)
def test_each_kind_of_fault_is_refused_before_anything_starts(faulty_server, packages, kind):
    """A5, over the wire"""
    capability = kind.replace('-', '_') + '/Need'
    index, _ = spec_index_from_spec_file_index(spec_file_index_from_package_index(
        package_index_from_package_path([str(packages)])))
    text = error_text(plan_start(index, capability, launch_files=LaunchFiles()))
    eventually(lambda: faulty_server.statuses() == [])      # another test may have started some
    faulty_server.wait_for_all_events()
    launched = faulty_server.types('launched')
    bond = faulty_server.bond()
    for service, *rest in ('start_capability', ''), ('use_capability', '', bond.id):
        assert ('error processing request: ' + text
                in faulty_server.error(service, capability, *rest))
    assert faulty_server.statuses() == [] and faulty_server.types('launched') == launched
    bond.shutdown()


def test_the_package_path_takes_the_place_of_ros_package_path(faulty_server, robot):
    """1.1: for discovery, but what it starts finds the packages of both"""
    interfaces = faulty_server.call('get_interfaces').interfaces
    assert {name.partition('/')[0] for name in interfaces} == {
        kind.replace('-', '_') for kind in CASES} | {'sound'}
    assert str(robot.workspace) in robot.server_environment['ROS_PACKAGE_PATH']
    assert 'not found' in faulty_server.error('start_capability', 'robot/Base', '')

    assert faulty_server.call('start_capability', 'sound/Base', '').result == 0
    eventually(lambda: [status.state for status in faulty_server.statuses()] == ['running'])
    assert faulty_server.node_pid('base')
    assert faulty_server.call('stop_capability', 'sound/Base').successful
