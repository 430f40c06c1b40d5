"""The status of each capability that is wanted, is ending or has failed."""
from __future__ import annotations

from typing import Dict, List, NamedTuple, Tuple

from capabilities.instances import NO_EXIT_CODE
from capabilities.roster import Roster

__all__ = ['FAILED', 'StatusEntry', 'status_entries']

#: the state of a capability that ended unasked or could not start; it has no instance
FAILED = 'failed'


class StatusEntry(NamedTuple):
    """
    One capability, as in the message ``CapabilityStatus``.

    >>> StatusEntry('nav/Nav', 'nav/amcl', FAILED, True, 0, (), 0, 12.5, 1, 'exit 1').state
    'failed'
    """

    #: its name
    capability: str
    #: the name of its provider
    provider: str
    #: that of its `State`, or `FAILED`
    state: str
    #: was it started explicitly?
    started: bool
    #: how many uses it has
    uses: int
    #: the names of its direct dependents
    dependents: Tuple[str, ...]
    #: 0 where there is no process
    pid: int
    #: since when it is in this state, in seconds since 1970
    since: float
    #: -1 if there is none
    exit_code: int
    #: notes and reasons, for a person
    text: str


def status_entries(roster: Roster) -> List[StatusEntry]:
    """
    The entries of all capabilities that are wanted, are ending or have failed.

    :param Roster roster: the graph
    :returns: list of `StatusEntry`, failures last

    >>> status_entries(Roster(lambda: 0.0))
    []
    """
    dependents: Dict[int, Dict[str, None]] = {}     # names, which keep their order, by id
    for instance in roster.instances:
        for dependency in instance.dependencies:
            dependents.setdefault(id(dependency), {})[instance.interface] = None
    entries = [StatusEntry(
        capability=instance.interface, provider=instance.provider, state=instance.state.value,
        started=instance.started, uses=instance.reference_count,
        dependents=tuple(dependents.get(id(instance), ())), pid=instance.pid or 0,
        since=instance.since, exit_code=NO_EXIT_CODE, text='; '.join(instance.notes.values()))
        for instance in roster.instances]
    for failure in roster.failures.values():
        entries.append(StatusEntry(
            capability=failure.interface, provider=failure.provider, state=FAILED,
            started=failure.started, uses=failure.uses, dependents=failure.dependents, pid=0,
            since=failure.since, exit_code=failure.exit_code, text=failure.text))
    return entries
