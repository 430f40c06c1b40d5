"""What a server refuses to whoever reaches it: the page on security, line by line."""
import os

import pytest
from made_packages import make_package
from robot import INTERFACE, PROVIDER, sleeper

HOSTILE = ['--screen', 'robot/Base --wait', 'robot/Base;touch hacked', '$(touch hacked)',
           '`touch hacked`', '../robot/Base', '/etc/passwd', 'robot/Base\n', 'robot/Base\0',
           'robot/../robot/Base', 'name:=value', "robot/Base' || 'x", '\x1b[2Jgone', '\u202erobot',
           '%s%n', '']

#: launch files outside their package, as the providers name them
OUTSIDE = {'Above': '../../outside.launch', 'Absolute': '%s/outside.launch', 'Link': 'link.launch',
           'Folder': 'folder/outside.launch'}


@pytest.fixture(scope='module')
def guarded(robot, tmp_path_factory):
    """A server that knows the robot's packages, one with launch files outside, and no other."""
    folder = tmp_path_factory.mktemp('guarded')
    outside = '<launch><param name="hacked" command="touch %s/hacked"/>%s</launch>' % (
        folder, sleeper('outside'))
    (folder / 'outside.launch').write_text(outside)
    exports, files = [], {}
    for name, launch_file in OUTSIDE.items():
        exports += [('capability_interface', name + '.yaml'),
                    ('capability_provider', 'specs/by_%s.yaml' % name)]
        files[name + '_yaml'] = INTERFACE % name
        files['specs__by_%s_yaml' % name] = PROVIDER % ('by_' + name, 'leaving/' + name) + (
            'launch_file: %s\n' % (launch_file % folder if '%s' in launch_file else launch_file))
    package = make_package(folder / 'src', 'leaving', exports, **files)
    (package / 'specs' / 'link.launch').symlink_to(folder / 'outside.launch')
    (package / 'specs' / 'folder').symlink_to(folder)
    make_package(folder / 'src', 'intruder', [('capability_provider', 'base.yaml'),
                                              ('capability_interface', 'Own.yaml')],
                 base_yaml=PROVIDER % ('base', 'robot/Base') + 'launch_file: base.launch\n',
                 Own_yaml=INTERFACE % 'Own', base_launch=outside)
    server = robot.server({'nodelet_manager': False, 'package_whitelist': ['robot', 'leaving'],
                           'blacklist': ['robot/camera']})
    server.package_path += ':%s' % (folder / 'src')
    with server:
        yield server
    assert not (folder / 'hacked').exists()


def asked(server, capability, provider, bond):
    """The errors with which it answers all that would start something."""
    errors = [server.error('start_capability', capability, provider),
              server.error('use_capability', capability, provider, bond)]
    assert server.call('plan_capability', capability, provider).faults
    assert server.types() == [('server_ready', '')] and server.processes() == {}
    return errors


@pytest.mark.parametrize('name', OUTSIDE)
def test_a_launch_file_outside_its_package_is_not_started(guarded, name):
    bond = guarded.bond()
    for error in asked(guarded, 'leaving/' + name, '', bond.id):
        assert 'outside' in error
    bond.shutdown()


def test_what_is_filtered_out_is_not_started(guarded):
    bond = guarded.bond()
    for error in asked(guarded, 'robot/Base', 'intruder/base', bond.id):
        assert "Capability Provider 'intruder/base' not found" in error
    for error in asked(guarded, 'intruder/Own', '', bond.id):
        assert "Capability 'intruder/Own' not found" in error
    for error in asked(guarded, 'robot/Camera', 'robot/camera', bond.id):
        assert "Capability Provider 'robot/camera' not found" in error
    guarded.call('reload_capabilities')
    assert 'not found' in guarded.error('start_capability', 'robot/Base', 'intruder/base')
    assert 'intruder/base' not in guarded.call('get_providers', '', True).providers
    bond.shutdown()


@pytest.mark.parametrize('text', HOSTILE)
def test_a_text_that_is_no_name_names_nothing(guarded, robot, text):
    bond = guarded.bond()
    before = sorted(os.listdir(str(robot.folder)))
    errors = asked(guarded, text, '', bond.id)
    if text:        # no provider is named by ''
        errors += asked(guarded, 'robot/Base', text, bond.id)
    errors += [guarded.error('use_capability', 'robot/Base', '', text),
               guarded.error('free_capability', 'robot/Base', text),
               guarded.error('free_capability', text, bond.id),
               guarded.error('stop_capability', text),
               guarded.error('get_capability_spec', text), guarded.error('get_remappings', text)]
    for error in errors:
        assert 'error processing request: ' in error and 'internal error' not in error
        assert error.isprintable()
    log = guarded.log.read_text()
    assert '\x1b[2J' not in log and '\u202e' not in log and '\0' not in log
    assert guarded.types() == [('server_ready', '')] and guarded.processes() == {}
    assert sorted(os.listdir(str(robot.folder))) == before
    bond.shutdown()


def test_a_bond_that_the_server_has_not_made_uses_nothing(guarded):
    bond = guarded.bond()
    bond_id = bond.id
    bond.shutdown()
    assert 'Invalid bond_id' in guarded.error('use_capability', 'robot/Base', '', 'of_nobody')
    while 'Invalid bond_id' not in guarded.error('use_capability', 'robot/Base', '', bond_id):
        guarded.error('stop_capability', 'robot/Base')      # it has not yet heard of the end
    guarded.wait_for_all_events()
