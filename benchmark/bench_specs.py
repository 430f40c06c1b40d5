"""
How long it takes to load a capability spec, measured against yaml.load of the same text.

Both are measured in one run on one machine, in turn, so that the ratio holds on any machine. The
specs are those in the folder that ROCON_URI_CORPUS names, else the project's own.
"""
from __future__ import annotations

import logging
import os
import sys
import time
from pathlib import Path
from typing import Any, Callable, Dict, Iterator

import yaml

_ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(_ROOT / 'src'))

from capabilities.specs.interface import capability_interface_from_string   # noqa: E402
from capabilities.specs.provider import capability_provider_from_string     # noqa: E402
from capabilities.specs.semantic_interface import (                         # noqa: E402
    semantic_capability_interface_from_string)

TARGET = 1.5
_LOADERS: Dict[str, Callable[[str], Any]] = {
    'interface': capability_interface_from_string,
    'provider': capability_provider_from_string,
    'semantic_interface': semantic_capability_interface_from_string}
_ROUNDS = 15        # the shortest counts: what is longer, something else has caused
_LOADS = 20         # in each round


def figures() -> Iterator[Dict[str, Any]]:
    """
    Measure every spec.

    :returns: iterator of dicts with ``name`` (of the file), ``ratio`` (time to load the spec, by
        the time of the reference), ``target`` (what the ratio may be; None for a spec with an
        unknown key, for which near misses are looked for), ``reference`` (what it is
        measured against), ``seconds`` and ``reference_seconds`` (the times of one load)
    """
    logging.getLogger('capabilities.specs').addHandler(logging.NullHandler())
    folder = Path(os.environ.get('ROCON_URI_CORPUS') or _ROOT / 'test')
    for path in sorted(folder.rglob('*.yaml')):
        text = path.read_text(encoding='utf-8')
        try:
            data = yaml.load(text, Loader=_reference_loader())
            loader = _LOADERS[data['spec_type']]
            spec = loader(text)
        except (yaml.YAMLError, ValueError, KeyError, TypeError):
            continue    # another kind of file, or a bad example
        seconds, reference_seconds = _shortest(
            lambda: loader(text),                                           # noqa: B023
            lambda: yaml.load(text, Loader=_reference_loader()))            # noqa: B023
        is_odd = any(warning.id == 'unknown-key' for warning in spec.warnings)
        yield {'name': str(path.relative_to(folder)), 'ratio': seconds / reference_seconds,
               'target': None if is_odd else TARGET,
               'reference': 'yaml.load with %s' % _reference_loader().__name__,
               'seconds': seconds, 'reference_seconds': reference_seconds}


def _reference_loader() -> Any:
    return getattr(yaml, 'CSafeLoader', yaml.SafeLoader)


def _shortest(*functions: Callable[[], Any]) -> Iterator[float]:
    """The seconds that one call of each takes; they are called in turn, round by round."""
    shortest = [float('inf')] * len(functions)
    for _ in range(_ROUNDS):
        for index, function in enumerate(functions):
            start = time.perf_counter()
            for _ in range(_LOADS):
                function()
            shortest[index] = min(shortest[index], (time.perf_counter() - start) / _LOADS)
    return iter(shortest)


def main() -> int:
    """Print the figures; 1 if one misses its target."""
    missed = False
    for figure in figures():
        missed |= figure['target'] is not None and figure['ratio'] > figure['target']
        print('%(ratio)5.2f (target %(target)s) of %(reference)s, %(name)s' % figure)
    return int(missed)


if __name__ == '__main__':
    sys.exit(main())
