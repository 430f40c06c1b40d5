"""A nodelet that its provider loads into the nodelet manager of the capability server."""
import os
import signal
import subprocess
from pathlib import Path

import pytest

from made_packages import make_package
from robot import INTERFACE, SERVER, eventually

NODELET = '''\
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <ros/ros.h>

namespace test_nodelet {
class Idle : public nodelet::Nodelet {
  void onInit() override {}
};
}
PLUGINLIB_EXPORT_CLASS(test_nodelet::Idle, nodelet::Nodelet)
'''

#: where Debian has the headers of what is one tree in /opt/ros
INCLUDE = ['/usr/include/' + name for name in (
    'pluginlib', 'class_loader', 'ament_index_cpp', 'rcutils', 'rcpputils')]

LAUNCH = '''\
<launch>
  <arg name="capability_server_nodelet_manager_name"/>
  <node pkg="nodelet" type="nodelet" name="idle"
        args="load test_nodelet/Idle $(arg capability_server_nodelet_manager_name)"/>
</launch>
'''


@pytest.fixture(scope='module')
def nodelets(tmp_path_factory):
    """A folder with a package that has a nodelet, and one that provides it as a capability."""
    packages = pytest.importorskip('roslib.packages')
    if not packages.find_node('nodelet', 'nodelet'):
        pytest.skip('package nodelet is not installed')
    folder = tmp_path_factory.mktemp('nodelets')
    package = make_package(
        folder / 'share', 'test_nodelet', [('capability_interface', 'Idle.yaml'),
                                           ('capability_provider', 'idle.yaml')])
    manifest = package / 'package.xml'
    manifest.write_text(manifest.read_text().replace(
        '  <export>\n', '  <depend>nodelet</depend>\n  <export>\n'
        '    <nodelet plugin="${prefix}/nodelets.xml"/>\n'))
    ros = Path(packages.find_node('nodelet', 'nodelet')[0]).resolve().parents[2]
    is_of_ros_2 = ros == Path('/usr') and os.path.isdir('/usr/include/ament_index_cpp')
    (package / 'nodelets.xml').write_text(
        '<library path="%s"><class name="test_nodelet/Idle" type="test_nodelet::Idle" '
        'base_class_type="nodelet::Nodelet"/></library>\n' % (
            'test_nodelet' if is_of_ros_2 else 'lib/libtest_nodelet'))
    (package / 'Idle.yaml').write_text(INTERFACE % 'Idle')
    (package / 'idle.yaml').write_text(
        'name: idle\nspec_version: 1\nspec_type: provider\nimplements: test_nodelet/Idle\n'
        'launch_file: idle.launch\nnodelet_manager: %s\n' % 'the_one_of_the_server')
    (package / 'idle.launch').write_text(LAUNCH)
    # Noetic's pluginlib finds the library below the package; Debian's, that of ROS 2, by the index
    # of ament.
    for lib in folder / 'lib', package / 'lib':
        lib.mkdir()
    (folder / 'nodelet.cpp').write_text(NODELET)
    subprocess.run(
        ['g++', '-std=c++17', '-shared', '-fPIC', 'nodelet.cpp', '-o', 'lib/libtest_nodelet.so',
         *('-I' + path for path in [*INCLUDE, str(ros / 'include')] if os.path.isdir(path)),
         '-L%s' % (ros / 'lib'), '-lnodeletlib'], cwd=str(folder), check=True)
    (package / 'lib' / 'libtest_nodelet.so').symlink_to(folder / 'lib' / 'libtest_nodelet.so')
    index = folder / 'share' / 'ament_index' / 'resource_index'
    for kind, text in (('packages', ''),
                       ('nodelet__pluginlib__plugin', 'share/test_nodelet/nodelets.xml')):
        (index / kind).mkdir(parents=True)
        (index / kind / 'test_nodelet').write_text(text)
    return folder


def test_a_nodelet_is_loaded_into_the_manager_and_with_it_again(robot, nodelets):
    """A14: what a provider of a nodelet is told, and its restart with the manager"""
    import rospy
    from nodelet.srv import NodeletList
    program = ('import os, sys\n'
               'os.environ["AMENT_PREFIX_PATH"] = %r\n'
               'sys.argv[1] += ":" + %r\n' % (str(nodelets), str(nodelets / 'share')) + SERVER)
    with robot.server(program=program) as server:
        manager = server.call('get_nodelet_manager_name').nodelet_manager_name

        def loaded():
            try:
                return rospy.ServiceProxy(manager + '/list', NodeletList)().nodelets
            except (rospy.ServiceException, OSError):       # it does not run
                return None

        assert server.call('start_capability', 'test_nodelet/Idle', '').result == 0
        eventually(lambda: loaded() == ['/idle'])
        os.kill(server.node_pid(manager.rpartition('/')[2]), signal.SIGKILL)
        eventually(lambda: ('stopped', 'Idle') in server.types())
        eventually(lambda: loaded() == ['/idle'])
        assert [(one.capability, one.state) for one in server.statuses()] == [
            ('test_nodelet/Idle', 'running')]
        assert server.call('stop_capability', 'test_nodelet/Idle').successful
        assert loaded() == []
