r"""
Parser: from the text of a regular expression in the name field to a syntax tree.

The syntax is ``regex`` in `rocon_uri.grammar.EBNF`, the common core of regular expression syntaxes,
over the 63 characters of a ROS name. The pattern covers the whole name, so the anchors at its ends
are redundant; ``.``, ``\D``, ``\W`` and negated classes match only these 63 characters.

Every other construct is refused with an error of its own that says what to write instead. Reading
takes time linear in the length of the text.
"""
from __future__ import annotations

import re

from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import quoted
from rocon_uri.regular.tree import (
    BIT, DIGITS, LETTERS, LOWER, NOTHING, UPPER, WORD, Characters, Node, choice, repeat, sequence)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import List, Optional, Tuple

__all__ = ['COUNT_LIMIT', 'DEPTH_LIMIT', 'SIZE_LIMIT', 'parse']

DEPTH_LIMIT = 32    # nested groups
COUNT_LIMIT = 255   # in {m,n}
SIZE_LIMIT = 4096   # atoms, once counted repetition is written out

_ESCAPES = {'d': DIGITS, 'D': WORD & ~DIGITS, 'w': WORD, 'W': 0}
_QUANTIFIERS = {'*': (0, None), '+': (1, None), '?': (0, 1)}
_count = re.compile(r'\{([0-9]*)(,?)([0-9]*)\}').match
_reference = re.compile(r'\\[0-9]+').match
_flags = re.compile(r'\(\?[a-zA-Z-]+[:)]').match

# The text after '(', what the construct is called, what to write instead. The first match counts.
_SPECIAL_GROUPS = (
    ('?=', 'look-ahead', 'write out the names that are meant'),
    ('?!', 'look-ahead', 'write out the names that are meant'),
    ('?<=', 'look-behind', 'write out the names that are meant'),
    ('?<!', 'look-behind', 'write out the names that are meant'),
    ('?P=', 'back-reference', 'write the group out again'),
    ('?P<', 'named group', "write '(' alone"),
    ('?<', 'named group', "write '(' alone"),
    ('?>', 'atomic group', "write '(' alone"),
    ('?#', 'comment', 'leave it out'),
    ('?(', 'conditional group', "write both cases, as in '(ab|c)'"),
    ('?', 'group', "write '(' or '(?:'"),
)

_CLASS_ADVICE = {
    '-': "in a class it stands only between the ends of a range, as in '[a-z]'",
    '[': "a class holds characters, ranges, '\\d', '\\D', '\\w' and '\\W'"}


def parse(text: str) -> Node:
    r"""
    Read a regular expression in the name field.

    :param str text: the expression, of at most 255 characters
    :returns: Node, the tree
    :raises RoconURIValueError: if the text is not in the syntax, exceeds a limit, or matches no
        legal ROS name; ``span`` is where in the text the fault is

    >>> parse('^(?:a|b)+$') == parse('[ab][ab]*')
    True
    >>> parse('a)')
    Traceback (most recent call last):
    rocon_uri.exceptions.RoconURIValueError: ')' closes no group, at character 2 of 'a)'
    """
    reader = _Reader(text)
    tree = reader.read()
    if not tree.opening & LETTERS:
        reason = ('a ROS name starts with a letter' if tree.opening else
                  'it asks for a character that is not in ROS names' if tree == NOTHING else
                  'a ROS name has at least one character')
        raise reader.error('name pattern %s admits no name: %s' % (quoted(text), reason),
                           0, len(text))
    return tree


class _Reader:
    """A recursive descent parser, which reads a text once, from left to right."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = self.begin = 1 if text.startswith('^') else 0
        self.end = len(text) - 1 if text.endswith('$') else len(text)

    def error(self, problem: str, start: int, end: int, advice: str = '') -> RoconURIValueError:
        return RoconURIValueError(problem, self.text, 'name', self.text, (start, end),
                                  advice=advice)

    def refused(self, what: str, start: int, end: int, advice: str) -> RoconURIValueError:
        shown = quoted(self.text[start:end])
        return self.error('%s %s is not supported in a name' % (what, shown), start, end, advice)

    def read(self) -> Node:
        tree, _ = self.branches(0)
        if self.at < self.end:
            raise self.error("')' closes no group", self.at, self.at + 1)
        return tree

    def branches(self, depth: int) -> Tuple[Node, int]:
        """The content of a group, and how many atoms it has once repetition is written out."""
        branches: List[List[Node]] = [[]]
        size = 0
        while self.at < self.end and self.text[self.at] != ')':
            start, char = self.at, self.text[self.at]
            if char == '|':
                if not depth:
                    raise self.error("the or operator '|' is not for the name", start, start + 1,
                                     'write %s' % quoted('(%s)' % self.text[self.begin:self.end]))
                self.at += 1
                branches.append([])
                continue
            node, atoms = self.group(depth + 1) if char == '(' else (Characters(self.atom(char)), 1)
            least, most = self.quantifier()
            size += atoms * (max(least, 1) if most is None else most)
            if size > SIZE_LIMIT:
                raise self.error(
                    'name pattern %s is too large: more than %d atoms once counted repetition is '
                    'written out' % (quoted(self.text), SIZE_LIMIT), start, self.at)
            branches[-1].append(repeat(node, least, most))
        return choice(map(sequence, branches)), size

    def group(self, depth: int) -> Tuple[Node, int]:
        start = self.at
        if depth > DEPTH_LIMIT:
            raise self.error('groups are at most %d deep' % DEPTH_LIMIT, start, start + 1)
        self.at += 1
        if self.text.startswith('?:', self.at):
            self.at += 2
        elif self.text.startswith('?', self.at):
            raise self.special_group(start)
        content = self.branches(depth)
        if self.at == self.end:
            raise self.error("'(' is not closed", start, start + 1)
        self.at += 1
        return content

    def special_group(self, start: int) -> RoconURIValueError:
        flags = _flags(self.text, start)
        if flags:
            return self.refused('flag', start, flags.end(),
                                "write both cases, as in '[Bb]ob', if that is what it is for")
        opening, what, advice = next(row for row in _SPECIAL_GROUPS
                                     if self.text.startswith(row[0], self.at))
        return self.refused(what, start, self.at + len(opening), advice)

    def quantifier(self) -> Tuple[int, Optional[int]]:
        """How often the atom before is repeated: at least and at most (None: no limit)."""
        char = self.text[self.at:self.at + 1] if self.at < self.end else ''
        start = self.at
        if char == '{':
            counts = self.counts()
        elif char in _QUANTIFIERS:
            self.at += 1
            counts = _QUANTIFIERS[char]
        else:
            return 1, 1
        following = self.text[self.at:self.at + 1]
        if following and following in '*+?{':
            what, advice = {
                '?': ('lazy quantifier', "leave out the '?': the pattern covers the whole name "
                                         'either way'),
                '+': ('possessive quantifier', "leave out the '+'"),
            }.get(following, ('quantifier after a quantifier', 'put the first one and what it '
                              "repeats in a group, as in '(a*)*'"))
            raise self.refused(what, start, self.at + 1, advice)
        return counts

    def counts(self) -> Tuple[int, Optional[int]]:
        start = self.at
        found = _count(self.text, start)
        if not found:
            raise self.error("'{' starts no count", start, start + 1,
                             "write '{m}', '{m,}' or '{m,n}'")
        self.at = end = found.end()
        shown = quoted(found.group())
        least, comma, most = found.groups()
        if not least:
            raise self.error('count %s has no least number' % shown, start, end, "write '{0,%s}'"
                             % most if most else "write '{m}', '{m,}' or '{m,n}'")
        low, high = int(least), int(most) if most else None if comma else int(least)
        if max(low, high or 0) > COUNT_LIMIT:
            raise self.error('count %s is too large: at most %d' % (shown, COUNT_LIMIT), start, end)
        if high is not None and high < low:
            raise self.error('count %s is out of order' % shown, start, end,
                             "write '{%d,%d}'" % (high, low))
        return low, high

    def atom(self, char: str) -> int:
        """The set of characters that the next atom matches; not for groups."""
        start = self.at
        if char == '\\':
            return self.escape()
        self.at += 1
        if char in BIT:
            return BIT[char]
        if char == '.':
            return WORD
        if char == '[':
            return self.char_class()
        if char in '*+?{':
            raise self.error('quantifier %s has nothing to repeat' % quoted(char), start, self.at,
                             "write '.%s' to repeat any character" % char if char in '*+' else '')
        if char in '^$':
            raise self.error('anchor %s is only for the %s of the pattern'
                             % (quoted(char), 'start' if char == '^' else 'end'), start, self.at,
                             'leave it out: a pattern covers the whole name')
        raise self.not_in_names(char, start)

    def not_in_names(self, char: str, start: int, advice: str = '') -> RoconURIValueError:
        return self.error("%s cannot stand in a ROS name, which has only letters, digits and '_'"
                          % quoted(char), start, start + 1, advice)

    def escape(self) -> int:
        start = self.at
        char = self.text[start + 1:start + 2]
        self.at += 2
        if char and char in _ESCAPES:
            return _ESCAPES[char]
        if not char:
            raise self.error("'\\' escapes nothing", start, start + 1)
        number = _reference(self.text, start)
        if number:
            raise self.refused('back-reference', start, number.end(), 'write the group out again')
        if char in 'AZzbB':
            raise self.refused('anchor', start, self.at,
                               'leave it out: a pattern covers the whole name')
        raise self.refused('escape', start, self.at,
                           "there are '\\d', '\\D', '\\w' and '\\W', and no character of a ROS "
                           'name needs one')

    def char_class(self) -> int:
        """The set of characters of a class whose ``[`` has been read."""
        opened = self.at - 1
        negated = self.text.startswith('^', self.at)
        self.at += negated
        first, chars = self.at, 0
        while self.at < self.end:
            start, char = self.at, self.text[self.at]
            if char == ']':
                if start == first:
                    raise self.error('class %s is empty' % quoted(self.text[opened:start + 1]),
                                     opened, start + 1)
                self.at += 1
                return WORD & ~chars if negated else chars
            if char == '\\':
                chars |= self.escape()
                continue
            if char not in BIT:
                raise self.not_in_names(char, start, _CLASS_ADVICE.get(char, ''))
            self.at += 1
            chars |= self.char_range(char, start) if self.text.startswith('-', self.at) \
                else BIT[char]
        raise self.error("'[' is not closed", opened, opened + 1)

    def char_range(self, low: str, start: int) -> int:
        """The set of characters of a range whose first end has been read."""
        high = self.text[self.at + 1:self.at + 2]
        if high not in BIT:
            raise self.not_in_names('-', self.at, _CLASS_ADVICE['-'])
        self.at += 2
        written = quoted(self.text[start:self.at])
        if not any(BIT[low] & kind and BIT[high] & kind for kind in (LOWER, UPPER, DIGITS)):
            raise self.error('range %s is not of two digits, two lower-case or two upper-case '
                             'letters' % written, start, self.at, "for any letter write '[A-Za-z]'"
                             if BIT[low] & LETTERS and BIT[high] & LETTERS else '')
        if BIT[low] > BIT[high]:
            raise self.error('range %s is out of order' % written, start, self.at,
                             "write '%s-%s'" % (high, low))
        return 2 * BIT[high] - BIT[low]
