"""The ground floor: what strangers wrote is read here, safely, and nowhere else."""
from __future__ import annotations


def __getattr__(name: str) -> object:
    from rocon_uri.sources.submodules import submodule
    return submodule(__name__, name)
