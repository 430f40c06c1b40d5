"""The earlier path of `rocon_uri.sources.ros_names`."""
from rocon_uri.sources.ros_names import *  # noqa: F401,F403
