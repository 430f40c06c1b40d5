"""
The grammar of a rocon URI: as EBNF for people, and as the one expression that splits a text.

The expression only finds the parts. `rocon_uri.reading` decides whether each part is legal.
"""
from __future__ import annotations

import re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterable, Mapping, Tuple

__all__ = ['ALTERNATIVES_LIMIT', 'EBNF', 'NAME_LIMIT', 'TEXT_LIMIT', 'VOCABULARY_FIELDS',
           'decoded', 'ebnf', 'is_literal', 'is_rocon_app', 'raw_span', 'split', 'stray_character']

TEXT_LIMIT = 65536          # characters of a whole URI
NAME_LIMIT = 255            # characters of a concert name, of a name or pattern, of half an app
ALTERNATIVES_LIMIT = 256    # alternatives of one field

#: The fields whose values are registered, in the order in which a URI has them.
VOCABULARY_FIELDS = ('hardware_platform', 'application_framework', 'operating_system')

EBNF = r'''
rocon_uri   = "rocon:" , [ "//" , [ concert_name ] ] , [ "/" , fields ] , [ "#" , [ rocon_app ] ] ;
fields      = hardware_platform , [ "/" , name , [ "/" , application_framework ,
              [ "/" , operating_system , [ "/" ] ] ] ] ;

hardware_platform     = [ platform , { "|" , platform } ] ;
application_framework = [ framework , { "|" , framework } ] ;
operating_system      = [ system , { "|" , system } ] ;
name                  = [ "*" | base_name | glob | regex ] ;
concert_name          = base_name ;
rocon_app             = base_name , [ "/" , ( letter | digit ) , { letter | digit | "_" } ] ;

base_name   = letter , { letter | digit | "_" } ;
glob        = { letter | digit | "_" | "*" } ;              (* at least one "*" *)

regex       = [ "^" ] , branch , [ "$" ] ;                  (* of the whole name *)
branch      = { piece } ;
piece       = atom , [ "*" | "+" | "?" | count ] ;
count       = "{" , m , [ "," , [ n ] ] , "}" ;
atom        = letter | digit | "_" | "." | class | shorthand | group ;
group       = ( "(" | "(?:" ) , branch , { "|" , branch } , ")" ;
class       = "[" , [ "^" ] , item , { item } , "]" ;
item        = letter | digit | "_" | range | shorthand ;
range       = ? two digits, two lower-case or two upper-case letters in order, "-" between ? ;
shorthand   = "\d" | "\D" | "\w" | "\W" ;
m           = ? a number from 0 to 255 ? ;
n           = ? a number from m to 255 ? ;
letter      = ? A to Z, a to z ? ;
digit       = ? 0 to 9 ? ;

platform    = "*" | ? a hardware_platform that is registered, or a group of them ? ;
framework   = "*" | ? an application_framework, likewise ? ;
system      = "*" | ? an operating_system, likewise ? ;
'''.lstrip()

#: Matches a text that begins with the scheme. The groups are the concert name, the slash before
#: the fields ('' where it is missing), the four fields, a fifth field and more, and the app; all
#: of them raw, and None where they are left out.
split = re.compile(
    r'(?i:rocon):(?://([^/#]*))?(/?)([^/#]*)(?:/([^/#]*)(?:/([^/#]*)(?:/([^/#]*)(/[^#]*)?)?)?)?'
    r'(?:#(.*))?', re.DOTALL).fullmatch

#: A match of the first white space or control character, which no URI may have, else None.
stray_character = re.compile(r'[\s\x00-\x1f\x7f-\x9f]').search

_escape = re.compile(r'%([0-9A-Fa-f]{2})?')

#: A match if the text is a literal name, else None.
is_literal = re.compile(r'[A-Za-z]\w{0,254}', re.ASCII).fullmatch

#: A match if the text is the name of an app, ``package/name`` or ``name``, else None.
is_rocon_app = re.compile(r'[A-Za-z]\w{0,254}(?:/[A-Za-z0-9]\w{0,254})?', re.ASCII).fullmatch


def decoded(raw: str) -> str:
    """
    A part of a URI with its percent-escapes decoded.

    :raises ValueError: for a ``%`` without two hexadecimal digits, and for escapes that are not
        UTF-8; its text says which

    >>> decoded('pr2%7Ckobuki')
    'pr2|kobuki'
    """
    if '%' not in raw:
        return raw
    for match in _escape.finditer(raw):
        if match.group(1) is None:
            raise ValueError("'%' is not followed by two hexadecimal digits")
    # a lone surrogate cannot be encoded, as a stray byte cannot be decoded
    try:
        octets = b''.join(bytes([int(piece, 16)]) if index % 2 else piece.encode('utf-8')
                          for index, piece in enumerate(_escape.split(raw)))
        return octets.decode('utf-8')
    except UnicodeError:
        raise ValueError('its percent-escapes are not UTF-8') from None


def raw_span(raw: str, start: int, end: int) -> Tuple[int, int]:
    """
    Where characters of a decoded part stand in its raw text, which `decoded` takes.

    >>> raw_span('pr2%7Ckobuki', 4, 10)
    (6, 12)
    """
    if '%' not in raw:
        return start, end
    # where each decoded character starts: an escape of a continuation byte does not start one
    starts = [match.start() for match in re.finditer('%[0-9A-Fa-f]{2}|.', raw, re.DOTALL)
              if not re.match('%[89ABab]', match.group())]
    starts.append(len(raw))
    return starts[start], starts[end]


def ebnf(values: Mapping[str, Iterable[str]]) -> str:
    """
    The whole grammar with the vocabulary in it.

    :param values: mapping of the name of each vocabulary field to its values and groups
    :returns: str, several lines

    >>> print(ebnf({'hardware_platform': ['pc'], 'application_framework': ['ros'],
    ...             'operating_system': ['linux']}).splitlines()[-1])
    system      = "*" | "linux" ;
    """
    symbols = zip(('platform', 'framework', 'system'), VOCABULARY_FIELDS)
    rules, blank, _ = EBNF.rpartition('\n\n')
    return rules + blank + ''.join(_choice(symbol, values[field]) for symbol, field in symbols)


def _choice(symbol: str, values: Iterable[str]) -> str:
    """One rule of EBNF: a choice of quoted values, wrapped at 100 characters."""
    import textwrap     # slow to import, and parsing does not need it
    # no-break spaces, so that each line begins with a '|'
    choice = ' |\xa0'.join('"%s"' % value for value in ('*', *values))
    rule = textwrap.fill('%-11s = %s\xa0;' % (symbol, choice), 100, subsequent_indent=' ' * 12,
                         break_long_words=False)
    return rule.replace('\xa0', ' ') + '\n'
