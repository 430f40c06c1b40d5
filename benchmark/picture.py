"""
Draws figures that the benchmark wrote: times beside those of others, and growth.

    python3 benchmark --json doc/performance.json peers growth
    python3 benchmark/picture.py doc/performance.json doc/pictures/performance.svg

All times are on one logarithmic axis, where equal steps are equal factors.
"""
import html
import json
import math
import sys

from measure import with_unit

__all__ = ['machine_of', 'picture']

WIDTH, LEFT, RIGHT, ROW = 1120, 560, 150, 24
LOW, HIGH = -7, 1       # powers of ten of a second
STYLE = '''
text { font: 14px "DejaVu Sans", Verdana, sans-serif; fill: #1f2328 }
.page { fill: #ffffff } .head { font-weight: bold } .faint { fill: #59636e }
.axis { stroke: #d1d9e0 } .end { text-anchor: end } .unit { text-anchor: middle; font-size: 12px }
.ours { fill: #0969da } .theirs { fill: #bc4c00 } .line { stroke: #8c959f; stroke-width: 2 }
@media (prefers-color-scheme: dark) {
text { fill: #e6edf3 } .page { fill: #0d1117 } .faint { fill: #9198a1 } .axis { stroke: #30363d }
.ours { fill: #4493f8 } .theirs { fill: #f0883e } .line { stroke: #656c76 } }
'''


def picture(found):
    """
    The picture of what the benchmark found.

    :param dict found: as ``--json`` writes it
    :returns: str, SVG that is readable on a light and on a dark page
    """
    peers = [figure for figure in found['figures'] if figure['part'] == 'peers']
    growths = [figure for figure in found['figures'] if 'times' in figure]
    parts, y = [], 30
    y = section(parts, y, 'Beside other libraries',
                [('ours', 'rocon_uri'), ('theirs', 'the other')], 'times as fast')
    for figure in peers:
        row(parts, y, '%s / %s' % (figure['name'], figure['reference']), [
            ('ours', figure['seconds']), ('theirs', figure['reference_seconds'])],
            '%.1f' % (1 / figure['ratio']))
        y += ROW
    y = section(parts, y + 20, 'Growth: n, 10 n, 100 n', [], 'exponent')
    for figure in growths:
        row(parts, y, '%s, n = %s' % (figure['name'], format(figure['sizes'][0], ',')), [
            ('ours', seconds) for seconds in figure['times']], '%.2f' % figure['ratio'])
        y += ROW
    text(parts, 12, y + 16, machine_of(found), 'faint')
    height = y + 34
    axis = ['<path class="axis" d="M%.1f 50V%d"/>' % (position(10.0 ** power), y - 8)
            for power in range(LOW, HIGH + 1)]
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" '
            'height="{1}" role="img" aria-label="Times of rocon_uri">\n<style>{2}</style>\n'
            '<rect class="page" width="{0}" height="{1}"/>\n{3}\n</svg>\n').format(
                WIDTH, height, STYLE, '\n'.join(axis + parts))


def machine_of(found):
    """Where and when it was measured, as a line."""
    return '%s, %d processors, %s, Python %s, %s' % (
        found['processor'], found['processors'], found['machine'], found['python'], found['date'])


def section(parts, y, title, legend, last):
    """Write a title, what the colours are, and the axis; return where the first row is."""
    text(parts, 12, y, title, 'head')
    for number, (style, name) in enumerate(legend):
        x = 200 + 90 * number
        parts.append('<circle class="%s" cx="%d" cy="%d" r="5"/>' % (style, x, y - 5))
        text(parts, x + 9, y, name, 'faint')
    for power in range(LOW, HIGH + 1):
        text(parts, position(10.0 ** power), y, with_unit(10.0 ** power), 'faint unit')
    text(parts, WIDTH - 12, y, last, 'faint end')
    return y + ROW


def row(parts, y, name, times, last):
    """Write what was measured, a dot for each time, and a figure."""
    text(parts, 12, y, name)
    places = [position(seconds) for _, seconds in times]
    parts.append('<path class="line" d="M%.1f %dH%.1f"/>' % (min(places), y - 5, max(places)))
    for (style, seconds), x in zip(times, places):
        parts.append('<circle class="%s" cx="%.1f" cy="%d" r="5"><title>%s</title></circle>' % (
            style, x, y - 5, with_unit(seconds)))
    text(parts, WIDTH - 12, y, last, 'end')


def position(seconds):
    """Where a time is on the axis."""
    return LEFT + (math.log10(seconds) - LOW) / (HIGH - LOW) * (WIDTH - LEFT - RIGHT)


def text(parts, x, y, shown, style=''):
    """Write a text."""
    parts.append('<text x="%.1f" y="%d"%s>%s</text>' % (
        x, y, ' class="%s"' % style if style else '', html.escape(shown)))


def main():
    """Write the picture."""
    source, target = sys.argv[1:]
    with open(source, encoding='utf-8') as file:
        found = json.load(file)
    with open(target, 'w', encoding='utf-8') as file:
        file.write(picture(found))


if __name__ == '__main__':
    main()
