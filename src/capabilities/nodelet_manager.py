"""The nodelet manager: its name, its launch file, and whether it can be started."""
import logging
import os
import sys
from typing import Any, Optional, Tuple

__all__ = ['ARGUMENT', 'LAUNCH_FILE', 'is_installed', 'manager_name', 'server_name']

#: the argument that tells a launch file its name
ARGUMENT = 'capability_server_nodelet_manager_name'
LAUNCH_FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'nodelet_manager.launch')

_LOG = logging.getLogger('rosout')      # rospy's own once a node is initialised


def server_name() -> Tuple[str, str]:
    """Namespace and base name of this node; without one, those that the server would have."""
    rospy: Any = sys.modules.get('rospy')
    if rospy is not None and rospy.core.is_initialized():
        namespace, _, base_name = rospy.get_name().rpartition('/')
        return namespace or '/', base_name
    return os.environ.get('ROS_NAMESPACE') or '/', 'capability_server'


def manager_name(given: Optional[str]) -> str:
    """The name with its namespace, which is that of this node; None stands for the usual one."""
    namespace, node = server_name()
    name = given or node + '_nodelet_manager'
    return name if name.startswith('/') else '/' + '/'.join(
        [part for part in namespace.split('/') if part] + [name])


def is_installed() -> bool:
    """Is package nodelet installed? Logs a warning if it is not."""
    try:
        import roslib.packages
        if roslib.packages.find_node('nodelet', 'nodelet'):
            return True
    except Exception:       # without roslib or the package, and whatever a broken workspace raises
        pass
    _LOG.warning('package nodelet is not installed, so no nodelet manager is started')
    return False
