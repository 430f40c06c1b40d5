"""The pictures in the repository are those that the commands make now."""
from __future__ import annotations

import re
import shutil
from collections import Counter
from pathlib import Path
from typing import Callable, List, Tuple

import pytest
import screenshots
from sources import ROOT

PICTURES = ROOT / 'doc' / 'pictures'
pytestmark = pytest.mark.skipif(not PICTURES.is_dir(), reason='the pictures are not here')
pytest.importorskip('yaml', reason='PyYAML is not installed')
pytest.importorskip('catkin_pkg', reason='catkin_pkg is not installed')


def texts(picture: Path) -> List[Tuple[str, str]]:
    """What is written in an SVG: the text itself, and what is shown of what one points at."""
    svg = picture.read_text(encoding='utf-8')
    return re.findall(r'<text[^>]*>([^<]*)</text>|xlink:title="([^"]*)"', svg)


def test_the_graph_says_what_it_says_now(tmp_path: Path) -> None:
    if shutil.which('dot') is None:
        pytest.skip('graphviz is not installed')
    screenshots.cafe(tmp_path / 'cafe.svg')
    said, now = texts(PICTURES / 'cafe.svg'), texts(tmp_path / 'cafe.svg')
    assert len(now) > 30
    assert Counter(said) == Counter(now), 'run test/screenshots.py'


@pytest.mark.parametrize('name, page', [
    ('fleet_report', screenshots.fleet_page), ('finding', screenshots.finding_page)])
def test_what_a_browser_shows_is_as_it_was_for_the_picture(
        name: str, page: Callable[[Path], Path], tmp_path: Path) -> None:
    picture = (PICTURES / (name + '.png')).read_bytes()
    assert picture.startswith(b'\x89PNG\r\n\x1a\n') and len(picture) > 10000
    assert screenshots.page_of(picture) == screenshots.digest(page(tmp_path)), (
        'run test/screenshots.py')


def test_readme_shows_the_pictures_and_says_what_is_on_it() -> None:
    shown = dict(re.findall(r'!\[([^\]]*)\]\(doc/pictures/([^)]*)\)',
                            (ROOT / 'README.md').read_text(encoding='utf-8')))
    assert sorted(shown.values()) == sorted(screenshots.NAMES)
    assert all(len(text.split()) > 4 for text in shown)


def test_the_pages_show_each_picture_and_say_what_is_on_it() -> None:
    pages = [page.read_text(encoding='utf-8') for page in (ROOT / 'doc').glob('*.rst')]
    shown = {name: text for page in pages for name, text in re.findall(
        r'^\.\. image:: pictures/(\S+)\n   :alt: (.*)$', page, re.MULTILINE)}
    assert sorted(shown) == sorted(path.name for path in PICTURES.iterdir())
    assert sum(page.count('.. image::') for page in pages) == sum(
        page.count('   :alt: ') for page in pages)


@pytest.mark.parametrize('command', [screenshots.CAFE, screenshots.FLEET], ids=['cafe', 'fleet'])
def test_readme_says_which_command_makes_a_picture(command: str) -> None:
    readme = (ROOT / 'README.md').read_text(encoding='utf-8')
    assert '\n    scripts/rocon_uri %s ' % command in readme
