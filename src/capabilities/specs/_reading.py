"""
How a spec is read: from a text to plain data, and what is asked of the data.
"""
from __future__ import annotations

import re

from capabilities.specs.common import SpecName, SpecWarning
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.sources.wording import did_you_mean, near_misses, shown
from rocon_uri.sources.yaml_data import MAX_SIZE, YamlError, YamlMapping, YamlSequence
from rocon_uri.sources.yaml_source import load, load_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from os import PathLike
    from typing import IO, Any, Callable, Dict, List, Optional, Tuple, Type, TypeVar, Union

    from capabilities.specs.common import CapabilitySpec, InvalidSpec

    Place = Tuple[Optional[int], Optional[int]]
    S = TypeVar('S', bound=CapabilitySpec)

__all__ = ['SpecSource', 'key_place', 'load_spec_file', 'load_spec_file_path', 'load_spec_string',
           'value_place']

NOWHERE: Place = (None, None)
_MAX_WARNINGS = 100     # of unknown keys: a text with more is something else

_find_surrogate = re.compile('[\ud800-\udfff]').search


class SpecSource:
    """
    One spec that is being read: what is asked of it is there, or an error says what and where.

    :param spec: what should be a spec, as plain data
    :param str file_name: where it is from
    :param str spec_type: the kind of spec that it should be
    :param keys: the names of what a spec of that kind has, beside what all have
    :param invalid: the subclass of `InvalidSpec` to raise

    Where a method takes ``what, *names``, that is what its error calls the thing: a format with
    ``%s``, and what to show in it. It is put together only for an error.
    """

    def __init__(self, spec: Any, file_name: str, spec_type: str, keys: Tuple[str, ...],
                 invalid: Type[InvalidSpec]) -> None:
        self.file_name = file_name
        self.invalid = invalid
        self.warnings: List[SpecWarning] = []
        self.keys = ('name', 'spec_version', 'spec_type', 'description') + keys
        if not isinstance(spec, dict):
            raise invalid(_no_spec(spec), file_name)
        self.spec = spec
        self.check_repeated(spec)
        if self.text('spec_type') != spec_type:
            raise self.error(value_place(spec, 'spec_type'), 'spec_type is %s, expected %s',
                             spec['spec_type'], spec_type)
        version = self.required('spec_version')
        if isinstance(version, bool) or not isinstance(version, int) or version != 1:
            raise self.error(value_place(spec, 'spec_version'), 'spec_version is %s, expected 1',
                             version)
        self.name = self.text('name')
        if not _is_name(self.name):
            raise self.error(value_place(spec, 'name'), 'name %s is not legal, expected a letter, '
                             'then letters, digits and underscores', self.name)
        self.description = self.description_in(spec, 'description')
        self.warn_of_unknown(spec, self.keys, 'the spec')

    def finished(self, spec: S) -> S:
        """The spec that was read, with what is known about its reading."""
        spec.source = self.spec
        spec.file_name = self.file_name
        spec.warnings = tuple(self.warnings)
        if spec.warnings:
            import logging      # here, since few specs need it, and it is slow to import
            for warning in spec.warnings:
                logging.getLogger('capabilities.specs').warning('%s', warning)
        return spec

    def error(self, place: Place, what: str, *names: Any) -> InvalidSpec:
        """The error to raise."""
        return self.invalid(what % tuple(map(shown, names)), self.file_name, *place)

    def warn(self, place: Place, what: str, *names: Any) -> None:
        """Note something odd, which is logged if the spec can be read."""
        self.warnings.append(
            SpecWarning(what % tuple(map(shown, names)), self.file_name, *place))

    def required(self, key: str) -> Any:
        """What the spec must have by this name."""
        value = self.spec.get(key)
        if value is not None:
            return value
        unknown = [name for name in self.spec if isinstance(name, str) and name not in self.keys]
        for near in near_misses(key, unknown[:_MAX_WARNINGS]):
            raise self.error(key_place(self.spec, near), 'unknown key %s, and the spec has no '
                             + key + did_you_mean([key]), near)
        raise self.error(key_place(self.spec, key) if key in self.spec else place_of(self.spec),
                         'the spec has no ' + key)

    def text(self, key: str) -> str:
        """The text that the spec must have by this name."""
        return self.text_in(self.spec, key, self.required(key), key)

    def optional_text(self, key: str) -> Optional[str]:
        """The text that the spec may have by this name."""
        value = self.spec.get(key)
        return None if value is None else self.text_in(self.spec, key, value, key)

    def text_in(self, collection: Any, key: Any, value: Any, what: str, *names: Any) -> str:
        """This value of a collection, which must be text."""
        if is_text(value):
            return value    # type: ignore[no-any-return]
        raise self.error(value_place(collection, key), what + ' is %s, expected text',
                         *names, value)

    def name_in(self, mapping: Dict[Any, Any], key: Any, what: str) -> str:
        """This key of a mapping, which must be text."""
        if is_text(key):
            return key      # type: ignore[no-any-return]
        raise self.error(key_place(mapping, key), what + ' is %s, expected text', key)

    def spec_name(self, key: str) -> SpecName:
        """The name of another spec that the spec must have by this name."""
        return self.spec_name_at(value_place(self.spec, key), self.required(key), key)

    def spec_name_at(self, place: Place, value: Any, what: str) -> SpecName:
        """The name of another spec that is given here."""
        try:
            return SpecName(value)
        except ValueError:
            raise self.error(place, what + ' is %s, expected package/name', value) from None

    def description_in(self, mapping: Dict[Any, Any], what: str, *names: Any) -> Optional[str]:
        """The description of the spec or of a part of it, which may be empty."""
        value = mapping.get('description')
        if value is None or value == '':
            return value
        return self.text_in(mapping, 'description', value, what, *names)

    def mapping_in(self, collection: Dict[Any, Any], key: Any, what: str,
                   *names: Any) -> Dict[Any, Any]:
        """This value of a mapping, which must be a mapping, or empty."""
        value = collection.get(key)
        if isinstance(value, dict):
            return value
        if value is None or isinstance(value, list) and not value:
            return {}
        raise self.error(value_place(collection, key), what + ' is %s, expected a mapping',
                         *names, value)

    def names_in(self, collection: Dict[Any, Any], key: Any, what: str,
                 *names: Any) -> Dict[Any, Any]:
        """This value of a mapping, which must be a mapping with each key once, or empty."""
        mapping = self.mapping_in(collection, key, what, *names)
        self.check_repeated(mapping)
        return mapping

    def check_repeated(self, mapping: Dict[Any, Any], harmless: Tuple[str, ...] = (),
                       within: str = '', *names: Any) -> None:
        """Refuse a mapping that has a key twice, since one of the two would be lost."""
        for key, _, place in getattr(mapping, 'repeated', ()):
            if key not in harmless:
                raise self.error(place, '%s is there twice' + within, key, *names)
            self.warn(place, '%s is there twice' + within + ', the last one counts', key, *names)

    def unknown(self, kind: str, mapping: Dict[Any, Any], key: Any, known: Tuple[str, ...],
                within: str, *names: Any) -> Tuple[Any, ...]:
        """The arguments of `error` and `warn` for a key that is not known."""
        near = near_misses(key, known) if isinstance(key, str) else []
        expected = did_you_mean(near) or ' (expected %s)' % ', '.join(known)
        return (key_place(mapping, key), 'unknown %s %%s in %s%s' % (kind, within, expected),
                key, *names)

    def warn_of_unknown(self, mapping: Dict[Any, Any], known: Tuple[str, ...], within: str,
                        *names: Any) -> None:
        """Note the keys that are not known."""
        for key in mapping:
            if key not in known and len(self.warnings) < _MAX_WARNINGS:
                self.warn(*self.unknown('key', mapping, key, known, within, *names))


def load_spec_string(string: str, file_name: str,
                     invalid: Type[InvalidSpec]) -> Tuple[Dict[Any, Any], str]:
    """
    The plain data of a spec, and the name that errors give.

    :param str string: the text of the spec
    :param str file_name: the name that errors give
    :param invalid: the subclass of `InvalidSpec` to raise
    :returns: (`rocon_uri.yaml_source.YamlMapping`, str)
    :raises InvalidSpec: if it is not YAML, or no mapping
    :raises AttributeError: if ``string`` is not a str
    """
    if not isinstance(string, str):
        raise AttributeError('a spec is read from a str, found %s' % type(string).__name__)
    return _loaded(lambda: load(string, file_name), file_name, invalid)


def load_spec_file(file_handle: IO[Any],
                   invalid: Type[InvalidSpec]) -> Tuple[Dict[Any, Any], str]:
    """
    The plain data of a spec, from an open file. Parameters and errors as in `load_spec_string`.

    :param file_handle: open for reading, as text or binary
    :raises OSError: if it cannot be read
    """
    file_name = str(getattr(file_handle, 'name', '<file>'))
    return _loaded(lambda: load(file_handle.read(MAX_SIZE + 1), file_name), file_name, invalid)


def load_spec_file_path(file_path: Union[str, PathLike[str]],
                        invalid: Type[InvalidSpec]) -> Tuple[Dict[Any, Any], str]:
    """
    The plain data of a spec, from a file. Parameters and errors as in `load_spec_string`.

    :param file_path: where the file is
    :raises OSError: if it is not there, or cannot be read
    """
    return _loaded(lambda: load_file(file_path), str(file_path), invalid)


def _loaded(read: Callable[[], Any], file_name: str,
            invalid: Type[InvalidSpec]) -> Tuple[Dict[Any, Any], str]:
    """What is read, if it is a mapping, and where it is from."""
    try:
        data = read()
    except YamlError as error:
        raise invalid(error.problem, file_name, error.line, error.column) from error
    except UnicodeDecodeError as error:     # by a file that was opened as text
        raise invalid('not %s text: %s' % (error.encoding, error.reason), file_name) from error
    if not isinstance(data, dict):
        raise invalid(_no_spec(data), file_name, 1, 1)
    return data, file_name


def _no_spec(data: Any) -> str:
    """What to say about data that are no spec."""
    return '%s, expected a spec, which is a mapping' % (
        'nothing there' if data is None else 'found %s' % shown(data))


def is_text(value: Any) -> bool:
    """Is it a text that says something, and that a file can hold?"""
    return isinstance(value, str) and value != '' and (
        value.isascii() or not _find_surrogate(value))


def _is_name(name: str) -> bool:
    """Is it the name of a spec, with or without the package?"""
    package, slash, own_name = name.partition('/')
    return is_legal_base_name(package) and (not slash or is_legal_base_name(own_name))


def place_of(collection: Any) -> Place:
    """Where a collection begins, if it was read from a text."""
    if isinstance(collection, (YamlMapping, YamlSequence)):
        return collection.position
    return NOWHERE


def key_place(mapping: Dict[Any, Any], key: Any) -> Place:
    """Where a key stands, if it was read from a text."""
    if isinstance(mapping, YamlMapping):
        try:
            return mapping.key_position(key)
        except KeyError:    # put in since
            pass
    return NOWHERE


def value_place(collection: Any, key: Any) -> Place:
    """Where a value of a mapping, or an item of a sequence, begins, if it was read from a text."""
    try:
        if isinstance(collection, YamlMapping):
            return collection.value_position(key)
        if isinstance(collection, YamlSequence):
            return collection.item_position(key)
    except LookupError:     # put in since
        pass
    return NOWHERE
