"""The faults that prevent the launch of the providers of a plan."""
from __future__ import annotations

import os
from typing import Callable, Dict, Iterable, List, NamedTuple, Optional

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.plan import RunningProvider
from capabilities.spec_index import SpecIndex
from capabilities.specs.provider import CapabilityProvider
from rocon_uri.sources.launch_file import LaunchFile

__all__ = ['Launches', 'LookAt']

#: As `LaunchFiles.look_at`: takes the name of a launch file and the folder that it is relative to.
#: It returns None for a file that was never read, and is not to be read now.
LookAt = Callable[[str, str], Optional[LaunchFile]]


class _Launch(NamedTuple):
    """A provider that is to be launched."""

    #: what it implements
    capability: str
    #: its name
    provider: str
    #: the capability that was asked for, and needs it
    asked_for: str


class Launches:
    """
    The providers that a plan launches, and the faults found.

    A launch file is relative to the folder of the provider's spec. It cannot run twice at a time,
    since the names of its nodes would clash.

    :param SpecIndex spec_index: the index that has the specs
    :param running: iterable of `RunningProvider`, whose launch files are in use
    :param look_at: says what is against a launch file; None where that does not matter
    :param bool nodelet_manager: is there one?
    """

    def __init__(self, spec_index: SpecIndex, running: Iterable[RunningProvider],
                 look_at: Optional[LookAt], nodelet_manager: bool) -> None:
        self.unread: List[str] = []
        self._spec_index = spec_index
        self._look_at = look_at
        self._nodelet_manager = nodelet_manager
        self._faults: List[Fault] = []
        self._in_use: Dict[str, List[RunningProvider]] = {}
        for one in running:
            if one.launch_file is not None:
                self._in_use.setdefault(one.launch_file, []).append(one)
        self._launched: Dict[str, List[_Launch]] = {}

    def add(self, capability: str, spec: CapabilityProvider, asked_for: str) -> Optional[str]:
        """
        Add a provider.

        :returns: str, the real path of its launch file; None if it has none, or it does not exist
        """
        launch = _Launch(capability=capability, provider=spec.name, asked_for=asked_for)
        if spec.nodelet_manager and not self._nodelet_manager:
            self._faults.append(Fault(kind=FaultKind.NO_NODELET_MANAGER, capability=capability,
                                      asked_for=asked_for, provider=spec.name))
        if self._look_at is None or not spec.launch_file:
            return None
        folder = os.path.dirname(self._spec_index.provider_path(spec.name))
        file = self._look_at(spec.launch_file, folder)
        if file is None:
            self.unread.append(os.path.join(folder, spec.launch_file))
            return None
        if file.fault is not None:
            self._faults.append(Fault(kind=FaultKind(file.fault.kind), capability=capability,
                                      asked_for=asked_for, provider=spec.name, launch=file.fault))
        if file.real_path is not None:
            self._launched.setdefault(file.real_path, []).append(launch)
        return file.real_path

    def all_faults(self) -> List[Fault]:
        """The faults of the single providers, then of launch files that several of them share."""
        return self._faults + [fault for path in self._launched for fault in self._shared(path)]

    def _shared(self, path: str) -> Iterable[Fault]:
        launched = self._launched[path]
        capabilities = {launch.capability for launch in launched}
        providers = tuple(launch.provider for launch in launched)
        in_use = [one for one in self._in_use.get(path, ()) if one.capability not in capabilities]
        if not in_use and len(launched) == 1:
            return
        running = in_use[0].provider if in_use else None
        yield Fault(kind=FaultKind.LAUNCH_SHARED, capability=launched[-1].capability,
                    asked_for=launched[-1].asked_for, provider=providers[-1], launch_file=path,
                    running=running, sharers=(() if running is None else (running,)) + providers)
