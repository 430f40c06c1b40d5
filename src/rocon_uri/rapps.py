"""The earlier path of `rocon_uri.apps.rapps`."""
from rocon_uri.apps.rapps import *  # noqa: F401,F403
