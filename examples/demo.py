"""What examples/demo shows, once the package is built and its setup.bash was sourced."""
from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from typing import List

USER = '''
import rospy
from capabilities.client import CapabilitiesClient
rospy.init_node('user', anonymous=True)
client = CapabilitiesClient()
client.use_capability('demo_robot/Camera')
print('uses it', flush=True)
rospy.spin()
'''


def free_port() -> int:
    """A port for a master that is in nobody's way."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return int(probe.getsockname()[1])


def say(text: str) -> None:
    """Say what comes."""
    print('\n# %s' % text, flush=True)


def run(*verb: str) -> None:
    """Do what a verb of ``rocon_uri capabilities`` does."""
    print('$ rocon_uri capabilities %s' % ' '.join(verb), flush=True)
    subprocess.call(['rosrun', 'capabilities', 'capabilities', *verb])


def wait_for(uses: int, patience: float = 60.0) -> None:
    """Wait until the server is there and the camera has so many uses; for 0, nothing runs."""
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline:
        done = subprocess.run(
            ['rosrun', 'capabilities', 'capabilities', 'status', '--json'], stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, universal_newlines=True)
        answer = json.loads(done.stdout)
        if 'capabilities' in answer:        # the server is there
            found = {one['capability']: (one['uses'], one['state'])
                     for one in answer['capabilities']}
            if found.get('demo_robot/Camera') == (uses, 'running') if uses else not found:
                return
        time.sleep(0.2)
    raise AssertionError('the camera should have %d uses by now' % uses)


def start_user(users: 'List[subprocess.Popen[str]]') -> None:
    """Start a user of the camera, in a process of its own."""
    user = subprocess.Popen([sys.executable, '-c', USER], stdout=subprocess.PIPE,
                            stderr=subprocess.DEVNULL, universal_newlines=True)
    users.append(user)
    assert user.stdout is not None
    if not user.stdout.readline():
        raise AssertionError('a user could not use the camera')


def tour(users: 'List[subprocess.Popen[str]]') -> None:
    """What there is to see, with users that are added to a list."""
    wait_for(0)
    say('What the robot can do:')
    run('list')
    say('What a start of the camera would do:')
    run('plan', 'demo_robot/Camera')
    say('Two users use the camera. It runs, and so does the base, which it depends on.')
    start_user(users)
    start_user(users)
    first, second = users
    wait_for(2)
    run('status')
    say('The first user is killed. The camera runs on, for the second.')
    first.kill()
    first.wait()
    wait_for(1)
    run('status')
    say('The second one ends. Nobody wants anything any more.')
    second.send_signal(signal.SIGINT)
    second.wait()
    wait_for(0)
    run('status')


def main() -> int:
    """Show it, and return the exit status."""
    port = free_port()
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(ROS_MASTER_URI='http://127.0.0.1:%d' % port, ROS_IP='127.0.0.1',
                          ROS_HOME=folder, ROS_LOG_DIR=folder)
        os.environ.pop('ROS_HOSTNAME', None)
        os.environ.pop('ROS_NAMESPACE', None)
        with open(os.path.join(folder, 'server.log'), 'w+') as log:
            server = subprocess.Popen(['roslaunch', '-p', str(port), 'capabilities', 'demo.launch'],
                                      stdout=log, stderr=log)
            users: 'List[subprocess.Popen[str]]' = []
            try:
                tour(users)
            except AssertionError as error:
                log.seek(0)
                print('%s; the server says:\n%s' % (error, log.read()), file=sys.stderr)
                return 1
            finally:
                for user in users:
                    user.kill()
                server.send_signal(signal.SIGINT)
                server.wait()
    return 0


if __name__ == '__main__':
    sys.exit(main())
