"""
What the three kinds of capability specs share: names, errors, and what every spec has.

A spec that cannot be used is refused with an `InvalidSpec`, which has the place. What is odd and
does no harm (an unknown key, a duplicate description) is logged to ``capabilities.specs``, and kept
in the spec's ``warnings``.
"""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Optional, Tuple

from rocon_uri.sources.located import Located, LocatedError
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.sources.wording import quoted, shown

__all__ = ['NO_DESCRIPTION', 'CapabilitySpec', 'InvalidSpec', 'SpecName', 'SpecWarning',
           'split_spec_name', 'validate_spec_name']

NO_DESCRIPTION = 'No description given.'


class InvalidSpec(LocatedError, ValueError):
    """
    A capability spec that is not complete, or has an entry that cannot be used.

    Parameters and attributes are those of `rocon_uri.sources.located.LocatedError`.

    >>> print(InvalidSpec("topic 'scan' has no type", 'laser.yaml', 12, 5))
    laser.yaml:12:5: topic 'scan' has no type
    """

    @property
    def msg(self) -> str:
        """The same as ``problem``, as the specification calls the parameter."""
        return self.problem


@dataclass(frozen=True)
class SpecWarning(Located):
    """
    Something odd in a spec, which is ignored.

    >>> print(SpecWarning("unknown key 'colour'", 'laser.yaml', 3, 1))
    laser.yaml:3:1: unknown key 'colour'
    """

    #: what is odd, without the place
    problem: str
    #: where the spec is from
    file_name: str
    #: where in it, counted from 1; None if it is not from a text
    line: Optional[int] = None
    #: counted from 1, or None
    column: Optional[int] = None
    #: the kind of fault
    id: str = 'unknown-key'


class SpecName(str):
    """
    The name of a spec, ``package/name``: a ``str`` that knows its parts.

    :param str name: package and name with a ``/`` between, each a ROS base name
    :raises ValueError: if it is not of that form

    >>> name = SpecName('a_package/RGBCamera')
    >>> name.package, name.name, name == 'a_package/RGBCamera'
    ('a_package', 'RGBCamera', True)
    """

    __slots__ = ()

    def __new__(cls, name: str) -> SpecName:
        package, _, own_name = name.partition('/') if isinstance(name, str) else ('', '', '')
        if not (is_legal_base_name(package) and is_legal_base_name(own_name)):
            raise ValueError('%s is not the name of a spec, expected package/name' % shown(name))
        return super().__new__(cls, name)

    @property
    def package(self) -> str:
        """The package that exports the spec, a str."""
        return self.partition('/')[0]

    @property
    def name(self) -> str:
        """The name of the spec within its package, a str."""
        return self.partition('/')[2]


def validate_spec_name(name: str) -> SpecName:
    """
    The name of a spec, checked. Parameter, result and error are those of `SpecName`.

    >>> validate_spec_name('a_package/RGBCamera').package
    'a_package'
    """
    return SpecName(name)


def split_spec_name(name: str) -> Tuple[str, str]:
    """
    The package and the name within it (str each) of the name of a spec, as `SpecName` checks it.

    >>> split_spec_name('a_package/RGBCamera')
    ('a_package', 'RGBCamera')
    """
    spec_name = SpecName(name)
    return spec_name.package, spec_name.name


class CapabilitySpec:
    """
    What every spec has. Its attributes can be set. Specs are equal if their `to_dict` is.

    - ``name`` (str): as in the file; ``package/name`` once it is indexed
    - ``spec_type`` (str): ``'interface'``, ``'provider'`` or ``'semantic_interface'``
    - ``spec_version`` (int): 1
    - ``description`` (str): ``'No description given.'`` if there is none
    - ``file_name`` (str or None): where it was read from
    - ``source`` (dict or None): the data that it was read from; where that is from a text, a
      `rocon_uri.sources.yaml_data.YamlMapping`, which knows its lines
    - ``warnings`` (tuple of `SpecWarning`): what was odd in it
    """

    spec_type = ''

    def __init__(self, name: str, spec_version: int, description: Optional[str]) -> None:
        self.name = name
        self.spec_version = spec_version
        self.description = NO_DESCRIPTION if description is None else description
        self.file_name: Optional[str] = None
        self.source: Optional[Dict[str, Any]] = None
        self.warnings: Tuple[SpecWarning, ...] = ()

    def to_dict(self) -> Dict[str, object]:
        """The spec as plain data (dict), from which ``..._from_dict`` makes an equal spec."""
        head: Dict[str, object] = {
            'name': str(self.name), 'spec_version': self.spec_version, 'spec_type': self.spec_type}
        if self.description != NO_DESCRIPTION:
            head['description'] = str(self.description)
        return head

    def to_yaml(self) -> str:
        """The text of a file (str), from which ``..._from_string`` makes an equal spec."""
        import yaml     # here, since specs can be made and compared without it
        text: str = yaml.safe_dump(self.to_dict(), sort_keys=False, default_flow_style=False)
        return text

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self.to_dict() == other.to_dict()

    __hash__ = None     # type: ignore[assignment]    # it can be changed

    def __repr__(self) -> str:
        return '<%s %s>' % (type(self).__name__, quoted(self.name))
