"""Packages that tests make for themselves, where a folder of files would hide what matters."""
from __future__ import annotations

from textwrap import dedent

PACKAGE_XML = '''\
<package format="2">
  <name>%s</name>
  <version>1.0.0</version>
  <description>Made by a test</description>
  <maintainer email="somebody@example.org">Somebody</maintainer>
  <license>BSD</license>
  <export>
%s
  </export>
</package>
'''


def make_package(workspace, name, exports=(), **files):
    """
    Write a package and return its folder.

    Exports are (tag, path); files are content by path, in which ``__`` stands for a ``/`` and the
    last ``_`` for the dot: ``rapps__dance_rapp`` is rapps/dance.rapp.
    """
    folder = workspace / name
    folder.mkdir(parents=True)
    lines = '\n'.join('    <%s>%s</%s>' % (tag, path, tag) for tag, path in exports)
    (folder / 'package.xml').write_text(PACKAGE_XML % (name, lines))
    for key, content in files.items():
        path = folder / '.'.join(key.replace('__', '/').rsplit('_', 1))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(dedent(content))
    return folder
