"""A PostgreSQL of the tests' own, of the distribution's binaries."""
from __future__ import annotations

import glob
import os
import shutil
import signal
import subprocess
import tempfile
import time
from contextlib import contextmanager
from typing import Iterator, List, Optional

__all__ = ['Server', 'find_binaries']

# Ends with whoever holds the other end of its standard input, however that one ends; without
# writing all to the disk, as after a crash.
_GUARD = '"$@" </dev/null & read line; kill -QUIT $!; wait $!'

_PATIENCE = 300      # seconds for it to start, and to end


def find_binaries() -> Optional[str]:
    """The folder of the newest PostgreSQL that is installed, None if there is none."""
    found = glob.glob('/usr/lib/postgresql/*/bin/initdb')
    newest = max(found, key=lambda path: float(path.split('/')[4]), default='')
    return os.path.dirname(newest) or None


class Server:
    """
    A server that is asked through a socket in a temporary folder, and keeps nothing.

    As root it runs as the user postgres.
    """

    def __init__(self) -> None:
        binaries = find_binaries()
        assert binaries, 'PostgreSQL is not installed'
        self._binaries = binaries
        self.folder = tempfile.mkdtemp(prefix='rocon_uri_pg_')
        self._data = os.path.join(self.folder, 'data')
        self._databases = 0
        self._free: List[str] = []      # names of those that are empty
        self._as_user: List[str] = []
        if os.geteuid() == 0:
            self._as_user = ['/usr/sbin/runuser', '-u', 'postgres', '--']
            shutil.chown(self.folder, 'postgres')
        try:
            subprocess.run(
                [*self._as_user, os.path.join(binaries, 'initdb'), '--pgdata', self._data,
                 '--username', 'postgres', '--auth', 'trust', '--locale', 'C.UTF-8',
                 '--encoding', 'UTF8', '--no-sync'],
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=self.folder, check=True,
                timeout=_PATIENCE)
            self.start()
        except BaseException:
            shutil.rmtree(self.folder, ignore_errors=True)  # initdb may still write into it
            raise

    def start(self) -> None:
        """Start it, and wait until it answers."""
        import psycopg2
        with open(os.path.join(self.folder, 'log'), 'ab') as log:
            self._process = subprocess.Popen(
                [*self._as_user, 'sh', '-c', _GUARD, 'sh',
                 os.path.join(self._binaries, 'postgres'), '-D', self._data, '-k', self.folder,
                 '-c', 'listen_addresses=', '-c', 'fsync=off'],
                stdin=subprocess.PIPE, stdout=log, stderr=log, cwd=self.folder,
                start_new_session=True)     # a Ctrl-C is for the tests, which then end it
        deadline = time.monotonic() + _PATIENCE
        while True:
            try:
                psycopg2.connect(host=self.folder, user='postgres', dbname='postgres').close()
                return
            except psycopg2.OperationalError:
                if self._process.poll() is not None or time.monotonic() > deadline:
                    self.stop()
                    raise
                time.sleep(0.02)

    def stop(self) -> None:
        """End it and all connections to it; it can be started again."""
        assert self._process.stdin
        self._process.stdin.close()
        try:
            self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
            raise AssertionError('PostgreSQL does not end') from None

    def remove(self) -> None:
        """End it and remove its folder."""
        self.stop()
        shutil.rmtree(self.folder)

    @contextmanager
    def database(self) -> Iterator[str]:
        """
        An empty database; the value is its URL. All connections to it end with the block.

        It is emptied for the next one: to remove the 300 files that each has can take 0.6 s.
        """
        if not self._free:
            self._databases += 1
            self._free.append('fleet_%d' % self._databases)
            self.execute('CREATE DATABASE %s' % self._free[-1])
        name = self._free.pop()
        yield 'postgresql://postgres@/%s?host=%s' % (name, self.folder)
        self.execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
                     "WHERE datname = '%s'" % name)
        self.execute('DROP SCHEMA public CASCADE; CREATE SCHEMA public', name)
        self._free.append(name)

    def execute(self, statement: str, database: str = 'postgres') -> None:
        """Do something as its superuser."""
        import psycopg2
        connection = psycopg2.connect(host=self.folder, user='postgres', dbname=database)
        try:
            connection.autocommit = True
            connection.cursor().execute(statement)
        finally:
            connection.close()
