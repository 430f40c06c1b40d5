"""The earlier path of `capabilities.planning.providers`."""
from capabilities.planning.providers import *  # noqa: F401,F403
