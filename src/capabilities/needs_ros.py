"""
What the runtime modules import first: it says in one line what of ROS is missing.

Specs, discovery and planning do without ROS.
"""
from __future__ import annotations

import sys
from importlib import import_module

__all__: 'list[str]' = []

for _name in ('rospy', 'rosgraph', 'bondpy.bondpy', 'std_srvs.srv', 'capabilities.msg',
              'capabilities.srv'):
    try:
        if _name == 'bondpy.bondpy':    # that of Ubuntu 20.04 itself asks for it as Python 2 does
            sys.modules.setdefault('BondSM_sm', import_module('bondpy.BondSM_sm'))
        _module = import_module(_name)
    except ImportError as error:
        raise ImportError('the capability server and its client need ROS, and %s cannot be '
                          'imported (%s): is a workspace sourced?' % (_name, error)) from None

if not hasattr(_module, 'GetStatus'):
    raise ImportError('the messages of the old package capabilities, in %s, come before those of '
                      'this one on the path: remove the old package' % _module.__file__)
