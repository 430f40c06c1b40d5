"""What `capabilities.graph.Graph` answers: results, refusals and actions."""
from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from capabilities.instances import CapabilityInstance

__all__ = ['ENDS', 'Action', 'Do', 'RefusedRequest', 'StartResult']

ENDS = 'the capability server ends'


class RefusedRequest(RuntimeError):
    """A request that cannot be fulfilled; its text is for the client."""


class StartResult(Enum):
    """What an explicit start did; the values are those of the service."""

    SUCCESS = 0
    STARTING = 1
    RUNNING = 2
    STOPPING = 3


class Do(Enum):
    """What the runtime has to do with an instance."""

    #: make its process, and tell `Graph.launched` or `Graph.launch_failed`
    LAUNCH = 'launch'
    #: end its process; `Graph.ended` is told when it is gone
    STOP = 'stop'
    #: tell the audience the event of this name
    TELL_LAUNCHED = 'launched'
    TELL_STOPPED = 'stopped'
    TELL_TERMINATED = 'terminated'
    #: answer the requests that wait for its end
    GONE = 'gone'


class Action(NamedTuple):
    """Something to do with an instance."""

    #: what to do
    do: Do
    #: with which instance
    instance: CapabilityInstance
