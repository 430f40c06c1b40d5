"""Apps: how long the answer for a workspace takes, and a fleet report of a thousand robots."""
import os
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SCRIPT = os.path.join(ROOT, 'scripts', 'rocon_uri')
PACKAGES, APPS, ROBOTS, REQUESTS, REPEAT = 300, 100, 1000, 100, 5

MANIFEST = '''<package format="2"><name>%s</name><version>1.0.0</version>
<description>d</description><maintainer email="a@example.org">a</maintainer>
<license>BSD</license>%s<export>%s</export>
</package>'''
RAPP = '''display: App
description: Does it
compatibility: rocon:/%s
launch: app.launch
required_capabilities: [{name: package_%d/Base}]
'''
INTERFACE = '''name: Base
spec_version: 1
spec_type: interface
interface: {topics: {requires: {/cmd_vel: {type: geometry_msgs/Twist}}}}
'''
PROVIDER = '''name: base
spec_version: 1
spec_type: provider
implements: %s/Base
launch_file: base.launch
'''


def figures():
    """What this part measures."""
    with tempfile.TemporaryDirectory() as folder:
        environment = dict(os.environ, PYTHONPATH=os.path.join(ROOT, 'src'),
                           PYTHONPYCACHEPREFIX=os.path.join(folder, 'compiled'))
        environment.pop('PYTHONDONTWRITEBYTECODE', None)
        workspace = os.path.join(folder, 'workspace')
        make_workspace(workspace)
        yield figure(
            '`apps` on %d packages with %d apps, start included' % (PACKAGES, APPS), environment,
            [SCRIPT, 'apps', '--robot', 'rocon:/kobuki/bob', '--package-path', workspace])
        robots, requests, page = (os.path.join(folder, name)
                                  for name in ('robots.txt', 'apps.txt', 'fleet.html'))
        make_fleet(robots, requests)
        found = figure(
            'fleet report of %d robots by %d apps' % (ROBOTS, REQUESTS), environment,
            [SCRIPT, 'match', '--matrix', '--requests-in', requests, '--in', robots,
             '--html', page])
        found['details'] = '%.2f MB; %s' % (os.path.getsize(page) / 1e6, in_browser(page))
        yield found


def figure(name, environment, arguments):
    """The figure of a command, beside the start of Python."""
    commands = [sys.executable] + arguments, [sys.executable, '-c', 'import argparse']
    times = [[processor_time(command, environment) for command in commands]
             for _ in range(REPEAT)]
    seconds, reference = map(min, zip(*times))
    return {'name': name, 'ratio': seconds / reference, 'target': None,
            'reference': "python3 -c 'import argparse', in processor time",
            'seconds': seconds, 'reference_seconds': reference}


def processor_time(command, environment):
    """Run a process, and return how many seconds of the processor it took."""
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    start = spent()
    subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=True)
    return spent() - start


def write(*parts):
    """Write a file: the parts of its path, and last its text."""
    path = os.path.join(*parts[:-1])
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w') as file:
        file.write(parts[-1])


def make_workspace(folder):
    """Packages with an app each, as many with a capability, and the rest with nothing."""
    depends = ''.join('<depend>other_%d</depend>' % number for number in range(12))
    for number in range(PACKAGES):
        name, exports = 'package_%d' % number, ''
        package = os.path.join(folder, name)
        if number < APPS:
            exports = '<rocon_app>rapps/app.rapp</rocon_app>'
            platform = ('turtlebot2|kobuki', 'robot/*/ros', 'pr2')[number % 3]
            write(package, 'rapps', 'app.rapp', RAPP % (platform, APPS + number))
            write(package, 'rapps', 'app.launch', '<launch/>')
        elif number < 2 * APPS:
            exports = ('<capability_interface>Base.yaml</capability_interface>'
                       '<capability_provider>base.yaml</capability_provider>')
            write(package, 'Base.yaml', INTERFACE)
            write(package, 'base.yaml', PROVIDER % name)
            write(package, 'base.launch', '<launch/>')
        write(package, 'package.xml', MANIFEST % (name, depends, exports))


def make_fleet(robots, requests):
    """A file of robots, and one of what apps run on."""
    platforms = ('pr2', 'kobuki', 'turtlebot2', 'fetch', 'pepper', 'ur5e')
    releases = (('noetic', 'focal'), ('melodic', 'bionic'), ('indigo', 'trusty'))
    write(robots, ''.join('rocon:/%s/robot_%d/%s/%s\n' % (
        platforms[number % 6], number, *releases[number % 3]) for number in range(ROBOTS)))
    names = ('*', '*', 'robot_1*', 'robot_[0-9]*5')
    write(requests, ''.join('rocon:/%s/%s/%s#ours/app_%d\n' % (
        (*platforms, 'robot', '*')[number % 8], names[number % 4], ('ros', '*')[number % 2], number)
        for number in range(REQUESTS)))


def in_browser(page):
    """How long a page takes in headless Chromium, where there is one."""
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
    except ImportError:
        return 'no browser to open it in'
    programs = shutil.which('chromium'), shutil.which('chromedriver')
    if None in programs:
        return 'no browser to open it in'
    options = webdriver.ChromeOptions()
    for argument in ('--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage',
                     '--window-size=1280,800'):
        options.add_argument(argument)
    options.binary_location = programs[0]
    driver = webdriver.Chrome(service=Service(programs[1]), options=options)
    try:
        driver.get('file://' + page)
        there = driver.execute_script(
            "return performance.getEntriesByType('navigation')[0].loadEventEnd")
        filtered = driver.execute_script('''
            var field = document.querySelector('[name=field0]'), start = performance.now();
            field.value = 'pr2';
            field.dispatchEvent(new Event('input'));
            document.body.offsetHeight;
            return performance.now() - start;''')
    finally:
        driver.quit()
    return 'in the browser there in %.2f s, filtered in %.2f s' % (there / 1e3, filtered / 1e3)
