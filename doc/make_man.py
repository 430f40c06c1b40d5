"""
Write the manual page of the command rocon_uri, made from its help.

``python3 doc/make_man.py rocon_uri.1``; catkin makes and installs it.
"""
import argparse
import sys
from importlib import import_module
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'src'))

import rocon_uri        # noqa: E402
from rocon_uri.cli import VERBS     # noqa: E402
from rocon_uri.cli import __doc__ as OVERVIEW       # noqa: E402
from rocon_uri.cli.json_forms import json_forms     # noqa: E402
from rocon_uri.cli.parsers import described, verb_parser        # noqa: E402


def escaped(text):
    """A text as roff takes it, a line that starts with a dot or a quote included."""
    lines = text.replace('\\', '\\e').replace('-', '\\-').split('\n')
    return '\n'.join('\\&' + line if line[:1] in ('.', "'") else line for line in lines)


def paragraphs(text):
    """The lines of a description: indented ones as they are, the others filled."""
    verbatim = False
    for line in text.splitlines():
        if (line[:1] == ' ') != verbatim:
            verbatim = not verbatim
            yield '.nf' if verbatim else '.fi'
        yield escaped(line) if line.strip() else '.PP'
    if verbatim:
        yield '.fi'


def options(parser):
    """Each argument of a verb with what it means."""
    formatter = argparse.HelpFormatter('rocon_uri')
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction) or action.help == argparse.SUPPRESS:
            continue
        value = '' if action.nargs == 0 else ' ' + str(
            action.metavar or ('{%s}' % ','.join(action.choices) if action.choices
                               else action.dest.upper()))
        names = ', '.join(action.option_strings)
        yield '.TP'
        yield '.B ' + escaped((names + value).strip())
        yield escaped(formatter._expand_help(action))


def verb_section(words, doc, parser):
    """What the page says about a verb."""
    yield '.SS ' + escaped('rocon_uri %s' % words)
    yield from paragraphs(described(doc))
    yield from options(parser)


def man_page():
    """The text of the page."""
    first, _, rest = OVERVIEW.strip().partition('\n\n')
    yield '.TH ROCON_URI 1 "" "rocon_uri %s"' % rocon_uri.__version__
    yield '.SH NAME'
    yield 'rocon_uri \\- ' + escaped(first.rstrip('?').lower().replace('uris', 'URIs'))
    yield '.SH SYNOPSIS'
    yield '.B rocon_uri'
    yield '.I VERB\n[\\fIARGUMENT\\fR]...'
    yield '.br\n.B rocon_uri help\n[\\fIVERB\\fR]'
    yield '.SH DESCRIPTION'
    yield from paragraphs(first + '\n\n' + rest)
    yield '.SH VERBS'
    for verb in VERBS:
        parser = verb_parser(verb)
        module = import_module('rocon_uri.cli.' + verb)
        yield from verb_section(verb, module.__doc__, parser)
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                for name, subparser in action.choices.items():
                    yield from verb_section('%s %s' % (verb, name), import_module(
                        '%s.%s' % (module.__name__, name)).__doc__, subparser)
    yield '.SH JSON'
    yield from paragraphs(json_forms(VERBS))
    yield '.SH ENVIRONMENT'
    yield '.TP\n.B ROS_PACKAGE_PATH\nfolders with packages, where \\-\\-package\\-path is left out'
    yield '.TP\n.B ROCON_URI_RULES\nfiles with more values of the vocabulary, separated by colons'
    yield '.TP\n.B NO_COLOR\nif it is not empty, output is never coloured'


if __name__ == '__main__':
    Path(sys.argv[1]).write_text('\n'.join(man_page()) + '\n', encoding='utf-8')
