"""
Capabilities that run, or are on their way: one `CapabilityInstance` each, and its states.

    waiting --launch()--> launching --launched(pid)--> running --stopped()--> stopping --> gone
       |                      |                           |                     ^
       cancel()               +---------stopped()---------+---------------------+

Nothing here knows ROS, and nothing starts or ends a process; `capabilities.graph` decides that.
"""
from __future__ import annotations

import logging
from enum import Enum
from typing import NamedTuple, Tuple

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterable, List, Optional

    from capabilities.specs.provider import CapabilityProvider

__all__ = ['NO_EXIT_CODE', 'USER_SERVICE_REASON', 'CapabilityInstance', 'Failure', 'State',
           'get_reverse_depends']

#: the ``started_by`` of what a service call started
USER_SERVICE_REASON = 'user service call'

NO_EXIT_CODE = -1

_logger = logging.getLogger('rosout.capabilities')     # rospy shows what is logged below 'rosout'


class State(str, Enum):
    """
    What an instance is doing. Each is a str, and equal to its text.

    >>> State.RUNNING == 'running'
    True
    """

    #: it waits for a dependency to have a process, or for its predecessor to end
    WAITING = 'waiting'
    #: its roslaunch exists, and has not yet reported that it started the nodes
    LAUNCHING = 'launching'
    RUNNING = 'running'
    #: one of its nodes or dependencies has died
    DEGRADED = 'degraded'
    #: it is to end, or is ending
    STOPPING = 'stopping'
    #: its process has ended
    TERMINATED = 'terminated'

    __str__ = str.__str__


class Failure(NamedTuple):
    """
    What the status remembers of a capability that ended unasked, or could not start.

    >>> Failure('nav/Nav', 'nav/amcl', True, 0, (), 12.5, 1, 'exit 1, unexpected').started
    True
    """

    #: the name of its interface
    interface: str
    #: '' if none had been chosen
    provider: str
    #: was it started explicitly?
    started: bool
    #: how many uses it had
    uses: int
    #: what depended on it, by name
    dependents: Tuple[str, ...]
    #: when it failed, in seconds since 1970
    since: float
    #: `NO_EXIT_CODE` if no process of its own ended
    exit_code: int
    #: why it ended, or could not start
    text: str


class CapabilityInstance:
    """
    One capability that runs, is to run, or is ending.

    :param CapabilityProvider provider: the spec that runs it; kept as it is, whatever a reload does
    :param str provider_path: the file of the spec
    :param str started_by: `USER_SERVICE_REASON`, or the provider that depends on it
    :param redefines: str, the interface that its (semantic) interface redefines, or None
    :param launch_file: str, the real path of its launch file, or None
    :param depends_on: the names of the capabilities that it depends on; None for those of the spec
    :param bool uses_nodelet_manager: is it to be restarted with the nodelet manager?

    - ``name``, ``provider`` (str): the provider's name; ``interface`` (str): what it implements
    - ``spec`` (`CapabilityProvider`), ``provider_path``, ``started_by``, ``redefines``,
      ``launch_file``, ``depends_on`` (list of str), ``uses_nodelet_manager``: as given
    - ``pid`` (int or None), ``since`` (float): of the state, in seconds since 1970
    - ``canceled`` (bool): was it dropped before it was launched?
    - ``started`` (bool): was it started explicitly?
    - ``bonds`` (dict from bond id to int): its uses; ``asked_as`` (dict from bond id and name to
      int): how many of them were asked for by the name of the interface that is redefined
    - ``dependencies`` (list of `CapabilityInstance`): the instances that it depends on
    - ``notes`` (dict of str): texts for the status, by node or capability
    - ``stop_sent`` (bool): has its process been told to end?
    - ``failure`` (`Failure` or None): what to remember when it is gone
    """

    def __init__(self, provider: CapabilityProvider, provider_path: str,
                 started_by: str = 'unknown', redefines: Optional[str] = None,
                 launch_file: Optional[str] = None,
                 depends_on: Optional[Iterable[str]] = None,
                 uses_nodelet_manager: bool = False) -> None:
        self.spec = provider
        self.name = self.provider = provider.name
        self.provider_path = provider_path
        self.interface = provider.implements
        self.redefines = redefines
        self.launch_file = launch_file
        self.depends_on: List[str] = list(
            provider.dependencies if depends_on is None else depends_on)
        self.uses_nodelet_manager = uses_nodelet_manager
        self.started_by = started_by
        self._state = State.WAITING
        self.since = 0.0
        self.pid: Optional[int] = None
        self.canceled = False
        self.started = False
        self.bonds: Dict[str, int] = {}
        self.asked_as: Dict[Tuple[str, str], int] = {}
        self.dependencies: List[CapabilityInstance] = []
        self.notes: Dict[str, str] = {}
        self.stop_sent = False
        self.failure: Optional[Failure] = None

    @property
    def state(self) -> State:
        """What it is doing (`State`)."""
        return self._state

    # what old tests set
    _CapabilityInstance__state = property(
        lambda self: self._state, lambda self, state: setattr(self, '_state', State(state)))

    @property
    def reference_count(self) -> int:
        """The uses of all bonds (int)."""
        return sum(self.bonds.values())

    @property
    def is_up(self) -> bool:
        """Is it listed as running, and may what depends on it start? (bool)"""
        return self.pid is not None and self._state in (
            State.LAUNCHING, State.RUNNING, State.DEGRADED)

    def add_use(self, bond_id: str, asked_as: str) -> None:
        """Count one more use by a bond, asked for by this name."""
        self.bonds[bond_id] = self.bonds.get(bond_id, 0) + 1
        if asked_as != self.interface:
            key = bond_id, asked_as
            self.asked_as[key] = self.asked_as.get(key, 0) + 1

    def remove_use(self, bond_id: str, asked_as: str) -> None:
        """Remove a use by a bond, preferably one that was asked for by this name."""
        key = bond_id, asked_as
        self.bonds[bond_id] -= 1
        by_other_names = sum(count for (bond, _), count in self.asked_as.items() if bond == bond_id)
        if key not in self.asked_as and by_other_names > self.bonds[bond_id]:
            key = next(key for key in self.asked_as if key[0] == bond_id)
        if key in self.asked_as:
            self.asked_as[key] -= 1
            if not self.asked_as[key]:
                del self.asked_as[key]
        if not self.bonds[bond_id]:
            del self.bonds[bond_id]

    def drop_wants(self, bond_id: Optional[str] = None) -> None:
        """Forget the uses of one bond, or all of them and the explicit start."""
        if bond_id is None:
            self.started = False
            self.bonds.clear()
            self.asked_as.clear()
        elif self.bonds.pop(bond_id, 0):
            for key in [key for key in self.asked_as if key[0] == bond_id]:
                del self.asked_as[key]

    def successor(self) -> CapabilityInstance:
        """An instance that waits to take its place, with its wants and dependencies."""
        successor = CapabilityInstance(self.spec, self.provider_path, self.started_by,
                                       self.redefines, self.launch_file, self.depends_on,
                                       self.uses_nodelet_manager)
        successor.started = self.started
        successor.bonds = dict(self.bonds)
        successor.asked_as = dict(self.asked_as)
        successor.dependencies = list(self.dependencies)
        return successor

    def cancel(self) -> bool:
        """Drop it before it is launched; False, and an error is logged, if it is too late."""
        if self._state is not State.WAITING:
            return self._refused('cancel')
        self.canceled = True
        return True

    def launch(self) -> bool:
        """Its process is about to be made; False, and an error is logged, unless it waits."""
        return self._move('launch', State.LAUNCHING, State.WAITING)

    def launched(self, pid: int) -> bool:
        """Its nodes were started; False, and an error is logged, unless it is launching."""
        if not self._move('set to running', State.RUNNING, State.LAUNCHING):
            return False
        self.pid = pid
        return True

    def degraded(self) -> bool:
        """Something in it died; False, and an error is logged, unless it runs."""
        return self._move('set to degraded', State.DEGRADED, State.LAUNCHING, State.RUNNING,
                          State.DEGRADED)

    def stopped(self) -> bool:
        """It is to end; False, and an error is logged, unless it has a process."""
        return self._move('stop', State.STOPPING, State.LAUNCHING, State.RUNNING, State.DEGRADED)

    def terminated(self) -> bool:
        """Its process has ended; False, and an error is logged, if that was not asked for."""
        expected = self._state is State.STOPPING
        if not expected:
            self._refused('end')
        self.ended()
        return expected

    def ended(self) -> None:
        """Its process has ended, asked for or not."""
        self._state = State.TERMINATED

    def _move(self, verb: str, state: State, *earlier: State) -> bool:
        if self._state not in earlier:
            return self._refused(verb)
        self._state = state
        return True

    def _refused(self, verb: str) -> bool:
        _logger.error("Cannot %s provider '%s' of capability '%s', which is %s.",
                      verb, self.name, self.interface, self._state.value)
        return False

    def __repr__(self) -> str:
        return '<CapabilityInstance %s by %s, %s>' % (
            self.interface, self.provider, self._state.value)


def get_reverse_depends(name: str, instances: Iterable[CapabilityInstance]
                        ) -> List[CapabilityInstance]:
    """
    The instances that depend on a capability directly.

    :param str name: the name of the capability
    :param instances: iterable of `CapabilityInstance`
    :returns: list of them

    >>> get_reverse_depends('base/Base', [])
    []
    """
    return [instance for instance in instances if name in instance.depends_on]
