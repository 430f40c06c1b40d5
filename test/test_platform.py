"""What this machine is, as a rocon URI."""
from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading
import time
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocon_uri import platform
from rocon_uri.cli import main
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.platform import default_robot_name, generate_platform_rocon_uri
from rocon_uri.uri import parse
from rocon_uri.vocabulary import Vocabulary, current


def fields(text):
    return text[len('rocon:/'):].split('/')


@pytest.fixture
def without_rospkg(monkeypatch):
    monkeypatch.setitem(sys.modules, 'rospkg', None)


@pytest.mark.parametrize('given_text, name', [
    ('bob', 'bob'),
    ('Cybernetic Pirate', 'cybernetic_pirate'),
    ('R2-D2', 'r2_d2'),
    ('3po', 'r3po'),
    ('_bob', 'r_bob'),
    ('-', 'r_'),
    ('J\u00f6rg', 'j_rg'),
    ('rocon:/#%|*', 'rocon______'),
    ('a' * 300, 'a' * 255),
    ('7' * 300, 'r' + '7' * 254),
])
def test_type_and_name_are_made_legal(given_text, name):
    assert fields(generate_platform_rocon_uri('pc', given_text))[1] == name
    assert fields(generate_platform_rocon_uri(given_text, 'bob'))[0] == name


@pytest.mark.parametrize('robot_type, robot_name, field', [('', 'bob', 'hardware_platform'),
                                                           ('pc', '', 'name')])
def test_an_empty_type_or_name_is_an_error(robot_type, robot_name, field):
    with pytest.raises(RoconURIValueError) as caught:
        generate_platform_rocon_uri(robot_type, robot_name)
    assert caught.value.field == field
    assert isinstance(caught.value, ValueError)


def test_an_unregistered_type_is_left_to_who_reads_the_text():
    text = generate_platform_rocon_uri('a_robot_that_is_not_registered', 'bob')
    with pytest.raises(RoconURIValueError):
        parse(text)


@given(st.text(min_size=1), st.text(min_size=1))
def test_any_type_and_name_give_a_uri_of_four_fields(robot_type, robot_name):
    text = generate_platform_rocon_uri(robot_type, robot_name)
    assert str(parse(text, vocabulary=Vocabulary.open())) == text
    assert '*' not in fields(text)


def test_a_browser_can_be_appended_to_the_operating_system():
    uri = parse(generate_platform_rocon_uri('pc', 'bob') + '|chrome')
    assert uri.operating_system.list[1:] == ['chrome']


@pytest.mark.parametrize('distribution, framework', [
    ('noetic', 'noetic'),
    ('humble', 'humble'),
    ('Debian', 'ros_other'),
    ('', 'ros_other'),
    ('*', 'ros_other'),
])
def test_the_framework_is_the_ros_distribution_where_that_is_registered(
        distribution, framework, monkeypatch):
    monkeypatch.setenv('ROS_DISTRO', distribution)
    assert fields(generate_platform_rocon_uri('pc', 'bob'))[2] == framework


def test_the_framework_is_ros_other_where_ros_says_nothing(monkeypatch):
    monkeypatch.delenv('ROS_DISTRO', raising=False)
    assert fields(generate_platform_rocon_uri('pc', 'bob'))[2] == 'ros_other'


# ROS_OS_OVERRIDE is os_detect's own: the name, the version and the codename that it shall find.
@pytest.mark.parametrize('detected, system', [
    ('ubuntu:20.04:focal', 'focal'),
    ('debian:12:bookworm', 'bookworm'),
    ('mint:20.3:una', 'una'),
    ('pop:22.04:jammy', 'jammy'),
    ('debian:99:', 'debian'),
    ('ubuntu:99.04:zany', 'ubuntu'),
    ('fedora:40:workstation edition', 'fedora'),
    ('arch::', 'arch'),
    ('slackware:15.0:', 'linux'),
    ('osx:10.14:mojave', 'osx'),
    ('windows:10.0.19045:10', 'windows10'),
    ('windows:6.0:Vista', 'windows'),
    ('freebsd:13.2:', 'freebsd'),
    ('', 'linux'),
])
def test_the_system_is_the_nearest_registered_one_to_what_os_detect_says(
        detected, system, monkeypatch):
    pytest.importorskip('rospkg')
    monkeypatch.setenv('ROS_OS_OVERRIDE', detected)
    if not detected:    # os_detect finds nothing at all, and neither does what stands in for it
        monkeypatch.setattr(platform, '_OS_RELEASE_FILES', ())
    assert fields(generate_platform_rocon_uri('pc', 'bob'))[3] == system


@pytest.mark.parametrize('os_release, system', [
    ('ID=ubuntu\nID_LIKE=debian\nVERSION_CODENAME=focal\n', 'focal'),
    ('ID=debian\nVERSION_CODENAME="bookworm"\n', 'bookworm'),
    ("ID='ubuntu'\nVERSION_CODENAME=zany\n", 'ubuntu'),
    ('ID=zorin\nID_LIKE="ubuntu debian"\n', 'ubuntu'),
    ('ID="opensuse-leap"\nID_LIKE="suse opensuse"\n', 'opensuse'),
    ('ID=elementary\nID_LIKE=ubuntu\nVERSION_CODENAME=odin\nUBUNTU_CODENAME=focal\n', 'focal'),
    ('ID=elementary\nID_LIKE=ubuntu\nUBUNTU_CODENAME=focal\n', 'focal'),
    ('ID=mx\nID_LIKE=debian\nDEBIAN_CODENAME=bookworm\n', 'bookworm'),
    ('ID=linuxmint\nID_LIKE="ubuntu debian"\nVERSION_CODENAME=una\nUBUNTU_CODENAME=focal\n', 'una'),
    ('ID=ubuntu\nVERSION_CODENAME=zany\nDEBIAN_CODENAME=trixie\n', 'trixie'),
    ('ID=neon\nID_LIKE="zorin debian"\n', 'debian'),
    ('# nothing of use\n\nID\n', 'linux'),
    ('', 'linux'),
    (None, 'linux'),
])
@pytest.mark.skipif(not sys.platform.startswith('linux'), reason='for Linux')
@pytest.mark.parametrize('with_rospkg', [False, True])
def test_the_system_says_itself_what_it_is(
        with_rospkg, os_release, system, tmp_path, monkeypatch):
    if with_rospkg:     # which does not know elementary OS
        os_detect = pytest.importorskip('rospkg.os_detect')
        monkeypatch.delenv('ROS_OS_OVERRIDE', raising=False)
        monkeypatch.setattr(os_detect.OsDetect, 'detect_os', lambda self: ('pop', '8', 'odin'))
    else:
        monkeypatch.setitem(sys.modules, 'rospkg', None)
    path = tmp_path / 'os-release'
    if os_release is not None:
        path.write_text(os_release)
    monkeypatch.setattr(platform, '_OS_RELEASE_FILES', (str(tmp_path / 'missing'), str(path)))
    assert fields(generate_platform_rocon_uri('pc', 'bob'))[3] == system


@pytest.mark.skipif(not os.path.exists('/etc/os-release'), reason='no /etc/os-release')
def test_without_rospkg_this_machine_is_what_its_os_release_says(without_rospkg):
    script = '. /etc/os-release; echo "$VERSION_CODENAME"'
    codename = subprocess.check_output(['sh', '-c', script], universal_newlines=True).strip()
    if codename not in current().field('operating_system'):
        pytest.skip('a system without a registered codename')
    assert fields(generate_platform_rocon_uri('pc', 'bob'))[3] == codename


def test_a_robot_that_nobody_named_bears_the_name_of_its_host():
    node = os.uname().nodename
    assert default_robot_name() == node.split('.')[0]
    assert parse(generate_platform_rocon_uri('pc', default_robot_name())).name.string


# The master

@pytest.fixture
def master_says():
    """Start something that answers as the master does to getParam; where it is."""
    servers = []

    def start(answer):
        server = SimpleXMLRPCServer(('127.0.0.1', 0), logRequests=False)
        server.register_function(lambda caller, name: answer, 'getParam')
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        servers.append((server, thread))
        return 'http://127.0.0.1:%d' % server.server_address[1]
    yield start
    for server, thread in servers:
        server.shutdown()
        thread.join()
        server.server_close()


def note(capsys):
    assert main(['platform']) == 0
    return capsys.readouterr().err


@pytest.mark.parametrize('ours, theirs, says', [
    ('noetic', 'melodic\n', "'noetic' is taken, since ROS_DISTRO is 'noetic'; /rosdistro of the "
     "master is 'melodic'"),
    ('Debian', 'noetic', "'ros_other' is taken, since ROS_DISTRO is 'Debian'; /rosdistro of the "
     "master is 'noetic'"),
    ('', 'noetic', "'ros_other' is taken, since ROS_DISTRO is not set; /rosdistro of the master is "
     "'noetic'"),
])
def test_another_distribution_of_the_master_is_mentioned(
        ours, theirs, says, master_says, monkeypatch, capsys):
    monkeypatch.setattr('rocon_uri.cli.platform._PATIENCE', 30)
    monkeypatch.setenv('ROS_DISTRO', ours)
    monkeypatch.setenv('ROS_MASTER_URI', master_says([1, '', theirs]))
    assert note(capsys) == 'rocon_uri: note: %s\n' % says


@pytest.mark.parametrize('answer', [[1, '', 'noetic\n'], [1, '', 'debian'], [-1, 'not set', 0],
                                    [], 7, {'a': 1}])
def test_what_the_master_says_is_not_mentioned_where_it_does_not_matter(
        answer, master_says, monkeypatch, capsys):
    monkeypatch.setattr('rocon_uri.cli.platform._PATIENCE', 30)
    monkeypatch.setenv('ROS_DISTRO', 'noetic')
    monkeypatch.setenv('ROS_MASTER_URI', master_says(answer))
    assert note(capsys) == ''


def test_a_master_that_does_not_answer_is_none(monkeypatch, capsys):
    monkeypatch.setenv('ROS_DISTRO', 'noetic')
    with socket.socket() as silent:     # it accepts connections, and nobody looks at them
        silent.bind(('127.0.0.1', 0))
        silent.listen(1)
        monkeypatch.setenv('ROS_MASTER_URI', 'http://127.0.0.1:%d' % silent.getsockname()[1])
        started = time.monotonic()
        assert note(capsys) == ''
        assert time.monotonic() - started < 10      # 0.2 s, but the machine may be busy
    for uri in ('http://127.0.0.1:9', 'zork', 'file:///tmp', 'http://'):
        monkeypatch.setenv('ROS_MASTER_URI', uri)
        assert note(capsys) == ''
