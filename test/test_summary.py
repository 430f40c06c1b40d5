"""The summary at the end of test/run says what happened."""
from __future__ import annotations

import summary

REPORT = '''<testsuites><testsuite name="pytest">
<testcase classname="test.a" name="one" /><testcase classname="test.a" name="two" />
<testcase classname="test.b" name="three"><skipped message="there is no ROS" /></testcase>
%s</testsuite></testsuites>'''
FAILURE = '<testcase classname="test.b" name="four"><failure message="no">no</failure></testcase>'
ERROR = '<testcase classname="test.b" name="five"><error message="no">no</error></testcase>'


def summarised(tmp_path, monkeypatch, capsys, lines, more='', versions=(), ci=''):
    """The exit status of test/run and the lines of the summary, for these steps and one report."""
    monkeypatch.setenv('CI', ci)
    (tmp_path / 'pytest.xml').write_text(REPORT % more)
    steps = tmp_path / 'steps.txt'
    steps.write_text(''.join('\t'.join(line) + '\n' for line in lines))
    status = summary.main(str(steps), *versions)
    return status, capsys.readouterr().out.splitlines()


def test_what_passed_and_what_was_skipped_and_why(tmp_path, monkeypatch, capsys):
    status, lines = summarised(tmp_path, monkeypatch, capsys, [
        ('build', '', '0', '75'), ('devel space', str(tmp_path / '*.xml'), '0', '9')])
    assert status == 0
    assert [' '.join(line.split()) for line in lines[1:4]] == [
        'build done, 1:15', 'devel space 2 passed, 0 failed, 1 skipped, 0:09',
        'skipped 1: there is no ROS']
    assert lines[-2:] == ['2 passed, 0 failed, 1 skipped', 'PASSED']


def test_the_last_line_says_what_failed(tmp_path, monkeypatch, capsys):
    # a test that failed, a test that could not start, and a step that ended badly without a report
    for more, name in (FAILURE, 'test.b.four'), (ERROR, 'test.b.five'):
        status, lines = summarised(tmp_path, monkeypatch, capsys, [
            ('devel space', str(tmp_path / '*.xml'), '0', '9')], more)
        assert status == 1 and lines[-1] == 'FAILED: devel space'
        assert '    failed: ' + name in lines and '2 passed, 1 failed, 1 skipped' in lines
    status, lines = summarised(tmp_path, monkeypatch, capsys, [
        ('build', '', '1', '2'), ('wheel', str(tmp_path / 'none.xml'), '2', '1')])
    assert status == 1 and lines[-1] == 'FAILED: build; wheel'


def test_a_report_that_breaks_off_has_failed(tmp_path, monkeypatch, capsys):
    (tmp_path / 'half.xml').write_text('<testsuites>')
    status, lines = summarised(tmp_path, monkeypatch, capsys, [
        ('devel space', str(tmp_path / 'half.xml'), '0', '9')])
    assert status == 1 and lines[-1] == 'FAILED: devel space'


def test_what_was_left_out_fails_in_ci_only(tmp_path, monkeypatch, capsys):
    steps = [('wheel, Python 3.8.18', 'none.xml', '75', '3')]
    status, lines = summarised(tmp_path, monkeypatch, capsys, steps)
    assert status == 0 and 'left out, PyPI cannot be reached' in lines[1]
    status, lines = summarised(tmp_path, monkeypatch, capsys, steps, ci='1')
    assert status == 1 and lines[-1] == 'FAILED: wheel, Python 3.8.18'


def test_pythons_that_were_not_found_are_named(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(summary, 'PYTHONS', ['3.1', '3.2', '3.3'])
    _, lines = summarised(tmp_path, monkeypatch, capsys, [], versions=['3.2'])
    assert 'not found: Python 3.1, 3.3' in lines
