"""
Conversion between a RoconURI and the ROS message ``rocon_uri/RoconURI``.

Building the package generates the class of the message. It is imported only when it is needed,
since the rest of the package works without ROS.
"""
from __future__ import annotations

from rocon_uri.parts import FIELDS
from rocon_uri.uri import RoconURI

TYPE_CHECKING = False
if TYPE_CHECKING:
    from rocon_uri.msg import RoconURI as Message

__all__ = ['from_msg', 'to_msg']


def to_msg(uri: RoconURI) -> Message:
    """
    The message with the content of a URI.

    :param RoconURI uri: any
    :returns: ``rocon_uri.msg.RoconURI``
    :raises ImportError: where the messages of this package have not been built

    >>> from rocon_uri import parse
    >>> to_msg(parse('rocon:/turtlebot2|pr2/bob')).hardware_platform
    ['turtlebot2', 'pr2']
    """
    from rocon_uri.msg import RoconURI as Message
    return Message(concert_name=uri.concert_name,
                   hardware_platform=uri.hardware_platform.list,
                   name=uri.name.string,
                   application_framework=uri.application_framework.list,
                   operating_system=uri.operating_system.list,
                   rocon_app=uri.rocon_app)


def from_msg(msg: Message) -> RoconURI:
    """
    The URI with the content of a message, checked as :func:`rocon_uri.parse` checks a text.

    Each string of the message is one value: ``/``, ``|``, ``#`` and ``%`` are not read as syntax.
    An empty list and an empty name are ``*``.

    :param msg: ``rocon_uri.msg.RoconURI``; its content need not be trusted
    :returns: RoconURI, equal to the one that the message was made from
    :raises RoconURIValueError: for a field that is not legal

    >>> from rocon_uri import parse
    >>> from_msg(to_msg(parse('rocon:/pr2/bob'))) == parse('rocon:/pr2/bob')
    True
    """
    return RoconURI.from_fields(**{field: getattr(msg, field) for field in FIELDS})
