"""RoconURI messages from anybody: their fields as a program sets them, and as bytes on the wire."""
from __future__ import annotations

import sys
from io import BytesIO
from types import SimpleNamespace

from fuzz.damage import ROOT, damaged
from fuzz.name_pattern import GOOD as PATTERNS
from fuzz.uri import KNOWN, VALUES
from genpy import DeserializationError
from genpy.dynamic import generate_dynamic

from rocon_uri import RoconURIValueError, is_compatible, parse
from rocon_uri.grammar import VOCABULARY_FIELDS
from rocon_uri.messages import from_msg, to_msg
from rocon_uri.name_pattern import read
from rocon_uri.sources.ros_names import is_legal_base_name


NAME = 'rocon_uri/RoconURI'
try:
    from rocon_uri.msg import RoconURI as Message
except ImportError:     # the package has not been built
    Message = generate_dynamic(NAME, (ROOT / 'msg/RoconURI.msg').read_text())[NAME]

TEXTS = ['', '*', 'pr2', 'pc', 'robot', 'nobody', 'noetic', 'ros', 'focal', 'linux', 'bob', 'bob_*',
         'bob[0-9]+', '(a|b)c', 'rocon_apps/teleop', 'teleop', 'pr2|kobuki', 'rocon:/pr2', '/', '|',
         '#', '%', '%7C', '%2F', '?', ' ', '\n', '\0', '\xe9', '\ud800', 'a' * 255, 'a' * 256, '**']
GOOD = {**VALUES, 'concert_name': ['', 'north', 'pc'], 'name': PATTERNS,
        'rocon_app': ['', 'teleop', 'rocon_apps/teleop']}
GOOD['operating_system'] = GOOD['operating_system'] + ['linux|windows']     # which is none
BYTES = [b'\0', b'\1', b'\xff', b'\0\0\0\0', b'\1\0\0\0', b'\xff\xff\xff\x7f', b'a', b'*',
         b'\xc3\xa9']


def make(rng):
    def text(field):
        if rng.random() < 0.8:
            return rng.choice(GOOD[field])
        return damaged(rng, rng.choice(TEXTS), TEXTS)

    def values(field):
        if rng.random() < 0.1:
            return rng.choices(GOOD[field], k=rng.choice((256, 257)))
        return [text(field) for _ in range(rng.choice((0, 0, 1, 1, 1, 2, 3)))]

    fields = {field: values(field) if field in VOCABULARY_FIELDS else text(field)
              for field in Message.__slots__ if rng.random() < 0.6}
    good = Message(hardware_platform=['pr2', 'robot'], name='bob', rocon_app='a/b')
    return fields, damaged(rng, on_the_wire(good), BYTES)


def check(given):
    fields, content = given
    sys.modules.setdefault('rocon_uri.msg', SimpleNamespace(RoconURI=Message))  # for to_msg
    check_message(Message(**fields))
    try:
        message = Message().deserialize(content)
    except (DeserializationError, UnicodeDecodeError):     # the latter from older genpy
        return
    check_message(message)


def check_message(message):
    try:
        uri = from_msg(message)
    except RoconURIValueError as error:
        assert str(error).isprintable()
        assert not is_legal(error.field, getattr(message, error.field))
        return
    assert all(is_legal(field, getattr(message, field)) for field in Message.__slots__)
    for field in Message.__slots__:
        given, found = getattr(message, field), getattr(uri, field)
        if field in VOCABULARY_FIELDS:
            assert found.list == (['*'] if '*' in given or not given
                                  else sorted(set(given), key=given.index))
        else:
            assert str(found) == (given or '*' if field == 'name' else given)
    arrived = from_msg(Message().deserialize(on_the_wire(to_msg(uri))))
    assert arrived == uri and str(arrived) == str(uri)
    assert parse(str(uri)) == uri
    assert is_compatible(uri, arrived)


def is_legal(field, value):
    if field in VOCABULARY_FIELDS:
        return len(value) <= 256 and all(
            one == '*' or one in KNOWN.field(field) for one in value)
    if field == 'name':
        return value == '' or is_pattern(value)
    names = value.split('/', 1) if field == 'rocon_app' else [value]
    return value == '' or all(len(name) <= 255 and is_legal_base_name(name) for name in names)


def is_pattern(text):
    try:
        read(text)
    except RoconURIValueError:
        return False
    return True


def on_the_wire(message):
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()
