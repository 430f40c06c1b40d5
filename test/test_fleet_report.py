"""Fleet reports: match --matrix and apps as a page for a browser, and the matrix as a table."""
from __future__ import annotations

import csv
import io
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Tuple

import pytest
from browser import open_browser
from made_packages import make_package
from sources import ROOT, SOURCE
from terminal import open_terminal

import rocon_uri
from rocon_uri.cli import main

EXAMPLES = ROOT / 'examples'
APPS, FLEET = str(EXAMPLES / 'apps.txt'), str(EXAMPLES / 'fleet.txt')
Report = Dict[str, Any]


pytestmark = pytest.mark.usefixtures('no_packages_around')


def uris(path: str) -> List[str]:
    return [line for line in Path(path).read_text().splitlines() if line.startswith('rocon:')]


def report_in(page: Path) -> Report:
    """The data of a page, from which the browser makes all that is seen."""
    [data] = re.findall(r'<script type="application/json" id="report">(.*?)</script>',
                        page.read_text(encoding='utf-8'), re.DOTALL)
    report: Report = json.loads(data)
    return report


def outcome(report: Report, row: int, column: int) -> Dict[str, Any]:
    found: Dict[str, Any] = report['outcomes'][report['cells'][row][column]]
    return found


# The pages

def test_the_page_of_a_matrix_says_what_is_compatible_and_which_fields_are(
        tmp_path: Path, capsys: Any) -> None:
    page = tmp_path / 'fleet.html'
    given = ['match', '--matrix', '--requests-in', APPS, '--in', FLEET]
    assert main([*given, '--html', str(page)]) == 0
    assert capsys.readouterr() == ('', '')
    report = report_in(page)
    assert [row['text'] for row in report['rows']] == uris(FLEET)
    for row, robot in enumerate(uris(FLEET)):
        for column, app in enumerate(uris(APPS)):
            found = outcome(report, row, column)
            assert found['mark'] == ('x' if rocon_uri.is_compatible(app, robot) else '.')
            assert [mark == 'x' for mark in found['fields']] == [
                field.is_compatible for field in rocon_uri.explain(app, robot).fields]
    assert report['columns'][0]['label'] == 'cafe_rapps/patrol'
    assert report['legend'] == 'x fits, . does not, ? is too complex to say'
    assert report['fields'] == ['hardware_platform', 'name', 'application_framework',
                                'operating_system']


def test_a_concert_is_a_field_where_one_is_named(tmp_path: Path) -> None:
    robots, page = tmp_path / 'robots.txt', tmp_path / 'x.html'
    robots.write_text('rocon://north/pr2\nrocon:/pr2\n')
    assert main(['match', '--matrix', 'rocon://south/pr2', '--in', str(robots),
                 '--html', str(page)]) == 0
    report = report_in(page)
    assert report['fields'][0] == 'concert_name'
    assert [outcome(report, row, 0)['fields'][0] for row in (0, 1)] == ['.', 'x']


def test_pairs_that_are_too_complex_are_marked(tmp_path: Path, capsys: Any) -> None:
    robots, page = tmp_path / 'robots.txt', tmp_path / 'x.html'
    robots.write_text('rocon:/pr2/(a|b)*a(a|b){200}\n')
    request = 'rocon:/*/(a|b)*b(a|b){200}'
    assert main(['match', '--matrix', request, '--in', str(robots), '--html', str(page)]) == 2
    assert 'undecided' in capsys.readouterr().err
    assert outcome(report_in(page), 0, 0) == {'mark': '?', 'fields': 'x?xx', 'reasons': []}


@pytest.mark.parametrize('ignored', [[], ['--ignore', 'platform', '--ignore', 'no-provider']])
def test_the_page_of_apps_has_the_reasons_of_the_verdicts(
        tmp_path: Path, capsys: Any, ignored: List[str]) -> None:
    robots = ['rocon:/turtlebot2/bob/noetic/focal', 'rocon:/cafe_cart']
    page = tmp_path / 'apps.html'
    (tmp_path / 'robots.txt').write_text('# the café\n\n%s\n' % '\n'.join(robots), encoding='utf-8')
    given = ['--package-path', str(EXAMPLES / 'workspace'), *ignored]
    assert main(['apps', *given, '--robots-in', str(tmp_path / 'robots.txt'),
                 '--html', str(page)]) == 0
    assert capsys.readouterr() == ('', '')
    report = report_in(page)
    labels = [column['label'] for column in report['columns']]
    for row, robot in enumerate(robots):
        main(['apps', *given, '--json', '--all', '--robot', robot])
        for app in json.loads(capsys.readouterr().out)['apps']:
            if app['virtual']:
                assert app['name'] not in labels
                continue
            found = outcome(report, row, labels.index(app['name']))
            assert found['mark'] == ('x' if app['runs'] else '.')
            assert found['reasons'] == [
                '%s [%s]' % (reason['text'], reason['kind'])
                for reason in app['reasons'] if reason['kind'] != 'platform']


def test_the_page_of_apps_takes_the_type_of_the_robots(tmp_path: Path, capsys: Any) -> None:
    made = make_package(
        tmp_path, 'ours', apps__x_installed='apps: [{app: ours/dance}]', a_interface='{}',
        dance_app='{platform: fetch15, interface: ours/a.interface, launch: ours/a.launch}',
        a_launch='<launch/>')
    (made / 'package.xml').write_text((made / 'package.xml').read_text().replace(
        '<export>', '<export><app_manager app_dir="apps"/>'))
    given = ['apps', '--robot', 'rocon:/fetch', '--package-path', str(tmp_path),
             '--html', str(tmp_path / 'x.html')]
    assert main(given) == 1
    assert main([*given, '--robot-type', 'fetch15']) == 0


def test_without_a_file_of_robots_the_page_has_the_one_that_is_given(
        tmp_path: Path, capsys: Any) -> None:
    page = tmp_path / 'x.html'
    given = ['apps', '--package-path', str(EXAMPLES / 'workspace'), '--html', str(page), '--robot']
    assert main([*given, 'rocon:/cafe_cart']) == 0
    assert [row['text'] for row in report_in(page)['rows']] == ['rocon:/cafe_cart']
    assert main([*given, 'rocon:/zork/bob']) == 2       # it is not registered, and judged
    assert [row['text'] for row in report_in(page)['rows']] == ['rocon:/zork/bob']
    assert main([*given, 'rocon:/cafe_cart', 'cafe_rapps/greet', '--json']) == 1
    assert json.loads(capsys.readouterr().out)['errors'] == []
    assert [column['label'] for column in report_in(page)['columns']] == ['cafe_rapps/greet']


def test_bad_robots_of_a_file_are_reported_with_their_lines(tmp_path: Path, capsys: Any) -> None:
    robots, page = tmp_path / 'robots.txt', tmp_path / 'x.html'
    robots.write_text('rocon:/pr2\nrocon:/pr2/3bob\n')
    given = ['apps', '--package-path', str(EXAMPLES / 'workspace'), '--html', str(page)]
    assert main([*given, '--robots-in', str(robots)]) == 2
    assert capsys.readouterr().err.startswith('%s:2: ' % robots)
    assert [row['text'] for row in report_in(page)['rows']] == ['rocon:/pr2']
    assert main([*given, '--robots-in', '/no/such/file']) == 2
    assert 'No such file or directory' in capsys.readouterr().err


def test_a_fault_of_many_robots_is_said_once_and_all_of_them_are_judged(
        tmp_path: Path, capsys: Any) -> None:
    robots, page = tmp_path / 'robots.txt', tmp_path / 'x.html'
    lines = ['rocon:/zork/bob_%d' % number for number in range(20)] + [
        'rocon:/cafe_cart', 'rocon:/cafe_cart/3bob', ' rocon:/zork/*/zork ', 'rocon:/zork']
    robots.write_text('\n'.join(lines))
    given = ['apps', '--package-path', str(EXAMPLES / 'workspace'), '--html', str(page)]
    assert main([*given, '--robots-in', str(robots)]) == 2
    first, name, others = capsys.readouterr().err.replace(str(robots), 'robots').splitlines()
    assert first.startswith("robots:1: hardware_platform 'zork' is not registered, at character 8")
    assert name.startswith('robots:22: ')
    assert others == ("robots: hardware_platform 'zork' is not registered, also on lines 2, 3, 4, "
                      '5, 6 and 16 more')
    assert [row['text'] for row in report_in(page)['rows']] == [
        line.strip() for line in lines if '3bob' not in line]


def test_robots_in_utf_16_are_said_to_be_that(tmp_path: Path, capsys: Any) -> None:
    robots, page = tmp_path / 'robots.txt', tmp_path / 'x.html'
    robots.write_text('rocon:/pr2\n', encoding='utf-16')
    given = ['apps', '--package-path', str(EXAMPLES / 'workspace'), '--html', str(page)]
    assert main([*given, '--robots-in', str(robots)]) == 2
    assert 'it is UTF-16, not UTF-8: byte 0xff at offset 0' in capsys.readouterr().err


def test_robots_of_a_file_without_a_page_are_refused(capsys: Any) -> None:
    assert main(['apps', '--robots-in', FLEET, '--package-path', str(EXAMPLES)]) == 2
    assert capsys.readouterr() == ('', 'rocon_uri apps: error: --robots-in needs --html\n')


@pytest.mark.parametrize('options, says', [
    (['--all'], '--html takes neither --all nor --running'),
    (['--running'], '--html takes neither --all nor --running'),
    (['--robots-in', FLEET, '--robot', 'rocon:/pr2'], '--robots-in or with --robot')])
def test_what_a_page_of_apps_has_no_use_for_is_refused(
        options: List[str], says: str, tmp_path: Path, capsys: Any) -> None:
    page = tmp_path / 'fleet.html'
    given = ['apps', '--package-path', str(EXAMPLES), '--html', str(page)]
    assert main([*given, *options]) == 2 and says in capsys.readouterr().err
    assert not page.exists()


@pytest.mark.parametrize('verb', ['match', 'apps'])
def test_a_page_that_cannot_be_written_is_an_error(verb: str, capsys: Any) -> None:
    given = {'match': ['--matrix', 'rocon:/pr2', '--in', FLEET],
             'apps': ['--robot', 'rocon:/pr2', '--package-path', str(EXAMPLES / 'workspace')]}[verb]
    assert main([verb, *given, '--html', '/no/such/folder/x.html', '--json']) == 2
    out, err = capsys.readouterr()
    assert "cannot write '/no/such/folder/x.html'" in err
    assert json.loads(out)['errors'][0]['file'] == '/no/such/folder/x.html'


HOSTILE = '</script><script>document.title = "broken"</script>&amp;<b>'


def hostile_page(folder: Path) -> Path:
    """The page of an app whose display is markup."""
    make_package(folder, 'ours', [('rocon_app', 'dance.rapp')], dance_launch='<launch/>',
                 dance_rapp=json.dumps({'compatibility': 'rocon:/pr2', 'launch': 'dance.launch',
                                        'display': HOSTILE}))
    main(['apps', '--package-path', str(folder), '--robot', 'rocon:/pr2',
          '--html', str(folder / 'x.html')])
    return folder / 'x.html'


def test_what_is_reported_is_no_markup(tmp_path: Path) -> None:
    page = hostile_page(tmp_path)
    assert page.read_text().count('<script') == 2 and '<b>' not in page.read_text()
    assert report_in(page)['columns'][0]['about'].startswith(HOSTILE)


def test_the_page_needs_nothing_else(tmp_path: Path) -> None:
    text = hostile_page(tmp_path).read_text()
    assert not re.search(r'(?:src|href)\s*=|url\(|@import|https?:', text)
    assert "default-src 'none'" in text


def test_a_large_page_is_small(tmp_path: Path) -> None:
    robots, apps, page = tmp_path / 'robots.txt', tmp_path / 'apps.txt', tmp_path / 'x.html'
    robots.write_text(''.join('rocon:/pr2/robot_%d/noetic/focal\n' % number
                              for number in range(1000)))
    apps.write_text(''.join('rocon:/pr2|kobuki/robot_*%d#ours/a%d\n' % (number % 10, number)
                            for number in range(100)))
    assert main(['match', '--matrix', '--requests-in', str(apps), '--in', str(robots),
                 '--html', str(page)]) == 0
    assert page.stat().st_size < 10 << 20
    report = report_in(page)
    assert (len(report['rows']), len(report['cells'][0])) == (1000, 100)


# The matrix as a table

@pytest.mark.parametrize('form, delimiter', [('csv', ','), ('tsv', '\t')])
def test_the_matrix_as_a_table(form: str, delimiter: str, capsys: Any) -> None:
    assert main(['match', '--matrix', '--requests-in', APPS, '--in', FLEET, '--format', form]) == 0
    head, *rows = csv.reader(io.StringIO(capsys.readouterr().out), delimiter=delimiter)
    assert head == ['resource', *(str(rocon_uri.parse(app).rocon_app) for app in uris(APPS))]
    for row, robot in zip(rows, uris(FLEET)):
        assert row == [robot, *('x' if rocon_uri.is_compatible(app, robot) else '.'
                                for app in uris(APPS))]
    assert len(rows) == len(uris(FLEET))


@pytest.mark.parametrize('option', [['--html', 'x.html'], ['--format', 'csv']])
def test_a_page_or_a_table_is_of_a_matrix(option: List[str], capsys: Any) -> None:
    assert main(['match', 'rocon:/pr2', '--in', FLEET, *option]) == 2
    assert '--html and --format need --matrix' in capsys.readouterr().err


def test_the_matrix_has_one_form(tmp_path: Path, capsys: Any) -> None:
    page = tmp_path / 'fleet.html'
    assert main(['match', 'rocon:/pr2', '--in', FLEET, '--matrix', '--html', str(page),
                 '--format', 'csv']) == 2
    assert 'give --html or --format' in capsys.readouterr().err and not page.exists()


def on_terminal(columns: int, apps: int, folder: Path) -> List[str]:
    """The lines of a matrix of so many apps on a terminal."""
    requests = folder / 'apps.txt'
    requests.write_text(''.join('rocon:/pr2#ours/app_%d\n' % number
                                for number in range(1, apps + 1)))
    robots = folder / 'robots.txt'
    robots.write_text('rocon:/pr2/bob\n')
    ours, theirs = open_terminal()
    environment = {**os.environ, 'PYTHONPATH': str(SOURCE), 'COLUMNS': str(columns),
                   'NO_COLOR': '1'}
    with subprocess.Popen(
            [sys.executable, str(ROOT / 'scripts' / 'rocon_uri'), 'match', '--matrix',
             '--requests-in', str(requests), '--in', str(robots)], stdout=theirs,
            stderr=subprocess.DEVNULL, env=environment):
        os.close(theirs)
        written = b''
        while True:
            try:
                piece = os.read(ours, 65536)
            except OSError:     # the other side was closed
                break
            if not piece:
                break
            written += piece
    os.close(ours)
    return written.decode().splitlines()


def test_many_apps_are_numbered_columns_on_a_terminal(tmp_path: Path) -> None:
    lines = on_terminal(100, 60, tmp_path)
    assert lines[1] == ' 1  ours/app_1' and lines[60] == '60  ours/app_60'
    assert lines[61] == '         ' + ''.join(str(tens) * 10 for tens in range(1, 6)) + '6'
    assert lines[62] == '1234567890' * 6
    assert lines[63] == 'x' * 60 + '  rocon:/pr2/bob'
    assert max(map(len, lines)) <= 100


def test_few_apps_have_their_names_above_their_columns(tmp_path: Path) -> None:
    assert on_terminal(100, 3, tmp_path)[1:] == [
        'ours/app_1', '| ours/app_2', '| | ours/app_3', 'x x x  rocon:/pr2/bob']


# In a browser

@pytest.fixture(scope='module')
def browser() -> Iterator[Any]:
    """Headless Chromium."""
    with open_browser('--disable-gpu', '--window-size=1280,800', log=True) as driver:
        yield driver


@pytest.fixture
def opened(browser: Any, tmp_path: Path) -> Callable[[Path], Any]:
    """Open a page, and return the browser, whose log stays empty."""
    def open_page(page: Path) -> Any:
        browser.get(page.as_uri())
        assert browser.get_log('browser') == []
        return browser
    return open_page


@pytest.fixture
def fleet(opened: Callable[[Path], Any], tmp_path: Path) -> Any:
    """The browser with the fleet of the examples."""
    main(['match', '--matrix', '--requests-in', APPS, '--in', FLEET,
          '--html', str(tmp_path / 'fleet.html')])
    return opened(tmp_path / 'fleet.html')


def text_of(browser: Any, selector: str) -> str:
    found: str = browser.find_element('css selector', selector).text
    return found


def first_rows(browser: Any) -> List[str]:
    return [row.text for row in browser.find_elements('css selector', '#grid tbody th')][:3]


def test_a_cell_says_why_when_it_is_clicked(fleet: Any) -> None:
    assert text_of(fleet, '#count') == '44 of 44 resources, 16 of 16 requests'
    assert text_of(fleet, '#legend').startswith('x fits, . does not')
    row = fleet.find_elements('css selector', '#grid tbody tr[data-i]')[0]
    assert row.text.split() == (
        'rocon:/waiterbot/waiter_1/indigo/trusty . x x x . x x . . . . . . . . .'.split())
    row.find_elements('tag name', 'td')[8].click()
    why = text_of(fleet, '#why')
    assert 'rocon:/waiterbot/waiter_1/indigo/trusty' in why and 'turtlebot_rapps/maze' in why
    assert '. hardware_platform turtlebot3 waiterbot' in why and 'x operating_system' in why
    assert len(fleet.get_screenshot_as_png()) > 10000


def test_no_label_touches_the_next(fleet: Any) -> None:
    fleet.set_window_size(1200, 900)
    places = fleet.execute_script('''
        return [...document.querySelectorAll('label')].map(function (label) {
          var range = document.createRange();
          range.selectNodeContents(label.firstChild);
          var place = range.getBoundingClientRect();
          return [place.top, place.left, place.right];
        })''')
    assert len(places) == 7 and places == sorted(places)
    assert all(right + 12 < next_left for (top, _, right), (next_top, next_left, _)
               in zip(places, places[1:]) if top == next_top)


def test_cells_and_reasons_are_seen_on_a_phone(fleet: Any) -> None:
    fleet.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
        'width': 400, 'height': 800, 'deviceScaleFactor': 1, 'mobile': False})
    try:
        fleet.refresh()
        right, top, bottom = fleet.execute_script('''
            var cell = document.querySelectorAll('#grid tbody tr[data-i] td')[3];
            cell.click();
            return [cell.getBoundingClientRect().right,
                    document.getElementById('why').getBoundingClientRect().top,
                    document.getElementById('scroll').getBoundingClientRect().bottom]''')
        assert right < 400 and top >= bottom
        assert 'rocon:/waiterbot/waiter_1/indigo/trusty' in text_of(fleet, '#why')
    finally:
        fleet.execute_cdp_cmd('Emulation.clearDeviceMetricsOverride', {})


def test_the_fleet_is_filtered_by_field_and_by_text(fleet: Any) -> None:
    fleet.find_element('name', 'field0').send_keys('turtlebot3')
    assert text_of(fleet, '#count').startswith('%d of 44 resources' % sum(
        'turtlebot3' in robot for robot in uris(FLEET)))
    assert all('turtlebot3' in row for row in first_rows(fleet))
    fleet.find_element('name', 'row').send_keys('burger_02')
    assert first_rows(fleet) == ['rocon:/turtlebot3/burger_02/noetic/focal']
    fleet.find_element('name', 'column').send_keys('cafe_rapps')
    assert text_of(fleet, '#count') == '1 of 44 resources, 5 of 16 requests'


def test_the_fleet_is_sorted(fleet: Any) -> None:
    fleet.find_element('css selector', 'select option[value=text]').click()
    assert first_rows(fleet) == sorted(uris(FLEET))[:3]
    heads = fleet.find_elements('css selector', '#grid thead button')
    [serve] = [head for head in heads if head.text == 'cafe_rapps/serve']
    serve.click()
    assert all(rocon_uri.is_compatible(uris(APPS)[1], row) for row in first_rows(fleet))
    assert text_of(fleet, '#grid thead [aria-sort]') == 'cafe_rapps/serve'


def test_the_page_works_by_keyboard(fleet: Any) -> None:
    from selenium.webdriver import ActionChains
    from selenium.webdriver.common.keys import Keys

    def press(*keys: str) -> None:
        for key in keys:
            ActionChains(fleet).send_keys(key).perform()

    fleet.execute_script("document.querySelector('#grid td[tabindex]').focus()")
    press(Keys.ARROW_DOWN, *[Keys.ARROW_RIGHT] * 7, Keys.ENTER)
    why = text_of(fleet, '#why')
    assert 'rocon:/waiterbot/waiter_2/indigo/trusty' in why
    assert 'kobuki_rapps/random_walker' in why
    press(Keys.END, Keys.ENTER)
    assert uris(FLEET)[-1] in text_of(fleet, '#why')
    press(Keys.HOME, Keys.ENTER)
    assert uris(FLEET)[0] in text_of(fleet, '#why')


def test_all_rows_are_printed(fleet: Any) -> None:
    count = "return document.querySelectorAll('#grid tbody th').length"
    assert fleet.execute_script(count) < 44
    fleet.execute_script("window.dispatchEvent(new Event('beforeprint'))")
    assert fleet.execute_script(count) == 44
    fleet.execute_script("window.dispatchEvent(new Event('afterprint'))")
    assert fleet.execute_script(count) < 44


def test_markup_in_a_report_is_text_in_the_browser(
        opened: Callable[[Path], Any], tmp_path: Path) -> None:
    page = opened(hostile_page(tmp_path))
    page.find_element('css selector', '#grid tbody td').click()
    assert HOSTILE in text_of(page, '#why') and page.title == 'What robots can run'


def test_a_dark_page_has_light_text(fleet: Any) -> None:
    shade = 'return getComputedStyle(document.body).%s'
    colours: List[Tuple[str, str]] = []
    for scheme in 'light', 'dark':
        fleet.execute_cdp_cmd('Emulation.setEmulatedMedia', {
            'features': [{'name': 'prefers-color-scheme', 'value': scheme}]})
        colours.append((fleet.execute_script(shade % 'color'),
                        fleet.execute_script(shade % 'backgroundColor')))
    assert colours == [('rgb(34, 34, 34)', 'rgb(255, 255, 255)'),
                       ('rgb(221, 221, 221)', 'rgb(24, 24, 24)')]
