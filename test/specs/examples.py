"""
Examples of capability specs, good and bad, which the tests of the loader and the schemas share.

Each is (kind of spec, text); a bad one has the error that it gives beside, without the file's name.
"""
from __future__ import annotations

INTERFACE = 'name: Camera\nspec_version: 1\nspec_type: interface\n'
PROVIDER = 'name: camera\nspec_version: 1\nspec_type: provider\nimplements: a_package/Camera\n'
SEMANTIC = ('name: Left\nspec_version: 1\nspec_type: semantic_interface\n'
            'redefines: a_package/Camera\n')


def _of(kind, head, bodies):
    return [(kind, head + body) for body in bodies]


def _bad(kind, head, table):
    return [(kind, head + body, error) for body, error in table]


GOOD = _of('interface', INTERFACE, [
    '',
    'description: a camera',
    'description:',
    'description: ""',
    'interface:',
    'interface: []',
    'interface: {}',
    'interface: {topics: , services: [], actions: {}, parameters: , dynamic_parameters: }',
    'interface: {topics: {provides: , requires: []}}',
    'interface: {topics: {image: {type: sensor_msgs/Image}}}',
    'interface: {topics: {image: {type: sensor_msgs/Image, description: raw}}}',
    'interface: {topics: {image: {type: sensor_msgs/Image, description: }}}',
    'interface: {topics: {image: {type: sensor_msgs/Image, colour: red}}}',
    'interface: {topics: {provides: {provides: {type: sensor_msgs/Image}}}}',
    'interface: {topics: {image: {type: a/B}, requires: {light: {type: a/B}}}}',
    'interface: {topics: {image: {type: a/B}}, services: {image: {type: a/B}}}',
    'interface: {actions: {pan: {type: a/Pan}}, parameters: {provides: {rate: {type: double}}}}',
    'interface: {dynamic_parameters: [exposure, gain]}',
    'interface: {dynamic_parameters: {}}',
    'interface: {topics: &t {image: {type: a/B}}, services: *t}',
    'interface: {topics: {~private: {type: a/B}, /absolute: {type: a/B}, 3d: {type: B}}}',
    'colour: red',
]) + _of('provider', PROVIDER, [
    '',
    'launch_file: launch/camera.launch',
    'launch_file:',
    'nodelet_manager: camera_nodelets',
    'nodelet_manager: ~',
    'depends_on:',
    'depends_on: a_package/Usb',
    'depends_on: [a_package/Usb, a_package/Power]',
    'depends_on: []',
    'depends_on: {}',
    'depends_on: {a_package/Usb: , a_package/Power: {}, a_package/Light: []}',
    'depends_on: {a_package/Usb: {provider: b_package/usb}}',
    'depends_on: {a_package/Usb: {provider: }}',
    'remappings:',
    'remappings: []',
    'remappings: {topics: , services: {}, actions: []}',
    'remappings: {topics: {image: left/image}, parameters: {rate: left/rate}}',
    'remappings: {topics: {image: left/image}, services: {image: left/image}}',
    'launch: launch/camera.launch',
]) + _of('semantic_interface', SEMANTIC, [
    '',
    'description: the left one',
    'global_namespace: left',
    'global_namespace:',
    'remappings: {topics: {image: left/image}}',
    'remap: {}',
]) + [
    ('interface', '{"name": "a_package/Camera", "spec_version": 1, "spec_type": "interface"}'),
    ('interface', '%YAML 1.1\n---\n' + INTERFACE + '...\n'),
]

BAD = _bad('interface', '', [
    ('', '1:1: the spec is empty, expected a mapping'),
    ('# nothing', '1:1: the spec is empty, expected a mapping'),
    ('- name: Camera', '1:1: the spec is a list, expected a mapping'),
    ('Camera', "1:1: the spec is 'Camera', expected a mapping"),
    ('3', '1:1: the spec is 3, expected a mapping'),
    ('{}', '1:1: the spec has no spec_type'),
    ('name: Camera\nspec_version: 1', '1:1: the spec has no spec_type'),
    ('spec_type:\nname: Camera', '1:1: the spec has no spec_type'),
    ('\nspec_typ: interface', "2:1: unknown key 'spec_typ', and the spec has no spec_type "
                              "(did you mean 'spec_type'?)"),
    ('spec_type: provider', "1:12: spec_type is 'provider', expected 'interface'"),
    ('spec_type: [interface]', '1:12: spec_type is a list, expected text'),
    ('spec_type: interface', '1:1: the spec has no spec_version'),
    ('spec_type: interface\nspec_version: 2', '2:15: spec_version is 2, expected 1'),
    ('spec_type: interface\nspec_version: "1"', "2:15: spec_version is '1', expected 1"),
    ('spec_type: interface\nspec_version: yes', '2:15: spec_version is true, expected 1'),
    ('spec_type: interface\nspec_version: 1.5', '2:15: spec_version is 1.5, expected 1'),
    ('spec_type: interface\nspec_version: ' + '9' * 100,
     '2:15: spec_version is a large number, expected 1'),
    ('spec_type: interface\nspec_version: 1', '1:1: the spec has no name'),
    ('spec_type: interface\nspec_version: 1\nnam: Camera',
     "3:1: unknown key 'nam', and the spec has no name (did you mean 'name'?)"),
    ('spec_type: interface\nspec_version: 1\nname:', '3:1: the spec has no name'),
    ('spec_type: interface\nspec_version: 1\nname: 3', '3:7: name is 3, expected text'),
    ('spec_type: interface\nspec_version: 1\nname: on', '3:7: name is true, expected text'),
    ('spec_type: interface\nspec_version: 1\nname: ""', '3:7: name is empty, expected text'),
    ('spec_type: interface\nspec_version: 1\nname: 3d', "3:7: name '3d' is not legal, expected a "
     'letter, then letters, digits and underscores'),
    ('spec_type: interface\nspec_version: 1\nname: "a\\n"', "3:7: name 'a\\n' is not legal, "
     'expected a letter, then letters, digits and underscores'),
    ('spec_type: interface\nspec_version: 1\nname: a/b/c', "3:7: name 'a/b/c' is not legal, "
     'expected a letter, then letters, digits and underscores'),
]) + _bad('interface', INTERFACE, [
    ('description: 3', '4:14: description is 3, expected text'),
    ('interface: camera', "4:12: interface is 'camera', expected a mapping"),
    ('interface: [topics]', '4:12: interface is a list, expected a mapping'),
    ('interface: {topcs: {}}', "4:13: unknown section 'topcs' in interface (did you mean "
                               "'topics'?)"),
    ('interface: {colours: {}}', "4:13: unknown section 'colours' in interface (expected topics, "
                                 'services, actions, parameters, dynamic_parameters)'),
    ('interface: {topics: image}', "4:21: topics is 'image', expected a mapping"),
    ('interface: {topics: [image]}', '4:21: topics is a list, expected a mapping'),
    ('interface: {topics: {provides: image}}',
     "4:32: provides of topics is 'image', expected a mapping"),
    ('interface:\n  topics:\n    camera/image_raw:',
     "6:5: topic 'camera/image_raw' has no type"),
    ('interface: {topics: {image: {description: raw}}}', "4:22: topic 'image' has no type"),
    ('interface: {parameters: {rate: {type: }}}', "4:26: parameter 'rate' has no type"),
    ('interface: {topics: {provide: {image: {type: a/B}}}}',
     "4:22: topic 'provide' has no type (did you mean 'provides'?)"),
    ('interface: {topics: {image: a/B}}',
     "4:29: topic 'image' is 'a/B', expected a mapping with a type"),
    ('interface: {services: {image: []}}',
     "4:31: service 'image' is a list, expected a mapping with a type"),
    ('interface: {actions: {pan: {type: [a/B]}}}',
     "4:35: type of action 'pan' is a list, expected text"),
    ('interface: {topics: {image: {type: ""}}}',
     "4:36: type of topic 'image' is empty, expected text"),
    ('interface: {topics: {image: {type: a/B, description: [raw]}}}',
     "4:54: description of topic 'image' is a list, expected text"),
    ('interface: {topics: {"": {type: a/B}}}',
     '4:22: the name of a topic is empty, expected text'),
    ('interface: {topics: {3: {type: a/B}}}',
     '4:22: the name of a topic is 3, expected text'),
    ('interface: {3: {}}', '4:13: unknown section 3 in interface (expected topics, services, '
                           'actions, parameters, dynamic_parameters)'),
    ('interface: {dynamic_parameters: gain}',
     "4:33: dynamic_parameters is 'gain', expected a list of names"),
    ('interface: {dynamic_parameters: {gain: 1}}',
     '4:33: dynamic_parameters is a mapping, expected a list of names'),
    ('interface: {dynamic_parameters: [gain, 3]}',
     '4:40: the name of a dynamic_parameter is 3, expected text'),
    ('interface: {dynamic_parameters: [gain, gain]}',
     "4:40: duplicate dynamic_parameter 'gain'"),
]) + _bad('provider', '', [
    ('name: camera\nspec_version: 1\nspec_type: provider', '1:1: the spec has no implements'),
    ('name: camera\nspec_version: 1\nspec_type: provider\nimplement: a/B',
     "4:1: unknown key 'implement', and the spec has no implements (did you mean 'implements'?)"),
    ('name: camera\nspec_version: 1\nspec_type: provider\nimplements: Camera',
     "4:13: implements is 'Camera', expected package/name"),
    ('name: camera\nspec_version: 1\nspec_type: provider\nimplements: {a/B: }',
     '4:13: implements is a mapping, expected package/name'),
]) + _bad('provider', PROVIDER, [
    ('launch_file: [a]', '5:14: launch_file is a list, expected text'),
    ('launch_file: ""', '5:14: launch_file is empty, expected text'),
    ('nodelet_manager: 3', '5:18: nodelet_manager is 3, expected text'),
    ('depends_on: Usb', "5:13: depends_on is 'Usb', expected package/name"),
    ('depends_on: "a/B\\n"', "5:13: depends_on is 'a/B\\n', expected package/name"),
    ('depends_on: ""', '5:13: depends_on is empty, expected package/name'),
    ('depends_on: 3', '5:13: depends_on is 3, expected the name of an interface, a list of names '
                      'or a mapping'),
    ('depends_on: [a/B, 3]', '5:19: depends_on is 3, expected package/name'),
    ('depends_on: [{a/B: {provider: c/d}}]',
     '5:14: depends_on is a mapping, expected package/name'),
    ('depends_on: [a/B, a/B]', "5:19: duplicate dependency 'a/B'"),
    ('depends_on: {~: }', '5:14: depends_on is empty, expected package/name'),
    ('depends_on: {B: }', "5:14: depends_on is 'B', expected package/name"),
    ('depends_on: {a/B: c/d}',
     "5:19: depends_on 'a/B' is 'c/d', expected a mapping"),
    ('depends_on: {a/B: {providr: c/d}}',
     "5:20: unknown condition 'providr' in depends_on 'a/B' (did you mean 'provider'?)"),
    ('depends_on: {a/B: {provider: d}}',
     "5:30: provider of depends_on 'a/B' is 'd', expected package/name"),
    ('depends_on: {a/B: {provider: [c/d]}}',
     "5:30: provider of depends_on 'a/B' is a list, expected package/name"),
    ('remappings: image', "5:13: remappings is 'image', expected a mapping"),
    ('remappings: {image: left/image}', "5:14: unknown kind 'image' in remappings (expected "
                                        'topics, services, actions, parameters)'),
    ('remappings: {topic: {image: left/image}}',
     "5:14: unknown kind 'topic' in remappings (did you mean 'topics'?)"),
    ('remappings: {topics: [image]}', '5:22: remappings of topics is a list, expected a mapping'),
    ('remappings: {topics: {image: }}', "5:30: the new name of 'image' is empty, expected text"),
    ('remappings: {topics: {image: 3}}', "5:30: the new name of 'image' is 3, expected text"),
    ('remappings: {topics: {no: image}}',
     '5:23: the name of a remapping is false, expected text'),
    ('remappings: {topics: {"": a}}', '5:23: the name of a remapping is empty, expected text'),
]) + _bad('semantic_interface', '', [
    ('name: Left\nspec_version: 1\nspec_type: semantic_interface',
     '1:1: the spec has no redefines'),
    ('name: Left\nspec_version: 1\nspec_type: semantic_interface\nredefines: Camera',
     "4:12: redefines is 'Camera', expected package/name"),
    ('name: Left\nspec_version: 1\nspec_type: interface',
     "3:12: spec_type is 'interface', expected 'semantic_interface'"),
]) + _bad('semantic_interface', SEMANTIC, [
    ('global_namespace: [left]', '5:19: global_namespace is a list, expected text'),
    ('global_namespace: ""', '5:19: global_namespace is empty, expected text'),
    ('remappings: {names: {image: a}}', "5:14: unknown kind 'names' in remappings (expected "
                                        'topics, services, actions, parameters)'),
])

# What a JSON Schema cannot refuse, by the reason.
BEYOND_SCHEMAS = {
    'it sees the data, in which a key is there once': _bad('interface', INTERFACE, [
        ('name: Camera', "4:1: duplicate key 'name'"),
        ('interface: {topics: {}, topics: {}}', "4:25: duplicate key 'topics'"),
        ('interface: {topics: {provides: {}, provides: {}}}', "4:36: duplicate key 'provides'"),
        ('interface: {topics: {image: {type: a/B}, image: {type: a/B}}}',
         "4:42: duplicate key 'image'"),
        ('interface: {topics: {image: {type: a/B, type: a/B}}}',
         "4:41: duplicate key 'type' in topic 'image'"),
    ]) + _bad('provider', PROVIDER, [
        ('depends_on: {a/B: , a/B: }', "5:21: duplicate key 'a/B'"),
        ('depends_on: {a/B: {provider: c/d, provider: c/d}}',
         "5:35: duplicate key 'provider' in depends_on 'a/B'"),
        ('remappings: {topics: {}, topics: {}}', "5:26: duplicate key 'topics'"),
        ('remappings: {topics: {image: a, image: b}}',
         "5:33: 'image' is remapped to 'a' and to 'b'"),
        ('remappings: {topics: {image: a, image: b, image: a}}',
         "5:43: 'image' is remapped to 'b' and to 'a'"),
    ]),
    'it cannot compare the keys of two objects': _bad('interface', INTERFACE, [
        ('interface: {topics: {provides: {a: {type: b/C}}, requires: {a: {type: b/C}}}}',
         "4:61: duplicate topic 'a'"),
        ('interface: {topics: {a: {type: b/C}, requires: {a: {type: b/C}}}}',
         "4:49: duplicate topic 'a'"),
    ]) + _bad('provider', PROVIDER, [
        ('remappings: {topics: {image: a}, services: {image: b}}',
         "5:45: 'image' is remapped to 'a' and to 'b'"),
    ]),
    'to it, 1.0 is an integer': [
        ('interface', 'name: Camera\nspec_version: 1.0\nspec_type: interface',
         '2:15: spec_version is 1.0, expected 1'),
    ],
    'it sees the data, not the text': _bad('interface', INTERFACE, [
        ('interface: [', '5:1: did not find expected node content while parsing a flow node'),
        ('interface: !robot {}',
         "4:12: tag '!robot' is not one of the core types, and no other is read"),
        ('--- {}', '4:1: a second document starts here, where one is expected'),
        ('interface: &a {topics: *a}', "4:24: alias '*a' is inside the node that it refers to"),
        ('interface: ' + '[' * 50000, '4:111: nested deeper than 100'),
    ]),
}

# What is odd and does no harm, with the warning that is logged.
ODD = _bad('interface', INTERFACE, [
    ('desription: a camera', "4:1: unknown key 'desription' in the spec (did you mean "
                             "'description'?)"),
    ('3: a camera', '4:1: unknown key 3 in the spec (expected name, spec_version, spec_type, '
                    'description, interface)'),
    ('interface: {topics: {image: {type: a/B, typ: c}}}',
     "4:41: unknown key 'typ' in topic 'image' (did you mean 'type'?)"),
    ('interface: {topics: {image: {description: a, type: a/B, description: b}}}',
     "4:57: duplicate key 'description' in topic 'image', the last one counts"),
]) + _bad('provider', PROVIDER, [
    ('launch_fil: a', "5:1: unknown key 'launch_fil' in the spec (did you mean 'launch_file'?)"),
    ('remappings: {topics: {image: a, image: a}}',
     "5:33: duplicate key 'image', remapped to the same name"),
]) + _bad('semantic_interface', SEMANTIC, [
    ('interface: {}', "5:1: unknown key 'interface' in the spec (expected name, spec_version, "
                      'spec_type, description, redefines, global_namespace, remappings)'),
])
