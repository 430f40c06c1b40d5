"""
The name checks of ``rosgraph.names`` and ``roslib.names``, without importing ROS.

They answer as the originals do, except for letters outside ASCII: on Python 3 the originals accept
them; roscpp and these do not. The length is not limited.
"""
from __future__ import annotations

import re

__all__ = ['is_legal_base_name', 'is_legal_name', 'is_legal_resource_name', 'legalised']


def is_legal_base_name(name: str | None) -> bool:
    """
    Is this a name without a namespace, like a robot's: a letter, then letters, digits and ``_``?

    :param str name: the name; ``None`` is not legal
    :returns: bool

    >>> is_legal_base_name('bob_7'), is_legal_base_name('7bob'), is_legal_base_name('a/bob')
    (True, False, False)
    """
    # as [A-Za-z]\w* in re, in half the time
    return name is not None and name.isascii() and name.isidentifier() and name[0] != '_'


def is_legal_resource_name(name: str | None) -> bool:
    """
    Is this the name of something in a package, such as ``rocon_apps/teleop``?

    It accepts more than a rocon URI accepts as its ``rocon_app``: ``a/b/c`` and ``a/`` too, as
    ``roslib.names`` does.

    :param str name: the name; ``None`` is not legal
    :returns: bool

    >>> is_legal_resource_name('rocon_apps/teleop'), is_legal_resource_name('/teleop')
    (True, False)
    """
    return (name is not None and '//' not in name
            and re.fullmatch(r'[A-Za-z][\w/]*', name, re.ASCII) is not None)


def is_legal_name(name: str | None) -> bool:
    """
    Is this a name in the ROS graph, such as that of a topic: global, private, relative or empty?

    :param str name: the name; ``None`` is not legal
    :returns: bool

    >>> is_legal_name('/camera/image_raw'), is_legal_name('~rate'), is_legal_name('a//b')
    (True, True, False)
    """
    if not name:
        return name == ''
    return '//' not in name and re.fullmatch(r'[~/A-Za-z][\w/]*', name, re.ASCII) is not None


def legalised(name: str) -> str:
    """
    A base name made of any text: in lower case, with ``_`` for every character that is not allowed.

    An ``r`` is put before a text that is empty or starts with a digit or ``_``.

    :param str name: any
    :returns: str

    >>> legalised('R2-D2'), legalised('3po'), legalised('bob')
    ('r2_d2', 'r3po', 'bob')
    """
    legal = re.sub('[^a-z0-9_]', '_', name.lower())
    return legal if is_legal_base_name(legal) else 'r' + legal
