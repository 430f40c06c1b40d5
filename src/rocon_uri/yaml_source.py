"""The earlier path of `rocon_uri.sources.yaml_source`."""
from rocon_uri.sources.yaml_source import *  # noqa: F401,F403
