"""
How a spec is read: from a text to plain data, and what all three kinds of specs have in common.
"""
from __future__ import annotations

from os import PathLike
from typing import IO, Callable, List, Mapping, Sequence, Tuple, TypeVar, Union

from capabilities.specs.common import CapabilitySpec, InvalidSpec, SpecName, SpecWarning
from rocon_uri.sources.checked import Reading
from rocon_uri.sources.located import NOWHERE, Place
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.sources.wording import shown
from rocon_uri.sources.yaml_data import MAX_SIZE
from rocon_uri.sources.yaml_source import read_file

__all__ = ['Invalid', 'SpecReading', 'load_spec_file', 'load_spec_file_path', 'load_spec_string']

Invalid = Callable[..., InvalidSpec]    # one of the subclasses
S = TypeVar('S', bound=CapabilitySpec)

_KEYS = ('name', 'spec_version', 'spec_type', 'description')    # of every spec
_MAX_WARNINGS = 100     # of unknown keys: a text with more is something else


class SpecReading(Reading):
    """
    One spec that is read. What all specs have is read first.

    :param spec: what should be a spec, as plain data
    :param str file_name: where it is from
    :param str spec_type: the kind of spec that it should be
    :param keys: the names of what a spec of that kind has, beside what all have
    :param invalid: the subclass of `InvalidSpec` to raise

    - ``spec``: `CheckedMapping`
    - ``name``: str; ``description``: str or None
    """

    def __init__(self, spec: object, file_name: str, spec_type: str, keys: Sequence[str],
                 invalid: Invalid) -> None:
        super().__init__(file_name, invalid)
        self.warnings: List[SpecWarning] = []
        self.keys = (*_KEYS, *keys)
        self.spec = spec = self.mapping(spec, 'the spec')
        if self.required_text('spec_type') != spec_type:
            raise spec.wrong('spec_type', shown(spec_type))
        version = spec.required('spec_version', self.keys)
        if isinstance(version, bool) or not isinstance(version, int) or version != 1:
            raise spec.wrong('spec_version', '1')
        self.name = self.required_text('name')
        if not _is_name(self.name):
            raise self.fault('name %s is not legal, expected a letter, then letters, digits and '
                             'underscores' % shown(self.name), spec.value_place('name'))
        self.description = spec.text('description', may_be_empty=True)
        spec.warn_of_unknown(self.keys)

    def warn(self, problem: str, place: Place = NOWHERE) -> None:
        """Note something odd, which is logged if the spec can be read."""
        if len(self.warnings) < _MAX_WARNINGS:
            self.warnings.append(SpecWarning(problem, self.file_name, *place))

    def finished(self, spec: S) -> S:
        """The spec that was read, with what is known about its reading."""
        spec.source = self.spec.data
        spec.file_name = self.file_name
        spec.warnings = tuple(self.warnings)
        if spec.warnings:
            import logging      # here, since few specs need it, and it is slow to import
            for warning in spec.warnings:
                logging.getLogger('capabilities.specs').warning('%s', warning)
        return spec

    def required_text(self, key: str) -> str:
        """The text that the spec must have by this name."""
        return self.spec.required_text(key, self.keys)

    def required_name(self, key: str) -> SpecName:
        """The name of another spec that the spec must have by this name."""
        return self.spec_name(self.spec.required(key, self.keys), self.spec.value_place(key), key)

    def spec_name(self, value: object, place: Place, what: str) -> SpecName:
        """A value as the name of another spec."""
        try:
            return SpecName(value)      # type: ignore[arg-type]
        except ValueError:
            raise self.fault('%s is %s, expected package/name' % (what, shown(value)),
                             place) from None


def load_spec_string(string: str, file_name: str,
                     invalid: Invalid) -> Tuple[Mapping[str, object], str]:
    """
    The plain data of a spec, and the name that errors give.

    :param str string: the text of the spec
    :param str file_name: the name that errors give
    :param invalid: the subclass of `InvalidSpec` to raise
    :returns: (`rocon_uri.yaml_source.YamlMapping`, str)
    :raises InvalidSpec: if it is not YAML, or not a mapping
    :raises AttributeError: if ``string`` is not a str
    """
    if not isinstance(string, str):
        raise AttributeError('a spec is read from a str, found %s' % type(string).__name__)
    return _loaded(string, file_name, invalid)


def load_spec_file(file_handle: Union[IO[str], IO[bytes]],
                   invalid: Invalid) -> Tuple[Mapping[str, object], str]:
    """
    The plain data of a spec, from an open file. Parameters and errors as in `load_spec_string`.

    :param file_handle: open for reading, as text or binary
    :raises OSError: if it cannot be read
    """
    file_name = str(getattr(file_handle, 'name', '<file>'))
    try:
        content = file_handle.read(MAX_SIZE + 1)
    except UnicodeDecodeError as error:
        raise invalid('not %s text: %s' % (error.encoding, error.reason), file_name) from error
    return _loaded(content, file_name, invalid)


def load_spec_file_path(file_path: Union[str, PathLike[str]],
                        invalid: Invalid) -> Tuple[Mapping[str, object], str]:
    """
    The plain data of a spec, from a file. Parameters and errors as in `load_spec_string`.

    :param file_path: where the file is
    :raises OSError: if it is not there, or cannot be read
    """
    return _loaded(read_file(file_path), str(file_path), invalid)


def _loaded(content: Union[str, bytes], file_name: str,
            invalid: Invalid) -> Tuple[Mapping[str, object], str]:
    return Reading(file_name, invalid).load(content, 'the spec').data, file_name


def _is_name(name: str) -> bool:
    """Is it the name of a spec, with or without the package?"""
    package, slash, own_name = name.partition('/')
    return is_legal_base_name(package) and (not slash or is_legal_base_name(own_name))
