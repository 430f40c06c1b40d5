"""What stands in the way of starting a capability, one `Fault` for each thing."""
from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Collection, Dict, List, Optional, Tuple, Union

from rocon_uri.sources import launch_file
from rocon_uri.sources.launch_file import LaunchFault
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted, quoted_path

__all__ = ['Fault', 'FaultKind']


class FaultKind(Enum):
    """The kinds of faults. The value is a stable id."""

    #: no package exports the capability
    NO_INTERFACE = 'no-interface'
    #: no provider implements it
    NO_PROVIDER = 'no-provider'
    #: no package exports the provider that is preferred, or the default
    UNKNOWN_PROVIDER = 'unknown-provider'
    #: the provider that is preferred, or the default, implements something else
    WRONG_PROVIDER = 'wrong-provider'
    #: several providers implement it, and none of them is named
    AMBIGUOUS = 'ambiguous'
    #: several providers are preferred for it, or would have to run at once
    CONFLICT = 'conflict'
    #: providers depend on each other in a circle
    CYCLE = 'cycle'
    #: a provider needs a nodelet manager, and the server has none
    NO_NODELET_MANAGER = 'no-nodelet-manager'
    #: the launch file of a provider is not there
    LAUNCH_MISSING = launch_file.MISSING
    #: it is not in the provider's package
    LAUNCH_OUTSIDE = launch_file.OUTSIDE
    #: it is not a file, cannot be opened, or is too large
    LAUNCH_UNREADABLE = launch_file.UNREADABLE
    #: it is not XML
    LAUNCH_NOT_XML = launch_file.NOT_XML
    #: it does not have exactly one ``<launch>``, at its top
    LAUNCH_NO_LAUNCH = launch_file.NO_LAUNCH
    #: it is that of another provider too, which runs or would have to run at once
    LAUNCH_SHARED = 'launch-shared'


@dataclass(frozen=True, repr=False)
class Fault:
    """
    A fault: one reason why a capability cannot be started. Its text is one line.

    >>> fault = Fault(FaultKind.NO_PROVIDER, 'ours/Map', 'ours/Drive', required_by='ours/base')
    >>> print(fault)
    provider 'ours/base' depends on 'ours/Map': no provider implements it
    >>> print(fault.reason)
    capability 'ours/Drive' cannot be started: provider 'ours/base' depends on 'ours/Map': \
no provider implements it
    """

    #: the kind of the fault
    kind: FaultKind
    #: the capability that cannot be had
    capability: str
    #: the capability that was asked for, and led here (first, if several do)
    asked_for: str
    #: the provider that depends on it; None for what is asked for itself, and for the kinds from
    #: `FaultKind.CONFLICT` on
    required_by: Optional[str] = None
    #: the provider that is named for it, where that is at fault, or that cannot be started
    provider: Optional[str] = None
    #: is ``provider`` the default, and not what ``required_by`` prefers?
    is_default: bool = False
    #: what ``provider`` implements instead
    implements: Optional[str] = None
    #: the providers that implement the capability; in a conflict, those that would have to run
    candidates: Tuple[str, ...] = ()
    #: the providers of semantic interfaces that redefine it, where no other implements it
    semantic_candidates: Tuple[str, ...] = ()
    #: the providers of a cycle, the first one again at the end
    cycle: Tuple[str, ...] = ()
    #: what is against the launch file of ``provider``
    launch: Optional[LaunchFault] = None
    #: the launch file that several providers have
    launch_file: Optional[str] = None
    #: the providers that have it
    sharers: Tuple[str, ...] = ()
    #: of those, the one that runs already; None where none does
    running: Optional[str] = None
    #: what could have stood in place of the name that is not there
    known: Collection[str] = field(default=(), compare=False)

    @property
    def suggestions(self) -> List[str]:
        """
        What was probably meant by the name that is not there: a list of at most three str.

        They are looked for when they are asked for, since that takes long among many names.
        """
        return near_misses(self.provider or self.capability, self.known)

    @property
    def is_of_the_capability(self) -> bool:
        """Is the fault of the capability that was asked for, and not of a dependency?"""
        return self.required_by is None and self.kind in _OF_THE_CAPABILITY

    @property
    def reason(self) -> str:
        """
        The fault as a reason why what was asked for cannot be started (str of one line).

        ``rocon_uri apps`` and the capability server both show this.
        """
        if self.is_of_the_capability:
            return str(self)
        return 'capability %s cannot be started: %s' % (quoted(self.asked_for), self)

    def to_dict(self) -> Dict[str, Union[None, bool, int, str, List[str]]]:
        """
        The fault as plain data.

        :returns: dict of the attributes, with the kind as its id and lists for tuples; of
            ``launch``, the path and the place

        >>> fault = Fault(FaultKind.NO_PROVIDER, 'navigation/Navigation', 'navigation/Navigation')
        >>> fault.to_dict()['kind']
        'no-provider'
        """
        launch = self.launch
        return {'kind': self.kind.value, 'capability': self.capability,
                'asked_for': self.asked_for, 'required_by': self.required_by,
                'provider': self.provider, 'is_default': self.is_default,
                'implements': self.implements, 'candidates': list(self.candidates),
                'semantic_candidates': list(self.semantic_candidates), 'cycle': list(self.cycle),
                'launch_file': self.launch_file if launch is None else launch.path,
                'line': None if launch is None else launch.line,
                'column': None if launch is None else launch.column,
                'sharers': list(self.sharers), 'running': self.running}

    def __repr__(self) -> str:
        return '<Fault %s>' % self

    def __str__(self) -> str:
        if self.kind is FaultKind.CYCLE:
            return 'providers depend on each other in a cycle: %s' % ' -> '.join(self.cycle)
        if self.kind is FaultKind.LAUNCH_SHARED:
            return self._shared()
        if self.launch is not None:
            return 'provider %s: %s' % (quoted(str(self.provider)), self.launch)
        if self.kind is FaultKind.NO_NODELET_MANAGER:
            return 'provider %s: it needs a nodelet manager, and the capability server has none' % (
                quoted(str(self.provider)))
        if self.required_by:
            where = 'provider %s depends on %s' % (quoted(self.required_by),
                                                   quoted(self.capability))
        else:
            where = 'capability %s' % quoted(self.capability)
        return '%s: %s' % (where, self._problem())

    def _problem(self) -> str:
        candidates = ', '.join(map(quoted, self.candidates))
        if self.kind is FaultKind.NO_INTERFACE:
            return 'no package exports this capability' + did_you_mean(self.suggestions)
        if self.kind is FaultKind.NO_PROVIDER:
            return 'no provider implements it' + self._semantic()
        if self.kind is FaultKind.AMBIGUOUS:
            return 'several providers implement it, and none is the default: %s' % candidates
        if self.kind is FaultKind.CONFLICT:
            return 'several of its providers would have to run at once: %s' % candidates
        named = 'the %s provider %s' % ('default' if self.is_default else 'preferred',
                                        quoted(str(self.provider)))
        if self.kind is FaultKind.WRONG_PROVIDER:
            return '%s implements %s instead' % (named, quoted(str(self.implements)))
        return 'no package exports %s%s' % (named, did_you_mean(self.suggestions))

    def _semantic(self) -> str:
        """What could be named, where nothing can be picked."""
        if not self.semantic_candidates:
            return ''
        return ' (those of semantic interfaces that redefine it have to be named: %s)' % ', '.join(
            map(quoted, self.semantic_candidates))

    def _shared(self) -> str:
        path = quoted_path(str(self.launch_file))
        if self.running is not None:
            others = [provider for provider in self.sharers if provider != self.running]
            have = 'provider %s has' if len(others) == 1 else 'providers %s have'
            return '%s the launch file of %s, which runs already: %s' % (
                have % ' and '.join(map(quoted, others)), quoted(self.running), path)
        return 'providers %s have one launch file, which cannot run twice: %s' % (
            ' and '.join(map(quoted, self.sharers)), path)


#: The kinds whose text names the capability that was asked for.
_OF_THE_CAPABILITY = (FaultKind.NO_INTERFACE, FaultKind.NO_PROVIDER, FaultKind.UNKNOWN_PROVIDER,
                      FaultKind.WRONG_PROVIDER, FaultKind.AMBIGUOUS)
