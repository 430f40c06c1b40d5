"""
A name that is probably meant as a value of another field, such as the one in ``rocon:/pc/kitkat``.

Such a URI is legal. Those who show URIs to people mention it, since it can hide a typing error.
"""
from __future__ import annotations

import os
from functools import lru_cache

from rocon_uri.grammar import VOCABULARY_FIELDS
from rocon_uri.sources.wording import did_you_mean, quoted, with_article
from rocon_uri.vocabulary import RULES_FOLDER, Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import FrozenSet, Optional
    from rocon_uri.uri import RoconURI

__all__ = ['misplaced_name']


def misplaced_name(uri: RoconURI) -> Optional[str]:
    """
    What to say about a URI whose name is probably meant as a value of another field.

    That is a literal name that is a registered application_framework or operating_system, while
    both these fields are ``*``. It is neither a hardware_platform nor a first name: releases of
    Linux Mint have first names, and so have a few of other systems.

    :param RoconURI uri: any
    :returns: str, one clause; None if there is nothing to say

    >>> from rocon_uri import parse
    >>> print(misplaced_name(parse('rocon:/pc/kitkat')))
    name 'kitkat' is an operating_system (did you mean 'rocon:/pc/*/*/kitkat'?)
    >>> print(misplaced_name(parse('rocon:/pc/jessie')), misplaced_name(parse('rocon:/pc/bob')))
    None None
    """
    name = uri.name_text
    if not (uri.name_pattern is None and uri.application_framework.is_any
            and uri.operating_system.is_any):
        return None
    fields = [field for field in VOCABULARY_FIELDS if name in uri.vocabulary.field(field)]
    if not fields or 'hardware_platform' in fields or _is_first_name(name, uri.vocabulary):
        return None
    meant = [(uri.replace(name='*', application_framework=name) if field == 'application_framework'
              else uri.replace(name='*', operating_system=name)).short for field in fields]
    return 'name %s is %s%s' % (quoted(name), ' and '.join(map(with_article, fields)),
                                did_you_mean(meant))


def _is_first_name(name: str, vocabulary: Vocabulary) -> bool:
    return name in vocabulary.field('operating_system').children('mint') or name in _first_names()


@lru_cache(maxsize=None)
def _first_names() -> FrozenSet[str]:
    import json     # here, since few names are values
    with open(os.path.join(RULES_FOLDER, 'first_names.json'), encoding='utf-8') as file:
        return frozenset(json.load(file))
