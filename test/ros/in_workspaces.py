"""
The two packages in workspaces of every kind. It takes minutes, so pytest is to be told its name.

It needs an environment without the packages: no setup.bash of theirs, nothing in PYTHONPATH.
"""
from __future__ import annotations

import contextlib
import os
import shutil
import signal
import socket
import subprocess
from pathlib import Path
from typing import Iterator

import pytest
from built import unless_built

ROOT = Path(__file__).resolve().parents[2]
CLIENT = Path(__file__).resolve().parent / 'workspace' / 'src' / 'contract_client'
PYTHON = '-DPYTHON_EXECUTABLE=/usr/bin/python3'

pytestmark = unless_built(
    all(map(shutil.which, ['catkin_make', 'catkin_make_isolated', 'roslaunch', 'rosmsg'])),
    'no ROS environment with catkin, roslaunch and rosmsg')

#: in both orders, from both packages
IMPORTS = ['capabilities.msg, capabilities.srv, capabilities.discovery, rocon_uri.msg',
           'rocon_uri.uri, rocon_uri.msg, capabilities.client, capabilities.msg']
#: the rosrun of Ubuntu 20.04 itself asks whether to run a script or catkin's wrapper of it: 1
COMMANDS = [
    'test -f "$(rospack find capabilities)/package.xml"',
    'test -f "$(rospack find rocon_uri)/package.xml"',
    'test "$(rosmsg md5 capabilities/CapabilityEvent)" = 5a0d82ee1a8e7a5d0b058f0b20305b18',
    'test "$(rossrv md5 capabilities/StartCapability)" = 736529805295984ddb5ab334f50db336',
    'rosrun capabilities capability_server --help <<< 1 | grep -q package_path',
    'rosrun capabilities capabilities --help <<< 1 | grep -q status',
    'rosrun rocon_uri rocon_uri parse rocon:/pr2 <<< 1 >/dev/null',
    'roslaunch capabilities capability_server.launch --nodes | grep -qx /capability_server',
    *('/usr/bin/python3 -c "import %s"' % modules for modules in IMPORTS)]


def environment(folder: Path) -> 'dict[str, str]':
    """That of this process, without a built package; catkin_make believes PWD."""
    kept = dict(os.environ, PWD=str(folder), ROS_HOME=str(folder / 'ros_home'), ROS_IP='127.0.0.1')
    for name in 'CMAKE_PREFIX_PATH', 'PYTHONPATH', 'ROS_PACKAGE_PATH', 'ROS_HOSTNAME':
        if 'opt/ros' not in kept.get(name, ''):
            kept.pop(name, None)
    return kept


def succeed(folder: Path, *command: str) -> str:
    done = subprocess.run(command, cwd=str(folder), env=environment(folder), text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    return done.stdout


def in_space(space: Path, command: str) -> 'list[str]':
    return ['bash', '-c', '. "%s/setup.bash" && %s' % (space, command)]


def check(space: Path, folder: Path) -> None:
    """Everything that is found by name is found, in a devel or install space."""
    for command in COMMANDS:
        succeed(folder, *in_space(space, command))
    succeed(folder, 'bash', '--norc', '-ic', '. "%s/setup.bash" && %s' % (
        space, 'complete -p rosrun | grep -q _rocon_uri_rosrun && test -x "$_rocon_uri_script"'))


@contextlib.contextmanager
def launched(space: Path, folder: Path, launch: str) -> 'Iterator[str]':
    """What roslaunch starts, with a master of its own, whose URI as a shell sets it is given."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        port = probe.getsockname()[1]
    process = subprocess.Popen(
        in_space(space, 'exec roslaunch -p %d %s' % (port, launch)),
        env=environment(folder), cwd=str(folder), stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        yield 'ROS_MASTER_URI=http://127.0.0.1:%d' % port
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()


def use_from_cpp(space: Path, folder: Path) -> None:
    """The contract of the server holds for a client in C++ that knows nothing else of it."""
    packages = folder / 'packages'
    shutil.copytree(str(CLIENT / 'fixtures'), str(packages))
    for node in packages.glob('*/nodes/*'):
        node.chmod(0o755)
    with launched(space, folder, '%s packages:=%s' % (CLIENT / 'contract.launch', packages)) as at:
        said = succeed(folder, *in_space(
            space, '%s timeout 400 rosrun contract_client contract_client /capability_server %s'
            % (at, packages)))
        assert 'FAILED' not in said, said


def run_demo(space: Path, folder: Path) -> None:
    with launched(space, folder, 'capabilities demo.launch') as at:
        command = at + ' rosrun capabilities capabilities '
        succeed(folder, *in_space(space, 'for _ in {1..300}; do %sstatus && break; sleep 0.2; done '
                                         '&& %sstart demo_robot/Camera' % (command, command)))


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A workspace with the two packages and the C++ client."""
    (tmp_path / 'src').mkdir()
    (tmp_path / 'src' / 'rocon_uri').symlink_to(ROOT)
    shutil.copytree(str(CLIENT), str(tmp_path / 'src' / 'contract_client'))
    return tmp_path


@pytest.mark.parametrize('with_symlink', [False, True])
def test_catkin_make(workspace: Path, with_symlink: bool) -> None:
    if with_symlink:
        (workspace / 'src' / 'capabilities').symlink_to('rocon_uri/capabilities')
        # so that it need not be told that it comes second
        manifest = workspace / 'src' / 'contract_client' / 'package.xml'
        manifest.write_text(manifest.read_text().replace(
            '<build_depend>rocon_uri<', '<build_depend>capabilities<'))
    succeed(workspace, 'catkin_make', PYTHON)
    check(workspace / 'devel', workspace)
    if with_symlink:
        return
    use_from_cpp(workspace / 'devel', workspace)
    succeed(workspace, 'catkin_make', 'install')
    check(workspace / 'install', workspace)
    run_demo(workspace / 'install', workspace)


def test_catkin_make_isolated(workspace: Path) -> None:
    succeed(workspace, 'catkin_make_isolated', '--install', PYTHON)
    check(workspace / 'devel_isolated', workspace)
    check(workspace / 'install_isolated', workspace)


def test_plain_cmake(tmp_path: Path) -> None:
    build = tmp_path / 'build'
    succeed(tmp_path, 'cmake', '-S', str(ROOT), '-B', str(build), PYTHON,
            '-DCMAKE_INSTALL_PREFIX=%s' % (tmp_path / 'install'))
    succeed(tmp_path, 'cmake', '--build', str(build), '--target', 'install')
    check(build / 'devel', tmp_path)
    check(tmp_path / 'install', tmp_path)


def test_without_the_server(tmp_path: Path) -> None:
    build = tmp_path / 'build'
    said = succeed(tmp_path, 'cmake', '-S', str(ROOT), '-B', str(build), PYTHON,
                   '-DROCON_URI_CAPABILITIES=OFF')
    assert 'rocon_uri: without the capability server' in said
    succeed(tmp_path, 'cmake', '--build', str(build))
    succeed(tmp_path, *in_space(build / 'devel',
                                '/usr/bin/python3 -c "import rocon_uri.msg, capabilities.specs"'))
    assert not (build / 'devel' / 'share' / 'capabilities').exists()
