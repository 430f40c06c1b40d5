"""The messages and services of the package capabilities are those that clients were built with."""
from __future__ import annotations

import os
import subprocess
import sys

import pytest
from built import built

msg = built('capabilities.msg')
srv = built('capabilities.srv')

MESSAGES = [
    ('Capability', '05f9dd41875315c324efdf915b0e33a9'),
    ('CapabilityEvent', '5a0d82ee1a8e7a5d0b058f0b20305b18'),
    ('CapabilitySpec', '410c606586817322b7ad85c73e4a4c9f'),
    ('Remapping', 'cf57fdc6617a881a88c16e768132149c'),
    ('RunningCapability', 'f97e2b23f907893008679ba2ff64fafc')]
SERVICES = [
    ('StartCapability', '736529805295984ddb5ab334f50db336'),
    ('StopCapability', 'a38f2dfa23de9298b61bf01d2624e1cc'),
    ('UseCapability', 'd12bf387dc5fcdd1fb836406b703a384'),
    ('FreeCapability', 'a428ffea976541636efe63c8605fd3ec'),
    ('EstablishBond', '5dec67991af973eddfa86dc20c3faef0'),
    ('GetInterfaces', '1e08367cf1ecdb90202f4711ad4955a7'),
    ('GetSemanticInterfaces', '2b0794f4415a7884148fc328bd6bc7d3'),
    ('GetProviders', 'd7193b8cbc296323bd5043e53d4b02d8'),
    ('GetCapabilitySpecs', '70274a8d27cd41f8e0754661d97168f8'),
    ('GetCapabilitySpec', 'd32f85e5386368c45ff17463743a70f8'),
    ('GetRunningCapabilities', 'e8e5cf68c34711ffaa719728f34ea7a3'),
    ('GetNodeletManagerName', '014bb50d87c6c69df1cbae3d5439041f'),
    ('GetRemappings', 'e08cc3bd533b5554ccb1906769ad809b')]
NEW_MESSAGES = [
    ('CapabilityStatus',
     'capability provider state started uses dependents pid since exit_code text',
     'string string string bool uint32 string[] int32 time int32 string'),
    ('CapabilityStatuses', 'header server ready capabilities',
     'std_msgs/Header string bool capabilities/CapabilityStatus[]')]


@pytest.mark.parametrize('name, md5', MESSAGES)
def test_a_message_has_the_md5_of_old(name, md5):
    message = getattr(msg, name)
    assert (message._type, message._md5sum) == ('capabilities/' + name, md5)


@pytest.mark.parametrize('name, md5', SERVICES)
def test_a_service_has_the_md5_of_old(name, md5):
    service = getattr(srv, name)
    assert (service._type, service._md5sum) == ('capabilities/' + name, md5)


@pytest.mark.parametrize('name, fields, types', NEW_MESSAGES)
def test_the_messages_of_the_status(name, fields, types):
    message = getattr(msg, name)
    assert (message.__slots__, message._slot_types) == (fields.split(), types.split())


def test_the_services_that_are_new():
    assert srv.GetStatusRequest.__slots__ == []
    assert srv.GetStatusResponse._slot_types == ['capabilities/CapabilityStatuses']
    assert srv.GetStatusResponse.__slots__ == ['status']
    assert srv.PlanCapabilityRequest.__slots__ == ['capability', 'preferred_provider']
    plan = srv.PlanCapabilityResponse
    assert plan.__slots__ == ['capabilities', 'providers', 'running', 'faults']
    assert plan._slot_types == ['string[]', 'string[]', 'bool[]', 'string[]']


def test_the_types_of_events_contain_their_quotation_marks():
    event = msg.CapabilityEvent
    assert [event.LAUNCHED, event.STOPPED, event.TERMINATED, event.SERVER_READY] == [
        '"launched"', '"stopped"', '"terminated"', '"server_ready"']


def test_what_a_start_comes_to():
    response = srv.StartCapabilityResponse
    assert [response.RESULT_SUCCESS, response.RESULT_CURRENTLY_STARTING,
            response.RESULT_CURRENTLY_RUNNING, response.RESULT_CURRENTLY_STOPPING] == [0, 1, 2, 3]


@pytest.mark.parametrize('modules', [
    'capabilities.msg, capabilities.srv, capabilities.discovery, rocon_uri.msg, rocon_uri.uri',
    'rocon_uri.uri, rocon_uri.msg, capabilities.discovery, capabilities.srv, capabilities.msg',
    'capabilities.discovery, rocon_uri.msg, capabilities.msg',
    'rocon_uri.cli, capabilities.msg, rocon_uri.msg'])
def test_sources_and_messages_are_found_in_any_order(modules, tmp_path):
    # also where the sources are in front of the messages, as with PYTHONPATH=src
    subprocess.run([sys.executable, '-c', 'import ' + modules], check=True, cwd=str(tmp_path),
                   env=dict(os.environ))
