"""The page of a fleet report: HTML that needs nothing else, with the report as data in it."""
from __future__ import annotations

import json
from html import escape

__all__ = ['page_text']


def page_text(report: object, title: str) -> str:
    """
    The page.

    :param report: plain data, as `rocon_uri.cli.fleet_report` makes it
    :param str title: what the page is called
    :returns: str, HTML

    >>> '<b>' in page_text({'rows': []}, '<b>')
    False
    """
    data = json.dumps(report, separators=(',', ':')).replace('<', '\\u003c')
    return _PAGE.replace('TITLE', escape(title)).replace('DATA', data, 1)


# The rows in sight are in the document only, since a thousand robots and a hundred apps would be a
# hundred thousand cells; all of them are put there to be printed. Texts of the report become text
# nodes, never markup.
_PAGE = '''<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy"
      content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<title>TITLE</title>
<style>
:root { color-scheme: light dark; --back: #fff; --text: #222; --line: #ccc; --head: #f2f2f2;
  --yes: #1b7a1b; --yes-back: #d9f2d9; --no: #777; --odd: #a33; --mark: #06c; }
@media (prefers-color-scheme: dark) { :root { --back: #181818; --text: #ddd; --line: #444;
  --head: #262626; --yes: #8fdc8f; --yes-back: #1d3a1d; --no: #888; --odd: #f99; --mark: #6bf; } }
* { box-sizing: border-box; }
body { margin: 0; height: 100vh; display: flex; flex-direction: column; background: var(--back);
  color: var(--text); font: 14px/1.4 system-ui, sans-serif; }
header, form { padding: 6px 12px; }
h1 { font-size: 18px; margin: 0; }
header p { margin: 0; }
form { display: flex; flex-wrap: wrap; gap: 8px 18px; border-bottom: 1px solid var(--line); }
label { display: flex; flex-direction: column; font-size: 12px; }
input, select { font: inherit; width: 11em; }
main { flex: 1; display: flex; min-height: 0; }
#scroll { flex: 1; overflow: auto; position: relative; }
table { border-collapse: separate; border-spacing: 0; }
#grid tr { height: 24px; }
#grid th, #grid td { border-right: 1px solid var(--line); border-bottom: 1px solid var(--line);
  padding: 0 4px; }
#grid td { text-align: center; width: 24px; min-width: 24px; cursor: pointer;
  font-family: monospace; color: var(--no); }
#grid td.x { color: var(--yes); background: var(--yes-back); font-weight: bold; }
#grid td.q { color: var(--odd); }
#grid td.gap { border: 0; cursor: default; padding: 0; }
#grid th { background: var(--head); text-align: left; font-weight: normal; white-space: nowrap; }
#grid tbody th { position: sticky; left: 0; font-family: monospace; }
#grid thead th { position: sticky; top: 0; z-index: 1; vertical-align: bottom; }
#grid thead th:first-child { left: 0; z-index: 2; }
#grid thead button { writing-mode: vertical-rl; transform: rotate(180deg); border: 0;
  background: none; color: inherit; font: inherit; padding: 4px 0; max-height: 16em;
  overflow: hidden; cursor: pointer; }
#grid thead [aria-sort] button { font-weight: bold; text-decoration: underline; }
td:focus, button:focus, input:focus, select:focus { outline: 2px solid var(--mark);
  outline-offset: -2px; }
aside { width: 30em; max-width: 45%; overflow: auto; padding: 8px 12px;
  border-left: 1px solid var(--line); }
aside h2 { font-size: 15px; margin: 0 0 4px; }
aside h2, aside p, aside li { overflow-wrap: anywhere; }
aside td, aside th { text-align: left; padding: 1px 8px 1px 0; vertical-align: top; }
aside td:nth-child(n+3) { overflow-wrap: break-word; }
.no { color: var(--odd); }
@media screen and (max-width: 700px) { main { flex-direction: column; }
  aside { width: auto; max-width: none; max-height: 45%; border-left: 0;
    border-top: 1px solid var(--line); }
  input, select { width: 8em; } form { gap: 4px 14px; }
  #grid tbody th { max-width: 55vw; overflow: hidden; text-overflow: ellipsis; font-size: 11px; } }
@media print { body, main, #scroll { display: block; height: auto; overflow: visible; }
  form, aside { display: none; } #grid th { position: static !important; } }
</style>
</head>
<body>
<header><h1>TITLE</h1><p id="legend"></p><p id="count" role="status"></p></header>
<form id="filters" onsubmit="return false"></form>
<main>
<div id="scroll"><table id="grid" role="grid"><thead></thead><tbody></tbody></table></div>
<aside id="why" aria-live="polite"><p>Choose a cell, with the mouse, or with Tab, the arrow keys and
Enter, to see why.</p></aside>
</main>
<script type="application/json" id="report">DATA</script>
<script>
'use strict';
(function () {
  var report = JSON.parse(document.getElementById('report').textContent);
  var rows = report.rows, columns = report.columns, outcomes = report.outcomes;
  var cells = report.cells, fields = report.fields;
  var scroll = document.getElementById('scroll'), grid = document.getElementById('grid');
  var head = grid.tHead, body = grid.tBodies[0], why = document.getElementById('why');
  var shown = [], seen = [], inputs = {}, sorted = null, headed = '';
  var at = [0, 0], HEIGHT = 24, printing = false;
  var MARKS = { x: '<td class="x">x</td>', '.': '<td>.</td>', '?': '<td class="q">?</td>' };

  function make(tag, parent, text) {
    var made = document.createElement(tag);
    if (text !== undefined) { made.textContent = text; }
    if (parent) { parent.appendChild(made); }
    return made;
  }
  function makeLines(tag, parent, text) {       // which end before a slash or a bar
    var made = make(tag, parent);
    text.split(/(?=[/|])/).forEach(function (part, i) {
      if (i) { make('wbr', made); }
      made.appendChild(document.createTextNode(part));
    });
  }
  function outcome(r, c) { return outcomes[cells[r][c]]; }
  function input(name, what) {
    var label = make('label', document.getElementById('filters'), what);
    inputs[name] = make('input', label);
    inputs[name].type = 'search';
    inputs[name].name = name;
    inputs[name].addEventListener('input', filter);
  }
  function wanted(name) { return inputs[name].value.trim().toLowerCase(); }

  function filter() {
    var text = wanted('row'), asked = fields.map(function (_, f) { return wanted('field' + f); });
    var app = wanted('column');
    shown = [];
    rows.forEach(function (row, r) {
      if (row.text.toLowerCase().indexOf(text) < 0) { return; }
      for (var f = 0; f < fields.length; f++) {
        if (asked[f] && row.fields[f].toLowerCase().indexOf(asked[f]) < 0) { return; }
      }
      shown.push(r);
    });
    seen = [];
    columns.forEach(function (column, c) {
      if ((column.label + ' ' + column.about).toLowerCase().indexOf(app) >= 0) { seen.push(c); }
    });
    order();
  }
  function order() {
    var how = inputs.sort.value;
    function fitting(r) {
      return seen.reduce(function (sum, c) { return sum + (outcome(r, c).mark === 'x'); }, 0);
    }
    var key = sorted !== null ? function (r) { return 'x?.'.indexOf(outcome(r, sorted).mark); } :
      how === 'text' ? function (r) { return rows[r].text; } :
      how === 'most' ? function (r) { return -fitting(r); } : function (r) { return r; };
    var keys = shown.map(function (r) { return [key(r), r]; });
    keys.sort(function (a, b) { return a[0] < b[0] ? -1 : a[0] > b[0] ? 1 : a[1] - b[1]; });
    shown = keys.map(function (pair) { return pair[1]; });
    document.getElementById('count').textContent = shown.length + ' of ' + rows.length + ' ' +
      report.rows_are + ', ' + seen.length + ' of ' + columns.length + ' ' + report.columns_are;
    at = [0, 0];
    if (JSON.stringify([seen, sorted]) !== headed) { headings(); }
    draw();
  }
  function headings() {
    headed = JSON.stringify([seen, sorted]);
    head.textContent = '';
    var line = make('tr', head);
    make('th', line, report.rows_are);
    seen.forEach(function (c) {
      var cell = make('th', line), button = make('button', cell, columns[c].label);
      button.type = 'button';
      button.title = columns[c].label + '\\n' + columns[c].about + '\\nsort by it';
      if (sorted === c) { cell.setAttribute('aria-sort', 'ascending'); }
      button.addEventListener('click', function () {
        sorted = sorted === c ? null : c;
        filter();
      });
    });
  }
  function gap(height) {
    if (height > 0) {
      var cell = make('td', make('tr', body));
      cell.className = 'gap';
      cell.colSpan = seen.length + 1;
      cell.style.height = height + 'px';
    }
  }
  function draw() {
    var first = printing ? 0 : Math.max(0, Math.floor(scroll.scrollTop / HEIGHT) - 3);
    var last = printing ? shown.length :
      Math.min(shown.length, first + Math.ceil(scroll.clientHeight / HEIGHT) + 6);
    var hadFocus = body.contains(document.activeElement);
    body.textContent = '';
    gap(first * HEIGHT);
    for (var i = first; i < last; i++) {
      var line = make('tr', body), r = shown[i], marks = '';
      for (var j = 0; j < seen.length; j++) { marks += MARKS[outcome(r, seen[j]).mark]; }
      line.innerHTML = '<th scope="row"></th>' + marks;
      line.firstChild.textContent = rows[r].text;
      line.dataset.i = i;
    }
    gap((shown.length - last) * HEIGHT);
    var cell = current();
    if (cell) { cell.tabIndex = 0; }
    if (cell && hadFocus) { cell.focus({ preventScroll: true }); }
  }
  function current() {
    var line = body.querySelector('[data-i="' + at[0] + '"]');
    return line && line.cells[at[1] + 1];
  }
  function go(i, j) {
    at = [Math.max(0, Math.min(shown.length - 1, i)), Math.max(0, Math.min(seen.length - 1, j))];
    var top = at[0] * HEIGHT;
    if (top < scroll.scrollTop || top > scroll.scrollTop + scroll.clientHeight - 12 * HEIGHT) {
      scroll.scrollTop = Math.max(0, top - 3 * HEIGHT);
    }
    draw();
    var cell = current();
    if (cell) { cell.focus(); }
  }
  function explain(r, c) {
    var row = rows[r], column = columns[c], result = outcome(r, c);
    why.textContent = '';
    makeLines('h2', why, row.text);
    makeLines('h2', why, column.label);
    if (column.about) { makeLines('p', why, column.about); }
    make('p', why, result.mark + '  ' + report.meanings[result.mark]);
    if (result.fields) {
      var table = make('table', why), line = make('tr', table);
      ['', 'field', report.columns_have, report.rows_have].forEach(function (text) {
        make('th', line, text);
      });
      fields.forEach(function (field, f) {
        var fits = result.fields[f];
        line = make('tr', table);
        if (fits !== 'x') { line.className = 'no'; }
        [fits, field, column.fields[f], row.fields[f]].forEach(function (text) {
          makeLines('td', line, text);
        });
      });
    }
    var list = make('ul', why);
    result.reasons.forEach(function (reason) { make('li', list, reason); });
  }

  document.getElementById('legend').textContent = report.legend;
  input('row', report.rows_are);
  fields.forEach(function (field, f) { input('field' + f, field); });
  input('column', report.columns_are);
  var label = make('label', document.getElementById('filters'), 'order');
  inputs.sort = make('select', label);
  [['given', 'as given'], ['text', 'by name'], ['most', 'most ' + report.columns_are + ' first']]
    .forEach(function (pair) { make('option', inputs.sort, pair[1]).value = pair[0]; });
  inputs.sort.addEventListener('change', function () { sorted = null; filter(); });
  scroll.addEventListener('scroll', function () { if (!printing) { draw(); } });
  window.addEventListener('resize', draw);
  window.addEventListener('beforeprint', function () { printing = true; draw(); });
  window.addEventListener('afterprint', function () { printing = false; draw(); });
  body.addEventListener('click', function (event) {
    var cell = event.target, line = cell.parentNode;
    if (cell.tagName === 'TD' && line.dataset.i !== undefined) {
      if (current()) { current().removeAttribute('tabindex'); }
      at = [+line.dataset.i, cell.cellIndex - 1];
      explain(shown[at[0]], seen[at[1]]);
      cell.tabIndex = 0;
      cell.focus();
    }
  });
  body.addEventListener('keydown', function (event) {
    var page = Math.max(1, Math.floor(scroll.clientHeight / HEIGHT) - 12);
    var move = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1],
      PageUp: [-page, 0], PageDown: [page, 0], Home: [-rows.length, 0], End: [rows.length, 0] };
    if (event.key in move) {
      event.preventDefault();
      go(at[0] + move[event.key][0], at[1] + move[event.key][1]);
    } else if (event.key === 'Enter' || event.key === ' ') {
      event.preventDefault();
      explain(shown[at[0]], seen[at[1]]);
    }
  });
  filter();
}());
</script>
</body>
</html>
'''
