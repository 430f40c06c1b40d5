"""
The rocon URI of this machine.

A robot needs it to announce itself, a remocon to say where it runs. The caller gives the type and
the name; the application framework and the operating system are found out here.
"""
from __future__ import annotations

import os

from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.grammar import NAME_LIMIT
from rocon_uri.sources.ros_names import legalised
from rocon_uri.sources.wording import quoted
from rocon_uri.vocabulary import complete, current

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterable, List, Optional, Tuple

__all__ = ['default_robot_name', 'default_robot_type', 'generate_platform_rocon_uri']

#: The hardware platform of a machine if none is given.
default_robot_type = 'pc'

_OS_RELEASE_FILES = ('/etc/os-release', '/usr/lib/os-release')
_CODENAMES = ('VERSION_CODENAME', 'UBUNTU_CODENAME', 'DEBIAN_CODENAME')     # in os-release(5)


def generate_platform_rocon_uri(robot_type: str, robot_name: str) -> str:
    """
    The rocon URI of this machine, all four fields of it.

    The type and the name are made legal. The type need not be registered: parsing the text reports
    that. The application framework is ``ROS_DISTRO`` if that is registered, else ``ros_other``.
    The operating system is the first registered one of the release, the distribution and those
    that it is like, as rospkg's ``os_detect`` and os-release(5) name them, or ``linux``.

    :param str robot_type: the hardware platform, as ``'turtlebot2'``
    :param str robot_name: the name of this robot
    :returns: str, as ``'rocon:/pc/bob/noetic/focal'``
    :raises RoconURIValueError: if the type or the name is empty

    >>> generate_platform_rocon_uri('turtlebot2', 'Cybernetic Pirate').split('/')[:3]
    ['rocon:', 'turtlebot2', 'cybernetic_pirate']
    """
    return 'rocon:/%s/%s/%s/%s' % (_legal_name(robot_type, 'hardware_platform'),
                                   _legal_name(robot_name, 'name'),
                                   _application_framework(), _operating_system())


def default_robot_name() -> str:
    """
    The default name of a robot: this machine's host name, without its domain.

    :returns: str, to be made legal by :func:`generate_platform_rocon_uri`; never empty

    >>> '.' in default_robot_name()
    False
    """
    import platform     # slow to import, and only two functions need it
    return platform.node().partition('.')[0] or 'localhost'


def _legal_name(text: str, field: str) -> str:
    if not text:
        raise RoconURIValueError('%s %s is empty, expected at least one character'
                                 % (field, quoted(text)), field=field)
    return legalised(text)[:NAME_LIMIT]


def _application_framework() -> str:
    distribution = os.environ.get('ROS_DISTRO', '')     # Debian's ROS sets it to 'Debian'
    return _first_registered('application_framework', [distribution]) or 'ros_other'


def _operating_system() -> str:
    names = [name.lower() for name in _system_names()]
    return _first_registered('operating_system', names) or 'linux'


def _first_registered(field: str, names: Iterable[str]) -> Optional[str]:
    for name in filter(None, names):
        if name in current().field(field) or name in complete().field(field):
            return name
    return None


def _system_names() -> List[str]:
    """
    The names that this system may have in the vocabulary, the most exact one first.

    The order is the same with and without rospkg, which knows fewer derivatives.
    """
    import platform     # as in default_robot_name
    name, codename = _detected_by_rospkg()
    system, release = platform.system(), platform.release()
    if name and os.environ.get('ROS_OS_OVERRIDE'):      # then this system does not matter
        return [codename, name + codename, name]
    if system != 'Linux':
        return [codename, name + codename, name, system + release,
                {'Darwin': 'osx'}.get(system, system)]
    facts = _os_release()
    return [codename, *(facts.get(key, '') for key in _CODENAMES), name + codename, name,
            facts.get('ID', ''), *facts.get('ID_LIKE', '').split()]


def _detected_by_rospkg() -> Tuple[str, str]:
    """The name of the system and of its release, '' for what cannot be detected."""
    try:
        import rospkg.os_detect     # slow to import, and missing without ROS
        name, _, codename = rospkg.os_detect.OsDetect().detect_os()
        return name, codename
    except Exception:       # a robot has a URI even if a detector fails
        return '', ''


def _os_release() -> Dict[str, str]:
    """The variables of the first os-release(5) file that can be read."""
    for path in _OS_RELEASE_FILES:
        try:
            with open(path, encoding='utf-8', errors='replace') as lines:
                pairs = [line.strip().partition('=') for line in lines]
        except OSError:
            continue
        return {key: value.strip('\'"') for key, _, value in pairs}
    return {}
