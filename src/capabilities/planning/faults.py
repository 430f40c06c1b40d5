"""What stands in the way of starting a capability, one `Fault` for each thing."""
from __future__ import annotations

from enum import Enum

from rocon_uri.sources.wording import did_you_mean, near_misses, quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Collection, Dict, List, Optional, Tuple

__all__ = ['Fault', 'FaultKind']


class FaultKind(Enum):
    """What stands in the way of starting a capability."""

    #: no package exports the capability
    NO_INTERFACE = 'no interface'
    #: no provider implements it
    NO_PROVIDER = 'no provider'
    #: no package exports the provider that is preferred, or the default
    UNKNOWN_PROVIDER = 'unknown provider'
    #: the provider that is preferred, or the default, implements something else
    WRONG_PROVIDER = 'wrong provider'
    #: several providers implement it, and none of them is named
    AMBIGUOUS = 'ambiguous'
    #: several providers of it would have to run at once
    CONFLICT = 'conflict'
    #: providers depend on each other in a circle
    CYCLE = 'cycle'


class Fault:
    """
    One thing that stands in the way. Its text is one line.

    - ``kind`` (`FaultKind`)
    - ``capability`` (str): what cannot be had
    - ``asked_for`` (str): the capability that was asked for, and led here (first, if several do)
    - ``required_by`` (str or None): the provider that depends on it; None for what is asked for
      itself, in a conflict and in a cycle
    - ``provider`` (str or None): the provider that is named for it, where that is at fault
    - ``is_default`` (bool): is ``provider`` the default, and not what ``required_by`` prefers?
    - ``implements`` (str or None): what ``provider`` implements instead
    - ``candidates`` (tuple of str): the providers that implement the capability; in a conflict,
      those that would have to run
    - ``cycle`` (tuple of str): the providers of a cycle, the first one again at the end
    """

    __slots__ = ('kind', 'capability', 'asked_for', 'required_by', 'provider', 'is_default',
                 'implements', 'candidates', 'cycle', '_known')

    def __init__(self, kind: FaultKind, capability: str, asked_for: str,
                 required_by: Optional[str] = None, provider: Optional[str] = None,
                 is_default: bool = False, implements: Optional[str] = None,
                 candidates: Tuple[str, ...] = (), cycle: Tuple[str, ...] = (),
                 known: Collection[str] = ()) -> None:
        self.kind = kind
        self.capability = capability
        self.asked_for = asked_for
        self.required_by = required_by
        self.provider = provider
        self.is_default = is_default
        self.implements = implements
        self.candidates = candidates
        self.cycle = cycle
        self._known = known     # what could have stood in place of the name that is not there

    @property
    def suggestions(self) -> List[str]:
        """
        What was probably meant by the name that is not there: a list of at most three str.

        They are looked for when they are asked for, since that takes long among many names.
        """
        return near_misses(self.provider or self.capability, self._known)

    def to_dict(self) -> Dict[str, Any]:
        """
        The fault as plain data.

        :returns: dict of the attributes, with the kind as its text and lists for tuples

        >>> fault = Fault(FaultKind.NO_PROVIDER, 'navigation/Navigation', 'navigation/Navigation')
        >>> fault.to_dict()['kind']
        'no provider'
        """
        return {'kind': self.kind.value, 'capability': self.capability,
                'asked_for': self.asked_for, 'required_by': self.required_by,
                'provider': self.provider, 'is_default': self.is_default,
                'implements': self.implements, 'candidates': list(self.candidates),
                'cycle': list(self.cycle)}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Fault):
            return NotImplemented
        return self.to_dict() == other.to_dict()

    def __hash__(self) -> int:
        return hash((self.kind, self.capability, self.required_by))

    def __repr__(self) -> str:
        return '<Fault %s>' % self

    def __str__(self) -> str:
        if self.kind is FaultKind.CYCLE:
            return 'providers depend on each other in a cycle: %s' % ' -> '.join(self.cycle)
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
            return 'no provider implements it'
        if self.kind is FaultKind.AMBIGUOUS:
            return 'several providers implement it, and none is the default: %s' % candidates
        if self.kind is FaultKind.CONFLICT:
            return 'several of its providers would have to run at once: %s' % candidates
        named = 'the %s provider %s' % ('default' if self.is_default else 'preferred',
                                        quoted(str(self.provider)))
        if self.kind is FaultKind.WRONG_PROVIDER:
            return '%s implements %s instead' % (named, quoted(str(self.implements)))
        return 'no package exports %s%s' % (named, did_you_mean(self.suggestions))
