"""rocon_uri_check() in a package of a robot of its own, beside rocon_uri and on top of it."""
from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from built import unless_built

ROOT = Path(__file__).resolve().parents[2]
TIDYBOT = Path(__file__).resolve().parent / 'workspace' / 'src' / 'tidybot'


def is_in_ros_package_path() -> bool:
    find = ['rospack', 'find', 'rocon_uri']
    return (all(map(shutil.which, ('rospack', 'catkin_make', 'rostest')))
            and subprocess.run(find, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL).returncode == 0)


pytestmark = unless_built(is_in_ros_package_path(),
                          'no ROS environment with rocon_uri, catkin and rostest')


def run(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
    # catkin_make believes PWD
    return subprocess.run(command, cwd=str(folder), env=dict(os.environ, PWD=str(folder)),
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True)


def succeed(folder: Path, *command: str) -> str:
    done = run(folder, *command)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture
def tidybot(tmp_path):
    """The package tidybot, in a folder of its own."""
    shutil.copytree(str(TIDYBOT), str(tmp_path / 'src' / 'tidybot'))
    (tmp_path / 'src' / 'tidybot' / 'test' / 'robot_knows_its_app').chmod(0o755)
    return tmp_path / 'src' / 'tidybot'


def test_catkin_make_checks_it_and_its_rostest_passes(tidybot, tmp_path):
    if not (ROOT / 'CMakeLists.txt').is_file():
        pytest.skip('not in the source of rocon_uri')
    (tmp_path / 'src' / 'rocon_uri').symlink_to(ROOT)
    succeed(tmp_path, 'catkin_make', '-DPYTHON_EXECUTABLE=' + sys.executable)
    output = succeed(tmp_path, 'catkin_make', 'run_tests_tidybot')
    assert str(tmp_path / 'src/rocon_uri/scripts/rocon_uri') in output
    assert 'rocon_uri: no errors and no warnings in 1 package' in output
    results = tmp_path / 'build' / 'test_results'
    assert 'Summary: 6 tests, 0 errors, 0 failures' in succeed(
        tmp_path, 'catkin_test_results', str(results))
    assert (results / 'tidybot' / 'rocon_uri_check.xml').is_file()
    assert (results / 'tidybot' / 'rostest-test_tidybot.xml').is_file()


def test_ctest_checks_it_in_the_space_that_these_tests_run_in(tidybot, tmp_path):
    build = tmp_path / 'build'
    succeed(tmp_path, 'cmake', '-S', str(tidybot), '-B', str(build),
            '-DPYTHON_EXECUTABLE=' + sys.executable)
    succeed(tmp_path, 'cmake', '--build', str(build))
    check = ['ctest', '--verbose', '-R', '_ctest_tidybot_rocon_uri_check']
    output = succeed(build, *check)
    assert '100% tests passed, 0 tests failed out of 1' in output
    space = Path(succeed(tmp_path, 'rospack', 'find', 'rocon_uri').strip())
    script = (space / 'scripts' / 'rocon_uri' if (space / 'scripts').is_dir()
              else space.parents[1] / 'lib' / 'rocon_uri' / 'rocon_uri')
    assert "'%s' specs check" % script in output

    rapp = tidybot / 'rapps' / 'tidy_up.rapp'
    rapp.write_text(rapp.read_text().replace('tidybot_family', 'tidybot_famly'))
    done = run(build, *check)
    assert done.returncode != 0
    assert "/tidy_up.rapp:3:23: error: compatibility: hardware_platform 'tidybot_famly' is not " \
        "registered (did you mean 'tidybot_family'" in done.stdout
    report = (build / 'test_results' / 'tidybot' / 'rocon_uri_check.xml').read_text()
    assert '<failure message="1 error"' in report


def test_where_tests_are_not_enabled_nothing_is_added(tidybot, tmp_path):
    lists = tidybot / 'CMakeLists.txt'
    lists.write_text(lists.read_text().partition('if(CATKIN_ENABLE_TESTING)')[0]
                     + 'rocon_uri_check()\n')
    succeed(tmp_path, 'cmake', '-S', str(tidybot), '-B', str(tmp_path / 'build'),
            '-DCATKIN_ENABLE_TESTING=OFF', '-DPYTHON_EXECUTABLE=' + sys.executable)
