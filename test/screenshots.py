"""
Makes the pictures of the documentation: what the command draws, and pages that a browser shows.

``/usr/bin/python3 test/screenshots.py`` writes them to ``doc/pictures``, or to the folder that it
is given. It needs graphviz, and Debian's chromium, chromium-driver and python3-selenium. A picture
of a page has a digest of that page in it, so that a test sees without a browser whether it is old.
"""
from __future__ import annotations

import hashlib
import html
import os
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path
from typing import Any, List, Match, Optional

ROOT = Path(__file__).resolve().parent.parent
#: the pictures; benchmark/picture.py makes another one
NAMES = 'cafe.svg', 'fleet_report.png', 'finding.png'
#: the commands of README whose last argument is the file to write
CAFE = ('specs graph --package-path examples/workspace'
        ' --robot rocon:/turtlebot2/cybernetic_pirate/noetic/focal --output')
FLEET = ('apps --package-path examples/workspace --robots-in examples/fleet.txt'
         ' --defaults examples/workspace/defaults.yaml --html')
#: the word that a picture has before the digest of its page
PAGE = b'Page'
#: A terminal as a page: the text goes where %s is.
TERMINAL = '''<!doctype html><meta charset="utf-8"><style>
body { margin: 0; background: #1d2026; color: #e4e6ea;
  font: 15px/1.45 "DejaVu Sans Mono", monospace }
pre { margin: 0; padding: 18px 22px; font: inherit; white-space: pre-wrap }
.c1 { font-weight: bold } .c2 { opacity: .6 } .c31 { color: #ff7b72 } .c32 { color: #7ee787 }
.c33 { color: #f2cc60 } .c36 { color: #76e3ea }</style><pre>%s</pre>'''


def as_page(text: str) -> str:
    """The output of a command, with its colours, as a page."""
    def styled(code: Match[str]) -> str:
        if code.group(1) == '0':
            return '</span>'
        return '<span class="%s">' % ' '.join('c' + style for style in code.group(1).split(';'))
    shown = re.sub(r'\x1b\[([\d;]+)m', styled, html.escape(text))
    return TERMINAL % shown


def in_terminal(arguments: List[str], folder: Path) -> str:
    """What the command prints on a terminal, below a prompt with the command."""
    ours, theirs = pty.openpty()
    command = [sys.executable, str(ROOT / 'scripts' / 'rocon_uri'), *arguments]
    process = subprocess.Popen(command, cwd=str(folder), stdout=theirs, stderr=theirs,
                               stdin=subprocess.DEVNULL,
                               env=dict(os.environ, TERM='xterm', COLUMNS='100', NO_COLOR='',
                                        ROS_PACKAGE_PATH=''))
    os.close(theirs)
    printed = b''
    try:
        while True:
            part = os.read(ours, 65536)
            if not part:
                break
            printed += part
    except OSError:     # Linux has no end of file here, but this
        pass
    os.close(ours)
    process.wait()
    return '$ rocon_uri %s\n%s' % (' '.join(arguments), printed.decode().replace('\r\n', '\n'))


def faulty_workspace(folder: Path) -> None:
    """The café as the examples have it, with three mistakes."""
    shutil.copytree(str(ROOT / 'examples' / 'workspace'), str(folder / 'workspace'))
    for name, right, wrong in (
            ('cafe_rapps/rapps/serve/serve.rapp', 'turtlebot2|', 'turtelbot2|'),
            ('cafe_rapps/rapps/greet/greet.rapp', 'greet.launch', 'gret.launch'),
            ('cafe_capabilities/providers/espeak.yaml', '/Speech', '/Speach')):
        path = folder / 'workspace' / name
        text = path.read_text(encoding='utf-8')
        assert right in text, name
        path.write_text(text.replace(right, wrong, 1), encoding='utf-8')


def resize(browser: Any, width: int, height: int) -> None:
    """Make a page so many pixels wide and high."""
    browser.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
        'width': width, 'height': height, 'deviceScaleFactor': 1, 'mobile': False})


def run(*arguments: str) -> None:
    """Run the command on the examples; what it could not do is an error, what it finds is none."""
    done = subprocess.run([sys.executable, 'scripts/rocon_uri', *arguments], cwd=str(ROOT),
                          env=dict(os.environ, ROS_PACKAGE_PATH='', ROCON_URI_RULES=''))
    if done.returncode > 1:
        raise SystemExit('rocon_uri %s: exit status %d' % (arguments[0], done.returncode))


def cafe(path: Path) -> None:
    """The workspace of the café, and what one robot can run of it."""
    run(*CAFE.split(), str(path))


def digest(page: Path) -> bytes:
    """What a picture of a page says that it was made of."""
    return hashlib.sha256(page.read_bytes()).hexdigest().encode()


def page_of(picture: bytes) -> Optional[bytes]:
    """The digest of the page that a picture shows, from its chunk of text."""
    found = re.search(b'tEXt' + PAGE + b'\\0([0-9a-f]{64})', picture)
    return found.group(1) if found else None


def save(browser: Any, page: Path, path: Path) -> None:
    """Write a picture of the page that a browser shows, with the digest of the page."""
    picture = browser.get_screenshot_as_png()
    chunk = b'tEXt' + PAGE + b'\0' + digest(page)
    head = 8 + 25       # the signature, and the chunk that always comes first
    path.write_bytes(picture[:head] + struct.pack('>I', len(chunk) - 4) + chunk
                     + struct.pack('>I', zlib.crc32(chunk)) + picture[head:])


def fleet_page(folder: Path) -> Path:
    """The apps of the café on all robots of the fleet."""
    page = folder / 'fleet.html'
    run(*FLEET.split(), str(page))
    return page


def fleet_report(browser: Any, folder: Path, path: Path) -> None:
    """The fleet report, with the reasons of one cell."""
    page = fleet_page(folder)
    resize(browser, 1200, 720)      # before, since the page is drawn anew when its size changes
    browser.get(page.as_uri())
    row = browser.find_elements('css selector', '#grid tbody tr[data-i]')[8]
    next(cell for cell in row.find_elements('tag name', 'td') if cell.text.strip() == '.').click()
    save(browser, page, path)


def finding_page(folder: Path) -> Path:
    """What the linter finds in the café with mistakes."""
    faulty_workspace(folder)
    page = folder / 'finding.html'
    page.write_text(as_page(in_terminal(['specs', 'check', 'workspace'], folder)), encoding='utf-8')
    return page


def finding(browser: Any, folder: Path, path: Path) -> None:
    """The findings in a terminal."""
    page = finding_page(folder)
    resize(browser, 1000, 100)
    browser.get(page.as_uri())
    resize(browser, 1000, browser.execute_script(
        'return document.querySelector("pre").offsetHeight'))
    save(browser, page, path)


def main(target: Path) -> None:
    """Write all pictures to a folder."""
    from browser import open_browser        # needs pytest and selenium, as only this does
    cafe(target / 'cafe.svg')
    with open_browser('--disable-gpu', '--disable-background-networking', '--hide-scrollbars') \
            as browser, tempfile.TemporaryDirectory() as folder:
        fleet_report(browser, Path(folder), target / 'fleet_report.png')
        finding(browser, Path(folder), target / 'finding.png')


if __name__ == '__main__':
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / 'doc' / 'pictures')
