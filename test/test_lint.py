"""What the linter finds in packages, and where."""
from __future__ import annotations

import os
from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_packages import make_package
from sources import ROOT

from rocon_uri.sources.wording import quoted_path
from rocon_uri.sources.yaml_data import YamlSequence
from rocon_uri.lint import ERROR, WARNING, Finding, check_packages

CORPUS = os.environ.get('ROCON_URI_CORPUS')
needs_corpus = pytest.mark.skipif(not CORPUS, reason='ROCON_URI_CORPUS is not set')

CAMERA = '''\
name: Camera
spec_version: 1
spec_type: interface
interface:
  topics:
    provides:
      image: {type: sensor_msgs/Image}
    requires:
      /flash: {type: std_msgs/Empty}
'''
USB_CAMERA = '''\
name: usb_camera
spec_version: 1
spec_type: provider
implements: ours/Camera
'''
DANCE = '''\
compatibility: rocon:/kobuki
launch: dance.launch
'''


def described(text):
    """A rapp with what people see of it, at its end."""
    if text.startswith('{'):
        return text[:-1] + ', ' * (text != '{}') + 'display: A, description: B}'
    return text.rstrip('\n') + '\ndisplay: A\ndescription: B\n'


def findings_in(workspace, monkeypatch, *package_path):
    """What is found in a workspace, as lines with paths relative to it and without the ids."""
    monkeypatch.chdir(workspace)
    return [str(finding)[:-len(' [%s]' % finding.id)]
            for finding in check_packages(['.'], package_path)]


def found(tmp_path, monkeypatch, exports=(), **files):
    """What is found in the package ours; each file is exported by its folder."""
    kinds = {'interfaces': 'capability_interface', 'semantic': 'semantic_capability_interface',
             'providers': 'capability_provider', 'rapps': 'rocon_app'}
    folders = [(kinds.get(key.partition('__')[0]), '.'.join(key.replace('__', '/').rsplit('_', 1)))
               for key in files]
    exports = [(tag, path) for tag, path in folders
               if tag and path.endswith(('.yaml', '.rapp'))] + list(exports)
    make_package(tmp_path, 'ours', exports, **{
        key: described(text) if key.endswith('_rapp') else text for key, text in files.items()})
    prefix = 'ours' + os.sep
    return [line[len(prefix):].partition('; to register it')[0]
            for line in findings_in(tmp_path, monkeypatch)]


# Workspaces

@pytest.mark.parametrize('folder', ['examples/workspace', 'test/workspace'])
def test_the_workspaces_of_this_repository_are_clean(folder):
    assert check_packages([str(ROOT / folder)]) == []


@needs_corpus
def test_in_the_corpus_only_what_is_really_wrong_is_found():
    findings = check_packages([CORPUS])
    assert Counter((finding.severity, finding.id) for finding in findings) == {
        (ERROR, 'launch-missing'): 15,      # the corpus holds no launch files and no icons
        (WARNING, 'file-missing'): 9,
        (ERROR, 'unknown-provider'): 2,
        (WARNING, 'unknown-name'): 1,
        (WARNING, 'duplicate-key'): 1}
    others = [finding for finding in findings if not finding.problem.endswith('does not exist')]
    assert [(finding.severity, finding.line, finding.column) for finding in others] == [
        (WARNING, 18, 9),       # a duplicate description
        (ERROR, 11, 19),        # kinect_rgbd_sensor, which is called rgbd_sensor
        (WARNING, 16, 5)]       # image_color/compressed, below a topic of the interface
    missing = [finding for finding in findings if finding not in others]
    assert {finding.severity for finding in missing
            if finding.problem.startswith('icon')} == {WARNING}
    assert {finding.severity for finding in missing if 'launch file' in finding.problem} == {ERROR}
    assert [finding.problem for finding in missing
            if not finding.problem.startswith(('icon', 'launch file'))] == [
        "preferred provider 'create_capabilities/create_differential_mobile_base' does not exist"]


def test_near_misses_in_many_files_are_looked_for_as_long_as_it_does_not_take_long(
        tmp_path, monkeypatch):
    files = {'interfaces__C%d_yaml' % number: 'name: Camera_%d\nspec_version: 1\n'
             'spec_type: interface\n' % number for number in range(400)}
    files.update(('providers__p%d_yaml' % number, USB_CAMERA.replace('usb', 'usb_%d' % number)
                  .replace('Camera', 'Camera_0') + 'depends_on: ours/Camra_%d\n' % number)
                 for number in range(60))
    lines = found(tmp_path, monkeypatch, **files)
    assert sum("does not exist (did you mean 'ours/Camera_" in line for line in lines) == 50
    assert sum(line.endswith('does not exist') for line in lines) == 10


def test_what_a_package_refers_to_may_be_elsewhere_on_the_package_path(tmp_path, monkeypatch):
    make_package(tmp_path / 'a', 'theirs', [('capability_interface', 'Camera.yaml')],
                 Camera_yaml=CAMERA)
    make_package(tmp_path / 'b', 'ours', [('capability_provider', 'usb_camera.yaml')],
                 usb_camera_yaml=USB_CAMERA.replace('ours', 'theirs'))
    assert findings_in(tmp_path / 'b', monkeypatch, str(tmp_path / 'a')) == []
    assert len(findings_in(tmp_path / 'b', monkeypatch)) == 1


def test_a_package_that_is_checked_stands_for_another_of_its_name(tmp_path, monkeypatch):
    make_package(tmp_path / 'old', 'ours', [('rocon_app', 'dance.rapp')], dance_rapp='[')
    make_package(tmp_path / 'new', 'ours', [('rocon_app', 'dance.rapp')],
                 dance_rapp=described('colour: red'))
    (line,) = findings_in(tmp_path / 'new', monkeypatch, str(tmp_path / 'old'))
    assert "unknown key 'colour'" in line


def test_only_the_packages_that_are_asked_for_are_checked(tmp_path, monkeypatch):
    make_package(tmp_path / 'a', 'theirs', [('rocon_app', 'dance.rapp')], dance_rapp='[')
    make_package(tmp_path / 'b', 'ours')
    assert findings_in(tmp_path / 'b', monkeypatch, str(tmp_path / 'a')) == []


def test_nothing_is_told_twice_and_all_is_sorted(tmp_path, monkeypatch):
    """Two rapps share a public interface with a fault in it."""
    rapp = 'public_interface: shared.interface\ncolour: red\nicon: i.png\n'
    lines = found(tmp_path, monkeypatch, rapps__b_rapp=rapp, rapps__a_rapp=rapp,
                  rapps__shared_interface='publishers: [{name: 7up, type: a/B}]')
    assert [line.partition(' ')[0] for line in lines] == [
        'rapps/a.rapp:2:1:', 'rapps/a.rapp:3:7:', 'rapps/b.rapp:2:1:', 'rapps/b.rapp:3:7:',
        'rapps/shared.interface:1:21:']


# package.xml

@pytest.mark.parametrize('export, finding', [
    ('<rocon_app>dance.rapp</rocon_app>', "8:5: error: exported file 'dance.rapp' does not exist"),
    ('<capability_interface>\n  a.yaml\n</capability_interface>',
     "8:5: error: exported file 'a.yaml' does not exist"),
    ('<rocon_uri rules="${prefix}/rules.yaml"/>',
     "8:5: error: exported file './rules.yaml' does not exist"),
    ('<rocon_app/>', "8:5: error: exported file '' is not a file"),
    ('<rocon_app>.</rocon_app>', "8:5: error: exported file '.' is not a file"),
    ('<rocon_app>../../etc/passwd</rocon_app>',
     "8:5: error: exported file '../../etc/passwd' is outside the package"),
    ('<rocon_app>../ours_two/a.rapp</rocon_app>',
     "8:5: error: exported file '../ours_two/a.rapp' is outside the package"),
    ('<rocon_app>/etc/passwd</rocon_app>',
     "8:5: error: exported file '/etc/passwd' is outside the package"),
    ('<rocon_app>here.rapp</rocon_app> <rocon_app>here.rapp</rocon_app>',
     "8:38: error: 'here.rapp' is exported twice"),
    ('<rosdoc>missing</rosdoc><x><rocon_app>missing</rocon_app></x>', None),
])
def test_an_export_names_a_file_of_the_package(tmp_path, monkeypatch, export, finding):
    folder = make_package(tmp_path, 'ours', here_rapp='{}')
    manifest = (folder / 'package.xml').read_text()
    (folder / 'package.xml').write_text(
        manifest.replace('<export>\n\n', '<export>\n    %s\n' % export))
    lines = [line for line in findings_in(tmp_path, monkeypatch)
             if line.startswith('ours/package.xml')]
    assert lines == ([] if finding is None else ['ours/package.xml:' + finding])


def test_what_is_exported_from_elsewhere_is_not_checked(tmp_path, monkeypatch):
    (tmp_path / 'elsewhere.rapp').write_text('colour: red')
    (tmp_path / 'elsewhere.yaml').write_text(CAMERA.replace('image:', '7mage:'))
    make_package(tmp_path, 'ours', [('rocon_app', '../elsewhere.rapp'),
                                    ('capability_interface', '../elsewhere.yaml')])
    lines = findings_in(tmp_path, monkeypatch)
    assert len(lines) == 2 and all('is outside the package' in line for line in lines)


@pytest.mark.parametrize('tag', ['capability_interface', 'semantic_capability_interface',
                                 'capability_provider', 'rocon_app', 'rules'])
def test_nothing_is_shown_of_what_is_elsewhere(tmp_path, monkeypatch, tag):
    (tmp_path / 'passwords').write_text('root:x:0:0:root\n- [')
    (tmp_path / 'src').mkdir()
    export = '<%s>../../passwords</%s>' % (tag, tag)
    if tag == 'rules':
        export = '<rocon_uri rules="../../passwords"/>'
    folder = make_package(tmp_path / 'src', 'ours')
    manifest = (folder / 'package.xml').read_text()
    (folder / 'package.xml').write_text(manifest.replace('<export>', '<export>' + export))
    lines = findings_in(tmp_path / 'src', monkeypatch)
    assert len(lines) == 1 and 'is outside the package' in lines[0]


def test_an_invalid_manifest_is_found_and_hides_no_other(tmp_path, monkeypatch):
    (make_package(tmp_path, 'bad') / 'package.xml').write_text('<package>\n<name>bad</nam>')
    make_package(tmp_path, 'ours', [('rocon_app', 'missing.rapp')])
    lines = findings_in(tmp_path, monkeypatch)
    assert len(lines) == 2 and 'mismatched tag' in lines[0]
    assert lines[0].startswith('bad/package.xml:2:') and ': error: ' in lines[0]


def test_rules_that_are_exported_are_read(tmp_path, monkeypatch):
    folder = make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp')],
                          dance_launch='<launch/>',
                          dance_rapp=described('{compatibility: "rocon:/our_robot", '
                                               'launch: dance.launch}'),
                          rules_yaml='hardware_platform: {robot: [our_robot]}')
    lines = findings_in(tmp_path, monkeypatch)
    assert len(lines) == 1 and "'our_robot' is not registered" in lines[0]
    manifest = (folder / 'package.xml').read_text()
    (folder / 'package.xml').write_text(
        manifest.replace('</export>', '<rocon_uri rules="${prefix}/rules.yaml"/></export>'))
    assert findings_in(tmp_path, monkeypatch) == []
    (folder / 'rules.yaml').write_text('hardware_platform:\n- "*"\n')
    lines = findings_in(tmp_path, monkeypatch)
    assert lines[-1].startswith("ours/rules.yaml:2:3: error: hardware_platform '*' is not")


# Specs

@pytest.mark.parametrize('old, new, finding', [
    ('', '', None),
    ('image:', "'1mage':", "7:7: error: topic '1mage' is not a legal ROS name"),
    ('image:', "'a b':", "7:7: error: topic 'a b' is not a legal ROS name"),
    ('sensor_msgs/Image', 'Image',
     "7:21: error: type 'Image' of topic 'image' is not of the form package/Type"),
    ('sensor_msgs/Image', 'sensor_msgs/msg/Image',
     "7:21: error: type 'sensor_msgs/msg/Image' of topic 'image' is not of the form package/Type "
     "(did you mean 'sensor_msgs/Image'?)"),
    ('sensor_msgs/Image', 'sensor_msgs/msg/Image/x',
     "7:21: error: type 'sensor_msgs/msg/Image/x' of topic 'image' is not of the form "
     'package/Type'),
    ('    requires:', '  parameters:\n    requires:', None),    # ... whose type is any word
    ('std_msgs/Empty}', 'std_msgs/Empty}\n  dynamic_parameters: [gain, 7]',
     '10:30: error: the name of a dynamic_parameter is 7, expected text'),
    ('std_msgs/Empty}', "std_msgs/Empty}\n  dynamic_parameters: [gain, 'a-b']",
     "10:30: error: dynamic_parameter 'a-b' is not a legal ROS name"),
    ('std_msgs/Empty}', 'std_msgs/Empty}\n  actions: {dock: {type: Dock}}',
     "10:26: error: type 'Dock' of action 'dock' is not of the form package/Type"),
    ('name: Camera', 'name: Camera\ndescritpion: x',
     "2:1: warning: unknown key 'descritpion' in the spec (did you mean 'description'?)"),
    ('type: sensor', 'tpye: sensor', "7:7: error: topic 'image' has no type"),
    (CAMERA, '[', '2:1: error: did not find expected node content while parsing a flow node'),
    ('name: Camera', 'nmae: Camera',
     "1:1: error: unknown key 'nmae', and the spec has no name (did you mean 'name'?)"),
])
def test_interfaces(tmp_path, monkeypatch, old, new, finding):
    lines = found(tmp_path, monkeypatch, interfaces__Camera_yaml=CAMERA.replace(old, new, 1))
    assert lines[:1] == ([] if finding is None else ['interfaces/Camera.yaml:' + finding])


@pytest.mark.parametrize('text, finding', [
    ('global_namespace: front', None), ('global_namespace: front/', None),
    ('global_namespace: /', None),
    ('global_namespace: //', "5:19: error: global_namespace '//' is not a legal ROS name"),
    ('remappings: {topics: {image: a, image: a}}',
     "5:33: warning: duplicate key 'image', remapped to the same name"),
    ('remappings: {topics: {image: front/image}}', None),
    ('remappings: {topics: {imgae: x}}',
     "5:23: error: 'ours/Camera' has no 'imgae' in topics to remap (did you mean 'image'?)"),
    ('remappings: {topics: {image: "a b"}}', "5:30: error: new name 'a b' is not a legal ROS name"),
    ('remappings: {topics: {image: /flash}}',
     "5:23: error: 'image' and '/flash' of topics both come out as '/flash'"),
    ('global_namespace: front-', "5:19: error: global_namespace 'front-' is not a legal ROS name"),
])
def test_semantic_interfaces(tmp_path, monkeypatch, text, finding):
    lines = found(tmp_path, monkeypatch, interfaces__Camera_yaml=CAMERA, semantic__Front_yaml=(
        'name: Front\nspec_version: 1\nspec_type: semantic_interface\nredefines: ours/Camera\n'
        + text))
    assert lines == ([] if finding is None else ['semantic/Front.yaml:' + finding])


@pytest.mark.parametrize('text, finding', [
    ('', None),
    ('launch_file: ../launch/usb.launch', None),
    ('launch_file: beside.launch', None),
    ('launch_file: launch/usb.launch',      # relative to the package: the server does not find it
     "5:14: warning: launch file 'launch/usb.launch' does not exist (did you mean "
     "'../launch/usb.launch'?)"),
    ('launch_file: besdie.launch',
     "5:14: error: launch file 'besdie.launch' does not exist (did you mean 'beside.launch'?)"),
    ('launch_file: lauch/usb.launch',
     "5:14: error: launch file 'lauch/usb.launch' does not exist"),
    ('launch_file: ../launch', "5:14: error: launch file '../launch' is not a file"),
    ('launch_file: ../../../etc/passwd',
     "5:14: error: launch file '../../../etc/passwd' is outside the package"),
    ('launch_file: /etc/passwd', "5:14: error: launch file '/etc/passwd' is outside the package"),
    ('remappings: {topics: {image: /usb/image}}', None),
    ('remappings: {topics: {image: a, image: a}}',
     "5:33: warning: duplicate key 'image', remapped to the same name"),
    ('remappings: {topics: {/image: x}}',
     "5:23: error: 'ours/Camera' has no '/image' in topics to remap (did you mean 'image'?)"),
    ('remappings: {services: {image: x}}',
     "5:25: error: 'ours/Camera' has no 'image' in services to remap"),
    ('remappings: {topics: {image_raw/compressed: x}}',
     "5:23: error: 'ours/Camera' has no 'image_raw/compressed' in topics to remap"),
    ('remappings: {topics: {image/compressed/a: x}}',
     "5:23: error: 'ours/Camera' has no 'image/compressed/a' in topics to remap"),
    ('remappings: {topics: {image/compressed: x}}',
     "5:23: warning: 'ours/Camera' has no 'image/compressed' in topics to remap"),
    ('remappings: {topics: {image: 7/x}}', "5:30: error: new name '7/x' is not a legal ROS name"),
    ('depends_on: ours/Light', None),
    ('depends_on: ours/Lihgt',
     "5:13: error: capability 'ours/Lihgt' does not exist (did you mean 'ours/Light'?)"),
    ('depends_on: [ours/Light, ours/Lamp]', "5:26: error: capability 'ours/Lamp' does not exist"),
    ('depends_on:\n  ours/Lamp:', "6:3: error: capability 'ours/Lamp' does not exist"),
    ('depends_on: {ours/Light: {provider: ours/led}}', None),
    ('depends_on: {ours/Light: {provider: ours/lde}}',
     "5:37: error: preferred provider 'ours/lde' does not exist (did you mean 'ours/led'?)"),
    ('depends_on: {ours/Light: {provider: ours/usb_camera}}',
     "5:37: error: preferred provider 'ours/usb_camera' implements 'ours/Camera', "
     "not 'ours/Light'"),
    ('depends_on: ours/Camera',
     '5:13: error: providers depend on each other in a cycle: '
     'ours/usb_camera -> ours/usb_camera'),
    ('launchfile: x', "5:1: warning: unknown key 'launchfile' in the spec"),
])
def test_providers(tmp_path, monkeypatch, text, finding):
    light = CAMERA.replace('Camera', 'Light')
    led = USB_CAMERA.replace('usb_camera', 'led').replace('Camera', 'Light')
    lines = found(tmp_path, monkeypatch, interfaces__Camera_yaml=CAMERA,
                  interfaces__Light_yaml=light, providers__usb_camera_yaml=USB_CAMERA + text,
                  providers__led_yaml=led, launch__usb_launch='<launch/>',
                  providers__beside_launch='<launch/>')
    assert [line.partition(' (did you mean')[0] if finding and 'did you' not in finding else line
            for line in lines] == (
        [] if finding is None else ['providers/usb_camera.yaml:' + finding])


def test_no_dependency_of_many_is_looked_for_in_their_list(tmp_path, monkeypatch):
    monkeypatch.setattr(YamlSequence, 'index', None, raising=False)
    lines = found(tmp_path, monkeypatch, interfaces__Camera_yaml=CAMERA,
                  providers__usb_camera_yaml=USB_CAMERA + 'depends_on: [ours/A, ours/B]')
    assert [line.partition(' ')[0] for line in lines] == [
        'providers/usb_camera.yaml:5:14:', 'providers/usb_camera.yaml:5:22:']


def test_a_provider_of_a_semantic_interface_may_be_preferred_for_what_it_redefines(
        tmp_path, monkeypatch):
    front = ('name: Front\nspec_version: 1\nspec_type: semantic_interface\n'
             'redefines: ours/Camera\n')
    light = CAMERA.replace('Camera', 'Light')
    led = USB_CAMERA.replace('usb_camera', 'led').replace('Camera', 'Light')
    for preferred, count in ('ours/usb_camera', 0), ('ours/led', 1):
        lines = found(
            tmp_path / preferred, monkeypatch, interfaces__Camera_yaml=CAMERA,
            interfaces__Light_yaml=light, semantic__Front_yaml=front,
            providers__usb_camera_yaml=USB_CAMERA.replace('ours/Camera', 'ours/Front'),
            providers__led_yaml=led + 'depends_on: {ours/Camera: {provider: %s}}' % preferred)
        assert len(lines) == count and all("not 'ours/Camera'" in line for line in lines)


@pytest.mark.parametrize('content, finding', [
    ('<launch>', '1:9: error: launch file is not XML: no element found'),
    ('\n<robot/>', "2:1: error: launch file has '<robot>' at its top, expected <launch>"),
    ('<launch>\n <launch/></launch>', '2:2: error: launch file has a second <launch>'),
])
def test_what_is_wrong_in_a_launch_file_is_found_in_it_and_once(
        tmp_path, monkeypatch, content, finding):
    assert found(tmp_path, monkeypatch, interfaces__Camera_yaml=CAMERA,
                 providers__usb_camera_yaml=USB_CAMERA + 'launch_file: ../rapps/dance.launch',
                 rapps__dance_rapp=DANCE, rapps__sing_rapp=DANCE,
                 rapps__dance_launch=content) == ['rapps/dance.launch:' + finding]


def test_a_provider_of_nothing_and_two_specs_of_one_name_are_errors(tmp_path, monkeypatch):
    assert found(
        tmp_path, monkeypatch, interfaces__Camera_yaml=CAMERA, interfaces__Other_yaml=CAMERA,
        providers__usb_camera_yaml=USB_CAMERA.replace('ours/Camera', 'ours/Camrea')) == [
        "interfaces/Other.yaml:1:7: error: 'ours/Camera' is already the name of an interface, in "
        + quoted_path(str(tmp_path / 'ours/interfaces/Camera.yaml')),
        "providers/usb_camera.yaml:4:13: error: provider 'ours/usb_camera' implements "
        "'ours/Camrea', which is not an interface that any package exports "
        "(did you mean 'ours/Camera'?)"]


# Rapps

@pytest.mark.parametrize('text, findings', [
    (DANCE, []),
    (DANCE.replace('kobuki', 'kobukki'),
     ["1:23: error: compatibility: hardware_platform 'kobukki' is not registered (did you mean "
      "'kobuki'?)"]),
    (DANCE.replace('rocon:/kobuki', '"rocon:/pr2|kobukki"'),
     ["1:28: error: compatibility: hardware_platform 'kobukki' is not registered (did you mean "
      "'kobuki'?)"]),
    ('launch: dance.launch\n\n\ncompatibility: "rocon:/pr2|kobukki"',
     ["4:28: error: compatibility: hardware_platform 'kobukki' is not registered (did you mean "
      "'kobuki'?)"]),
    (DANCE.replace('rocon:/kobuki', '>-\n  rocon:/kobukki'),     # nothing nearer is known
     ["1:16: error: compatibility: hardware_platform 'kobukki' is not registered (did you mean "
      "'kobuki'?)"]),
    (DANCE.replace('rocon:/', 'rocon://'),
     ["1:16: warning: compatibility: 'rocon://kobuki' is read as 'rocon:/kobuki', since kobuki is "
      'a hardware_platform, not a concert']),
    (DANCE.replace('dance.launch', 'dnace.launch'),
     ["2:9: error: launch file 'dnace.launch' does not exist (did you mean 'dance.launch'?)"]),
    (DANCE.replace('dance.launch', '../../../etc/passwd'),
     ["2:9: error: launch file '../../../etc/passwd' is outside the package"]),
    (DANCE + 'icon: dance.png', ["3:7: warning: icon 'dance.png' does not exist"]),
    (DANCE + 'icon: ../../x.png', ["3:7: error: icon '../../x.png' is outside the package"]),
    (DANCE + 'icon: dance.launch', []),
    (DANCE + 'dispaly: Dance',
     ["3:1: warning: unknown key 'dispaly' in the rapp (did you mean 'display'?)"]),
    (DANCE + 'parent_name: motoin',
     ["3:14: error: parent_name 'ours/motoin' does not exist or cannot be read (did you "
      "mean 'ours/motion'?)"]),
    (DANCE + 'parent_name: dance',
     ["3:14: error: rapp 'ours/dance' is its own ancestor: ours/dance -> ours/dance"]),
    ('launch: dance.launch',
     ['1:9: warning: the rapp has launch but no compatibility, so it never runs']),
    ('compatibility: rocon:/',
     ['1:16: warning: the rapp has compatibility but no launch, so it never runs']),
    ('launch: 7', ['1:9: error: launch is 7, expected text']),
    (DANCE + 'public_interface: x.interface',
     ["3:19: warning: public_interface 'x.interface' does not exist"]),
    (DANCE + 'required_capabilities: [{name: ours/Camrea}]',
     ["3:32: error: capability 'ours/Camrea' does not exist (did you mean 'ours/Camera'?)"]),
    (DANCE + 'required_capabilities: [{name: ours/Camera, interfcae: {}}]',
     ["3:45: warning: unknown key 'interfcae' in a required capability (did you mean "
      "'interface'?)"]),
    (DANCE + 'required_capabilities: [{name: ours/Camera, interface: {topcis: {}}}]',
     ["3:57: warning: unknown key 'topcis' in interface (did you mean 'topics'?)"]),
    (DANCE + 'required_capabilities: [{name: ours/Camera, interface: {topics: {image: x}}}]',
     ["3:66: warning: unknown key 'image' in topics (expected requires, provides)"]),
    (DANCE + '''\
required_capabilities:
- name: ours/Camera
  interface:
    topics:
      requires: {/flahs: dance/flash}
      provides: {image: dance image}
''', ["7:18: error: 'ours/Camera' has no '/flahs' in topics to remap (did you mean '/flash'?)",
      "8:25: error: new name 'dance image' is not a legal ROS name"]),
])
def test_rapps(tmp_path, monkeypatch, text, findings):
    assert found(tmp_path, monkeypatch, interfaces__Camera_yaml=CAMERA, rapps__dance_rapp=text,
                 rapps__motion_rapp='{}', rapps__dance_launch='<launch/>') == [
        'rapps/dance.rapp:' + finding for finding in findings]


@pytest.mark.parametrize('text, findings', [
    (DANCE,
     ['1:1: warning: the rapp has no display and no description, and no parent that has it']),
    (DANCE + 'display: Dance',
     ['1:1: warning: the rapp has no description, and no parent that has it']),
    (DANCE + 'display: Dance\ndescription: It dances', []),
    (DANCE + 'parent_name: motion', []),
    ('parent_name: motion\ndisplay: Dance',
     ['1:14: warning: the rapp has a parent but no launch and no compatibility, so it never runs']),
    ('parent_name: motion\nlaunch: dance.launch',
     ['1:14: warning: the rapp has a parent but no compatibility, so it never runs']),
    (DANCE + 'parent_name: motion\npublic_interface: dance.interface',
     ['4:19: warning: the rapp has a public_interface, which a rapp takes from its parent']),
    ('display: A\ndescription: B\nrequired_capabilities: [{name: ours/Camera}]',
     ['3:1: warning: the rapp is virtual and requires capabilities, which no other rapp inherits']),
    (DANCE + 'parent_name: motion\nrequired_capabilities: [{name: ours/Camera}]', []),
])
def test_the_form_of_rapps(tmp_path, monkeypatch, text, findings):
    make_package(tmp_path, 'ours', [
        ('capability_interface', 'Camera.yaml'), ('rocon_app', 'dance.rapp'),
        ('rocon_app', 'motion.rapp')], Camera_yaml=CAMERA, dance_rapp=text,
        motion_rapp=described('{}'), dance_launch='<launch/>', dance_interface='')
    assert findings_in(tmp_path, monkeypatch) == ['ours/dance.rapp:' + line for line in findings]


@pytest.mark.parametrize('key', ['icon', 'public_interface', 'public_parameters', 'launch'])
@pytest.mark.parametrize('name, what, meant', [
    ('ours/dance.x', 'is a resource name', '../media/dance.x'),
    ('$(find ours)/media/dance.x', 'is written with $(find)', '../media/dance.x'),
    ('package://ours/media/dance.x', 'is a package:// URL', '../media/dance.x'),
    ('ours/gone.x', 'is a resource name', None)])
def test_a_file_that_is_not_named_by_its_path(tmp_path, monkeypatch, key, name, what, meant):
    text = 'compatibility: rocon:/\nlaunch: dance.launch\n%s: %s\n' % (key, name)
    place, begin = '3:%d' % (len(key) + 3), 'warning: ' + key
    if key == 'launch':
        text, place, begin = text.replace('launch: dance.launch\n', ''), '2:9', 'error: launch file'
    assert found(tmp_path, monkeypatch, media__dance_x='<launch/>', rapps__dance_launch='<launch/>',
                 rapps__dance_rapp=text) == [
        'rapps/dance.rapp:%s: %s %s %s, expected a path relative to the file that names it%s' % (
            place, begin, quoted_path(name), what,
            ' (did you mean %s?)' % quoted_path(meant) if meant else '')]


def test_a_rapp_that_no_uri_can_name_is_a_warning(tmp_path, monkeypatch):
    folder = make_package(tmp_path, 'ours', [('rocon_app', 'tango-nuevo.rapp')])
    (folder / 'tango-nuevo.rapp').write_text(described('{}'))
    (line,) = findings_in(tmp_path, monkeypatch)
    assert line == (
        "ours/tango-nuevo.rapp: warning: no rocon URI can name rapp 'ours/tango-nuevo': the names "
        'of package and file have to be ROS base names (a letter, then letters, digits and _)')


@pytest.mark.parametrize('name, text, finding', [
    ('interface', 'publishers: [{name: image, type: sensor_msgs/Image}]\nsubscribers: []', None),
    ('interface', '', None),
    ('interface', '[', '2:1: error: did not find expected node content while parsing a flow node'),
    ('interface', '- a', '1:1: error: public_interface is a list, expected a mapping'),
    ('interface', 'publisher: []',
     "1:1: warning: unknown key 'publisher' in public_interface (did you mean 'publishers'?)"),
    ('interface', 'publishers: 7', '1:13: error: publishers is 7, expected a list'),
    ('interface', 'services: [reset]',
     "1:12: error: an item of services is 'reset', expected a mapping with a name and a type"),
    ('interface', 'services: [{name: reset}]',
     '1:12: error: an item of services has no type'),
    ('interface', 'services: [{name: re-set, type: std_srvs/Empty}]',
     "1:19: error: name 're-set' is not a legal ROS name"),
    ('interface', 'services: [{name: reset, type: Empty}]',
     "1:32: error: type 'Empty' of 'reset' is not of the form package/Type"),
    ('parameters', 'speed: 7', None),
    ('parameters', '7', '1:1: error: public_parameters is 7, expected a mapping'),
])
def test_the_public_files_of_rapps(tmp_path, monkeypatch, name, text, finding):
    files = {'rapps__dance_' + name: text}
    assert found(tmp_path, monkeypatch, rapps__dance_rapp='public_%s: dance.%s' % (name, name),
                 **files) == ([] if finding is None else ['rapps/dance.%s:%s' % (name, finding)])


# Interactions

LISTENER = '{name: Listener, compatibility: "rocon:/pc"}'


@pytest.mark.parametrize('text', [
    '[%s]' % LISTENER,
    'interactions: [%s]' % LISTENER,
    'interactions: [%s]\npairings: [{name: Talk, rapp: ours/dance}]' % LISTENER,
    '- {group: A, interactions: [%s]}\n- {group: B, pairings: }' % LISTENER,
    'Web apps: [%s]' % LISTENER,
    '- Web apps: [%s]\n- Others: [%s]' % (LISTENER, LISTENER.replace('Listener', 'Talker')),
])
def test_interactions_in_all_forms_are_found(tmp_path, monkeypatch, text):
    """There is nothing wrong, until a compatibility string is."""
    files = {'rapps__dance_rapp': '{}'}
    assert found(tmp_path / 'good', monkeypatch, x_interactions=text, **files) == []
    bad = text.replace('rocon:/pc', 'rocon:/pcc', 1)
    (line,) = found(tmp_path / 'bad', monkeypatch, x_interactions=bad, **files)
    assert "hardware_platform 'pcc' is not registered (did you mean 'pc'?)" in line


@pytest.mark.parametrize('text, findings', [
    ('', ['1:1: error: expected interactions, the file is empty']),
    ('7', ['1:1: error: expected a list of interactions, or a mapping that has one']),
    ('{a: b}', ['1:1: error: expected a list of interactions, or a mapping that has one']),
    ('[', ['2:1: error: did not find expected node content while parsing a flow node']),
    ('[7]', ['1:2: error: an interaction is 7, expected a mapping']),
    ('interactions: 7', ['1:15: error: interactions is 7, expected a list']),
    ('interactons: [%s]' % LISTENER,
     ["1:1: warning: unknown key 'interactons' (did you mean 'interactions'?)"]),
    ('[{name: Listener}]', ['1:2: error: an interaction has no compatibility']),
    ('[{compatibility: "rocon:/"}]', ['1:2: error: an interaction has no name']),
    ('[{name: 7, compatibility: "rocon:/"}]', ['1:9: error: name is 7, expected text']),
    ('[{name: A, compatibility: "rocon://pc"}]',
     ["1:28: warning: compatibility: 'rocon://pc' is read as 'rocon:/pc', since pc is a "
      'hardware_platform, not a concert']),
    ('[{name: A, compatibility: "rocon:/", comand: x}]',
     ["1:38: warning: unknown key 'comand' in an interaction (did you mean 'command'?)"]),
    ('[{name: A, compatibility: "rocon:/", namespace: a-b}]',
     ["1:49: error: namespace 'a-b' is not a legal ROS name"]),
    ('[{name: A, compatibility: "rocon:/", remappings: x}]',
     ["1:50: error: remappings is 'x', expected a list"]),
    ('[{name: A, compatibility: "rocon:/", remappings: [{remap_from: a, remap_to: b-c}]}]',
     ["1:77: error: remap_to 'b-c' is not a legal ROS name"]),
    ('[{name: A, compatibility: "rocon:/", remappings: [{remap_from: a, to: b}]}]',
     ['1:51: error: a remapping has no remap_to',
      "1:67: warning: unknown key 'to' in a remapping (expected remap_from, remap_to)"]),
    ('[{name: A, compatibility: "rocon:/", remappings: [{remap_from: a, remap_to: ""}]}]',
     ['1:77: error: remap_to is empty, expected text']),
    ('[%s, %s]' % (LISTENER, LISTENER), ["1:48: error: duplicate interaction 'Listener'"]),
    ('pairings: [{name: Talk}]', ['1:12: error: a pairing has no rapp']),
    ('pairings: [{name: Talk, rapp: ours/dacne}]',
     ["1:31: error: rapp 'ours/dacne' does not exist (did you mean 'ours/dance'?)"]),
])
def test_interactions(tmp_path, monkeypatch, text, findings):
    assert found(tmp_path, monkeypatch, deep__down__x_interactions=text,
                 rapps__dance_rapp='{}') == [
        'deep/down/x.interactions:' + finding for finding in findings]


def test_interactions_of_a_package_within_are_not_those_of_the_package(tmp_path, monkeypatch):
    folder = make_package(tmp_path, 'ours')
    make_package(folder, 'inner', x_interactions='[')
    assert findings_in(tmp_path, monkeypatch) == []
    (folder / 'x.interactions').write_text('[')
    (folder / 'z').mkdir()
    (folder / 'z' / 'x.interactions').write_text('[')
    assert [line.partition(' ')[0] for line in findings_in(tmp_path, monkeypatch)] == [
        'ours/x.interactions:2:1:', 'ours/z/x.interactions:2:1:']


# Hostile files

@pytest.mark.parametrize('content', [
    b'[' * 50000, b'\xff\xfe\x00', b'a: &a [' + b'*a, ' * 10 + b']', b'!!python/object:os.x {}',
    b'{' * 99, b'\x00', b'x: ' + b'9' * 5000, b'? [a]\n: b', b'a' * (2 ** 20 + 1)])
def test_what_no_file_should_hold_is_one_finding_for_each(tmp_path, monkeypatch, content):
    names = ['Camera.yaml', 'usb.yaml', 'dance.rapp', 'rules.yaml']
    folder = make_package(
        tmp_path, 'ours', zip(['capability_interface', 'capability_provider', 'rocon_app'], names))
    for name in [*names, 'x.interactions']:
        (folder / name).write_bytes(content)
    lines = findings_in(tmp_path, monkeypatch)
    assert sorted(line.partition(':')[0] for line in lines) == [
        'ours/Camera.yaml', 'ours/dance.rapp', 'ours/usb.yaml', 'ours/x.interactions']
    assert all(': error: ' in line and len(line) < 400 for line in lines)


def test_files_that_cannot_be_read_are_findings(tmp_path, monkeypatch):
    folder = make_package(tmp_path, 'ours', [
        ('rocon_app', 'loop.rapp'), ('rocon_app', 'fifo.rapp'), ('rocon_app', 'good.rapp')],
        good_rapp=described('icon: i.png'))
    (folder / 'loop.rapp').symlink_to('loop.rapp')
    os.mkfifo(str(folder / 'fifo.rapp'))
    (folder / 'x.interactions').symlink_to('gone')
    assert findings_in(tmp_path, monkeypatch) == [
        "ours/good.rapp:1:7: warning: icon 'i.png' does not exist",
        "ours/package.xml:8:5: error: exported file 'loop.rapp' does not exist",
        "ours/package.xml:9:5: error: exported file 'fifo.rapp' is not a file",
        'ours/x.interactions: error: cannot be read: No such file or directory']


texts = st.text(st.sampled_from('abc/:|*[]{}&!-,\'" \n~0.#%'), max_size=30)
values = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 99) | texts,
    lambda below: st.lists(below, max_size=3) | st.dictionaries(
        st.sampled_from(['name', 'interface', 'topics', 'requires', 'provides', 'type', 'image',
                         'remappings', 'interactions', 'compatibility', 'remap_from', '/flash',
                         'provider', 'ours/Camera', 'required_capabilities', 'services']),
        below, max_size=3), max_leaves=10)


@pytest.fixture(scope='module')
def package(tmp_path_factory):
    return make_package(
        tmp_path_factory.mktemp('any'), 'ours', [
            ('capability_interface', 'Camera.yaml'), ('capability_provider', 'usb.yaml'),
            ('semantic_capability_interface', 'Front.yaml'), ('rocon_app', 'dance.rapp')],
        Camera_yaml=CAMERA)


@settings(max_examples=150)
@given(st.fixed_dictionaries({
    key: values for key in ('interface', 'remappings', 'depends_on', 'required_capabilities',
                            'launch_file', 'compatibility', 'public_interface')}))
def test_whatever_files_say_the_linter_answers(package, data):
    import json
    head = {'spec_version': 1, 'name': 'usb', 'implements': 'ours/Camera',
            'redefines': 'ours/Camera'}
    spec_types = {'usb.yaml': 'provider', 'Front.yaml': 'semantic_interface'}
    for name, spec_type in spec_types.items():
        spec = {**head, **data, 'spec_type': spec_type, 'name': name.partition('.')[0]}
        (package / name).write_text(json.dumps(spec))
    (package / 'dance.rapp').write_text(json.dumps(data))
    (package / 'x.interactions').write_text(json.dumps([data['interface'], data]))
    for finding in check_packages([str(package)]):
        assert '\n' not in str(finding)


# Findings

def test_findings_are_told_in_three_forms():
    finding = Finding('a.rapp', 3, 9, ERROR, 'no', 'cycle')
    assert str(finding) == 'a.rapp:3:9: error: no [cycle]'
    assert finding.as_json() == {'file': 'a.rapp', 'line': 3, 'column': 9, 'severity': 'error',
                                 'id': 'cycle', 'text': 'no'}
    assert finding.as_github() == '::error file=a.rapp,line=3,col=9,title=cycle::no'
    nowhere = Finding('a.rapp', None, None, WARNING, 'no', 'cycle')
    assert (str(nowhere), nowhere.as_github()) == ('a.rapp: warning: no [cycle]',
                                                   '::warning file=a.rapp,title=cycle::no')


def test_github_gets_no_command_from_a_file():
    finding = Finding('a:b,c%\n::error::x', 1, 1, WARNING, '100%\r\n::set-output name=x::y',
                      'cycle')
    assert finding.as_github() == ('::warning file=a%3Ab%2Cc%25%0A%3A%3Aerror%3A%3Ax,line=1,col=1'
                                   ',title=cycle::100%25%0D%0A::set-output name=x::y')
    assert '\n' not in str(finding)


def test_github_gets_no_character_that_cannot_be_printed():
    finding = Finding("a\x1b'\\.rapp", 1, 1, ERROR, "it's \u2028 no", 'cycle')
    assert finding.as_github() == (
        "::error file=a\\x1b'\\.rapp,line=1,col=1,title=cycle::it's \\u2028 no")


@pytest.mark.parametrize('path, line', [
    ('::error ::x.rapp', './::error ::x.rapp:1:1: error: no [cycle]'),
    (' ::error ::x.rapp', './ ::error ::x.rapp:1:1: error: no [cycle]'),
    ('a::b.rapp', 'a::b.rapp:1:1: error: no [cycle]')])
def test_a_path_is_no_command_in_the_log_of_a_github_workflow(path, line):
    assert str(Finding(path, 1, 1, ERROR, 'no', 'cycle')) == line
