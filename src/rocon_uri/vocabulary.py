"""
Vocabularies: the values that the fields of a rocon URI may have.

A vocabulary never changes: more rules make a new one. What a URI is read with where nothing else is
said is `current`: first what is bundled, then, once it was `complete`, also what the packages on
this machine export.
"""
from __future__ import annotations

import itertools
import os
from _thread import RLock       # as functools does: threading takes longer than parsing

from rocon_uri.sources.wording import quoted
from rocon_uri.field_vocabulary import FieldVocabulary, RulesError, members
from rocon_uri.grammar import VOCABULARY_FIELDS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, Mapping, Optional, Tuple

__all__ = ['Vocabulary', 'complete', 'completed', 'current', 'precedence']

_RULES_FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'rules')
_serial_numbers = itertools.count()


class Vocabulary:
    """
    The values of the three fields that have registered ones.

    :param rules: mapping from ``'hardware_platform'``, ``'application_framework'`` and
        ``'operating_system'`` to nested groups: mappings from a group to what is in it, lists of
        values and of such mappings, or a mix; a list of such mappings is the same
    :raises RulesError: for rules that do not fit

    >>> ours = Vocabulary({'hardware_platform': {'robot': ['bender']}})
    >>> 'bender' in ours.field('hardware_platform')
    True
    """

    __slots__ = ('_fields', '_opened', 'is_open', 'serial', 'fields_read', 'uris_read')

    def __init__(self, rules: Any) -> None:
        fields = {name: FieldVocabulary(name, {}) for name in VOCABULARY_FIELDS}
        self._adopt(_extended(fields, rules))

    def _adopt(self, fields: Dict[str, FieldVocabulary], is_open: bool = False) -> None:
        self._fields = fields
        self._opened: Optional[Vocabulary] = None
        #: bool: is any base name a value?
        self.is_open = is_open
        #: int: larger for one that was made later
        self.serial = next(_serial_numbers)
        # What was read with this vocabulary, kept by those who read: so it ends with it, and a
        # thread that is late cannot leave anything for those who read with the next one.
        self.fields_read: Dict[str, Dict[str, Any]] = {name: {} for name in fields}
        self.uris_read: Dict[str, Any] = {}

    @classmethod
    def _of(cls, fields: Dict[str, FieldVocabulary], is_open: bool = False) -> 'Vocabulary':
        vocabulary = cls.__new__(cls)
        vocabulary._adopt(fields, is_open)
        return vocabulary

    @classmethod
    def bundled(cls) -> 'Vocabulary':
        """
        What this package knows by itself.

        :returns: Vocabulary

        >>> 'noetic' in Vocabulary.bundled().field('application_framework')
        True
        """
        import json     # here, since importing the package should be cheap
        rules = {}
        for name in VOCABULARY_FIELDS:
            with open(os.path.join(_RULES_FOLDER, name + '.json'), encoding='ascii') as rules_file:
                rules[name] = json.load(rules_file)
        return cls(rules)

    @classmethod
    def open(cls) -> 'Vocabulary':
        """
        The complete vocabulary of this machine, in which any other base name is a value too.

        :returns: Vocabulary

        >>> Vocabulary.open().is_open
        True
        """
        return complete().opened()

    def opened(self) -> 'Vocabulary':
        """
        This vocabulary, but any base name is a value.

        :returns: Vocabulary, itself where it is open already
        """
        if self._opened is None:
            self._opened = self if self.is_open else Vocabulary._of(self._fields, is_open=True)
        return self._opened

    def extended(self, rules: Any) -> 'Vocabulary':
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

        :param str name: one of `rocon_uri.grammar.VOCABULARY_FIELDS`
        :returns: FieldVocabulary
        :raises KeyError: for any other name
        """
        return self._fields[name]


def _extended(fields: Mapping[str, FieldVocabulary],
              rules: Any) -> Dict[str, FieldVocabulary]:
    extended = dict(fields)
    for name, below, path in members(rules):
        if name not in VOCABULARY_FIELDS:
            raise RulesError('%s is no field with registered values; these are: %s'
                             % (quoted(str(name)), ', '.join(VOCABULARY_FIELDS)), path)
        extended[name] = extended[name].extended(below, path)
    return extended


_initial: Optional[Vocabulary] = None       # what is bundled, in use until more is asked for
_complete: Optional[Vocabulary] = None
_lock = RLock()


def current() -> Vocabulary:
    """
    The vocabulary that URIs are read with where no other is given.

    :returns: Vocabulary: what is bundled, until something needed more and it was completed
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
            if _complete is None:
                from rocon_uri.exported_rules import with_exported_rules    # only where it is used
                _complete = with_exported_rules(current())
    return _complete


def completed(vocabulary: Vocabulary) -> Vocabulary:
    """
    The vocabulary to use where the extent of groups matters.

    :param Vocabulary vocabulary: any
    :returns: Vocabulary: the complete one for the one that stood in for it, else the one given
    """
    return complete() if vocabulary is _initial else vocabulary


def precedence(vocabulary: Vocabulary) -> Tuple[bool, int]:
    """
    A key that is larger for the one of two vocabularies that URIs of both are to be read with.

    That is one that was given, before what stands in where none is; and then the later one.

    :param Vocabulary vocabulary: any
    :returns: (bool, int)
    """
    stands_in = any(default is not None and vocabulary._fields is default._fields
                    for default in (_initial, _complete))
    return not stands_in, vocabulary.serial
