"""
Vocabularies: the values that the fields of a rocon URI may have.

A vocabulary never changes: more rules make a new one. A URI for which no vocabulary is given is
read with the `current` one: what is bundled and, once something needed it, also what the packages
on this machine export.
"""
from __future__ import annotations

import itertools
import os
from _thread import RLock       # as functools does: threading takes longer than parsing

from rocon_uri.sources.wording import cannot_be_read, expectation, shown
from rocon_uri.field_vocabulary import FieldVocabulary, RulesError, add_rules, members
from rocon_uri.grammar import VOCABULARY_FIELDS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple

    from rocon_uri.sources.located import Fault
    from rocon_uri.sources.packages import Package

    Parents = Dict[str, Optional[str]]      # of values and groups, by name

__all__ = ['RULES_FOLDER', 'Vocabulary', 'complete', 'completed', 'current', 'precedence',
           'read_rules', 'vocabulary_of_packages', 'with_exported_rules']

#: The folder of the bundled vocabulary.
RULES_FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'rules')
_serial_numbers = itertools.count()


class Vocabulary:
    """
    The values of the three fields that have registered ones.

    :param rules: mapping from ``'hardware_platform'``, ``'application_framework'`` and
        ``'operating_system'`` to nested groups. These are mappings from a group to its members,
        lists of values and of such mappings, or a mix. A list of mappings may stand for a mapping.
    :raises RulesError: for rules that do not fit

    >>> ours = Vocabulary({'hardware_platform': {'robot': ['bender']}})
    >>> 'bender' in ours.field('hardware_platform')
    True
    """

    __slots__ = ('_fields', '_opened', 'is_open', 'serial', 'fields_read', 'uris_read')

    def __init__(self, rules: object) -> None:
        self._adopt(_extended({name: FieldVocabulary(name, {}) for name in VOCABULARY_FIELDS},
                              rules))

    def _adopt(self, fields: Dict[str, FieldVocabulary], is_open: bool = False) -> None:
        self._fields = fields
        self._opened: Optional[Vocabulary] = None
        #: bool: is any base name a value?
        self.is_open = is_open
        #: int: larger for one that was made later
        self.serial = next(_serial_numbers)
        # What was read with this vocabulary. It is kept here so that it is dropped together with
        # the vocabulary: a slow thread cannot leave anything for those who read with the next one.
        self.fields_read: Dict[str, Dict[str, Any]] = {name: {} for name in fields}
        self.uris_read: Dict[str, Any] = {}

    def __repr__(self) -> str:
        counts = ', '.join('%d %s' % (len(list(field)), name)
                           for name, field in self._fields.items())
        return '<Vocabulary: %s%s>' % (counts, ', open' if self.is_open else '')

    @classmethod
    def _of(cls, fields: Dict[str, FieldVocabulary], is_open: bool = False) -> 'Vocabulary':
        vocabulary = cls.__new__(cls)
        vocabulary._adopt(fields, is_open)
        return vocabulary

    def __reduce__(self) -> Tuple[object, ...]:
        if self is _initial or self is _complete:
            return current, ()
        return Vocabulary._of, (self._fields, self.is_open)

    @classmethod
    def bundled(cls) -> 'Vocabulary':
        """
        What this package knows by itself, a `Vocabulary`.

        >>> 'noetic' in Vocabulary.bundled().field('application_framework')
        True
        """
        import json     # here, since importing the package should be cheap
        rules = {}
        for name in VOCABULARY_FIELDS:
            with open(os.path.join(RULES_FOLDER, name + '.json'), encoding='utf-8') as rules_file:
                rules[name] = json.load(rules_file)
        return cls(rules)

    @classmethod
    def open(cls) -> 'Vocabulary':
        """
        The complete vocabulary of this machine, a `Vocabulary` in which any base name is a value.

        >>> Vocabulary.open().is_open
        True
        """
        return complete().opened()

    def opened(self) -> 'Vocabulary':
        """
        This vocabulary, but any base name is a value; itself if it is open already.

        :returns: Vocabulary
        """
        if self._opened is None:
            with _lock:     # two threads must get the same one
                self._opened = self._opened or (
                    self if self.is_open else Vocabulary._of(self._fields, is_open=True))
        return self._opened

    def extended(self, rules: object) -> 'Vocabulary':
        """
        This vocabulary with more values and groups.

        :param rules: as `Vocabulary` takes
        :returns: Vocabulary
        :raises RulesError: for rules that do not fit

        >>> ours = Vocabulary.bundled().extended({'operating_system': {'linux': ['our_linux']}})
        >>> 'our_linux' in ours.field('operating_system').leaves('linux')
        True
        """
        return Vocabulary._of(_extended(self._fields, rules), self.is_open)

    def field(self, name: str) -> FieldVocabulary:
        """
        The values of one field.

        :param str name: one of `rocon_uri.grammar.VOCABULARY_FIELDS`; any other is a KeyError
        :returns: FieldVocabulary
        """
        return self._fields[name]


def _extended(fields: Mapping[str, FieldVocabulary],
              rules: object) -> Dict[str, FieldVocabulary]:
    added = _added({name: field.parents for name, field in fields.items()}, rules)
    return {name: field.with_added(added[name]) for name, field in fields.items()}


def _added(known: Mapping[str, Parents], rules: object) -> Dict[str, Parents]:
    """What rules add, by field, to what is known; RulesError if they do not fit."""
    added: Dict[str, Parents] = {name: {} for name in VOCABULARY_FIELDS}
    for name, below, path in members(rules):
        if not isinstance(name, str) or name not in VOCABULARY_FIELDS:
            raise RulesError('unknown field %s in the rules%s' % (
                shown(name), expectation(name, VOCABULARY_FIELDS)), path)
        add_rules(name, known[name], added[name], below, path)
    return added


def read_rules(vocabulary: Vocabulary, path: str) -> Vocabulary:
    """
    A vocabulary with what one rules file adds.

    :param Vocabulary vocabulary: what it is added to
    :param str path: a YAML or JSON file: fields at the top, nested groups below
    :returns: Vocabulary
    :raises YamlError: `rocon_uri.sources.yaml_data.YamlError`, with the place of a fault in it
    :raises OSError: if it cannot be read

    >>> cafe = read_rules(Vocabulary.bundled(), 'examples/workspace/cafe_cart/rules/robots.yaml')
    >>> 'cafe_cart' in cafe.field('hardware_platform')
    True
    """
    extended, faults = _with_rules_files(vocabulary, [path])
    for fault in faults:
        raise fault
    return extended


def vocabulary_of_packages(packages: Mapping[str, Package]) -> Tuple[Vocabulary, List[Fault]]:
    """
    The vocabulary of this machine, with what these packages add.

    :param packages: as `rocon_uri.sources.packages.find_packages` returns them
    :returns: (`Vocabulary`, list of `YamlError` and `OSError`); a file with a fault adds nothing

    >>> vocabulary, errors = vocabulary_of_packages({})
    >>> 'kobuki' in vocabulary.field('hardware_platform')
    True
    """
    from rocon_uri.exported_rules import rules_paths    # here and below, since it loads YAML
    paths = rules_paths(packages)
    return _with_rules_files(complete() if paths else current(), paths)


def with_exported_rules(vocabulary: Vocabulary) -> Vocabulary:
    """
    A vocabulary with all that the packages on this machine and ``ROCON_URI_RULES`` add.

    A package or a file with a fault is logged, with the line, and adds nothing.
    """
    from rocon_uri.exported_rules import rules_paths_of_machine
    from rocon_uri.sources.located import NOWHERE, located
    paths, package_errors = rules_paths_of_machine()
    vocabulary, faults = _with_rules_files(vocabulary, paths)
    for text, errors in ('rules of a package left out: %s', package_errors), (
            'rules left out: %s', faults):
        for error in errors:
            import logging      # costs more than the rest of the package, and few need it
            logging.getLogger('rocon_uri').warning(text, located(
                cannot_be_read(error), error.filename, *NOWHERE)
                if isinstance(error, OSError) else error)
    return vocabulary


def _with_rules_files(vocabulary: Vocabulary, paths: Iterable[str],
                      ) -> Tuple[Vocabulary, List[Fault]]:
    """
    One new vocabulary for all files without a fault, and the faults of the others.

    All are folded in at once: to make a vocabulary for each file would take long for thousands.
    """
    from rocon_uri.exported_rules import read_rules_file
    from rocon_uri.sources.located import with_id
    from rocon_uri.sources.yaml_data import YamlError, place_below
    fields = vocabulary._fields
    parents = {name: dict(field.parents) for name, field in fields.items()}
    faults: List[Fault] = []
    for path in paths:
        try:
            rules = read_rules_file(path)
            try:
                added = _added(parents, rules)
            except RulesError as error:
                raise with_id(YamlError(error.problem, path, *place_below(rules, error.path)),
                              'invalid-rules') from None
        except (OSError, YamlError) as error:
            faults.append(error)
        else:
            for name, new in added.items():
                parents[name].update(new)
    if all(len(parents[name]) == len(field.parents) for name, field in fields.items()):
        return vocabulary, faults       # nothing was added
    return Vocabulary._of({name: FieldVocabulary(name, parents[name]) for name in fields},
                          vocabulary.is_open), faults


_initial: Optional[Vocabulary] = None       # what is bundled; current until something needs more
_complete: Optional[Vocabulary] = None
_lock = RLock()


def current() -> Vocabulary:
    """
    The vocabulary that URIs are read with if none is given.

    :returns: Vocabulary, what is bundled until something needs more; then the `complete` one
    """
    global _initial
    if _complete is not None:
        return _complete
    if _initial is None:
        with _lock:
            _initial = _initial or Vocabulary.bundled()
    return _initial


def complete() -> Vocabulary:
    """
    The current vocabulary, with what the packages on this machine and ``ROCON_URI_RULES`` add.

    They are looked up once in a process. A faulty file is logged and left out.

    :returns: Vocabulary
    """
    global _complete
    if _complete is None:
        with _lock:
            _complete = _complete or with_exported_rules(current())
    return _complete


def completed(vocabulary: Vocabulary) -> Vocabulary:
    """The complete vocabulary for the bundled one that stands in for it, else the one given."""
    return complete() if vocabulary is _initial else vocabulary


def precedence(vocabulary: Vocabulary) -> Tuple[bool, int]:
    """
    A key by which to choose the vocabulary for two URIs that were read with different ones.

    The larger one is chosen: one that the caller gave, or else the one that was made later.
    """
    is_default = any(default is not None and vocabulary._fields is default._fields
                     for default in (_initial, _complete))
    return not is_default, vocabulary.serial
