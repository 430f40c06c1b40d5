"""The errors of specs that `capabilities.spec_index.SpecIndex` refuses."""
from __future__ import annotations

from typing import Iterable, List, Optional, Tuple

from rocon_uri.sources.located import LocatedError
from rocon_uri.sources.wording import did_you_mean, near_misses

__all__ = ['DuplicateNameException', 'InterfaceNameNotFoundException']


class _RefusedSpec(LocatedError):
    """A spec that cannot be indexed; the two exceptions below say why."""

    def __init__(self, problem: str, file_name: str, line: Optional[int], column: Optional[int],
                 spec_name: str, package: str, spec_type: str, *more: object) -> None:
        super().__init__(problem, file_name, line, column, spec_name, package, spec_type, *more)
        self.spec_name = spec_name
        self.package = package
        self.spec_type = spec_type


class DuplicateNameException(_RefusedSpec):
    """
    A spec whose name is taken. Specs of different kinds cannot share a name either.

    Attributes: those of `rocon_uri.sources.located.LocatedError`, and ``spec_name`` (str,
    ``package/name``), ``package`` (str) and ``spec_type`` (str, ``'interface'``,
    ``'semantic_interface'`` or ``'provider'``).
    """

    id = 'duplicate-name'


class InterfaceNameNotFoundException(_RefusedSpec):
    """
    A semantic interface or provider of an interface that does not exist.

    Attributes: those of `DuplicateNameException`, and ``interface`` (str), the name that it
    redefines or implements.
    """

    id = 'no-interface'

    def __init__(self, problem: str, file_name: str, line: Optional[int], column: Optional[int],
                 spec_name: str, package: str, spec_type: str, interface: str,
                 candidates: Iterable[str] = ()) -> None:
        super().__init__(problem, file_name, line, column, spec_name, package, spec_type, interface)
        self.interface = interface
        self._candidates = candidates

    @property
    def suggestions(self) -> List[str]:
        """The interfaces that were probably meant: a list of at most three str."""
        return near_misses(self.interface, self._candidates)

    @property
    def sentence(self) -> str:
        """The problem, and what was probably meant."""
        return self.problem + did_you_mean(self.suggestions)

    def __reduce__(self) -> Tuple[object, ...]:
        return type(self), (*self.args, self.suggestions)
