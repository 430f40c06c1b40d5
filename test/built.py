"""What catkin makes: where it was asked to, no test of that is skipped."""
from __future__ import annotations

import importlib
import os
from typing import Any

import pytest

#: the packages that were built, as the tests are told by who built them
PACKAGES = os.environ.get('ROCON_URI_BUILT', '').split(',')

#: what rosbash has for bash, where Debian and where Ubuntu 20.04 has it; None where nobody has
ROSBASH = next(filter(os.path.exists, ['/usr/share/bash-completion/completions/rosbash',
                                       '/etc/bash_completion.d/rosbash']), None)


def built(module: str) -> Any:
    """A module that catkin makes of messages. Tests that need it are skipped without a build."""
    if module.partition('.')[0] in PACKAGES:
        return importlib.import_module(module)
    return pytest.importorskip(module, reason='%s has not been built' % module)


def unless_built(is_there: bool, reason: str) -> Any:
    """Skip the tests of what is not there, but not where it was built."""
    return pytest.mark.skipif(not is_there and 'rocon_uri' not in PACKAGES, reason=reason)
