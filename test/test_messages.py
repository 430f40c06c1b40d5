"""A RoconURI as the ROS message rocon_uri/RoconURI, and back."""
from __future__ import annotations

from io import BytesIO

import pytest
from built import built
from hypothesis import given
from hypothesis import strategies as st

from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.messages import from_msg, to_msg
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import current

msg = built('rocon_uri.msg')


def alternatives(field):
    values = st.sampled_from(list(current().field(field)) + ['*'])
    return st.lists(values, min_size=1, max_size=5)


base_names = st.from_regex('[A-Za-z][A-Za-z0-9_]{0,8}', fullmatch=True)
uris = st.builds(
    RoconURI.from_fields,
    concert_name=st.one_of(st.just(''), base_names, st.sampled_from(['pc', 'turtlebot2', 'robot'])),
    hardware_platform=alternatives('hardware_platform'),
    name=st.one_of(base_names, st.sampled_from(['*', 'dud*', 'bob[0-9]+', '(bob|alice)_\\d{2}',
                                                'bob?[0-9]', 'a(|b)c'])),
    application_framework=alternatives('application_framework'),
    operating_system=alternatives('operating_system'),
    rocon_app=st.one_of(st.just(''), base_names, st.builds('{}/{}'.format, base_names, base_names)))


def over_the_wire(message):
    buffer = BytesIO()
    message.serialize(buffer)
    return msg.RoconURI().deserialize(buffer.getvalue())


@given(uris)
def test_nothing_is_lost_over_the_wire(uri):
    arrived = from_msg(over_the_wire(to_msg(uri)))
    assert arrived == uri
    assert str(arrived) == str(uri)


def test_a_message_says_what_the_uri_says():
    message = to_msg(parse('rocon://north/turtlebot2|pr2/bob_*/noetic#rocon_apps/teleop'))
    assert (message.concert_name, message.name, message.rocon_app) == (
        'north', 'bob_*', 'rocon_apps/teleop')
    assert message.hardware_platform == ['turtlebot2', 'pr2']
    assert message.application_framework == ['noetic']
    assert message.operating_system == ['*']


def test_a_concert_called_like_a_platform_stays_a_concert():
    uri = parse('rocon://pc/*/*/*/*')
    assert uri.concert_name == 'pc'
    assert from_msg(to_msg(uri)) == uri


def test_an_empty_message_is_any_resource():
    assert from_msg(msg.RoconURI()) == parse('rocon:/')


@pytest.mark.parametrize('field, value', [
    ('concert_name', '*'),
    ('concert_name', 'north/pr2'),
    ('hardware_platform', ['turtelbot2']),
    ('hardware_platform', ['']),
    ('hardware_platform', ['pr2', '']),
    ('hardware_platform', ['pr2|kobuki']),
    ('hardware_platform', ['pr2', 'turtelbot2|kobuki']),
    ('hardware_platform', ['pr2/bob']),
    ('hardware_platform', ['pr2#a/b']),
    ('hardware_platform', ['%70r2']),
    ('hardware_platform', ['pr2%7Ckobuki']),
    ('hardware_platform', ['pr2\n']),
    ('hardware_platform', ['pr2'] * 257),
    ('application_framework', ['noetic/focal']),
    ('operating_system', ['focal#rocon_apps/teleop']),
    ('name', 'bob/noetic'),
    ('name', 'bob#rocon_apps/teleop'),
    ('name', 'b%6Fb'),
    ('name', 'bob|alice'),
    ('name', 'bob alice'),
    ('name', '3bob'),
    ('name', 'b' * 256),
    ('rocon_app', 'a/b/c'),
    ('rocon_app', 'a%2Fb'),
    ('rocon_app', '#a'),
])
def test_a_field_that_holds_what_it_may_not_is_an_error_of_that_field(field, value):
    with pytest.raises(RoconURIValueError) as caught:
        from_msg(msg.RoconURI(**{field: value}))
    assert caught.value.field == field
    assert '\n' not in str(caught.value)


@given(st.fixed_dictionaries({
    'concert_name': st.text(), 'name': st.text(), 'rocon_app': st.text(),
    'hardware_platform': st.lists(st.text(), max_size=3),
    'application_framework': st.lists(st.text(), max_size=3),
    'operating_system': st.lists(st.text(), max_size=3)}))
def test_a_message_of_anything_is_read_or_refused(fields):
    try:
        uri = from_msg(msg.RoconURI(**fields))
    except RoconURIValueError:
        return
    assert from_msg(to_msg(uri)) == uri
