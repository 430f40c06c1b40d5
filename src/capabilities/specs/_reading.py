"""How specs are read: from a text to plain data, and what all three kinds have in common."""
from __future__ import annotations

from os import PathLike
from typing import IO, Callable, Generic, List, Mapping, Sequence, TypeVar, Union

from capabilities.specs.common import CapabilitySpec, InvalidSpec, SpecName, SpecWarning
from rocon_uri.sources.checked import Reading
from rocon_uri.sources.located import Place
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.sources.wording import shown
from rocon_uri.sources.yaml_data import MAX_SIZE
from rocon_uri.sources.yaml_source import read_file

__all__ = ['SpecLoader', 'SpecReading']

Spec = TypeVar('Spec', bound=CapabilitySpec)

_KEYS = ('name', 'spec_version', 'spec_type', 'description')    # of every spec
_MAX_WARNINGS = 100     # of unknown keys: a text with more is something else


class SpecReading(Reading):
    """
    One spec that is read, as plain data. What every spec has is read first.

    ``spec`` is the `CheckedMapping` of it. The parameters are those of `SpecLoader`.
    """

    def __init__(self, spec: object, file_name: str, spec_type: str, keys: Sequence[str],
                 invalid: Callable[..., InvalidSpec]) -> None:
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
                             'underscores' % shown(self.name), spec.value_place('name'),
                             'illegal-name')
        self.description = spec.text('description', may_be_empty=True)
        spec.warn_of_unknown(self.keys)

    def warn(self, problem: str, place: Place, fault_id: str) -> None:
        """Note something odd, which is logged if the spec can be read."""
        line, column = place
        self.warnings.append(SpecWarning(problem=problem, file_name=self.file_name, line=line,
                                         column=column, id=fault_id))

    def has_room(self) -> bool:
        """Is a further unknown key noted?"""
        return len(self.warnings) < _MAX_WARNINGS

    def finished(self, spec: Spec) -> Spec:
        """The spec, with what is known of its reading; its warnings are logged."""
        spec.source = self.spec.data
        spec.file_name = self.file_name
        spec.warnings = tuple(self.warnings)
        if spec.warnings:
            import logging      # here, since few specs need it, and it is slow to import
            for warning in spec.warnings:
                logging.getLogger('capabilities.specs').warning('%s', warning)
        return spec

    def required_text(self, key: str) -> str:
        """The text that the spec must have as the value of a key."""
        return self.spec.required_text(key, self.keys)

    def required_name(self, key: str) -> SpecName:
        """The name of another spec that the spec must have as the value of a key."""
        return self.spec_name(self.spec.required(key, self.keys), self.spec.value_place(key), key)

    def spec_name(self, value: object, place: Place, what: str, key: object = None) -> SpecName:
        """A value as the name of another spec; ``%s`` in what an error calls it is the key."""
        try:
            return SpecName(value)      # type: ignore[arg-type]
        except ValueError:
            raise self.fault('%s is %s, expected package/name' % (
                what.replace('%s', shown(key)), shown(value)), place) from None


class SpecLoader(Generic[Spec]):
    """
    Reads the specs of one kind, from a dict, a text or a file.

    :param str spec_type: the kind
    :param keys: the keys that a spec of that kind may have, beside those of every spec
    :param invalid: the subclass of `InvalidSpec` to raise
    :param make: makes the spec of a `SpecReading`
    """

    def __init__(self, spec_type: str, keys: Sequence[str], invalid: Callable[..., InvalidSpec],
                 make: Callable[[SpecReading], Spec]) -> None:
        self._spec_type = spec_type
        self._keys = keys
        self._invalid = invalid
        self._make = make

    def from_dict(self, spec: Mapping[str, object], file_name: str = '<dict>') -> Spec:
        """
        Make a spec of plain data.

        :param dict spec: what a file would hold
        :param str file_name: the name that errors give
        :returns: the spec
        :raises InvalidSpec: (the subclass for this kind) if it is not complete or not valid
        """
        reading = SpecReading(spec, file_name, self._spec_type, self._keys, self._invalid)
        return reading.finished(self._make(reading))

    def from_string(self, string: str, file_name: str = '<string>') -> Spec:
        """
        Read a spec.

        :param str string: the text of the spec
        :param str file_name: the name that errors give
        :returns: the spec
        :raises InvalidSpec: as ``from_dict``, or if the text is not YAML
        :raises AttributeError: if ``string`` is not a str
        """
        if not isinstance(string, str):
            raise AttributeError('a spec is read from a str, found %s' % type(string).__name__)
        return self._load(string, file_name)

    def from_file(self, file_handle: Union[IO[str], IO[bytes]]) -> Spec:
        """
        Read the spec in a file that is open for reading, as text or binary.

        :returns: the spec
        :raises InvalidSpec: as ``from_dict``, or if the text is not YAML
        :raises OSError: if the file cannot be read
        """
        file_name = str(getattr(file_handle, 'name', '<file>'))
        try:
            content = file_handle.read(MAX_SIZE + 1)
        except UnicodeDecodeError as error:
            raise self._invalid('not %s text: %s' % (error.encoding, error.reason),
                                file_name) from error
        return self._load(content, file_name)

    def from_file_path(self, file_path: Union[str, PathLike[str]]) -> Spec:
        """
        Read the spec in the file of this path.

        :returns: the spec
        :raises InvalidSpec: as ``from_dict``, or if the text is not YAML
        :raises OSError: if the file does not exist or cannot be read
        """
        return self._load(read_file(file_path), str(file_path))

    def _load(self, content: Union[str, bytes], file_name: str) -> Spec:
        spec = Reading(file_name, self._invalid).load(content, 'the spec')
        return self.from_dict(spec.data, file_name)


def _is_name(name: str) -> bool:
    """Is it the name of a spec, with or without the package?"""
    package, slash, own_name = name.partition('/')
    return is_legal_base_name(package) and (not slash or is_legal_base_name(own_name))
