"""The pages of the documentation as a browser shows them: nothing is cut off."""
from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any, Iterator, List

import pytest
from browser import open_browser
from sources import ROOT

WIDE, NARROW = 1280, 400    # pixels; a window is never narrower than 500, so that is a frame

#: The code blocks and pictures of a page that are wider than what shows them, and whether the page
#: itself scrolls sideways.
OVERFLOWING = '''
const page = arguments[0] ? document.getElementById('frame').contentDocument : document;
const found = [];
for (const block of page.querySelectorAll('div.highlight pre, div.body img'))
  if (block.scrollWidth > block.clientWidth + 1
      || block.getBoundingClientRect().right > page.documentElement.clientWidth + 1)
    found.push(block.textContent.slice(0, 200) || block.src);
if (page.documentElement.scrollWidth > page.documentElement.clientWidth + 1)
  found.push('the page');
return found;
'''


@pytest.fixture(scope='module')
def pages(tmp_path_factory: Any) -> Path:
    """The folder with the pages, as Sphinx makes them."""
    pytest.importorskip('sphinx', reason='Sphinx is not installed')
    pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')
    if not (ROOT / 'doc').is_dir():
        pytest.skip('the pages are not here')
    folder: Path = tmp_path_factory.mktemp('html')
    subprocess.run([sys.executable, '-m', 'sphinx', '-q', 'doc', str(folder)], cwd=str(ROOT),
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return folder


@pytest.fixture(scope='module')
def browser() -> Iterator[Any]:
    """A Chromium without a window."""
    with open_browser('--allow-file-access-from-files', '--window-size=%d,1000' % WIDE) as driver:
        yield driver


def overflowing(browser: Any, page: Path, width: int) -> List[str]:
    """What is cut off of a page where there is this much room."""
    if width == WIDE:
        browser.get(page.as_uri())
        found: List[str] = browser.execute_script(OVERFLOWING, False)
        return found
    holder = page.parent / ('frame_' + page.name)
    holder.write_text('<!doctype html><iframe id="frame" width="%d" height="800" src="%s"></iframe>'
                      % (width, page.name))
    browser.get(holder.as_uri())
    found = browser.execute_script(OVERFLOWING, True)
    return found


@pytest.mark.parametrize('width', [WIDE, NARROW])
def test_no_code_block_is_cut_off(browser: Any, pages: Path, width: int) -> None:
    names = [page.stem for page in (ROOT / 'doc').glob('*.rst')]
    assert len(names) > 15
    cut_off = {name: overflowing(browser, pages / (name + '.html'), width) for name in names}
    assert {name: found for name, found in cut_off.items() if found} == {}


def test_the_pictures_are_made_by_one_command(browser: Any, tmp_path: Path) -> None:
    import screenshots
    screenshots.main(tmp_path)
    pictures = ROOT / 'doc' / 'pictures'
    assert {path.name for path in tmp_path.iterdir()} == set(screenshots.NAMES)
    for path in tmp_path.glob('*.png'):
        assert len(path.read_bytes()) > 10000
        assert screenshots.page_of(path.read_bytes()) == screenshots.page_of(
            (pictures / path.name).read_bytes())


def test_a_finding_in_a_terminal_is_in_colour(tmp_path: Path) -> None:
    import screenshots
    screenshots.faulty_workspace(tmp_path)
    page = screenshots.as_page(screenshots.in_terminal(['specs', 'check', 'workspace'], tmp_path))
    assert page.count('<span class="c31">error</span>: ') == 3
    assert page.count('did you mean') == 3 and '3 errors and no warnings' in page
