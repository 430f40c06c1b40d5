"""The remappings of a running capability, merged with those of all that it depends on."""
from __future__ import annotations

from typing import Dict, Iterable, List, Set, Tuple

from capabilities.instances import CapabilityInstance
from capabilities.specs.remappings import REMAPPING_KINDS, RemappingSpec

__all__ = ['merged_remappings', 'with_dependencies']


def with_dependencies(instance: CapabilityInstance) -> List[CapabilityInstance]:
    """
    An instance and all that it depends on.

    :param CapabilityInstance instance: the one that comes last
    :returns: list of `CapabilityInstance`, each once and after those that it depends on
    """
    found: Dict[int, CapabilityInstance] = {}
    waiting: List[Tuple[CapabilityInstance, bool]] = [(instance, False)]
    while waiting:
        one, is_complete = waiting.pop()
        if is_complete:
            found.setdefault(id(one), one)
        elif id(one) not in found:
            waiting.append((one, True))
            waiting += [(below, False) for below in reversed(one.dependencies)]
    return list(found.values())


def merged_remappings(specs: Iterable[RemappingSpec]) -> Dict[str, Dict[str, str]]:
    """
    Merge the remappings of several specs.

    If a name is remapped to a name that an earlier spec remaps, it gets the final name, and the
    intermediate name is left out.

    :param specs: iterable of `RemappingSpec`, dependencies first
    :returns: dict from ``'topics'``, ``'services'``, ``'actions'`` and ``'parameters'`` to dicts
        from names to new names

    >>> from capabilities.specs.provider import CapabilityProvider
    >>> below = CapabilityProvider('b', 1, 'p/B', remappings={'topics': {'distance': 'range'}})
    >>> above = CapabilityProvider('a', 1, 'p/A', remappings={'topics': {'front': 'distance'}})
    >>> merged_remappings([below, above])['topics']
    {'front': 'range'}
    """
    merged: Dict[str, Dict[str, str]] = {kind: {} for kind in REMAPPING_KINDS}
    between: Dict[str, Set[str]] = {kind: set() for kind in REMAPPING_KINDS}
    for spec in specs:
        for kind, new_names in spec.remappings_by_type.items():
            below = merged[kind]
            resolved = {name: below.get(new_name, new_name)
                        for name, new_name in new_names.items()}
            # Intermediate names go at the end: another spec may remap to them, too.
            between[kind].update(below.keys() & set(new_names.values()))
            between[kind].difference_update(new_names)
            below.update(resolved)
    return {kind: {name: new_name for name, new_name in new_names.items()
                   if name not in between[kind]} for kind, new_names in merged.items()}
