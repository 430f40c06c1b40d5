-- What somebody who knows the fleet of benchmark/fleet.py would ask the tables for, by hand: each
-- request of the benchmark, with the values that it covers and the patterns that match written out.
-- The function rocon_uri_matches is that of rocon_uri.resource_database.register.

-- request rocon:/*/*/*/*
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE (expires IS NULL OR expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE (expires IS NULL OR expires > (julianday('now') -
    2440587.5) * 86400.0);

-- request rocon:/*/*/*/ubuntu
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(operating_system, '|') && '{*, linux, ubuntu, warty, hoary, breezy, dapper,
    edgy, feisty, gutsy, hardy, intrepid, jaunty, karmic, lucid, maverick, natty, oneiric,
    precise, quantal, raring, saucy, trusty, utopic, vivid, wily, xenial, yakkety, zesty, artful,
    bionic, cosmic, disco, eoan, focal, groovy, hirsute, impish, jammy, kinetic, lunar, mantic,
    noble, oracular, plucky, questing, resolute}') AND (expires IS NULL OR expires > extract(epoch
    FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS
    (SELECT 1 FROM json_each('["' || replace(operating_system, '|', '","') || '"]') WHERE value IN
    ('*', 'linux', 'ubuntu', 'warty', 'hoary', 'breezy', 'dapper', 'edgy', 'feisty', 'gutsy',
    'hardy', 'intrepid', 'jaunty', 'karmic', 'lucid', 'maverick', 'natty', 'oneiric', 'precise',
    'quantal', 'raring', 'saucy', 'trusty', 'utopic', 'vivid', 'wily', 'xenial', 'yakkety',
    'zesty', 'artful', 'bionic', 'cosmic', 'disco', 'eoan', 'focal', 'groovy', 'hirsute',
    'impish', 'jammy', 'kinetic', 'lunar', 'mantic', 'noble', 'oracular', 'plucky', 'questing',
    'resolute'))) AND (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/*/*/noetic/*
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(application_framework, '|') && '{*, ros, noetic}') AND (expires IS NULL OR
    expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS
    (SELECT 1 FROM json_each('["' || replace(application_framework, '|', '","') || '"]') WHERE
    value IN ('*', 'ros', 'noetic'))) AND (expires IS NULL OR expires > (julianday('now') -
    2440587.5) * 86400.0);

-- request rocon:/*/*/noetic/ubuntu
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(application_framework, '|') && '{*, ros, noetic}' AND
    string_to_array(operating_system, '|') && '{*, linux, ubuntu, warty, hoary, breezy, dapper,
    edgy, feisty, gutsy, hardy, intrepid, jaunty, karmic, lucid, maverick, natty, oneiric,
    precise, quantal, raring, saucy, trusty, utopic, vivid, wily, xenial, yakkety, zesty, artful,
    bionic, cosmic, disco, eoan, focal, groovy, hirsute, impish, jammy, kinetic, lunar, mantic,
    noble, oracular, plucky, questing, resolute}') AND (expires IS NULL OR expires > extract(epoch
    FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS
    (SELECT 1 FROM json_each('["' || replace(application_framework, '|', '","') || '"]') WHERE
    value IN ('*', 'ros', 'noetic')) AND EXISTS (SELECT 1 FROM json_each('["' ||
    replace(operating_system, '|', '","') || '"]') WHERE value IN ('*', 'linux', 'ubuntu',
    'warty', 'hoary', 'breezy', 'dapper', 'edgy', 'feisty', 'gutsy', 'hardy', 'intrepid',
    'jaunty', 'karmic', 'lucid', 'maverick', 'natty', 'oneiric', 'precise', 'quantal', 'raring',
    'saucy', 'trusty', 'utopic', 'vivid', 'wily', 'xenial', 'yakkety', 'zesty', 'artful',
    'bionic', 'cosmic', 'disco', 'eoan', 'focal', 'groovy', 'hirsute', 'impish', 'jammy',
    'kinetic', 'lunar', 'mantic', 'noble', 'oracular', 'plucky', 'questing', 'resolute'))) AND
    (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/robot/*/*/*
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(hardware_platform, '|') && '{*, robot, fgopher, gopher, gocart, gocart_v1,
    gocart_v2, gocart_v2_1, gocart_v2_2, gocart_v2_3, gocart_v2_4, gocart_mini, gocart_mini_v2_1,
    gocart_mini_v2_3, gocart_mini_v2_4, kobuki, korus, pr2, robosem, segbot, turtlebot,
    turtlebot2, waiterbot, furo, aldebaran_nao, robotis_op1, roch, srb, turtlebot3, turtlebot4,
    create2, create3, duckiebot, jetbot, leo, locobot, rosbot, boxer, dingo, husky, jackal,
    ridgeback, warthog, mir100, mir250, pioneer_3at, pioneer_3dx, rb1, rb_kairos, summit_xl, cob4,
    fetch, freight, hsr, pmb2, stretch, tiago, tiago_pro, youbot, anymal, spot, unitree_a1,
    unitree_b2, unitree_go1, unitree_go2, atlas, cassie, digit, icub, pepper, reem_c, robotis_op2,
    robotis_op3, romeo, talos, thormang3, unitree_g1, unitree_h1, baxter, fr3, iiwa7, iiwa14,
    jaco, kinova_gen3, open_manipulator, panda, sawyer, ur3, ur3e, ur5, ur5e, ur7e, ur10, ur10e,
    ur12e, ur15, ur16e, ur20, ur30, xarm5, xarm6, xarm7, yumi, ardrone, bebop, crazyflie,
    robot_other}') AND (expires IS NULL OR expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS
    (SELECT 1 FROM json_each('["' || replace(hardware_platform, '|', '","') || '"]') WHERE value
    IN ('*', 'robot', 'fgopher', 'gopher', 'gocart', 'gocart_v1', 'gocart_v2', 'gocart_v2_1',
    'gocart_v2_2', 'gocart_v2_3', 'gocart_v2_4', 'gocart_mini', 'gocart_mini_v2_1',
    'gocart_mini_v2_3', 'gocart_mini_v2_4', 'kobuki', 'korus', 'pr2', 'robosem', 'segbot',
    'turtlebot', 'turtlebot2', 'waiterbot', 'furo', 'aldebaran_nao', 'robotis_op1', 'roch', 'srb',
    'turtlebot3', 'turtlebot4', 'create2', 'create3', 'duckiebot', 'jetbot', 'leo', 'locobot',
    'rosbot', 'boxer', 'dingo', 'husky', 'jackal', 'ridgeback', 'warthog', 'mir100', 'mir250',
    'pioneer_3at', 'pioneer_3dx', 'rb1', 'rb_kairos', 'summit_xl', 'cob4', 'fetch', 'freight',
    'hsr', 'pmb2', 'stretch', 'tiago', 'tiago_pro', 'youbot', 'anymal', 'spot', 'unitree_a1',
    'unitree_b2', 'unitree_go1', 'unitree_go2', 'atlas', 'cassie', 'digit', 'icub', 'pepper',
    'reem_c', 'robotis_op2', 'robotis_op3', 'romeo', 'talos', 'thormang3', 'unitree_g1',
    'unitree_h1', 'baxter', 'fr3', 'iiwa7', 'iiwa14', 'jaco', 'kinova_gen3', 'open_manipulator',
    'panda', 'sawyer', 'ur3', 'ur3e', 'ur5', 'ur5e', 'ur7e', 'ur10', 'ur10e', 'ur12e', 'ur15',
    'ur16e', 'ur20', 'ur30', 'xarm5', 'xarm6', 'xarm7', 'yumi', 'ardrone', 'bebop', 'crazyflie',
    'robot_other'))) AND (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/robot/*/*/ubuntu
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(hardware_platform, '|') && '{*, robot, fgopher, gopher, gocart, gocart_v1,
    gocart_v2, gocart_v2_1, gocart_v2_2, gocart_v2_3, gocart_v2_4, gocart_mini, gocart_mini_v2_1,
    gocart_mini_v2_3, gocart_mini_v2_4, kobuki, korus, pr2, robosem, segbot, turtlebot,
    turtlebot2, waiterbot, furo, aldebaran_nao, robotis_op1, roch, srb, turtlebot3, turtlebot4,
    create2, create3, duckiebot, jetbot, leo, locobot, rosbot, boxer, dingo, husky, jackal,
    ridgeback, warthog, mir100, mir250, pioneer_3at, pioneer_3dx, rb1, rb_kairos, summit_xl, cob4,
    fetch, freight, hsr, pmb2, stretch, tiago, tiago_pro, youbot, anymal, spot, unitree_a1,
    unitree_b2, unitree_go1, unitree_go2, atlas, cassie, digit, icub, pepper, reem_c, robotis_op2,
    robotis_op3, romeo, talos, thormang3, unitree_g1, unitree_h1, baxter, fr3, iiwa7, iiwa14,
    jaco, kinova_gen3, open_manipulator, panda, sawyer, ur3, ur3e, ur5, ur5e, ur7e, ur10, ur10e,
    ur12e, ur15, ur16e, ur20, ur30, xarm5, xarm6, xarm7, yumi, ardrone, bebop, crazyflie,
    robot_other}' AND string_to_array(operating_system, '|') && '{*, linux, ubuntu, warty, hoary,
    breezy, dapper, edgy, feisty, gutsy, hardy, intrepid, jaunty, karmic, lucid, maverick, natty,
    oneiric, precise, quantal, raring, saucy, trusty, utopic, vivid, wily, xenial, yakkety, zesty,
    artful, bionic, cosmic, disco, eoan, focal, groovy, hirsute, impish, jammy, kinetic, lunar,
    mantic, noble, oracular, plucky, questing, resolute}') AND (expires IS NULL OR expires >
    extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS
    (SELECT 1 FROM json_each('["' || replace(hardware_platform, '|', '","') || '"]') WHERE value
    IN ('*', 'robot', 'fgopher', 'gopher', 'gocart', 'gocart_v1', 'gocart_v2', 'gocart_v2_1',
    'gocart_v2_2', 'gocart_v2_3', 'gocart_v2_4', 'gocart_mini', 'gocart_mini_v2_1',
    'gocart_mini_v2_3', 'gocart_mini_v2_4', 'kobuki', 'korus', 'pr2', 'robosem', 'segbot',
    'turtlebot', 'turtlebot2', 'waiterbot', 'furo', 'aldebaran_nao', 'robotis_op1', 'roch', 'srb',
    'turtlebot3', 'turtlebot4', 'create2', 'create3', 'duckiebot', 'jetbot', 'leo', 'locobot',
    'rosbot', 'boxer', 'dingo', 'husky', 'jackal', 'ridgeback', 'warthog', 'mir100', 'mir250',
    'pioneer_3at', 'pioneer_3dx', 'rb1', 'rb_kairos', 'summit_xl', 'cob4', 'fetch', 'freight',
    'hsr', 'pmb2', 'stretch', 'tiago', 'tiago_pro', 'youbot', 'anymal', 'spot', 'unitree_a1',
    'unitree_b2', 'unitree_go1', 'unitree_go2', 'atlas', 'cassie', 'digit', 'icub', 'pepper',
    'reem_c', 'robotis_op2', 'robotis_op3', 'romeo', 'talos', 'thormang3', 'unitree_g1',
    'unitree_h1', 'baxter', 'fr3', 'iiwa7', 'iiwa14', 'jaco', 'kinova_gen3', 'open_manipulator',
    'panda', 'sawyer', 'ur3', 'ur3e', 'ur5', 'ur5e', 'ur7e', 'ur10', 'ur10e', 'ur12e', 'ur15',
    'ur16e', 'ur20', 'ur30', 'xarm5', 'xarm6', 'xarm7', 'yumi', 'ardrone', 'bebop', 'crazyflie',
    'robot_other')) AND EXISTS (SELECT 1 FROM json_each('["' || replace(operating_system, '|',
    '","') || '"]') WHERE value IN ('*', 'linux', 'ubuntu', 'warty', 'hoary', 'breezy', 'dapper',
    'edgy', 'feisty', 'gutsy', 'hardy', 'intrepid', 'jaunty', 'karmic', 'lucid', 'maverick',
    'natty', 'oneiric', 'precise', 'quantal', 'raring', 'saucy', 'trusty', 'utopic', 'vivid',
    'wily', 'xenial', 'yakkety', 'zesty', 'artful', 'bionic', 'cosmic', 'disco', 'eoan', 'focal',
    'groovy', 'hirsute', 'impish', 'jammy', 'kinetic', 'lunar', 'mantic', 'noble', 'oracular',
    'plucky', 'questing', 'resolute'))) AND (expires IS NULL OR expires > (julianday('now') -
    2440587.5) * 86400.0);

-- request rocon:/robot/*/noetic/*
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(hardware_platform, '|') && '{*, robot, fgopher, gopher, gocart, gocart_v1,
    gocart_v2, gocart_v2_1, gocart_v2_2, gocart_v2_3, gocart_v2_4, gocart_mini, gocart_mini_v2_1,
    gocart_mini_v2_3, gocart_mini_v2_4, kobuki, korus, pr2, robosem, segbot, turtlebot,
    turtlebot2, waiterbot, furo, aldebaran_nao, robotis_op1, roch, srb, turtlebot3, turtlebot4,
    create2, create3, duckiebot, jetbot, leo, locobot, rosbot, boxer, dingo, husky, jackal,
    ridgeback, warthog, mir100, mir250, pioneer_3at, pioneer_3dx, rb1, rb_kairos, summit_xl, cob4,
    fetch, freight, hsr, pmb2, stretch, tiago, tiago_pro, youbot, anymal, spot, unitree_a1,
    unitree_b2, unitree_go1, unitree_go2, atlas, cassie, digit, icub, pepper, reem_c, robotis_op2,
    robotis_op3, romeo, talos, thormang3, unitree_g1, unitree_h1, baxter, fr3, iiwa7, iiwa14,
    jaco, kinova_gen3, open_manipulator, panda, sawyer, ur3, ur3e, ur5, ur5e, ur7e, ur10, ur10e,
    ur12e, ur15, ur16e, ur20, ur30, xarm5, xarm6, xarm7, yumi, ardrone, bebop, crazyflie,
    robot_other}' AND string_to_array(application_framework, '|') && '{*, ros, noetic}') AND
    (expires IS NULL OR expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS
    (SELECT 1 FROM json_each('["' || replace(hardware_platform, '|', '","') || '"]') WHERE value
    IN ('*', 'robot', 'fgopher', 'gopher', 'gocart', 'gocart_v1', 'gocart_v2', 'gocart_v2_1',
    'gocart_v2_2', 'gocart_v2_3', 'gocart_v2_4', 'gocart_mini', 'gocart_mini_v2_1',
    'gocart_mini_v2_3', 'gocart_mini_v2_4', 'kobuki', 'korus', 'pr2', 'robosem', 'segbot',
    'turtlebot', 'turtlebot2', 'waiterbot', 'furo', 'aldebaran_nao', 'robotis_op1', 'roch', 'srb',
    'turtlebot3', 'turtlebot4', 'create2', 'create3', 'duckiebot', 'jetbot', 'leo', 'locobot',
    'rosbot', 'boxer', 'dingo', 'husky', 'jackal', 'ridgeback', 'warthog', 'mir100', 'mir250',
    'pioneer_3at', 'pioneer_3dx', 'rb1', 'rb_kairos', 'summit_xl', 'cob4', 'fetch', 'freight',
    'hsr', 'pmb2', 'stretch', 'tiago', 'tiago_pro', 'youbot', 'anymal', 'spot', 'unitree_a1',
    'unitree_b2', 'unitree_go1', 'unitree_go2', 'atlas', 'cassie', 'digit', 'icub', 'pepper',
    'reem_c', 'robotis_op2', 'robotis_op3', 'romeo', 'talos', 'thormang3', 'unitree_g1',
    'unitree_h1', 'baxter', 'fr3', 'iiwa7', 'iiwa14', 'jaco', 'kinova_gen3', 'open_manipulator',
    'panda', 'sawyer', 'ur3', 'ur3e', 'ur5', 'ur5e', 'ur7e', 'ur10', 'ur10e', 'ur12e', 'ur15',
    'ur16e', 'ur20', 'ur30', 'xarm5', 'xarm6', 'xarm7', 'yumi', 'ardrone', 'bebop', 'crazyflie',
    'robot_other')) AND EXISTS (SELECT 1 FROM json_each('["' || replace(application_framework,
    '|', '","') || '"]') WHERE value IN ('*', 'ros', 'noetic'))) AND (expires IS NULL OR expires >
    (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/robot/*/noetic/ubuntu
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(hardware_platform, '|') && '{*, robot, fgopher, gopher, gocart, gocart_v1,
    gocart_v2, gocart_v2_1, gocart_v2_2, gocart_v2_3, gocart_v2_4, gocart_mini, gocart_mini_v2_1,
    gocart_mini_v2_3, gocart_mini_v2_4, kobuki, korus, pr2, robosem, segbot, turtlebot,
    turtlebot2, waiterbot, furo, aldebaran_nao, robotis_op1, roch, srb, turtlebot3, turtlebot4,
    create2, create3, duckiebot, jetbot, leo, locobot, rosbot, boxer, dingo, husky, jackal,
    ridgeback, warthog, mir100, mir250, pioneer_3at, pioneer_3dx, rb1, rb_kairos, summit_xl, cob4,
    fetch, freight, hsr, pmb2, stretch, tiago, tiago_pro, youbot, anymal, spot, unitree_a1,
    unitree_b2, unitree_go1, unitree_go2, atlas, cassie, digit, icub, pepper, reem_c, robotis_op2,
    robotis_op3, romeo, talos, thormang3, unitree_g1, unitree_h1, baxter, fr3, iiwa7, iiwa14,
    jaco, kinova_gen3, open_manipulator, panda, sawyer, ur3, ur3e, ur5, ur5e, ur7e, ur10, ur10e,
    ur12e, ur15, ur16e, ur20, ur30, xarm5, xarm6, xarm7, yumi, ardrone, bebop, crazyflie,
    robot_other}' AND string_to_array(application_framework, '|') && '{*, ros, noetic}' AND
    string_to_array(operating_system, '|') && '{*, linux, ubuntu, warty, hoary, breezy, dapper,
    edgy, feisty, gutsy, hardy, intrepid, jaunty, karmic, lucid, maverick, natty, oneiric,
    precise, quantal, raring, saucy, trusty, utopic, vivid, wily, xenial, yakkety, zesty, artful,
    bionic, cosmic, disco, eoan, focal, groovy, hirsute, impish, jammy, kinetic, lunar, mantic,
    noble, oracular, plucky, questing, resolute}') AND (expires IS NULL OR expires > extract(epoch
    FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS
    (SELECT 1 FROM json_each('["' || replace(hardware_platform, '|', '","') || '"]') WHERE value
    IN ('*', 'robot', 'fgopher', 'gopher', 'gocart', 'gocart_v1', 'gocart_v2', 'gocart_v2_1',
    'gocart_v2_2', 'gocart_v2_3', 'gocart_v2_4', 'gocart_mini', 'gocart_mini_v2_1',
    'gocart_mini_v2_3', 'gocart_mini_v2_4', 'kobuki', 'korus', 'pr2', 'robosem', 'segbot',
    'turtlebot', 'turtlebot2', 'waiterbot', 'furo', 'aldebaran_nao', 'robotis_op1', 'roch', 'srb',
    'turtlebot3', 'turtlebot4', 'create2', 'create3', 'duckiebot', 'jetbot', 'leo', 'locobot',
    'rosbot', 'boxer', 'dingo', 'husky', 'jackal', 'ridgeback', 'warthog', 'mir100', 'mir250',
    'pioneer_3at', 'pioneer_3dx', 'rb1', 'rb_kairos', 'summit_xl', 'cob4', 'fetch', 'freight',
    'hsr', 'pmb2', 'stretch', 'tiago', 'tiago_pro', 'youbot', 'anymal', 'spot', 'unitree_a1',
    'unitree_b2', 'unitree_go1', 'unitree_go2', 'atlas', 'cassie', 'digit', 'icub', 'pepper',
    'reem_c', 'robotis_op2', 'robotis_op3', 'romeo', 'talos', 'thormang3', 'unitree_g1',
    'unitree_h1', 'baxter', 'fr3', 'iiwa7', 'iiwa14', 'jaco', 'kinova_gen3', 'open_manipulator',
    'panda', 'sawyer', 'ur3', 'ur3e', 'ur5', 'ur5e', 'ur7e', 'ur10', 'ur10e', 'ur12e', 'ur15',
    'ur16e', 'ur20', 'ur30', 'xarm5', 'xarm6', 'xarm7', 'yumi', 'ardrone', 'bebop', 'crazyflie',
    'robot_other')) AND EXISTS (SELECT 1 FROM json_each('["' || replace(application_framework,
    '|', '","') || '"]') WHERE value IN ('*', 'ros', 'noetic')) AND EXISTS (SELECT 1 FROM
    json_each('["' || replace(operating_system, '|', '","') || '"]') WHERE value IN ('*', 'linux',
    'ubuntu', 'warty', 'hoary', 'breezy', 'dapper', 'edgy', 'feisty', 'gutsy', 'hardy',
    'intrepid', 'jaunty', 'karmic', 'lucid', 'maverick', 'natty', 'oneiric', 'precise', 'quantal',
    'raring', 'saucy', 'trusty', 'utopic', 'vivid', 'wily', 'xenial', 'yakkety', 'zesty',
    'artful', 'bionic', 'cosmic', 'disco', 'eoan', 'focal', 'groovy', 'hirsute', 'impish',
    'jammy', 'kinetic', 'lunar', 'mantic', 'noble', 'oracular', 'plucky', 'questing',
    'resolute'))) AND (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/*/bob_*
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_' AND name < 'bob`' AND
    (expires IS NULL OR expires > extract(epoch FROM now())) UNION ALL SELECT uri FROM
    rocon_uri_resource WHERE is_pattern = 1 AND name LIKE 'bob\_%' ESCAPE '\' AND (expires IS NULL
    OR expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_' AND name < 'bob`' AND
    (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0) UNION ALL SELECT uri
    FROM rocon_uri_resource WHERE is_pattern = 1 AND name LIKE 'bob\_%' ESCAPE '\' AND (expires IS
    NULL OR expires > (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/*/*_000042
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND reversed >= '240000_' AND reversed <
    '240000`' AND (expires IS NULL OR expires > extract(epoch FROM now())) UNION ALL SELECT uri
    FROM rocon_uri_resource WHERE is_pattern = 1 AND name LIKE '%\_*' ESCAPE '\' AND (expires IS
    NULL OR expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND reversed >= '240000_' AND reversed <
    '240000`' AND (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0) UNION
    ALL SELECT uri FROM rocon_uri_resource WHERE is_pattern = 1 AND name LIKE '%\_*' ESCAPE '\'
    AND (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/*/bob_[0-9]*(2|4|6|8)
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_' AND name < 'bob`' AND
    name ~ '^bob_[0-9]*[2468]$' AND (expires IS NULL OR expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_' AND name < 'bob`' AND
    rocon_uri_matches('bob_[0-9]*(2|4|6|8)', name) AND (expires IS NULL OR expires >
    (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/pr2/bob_*/noetic
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_' AND name < 'bob`' AND
    kind IN (SELECT id FROM rocon_uri_kind WHERE string_to_array(hardware_platform, '|') && '{*,
    robot, pr2}' AND string_to_array(application_framework, '|') && '{*, ros, noetic}') AND
    (expires IS NULL OR expires > extract(epoch FROM now())) UNION ALL SELECT uri FROM
    rocon_uri_resource WHERE is_pattern = 1 AND name LIKE 'bob\_%' ESCAPE '\' AND kind IN (SELECT
    id FROM rocon_uri_kind WHERE string_to_array(hardware_platform, '|') && '{*, robot, pr2}' AND
    string_to_array(application_framework, '|') && '{*, ros, noetic}') AND (expires IS NULL OR
    expires > extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_' AND name < 'bob`' AND
    kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS (SELECT 1 FROM json_each('["' ||
    replace(hardware_platform, '|', '","') || '"]') WHERE value IN ('*', 'robot', 'pr2')) AND
    EXISTS (SELECT 1 FROM json_each('["' || replace(application_framework, '|', '","') || '"]')
    WHERE value IN ('*', 'ros', 'noetic'))) AND (expires IS NULL OR expires > (julianday('now') -
    2440587.5) * 86400.0) UNION ALL SELECT uri FROM rocon_uri_resource WHERE is_pattern = 1 AND
    name LIKE 'bob\_%' ESCAPE '\' AND kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS (SELECT
    1 FROM json_each('["' || replace(hardware_platform, '|', '","') || '"]') WHERE value IN ('*',
    'robot', 'pr2')) AND EXISTS (SELECT 1 FROM json_each('["' || replace(application_framework,
    '|', '","') || '"]') WHERE value IN ('*', 'ros', 'noetic'))) AND (expires IS NULL OR expires >
    (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/robot/bob_000*/noetic/ubuntu
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_000' AND name < 'bob_001'
    AND kind IN (SELECT id FROM rocon_uri_kind WHERE string_to_array(hardware_platform, '|') &&
    '{*, robot, fgopher, gopher, gocart, gocart_v1, gocart_v2, gocart_v2_1, gocart_v2_2,
    gocart_v2_3, gocart_v2_4, gocart_mini, gocart_mini_v2_1, gocart_mini_v2_3, gocart_mini_v2_4,
    kobuki, korus, pr2, robosem, segbot, turtlebot, turtlebot2, waiterbot, furo, aldebaran_nao,
    robotis_op1, roch, srb, turtlebot3, turtlebot4, create2, create3, duckiebot, jetbot, leo,
    locobot, rosbot, boxer, dingo, husky, jackal, ridgeback, warthog, mir100, mir250, pioneer_3at,
    pioneer_3dx, rb1, rb_kairos, summit_xl, cob4, fetch, freight, hsr, pmb2, stretch, tiago,
    tiago_pro, youbot, anymal, spot, unitree_a1, unitree_b2, unitree_go1, unitree_go2, atlas,
    cassie, digit, icub, pepper, reem_c, robotis_op2, robotis_op3, romeo, talos, thormang3,
    unitree_g1, unitree_h1, baxter, fr3, iiwa7, iiwa14, jaco, kinova_gen3, open_manipulator,
    panda, sawyer, ur3, ur3e, ur5, ur5e, ur7e, ur10, ur10e, ur12e, ur15, ur16e, ur20, ur30, xarm5,
    xarm6, xarm7, yumi, ardrone, bebop, crazyflie, robot_other}' AND
    string_to_array(application_framework, '|') && '{*, ros, noetic}' AND
    string_to_array(operating_system, '|') && '{*, linux, ubuntu, warty, hoary, breezy, dapper,
    edgy, feisty, gutsy, hardy, intrepid, jaunty, karmic, lucid, maverick, natty, oneiric,
    precise, quantal, raring, saucy, trusty, utopic, vivid, wily, xenial, yakkety, zesty, artful,
    bionic, cosmic, disco, eoan, focal, groovy, hirsute, impish, jammy, kinetic, lunar, mantic,
    noble, oracular, plucky, questing, resolute}') AND (expires IS NULL OR expires > extract(epoch
    FROM now())) UNION ALL SELECT uri FROM rocon_uri_resource WHERE is_pattern = 1 AND name LIKE
    'bob\_000%' ESCAPE '\' AND kind IN (SELECT id FROM rocon_uri_kind WHERE
    string_to_array(hardware_platform, '|') && '{*, robot, fgopher, gopher, gocart, gocart_v1,
    gocart_v2, gocart_v2_1, gocart_v2_2, gocart_v2_3, gocart_v2_4, gocart_mini, gocart_mini_v2_1,
    gocart_mini_v2_3, gocart_mini_v2_4, kobuki, korus, pr2, robosem, segbot, turtlebot,
    turtlebot2, waiterbot, furo, aldebaran_nao, robotis_op1, roch, srb, turtlebot3, turtlebot4,
    create2, create3, duckiebot, jetbot, leo, locobot, rosbot, boxer, dingo, husky, jackal,
    ridgeback, warthog, mir100, mir250, pioneer_3at, pioneer_3dx, rb1, rb_kairos, summit_xl, cob4,
    fetch, freight, hsr, pmb2, stretch, tiago, tiago_pro, youbot, anymal, spot, unitree_a1,
    unitree_b2, unitree_go1, unitree_go2, atlas, cassie, digit, icub, pepper, reem_c, robotis_op2,
    robotis_op3, romeo, talos, thormang3, unitree_g1, unitree_h1, baxter, fr3, iiwa7, iiwa14,
    jaco, kinova_gen3, open_manipulator, panda, sawyer, ur3, ur3e, ur5, ur5e, ur7e, ur10, ur10e,
    ur12e, ur15, ur16e, ur20, ur30, xarm5, xarm6, xarm7, yumi, ardrone, bebop, crazyflie,
    robot_other}' AND string_to_array(application_framework, '|') && '{*, ros, noetic}' AND
    string_to_array(operating_system, '|') && '{*, linux, ubuntu, warty, hoary, breezy, dapper,
    edgy, feisty, gutsy, hardy, intrepid, jaunty, karmic, lucid, maverick, natty, oneiric,
    precise, quantal, raring, saucy, trusty, utopic, vivid, wily, xenial, yakkety, zesty, artful,
    bionic, cosmic, disco, eoan, focal, groovy, hirsute, impish, jammy, kinetic, lunar, mantic,
    noble, oracular, plucky, questing, resolute}') AND (expires IS NULL OR expires > extract(epoch
    FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name >= 'bob_000' AND name < 'bob_001'
    AND kind IN (SELECT id FROM rocon_uri_kind WHERE EXISTS (SELECT 1 FROM json_each('["' ||
    replace(hardware_platform, '|', '","') || '"]') WHERE value IN ('*', 'robot', 'fgopher',
    'gopher', 'gocart', 'gocart_v1', 'gocart_v2', 'gocart_v2_1', 'gocart_v2_2', 'gocart_v2_3',
    'gocart_v2_4', 'gocart_mini', 'gocart_mini_v2_1', 'gocart_mini_v2_3', 'gocart_mini_v2_4',
    'kobuki', 'korus', 'pr2', 'robosem', 'segbot', 'turtlebot', 'turtlebot2', 'waiterbot', 'furo',
    'aldebaran_nao', 'robotis_op1', 'roch', 'srb', 'turtlebot3', 'turtlebot4', 'create2',
    'create3', 'duckiebot', 'jetbot', 'leo', 'locobot', 'rosbot', 'boxer', 'dingo', 'husky',
    'jackal', 'ridgeback', 'warthog', 'mir100', 'mir250', 'pioneer_3at', 'pioneer_3dx', 'rb1',
    'rb_kairos', 'summit_xl', 'cob4', 'fetch', 'freight', 'hsr', 'pmb2', 'stretch', 'tiago',
    'tiago_pro', 'youbot', 'anymal', 'spot', 'unitree_a1', 'unitree_b2', 'unitree_go1',
    'unitree_go2', 'atlas', 'cassie', 'digit', 'icub', 'pepper', 'reem_c', 'robotis_op2',
    'robotis_op3', 'romeo', 'talos', 'thormang3', 'unitree_g1', 'unitree_h1', 'baxter', 'fr3',
    'iiwa7', 'iiwa14', 'jaco', 'kinova_gen3', 'open_manipulator', 'panda', 'sawyer', 'ur3',
    'ur3e', 'ur5', 'ur5e', 'ur7e', 'ur10', 'ur10e', 'ur12e', 'ur15', 'ur16e', 'ur20', 'ur30',
    'xarm5', 'xarm6', 'xarm7', 'yumi', 'ardrone', 'bebop', 'crazyflie', 'robot_other')) AND EXISTS
    (SELECT 1 FROM json_each('["' || replace(application_framework, '|', '","') || '"]') WHERE
    value IN ('*', 'ros', 'noetic')) AND EXISTS (SELECT 1 FROM json_each('["' ||
    replace(operating_system, '|', '","') || '"]') WHERE value IN ('*', 'linux', 'ubuntu',
    'warty', 'hoary', 'breezy', 'dapper', 'edgy', 'feisty', 'gutsy', 'hardy', 'intrepid',
    'jaunty', 'karmic', 'lucid', 'maverick', 'natty', 'oneiric', 'precise', 'quantal', 'raring',
    'saucy', 'trusty', 'utopic', 'vivid', 'wily', 'xenial', 'yakkety', 'zesty', 'artful',
    'bionic', 'cosmic', 'disco', 'eoan', 'focal', 'groovy', 'hirsute', 'impish', 'jammy',
    'kinetic', 'lunar', 'mantic', 'noble', 'oracular', 'plucky', 'questing', 'resolute'))) AND
    (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0) UNION ALL SELECT uri
    FROM rocon_uri_resource WHERE is_pattern = 1 AND name LIKE 'bob\_000%' ESCAPE '\' AND kind IN
    (SELECT id FROM rocon_uri_kind WHERE EXISTS (SELECT 1 FROM json_each('["' ||
    replace(hardware_platform, '|', '","') || '"]') WHERE value IN ('*', 'robot', 'fgopher',
    'gopher', 'gocart', 'gocart_v1', 'gocart_v2', 'gocart_v2_1', 'gocart_v2_2', 'gocart_v2_3',
    'gocart_v2_4', 'gocart_mini', 'gocart_mini_v2_1', 'gocart_mini_v2_3', 'gocart_mini_v2_4',
    'kobuki', 'korus', 'pr2', 'robosem', 'segbot', 'turtlebot', 'turtlebot2', 'waiterbot', 'furo',
    'aldebaran_nao', 'robotis_op1', 'roch', 'srb', 'turtlebot3', 'turtlebot4', 'create2',
    'create3', 'duckiebot', 'jetbot', 'leo', 'locobot', 'rosbot', 'boxer', 'dingo', 'husky',
    'jackal', 'ridgeback', 'warthog', 'mir100', 'mir250', 'pioneer_3at', 'pioneer_3dx', 'rb1',
    'rb_kairos', 'summit_xl', 'cob4', 'fetch', 'freight', 'hsr', 'pmb2', 'stretch', 'tiago',
    'tiago_pro', 'youbot', 'anymal', 'spot', 'unitree_a1', 'unitree_b2', 'unitree_go1',
    'unitree_go2', 'atlas', 'cassie', 'digit', 'icub', 'pepper', 'reem_c', 'robotis_op2',
    'robotis_op3', 'romeo', 'talos', 'thormang3', 'unitree_g1', 'unitree_h1', 'baxter', 'fr3',
    'iiwa7', 'iiwa14', 'jaco', 'kinova_gen3', 'open_manipulator', 'panda', 'sawyer', 'ur3',
    'ur3e', 'ur5', 'ur5e', 'ur7e', 'ur10', 'ur10e', 'ur12e', 'ur15', 'ur16e', 'ur20', 'ur30',
    'xarm5', 'xarm6', 'xarm7', 'yumi', 'ardrone', 'bebop', 'crazyflie', 'robot_other')) AND EXISTS
    (SELECT 1 FROM json_each('["' || replace(application_framework, '|', '","') || '"]') WHERE
    value IN ('*', 'ros', 'noetic')) AND EXISTS (SELECT 1 FROM json_each('["' ||
    replace(operating_system, '|', '","') || '"]') WHERE value IN ('*', 'linux', 'ubuntu',
    'warty', 'hoary', 'breezy', 'dapper', 'edgy', 'feisty', 'gutsy', 'hardy', 'intrepid',
    'jaunty', 'karmic', 'lucid', 'maverick', 'natty', 'oneiric', 'precise', 'quantal', 'raring',
    'saucy', 'trusty', 'utopic', 'vivid', 'wily', 'xenial', 'yakkety', 'zesty', 'artful',
    'bionic', 'cosmic', 'disco', 'eoan', 'focal', 'groovy', 'hirsute', 'impish', 'jammy',
    'kinetic', 'lunar', 'mantic', 'noble', 'oracular', 'plucky', 'questing', 'resolute'))) AND
    (expires IS NULL OR expires > (julianday('now') - 2440587.5) * 86400.0);

-- request rocon:/*/xtrudy_391430
-- postgresql
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name = 'xtrudy_391430' AND (expires IS
    NULL OR expires > extract(epoch FROM now())) UNION ALL SELECT uri FROM rocon_uri_resource
    WHERE is_pattern = 1 AND name = 'xtrudy_391430_*' AND (expires IS NULL OR expires >
    extract(epoch FROM now()));
-- sqlite
SELECT uri FROM rocon_uri_resource WHERE is_pattern = 0 AND name = 'xtrudy_391430' AND (expires IS
    NULL OR expires > (julianday('now') - 2440587.5) * 86400.0) UNION ALL SELECT uri FROM
    rocon_uri_resource WHERE is_pattern = 1 AND name = 'xtrudy_391430_*' AND (expires IS NULL OR
    expires > (julianday('now') - 2440587.5) * 86400.0);
