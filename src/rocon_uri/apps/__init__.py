"""Apps: what packages export as such, and whether a robot can run them."""
from __future__ import annotations


def __getattr__(name: str) -> object:
    from rocon_uri.sources.submodules import submodule
    return submodule(__name__, name)
