"""The earlier path of `capabilities.planning.faults`."""
from capabilities.planning.faults import *  # noqa: F401,F403
