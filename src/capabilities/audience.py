"""Who is told what happens in `capabilities.runtime.Runtime`; only for who checks types."""
from __future__ import annotations

from typing import TYPE_CHECKING, Callable, List

if TYPE_CHECKING:
    from typing import Protocol

    from capabilities.status import StatusEntry

    class Audience(Protocol):
        """Is told under the lock of the runtime, and therefore must not wait for anything."""

        def told(self, event: str, capability: str, provider: str, pid: int) -> None:
            """Something was ``launched``, is being ``stopped``, or has ``terminated``."""

        def status(self, entries: List[StatusEntry]) -> None:
            """The status is now this."""

        def error(self, text: str) -> None:
            """Something is to be logged as an error."""

        @property
        def must_end(self) -> Callable[[int], None]:
            """To be called when the server is to end, with the exit status."""
