"""The values that YAML 1.1 gives to scalars without quotes, or with a tag of a core type."""
from __future__ import annotations

import re
from typing import Callable, Dict, Optional, Union

__all__ = ['CORE', 'TAGGED', 'Scalar', 'plain']

Scalar = Union[str, int, float, bool, None]

CORE = 'tag:yaml.org,2002:'     # what the tags of the core types begin with

_MAX_NUMBER_LENGTH = 256    # characters: reading n digits takes time that grows with n squared
_BOOLS = {form: value for words, value in (('yes true on', True), ('no false off', False))
          for word in words.split() for form in (word, word.capitalize(), word.upper())}
_NULLS = dict.fromkeys(['', '~', 'null', 'Null', 'NULL'])
_WORDS: Dict[str, Optional[bool]] = {**_BOOLS, **_NULLS}
_START_OF_NUMBER = frozenset('+-.0123456789')
_integer = re.compile(
    r'[-+]?(?:0b[01_]+|0[0-7_]+|0|[1-9][0-9_]*|0x[0-9a-fA-F_]+|[1-9][0-9_]*(?::[0-5]?[0-9])+)'
).fullmatch
_float = re.compile(
    r'[-+]?[0-9][0-9_]*\.[0-9_]*(?:[eE][-+][0-9]+)?|\.[0-9][0-9_]*(?:[eE][-+][0-9]+)?'
    r'|[-+]?[0-9][0-9_]*(?::[0-5]?[0-9])+\.[0-9_]*|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)'
).fullmatch


def plain(value: str) -> Scalar:
    """The value of a scalar without quotes and tag; ValueError for a number that is too large."""
    if value in _WORDS:
        return _WORDS[value]
    if value[0] in _START_OF_NUMBER:
        if _integer(value):
            return _to_int(value)
        if _float(value):
            return _to_float(value)
    return value


def _to_int(value: str) -> int:
    """The value of an integer in the notation of YAML 1.1."""
    if len(value) > _MAX_NUMBER_LENGTH or not _integer(value):
        raise ValueError
    digits = value.replace('_', '').lstrip('+-')
    if ':' in digits:
        number = 0
        for part in digits.split(':'):
            number = number * 60 + int(part)
    elif digits[:2] in ('0b', '0x'):
        number = int(digits, 0)
    else:
        number = int(digits, 8 if digits[0] == '0' else 10)
    return -number if value[0] == '-' else number


def _to_float(value: str) -> float:
    """The value of a floating point number or an integer in the notation of YAML 1.1."""
    if _integer(value):
        return float(_to_int(value))
    if len(value) > _MAX_NUMBER_LENGTH or not _float(value):
        raise ValueError
    digits = value.replace('_', '').lstrip('+-').lower()
    number, base = 0.0, 1
    if ':' in digits:
        for part in reversed(digits.split(':')):
            number += float(part) * base
            base *= 60
    else:
        number = float(digits.lstrip('.') if digits[1:] in ('inf', 'nan') else digits)
    return -number if value[0] == '-' else number


TAGGED: Dict[str, Callable[[str], Scalar]] = {
    CORE + 'str': str, CORE + 'int': _to_int, CORE + 'float': _to_float,
    CORE + 'bool': _BOOLS.__getitem__, CORE + 'null': _NULLS.__getitem__}
