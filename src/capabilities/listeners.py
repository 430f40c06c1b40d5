"""The types of those who listen to the runtime and to its launch manager; for type checkers."""
from __future__ import annotations

from typing import TYPE_CHECKING, Callable, List

if TYPE_CHECKING:
    from typing import Protocol

    from capabilities.launch import Report
    from capabilities.status import StatusEntry

    class Audience(Protocol):
        """Listens to the runtime, which calls it under its lock: the methods must not wait."""

        def told(self, event: str, capability: str, provider: str, pid: int) -> None:
            """Something was ``launched``, is being ``stopped``, or has ``terminated``."""

        def status(self, entries: List[StatusEntry]) -> None:
            """The status has become this."""

        def error(self, text: str) -> None:
            """Log an error."""

        @property
        def must_end(self) -> Callable[[int], None]:
            """Called with the exit status when the server has to end."""

    class LaunchListener(Protocol):
        """Listens to a launch manager, which calls it in the threads of its launches."""

        def launch_reported(self, pid: int, report: Report) -> None:
            """A node died or was restarted, or the launch file has started its nodes."""

        def launch_ended(self, pid: int, exit_code: int, text: str) -> None:
            """All processes of a launch are gone: the last call for that id."""

        def nodelet_manager_ended(self, pid: int, exit_code: int, text: str) -> None:
            """The same for the nodelet manager."""
