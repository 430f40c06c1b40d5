"""The type of the listener of `capabilities.runtime.Runtime`; only for type checkers."""
from __future__ import annotations

from typing import TYPE_CHECKING, Callable, List

if TYPE_CHECKING:
    from typing import Protocol

    from capabilities.status import StatusEntry

    class Audience(Protocol):
        """Its methods are called under the lock of the runtime, so they must not wait."""

        def told(self, event: str, capability: str, provider: str, pid: int) -> None:
            """Something was ``launched``, is being ``stopped``, or has ``terminated``."""

        def status(self, entries: List[StatusEntry]) -> None:
            """The status has become this."""

        def error(self, text: str) -> None:
            """Log an error."""

        @property
        def must_end(self) -> Callable[[int], None]:
            """Called with the exit status when the server has to end."""
