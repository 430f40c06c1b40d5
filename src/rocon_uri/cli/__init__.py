# PYTHON_ARGCOMPLETE_OK
"""
Read, check and compare rocon URIs: which app can run on which robot?

Examples:
  rocon_uri parse 'rocon:/turtlebot2|pr2/bob'
  rocon_uri check 'rocon:/kobuki/*/ros' rocon:/kobuki/bob/noetic/focal
  rocon_uri match --matrix --requests-in apps.txt --in fleet.txt
  rocon_uri help match

Exit status of every VERB:
  0  done, or the answer is yes
  1  the answer is no
  2  something given was bad, whatever else was answered
"""
from __future__ import annotations

import io
import os
import re
import sys
from importlib import import_module

from rocon_uri.cli.parsers import overview, verb_parser, whole_parser

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Iterable, List, Optional, Sequence

__all__ = ['main']

#: Each is a module of this package whose docstring is its help. Its ``add_arguments(parser)`` adds
#: what it takes; its ``main(args)`` does it and returns the exit status.
VERBS = ('parse', 'check', 'match', 'fields', 'rules', 'platform', 'apps', 'specs',
         'capabilities')

_HELP = ('help', '--help', '-h')

#: What verbs need beside Python: module, package of apt and of PyPI.
_INSTALLED_BY = {'catkin_pkg': ('python3-catkin-pkg', 'catkin_pkg'),
                 'sqlalchemy': ('python3-sqlalchemy', 'SQLAlchemy'),
                 'yaml': ('python3-yaml', 'PyYAML')}


def main(argv: Optional[Sequence[str]] = None) -> int:
    """
    What the command does.

    :param argv: sequence of str, its arguments; those of the process where left out
    :returns: int, the exit status; 130 if it was interrupted
    """
    _prepare_streams()
    status = 0
    try:
        try:
            status = _run(_without_remappings(sys.argv[1:] if argv is None else argv))
        except SystemExit as stopped:       # by argparse, which has said why
            status = int(stopped.code or 0)
        sys.stdout.flush()
    except KeyboardInterrupt:
        _discard_output()
        return 130
    except BrokenPipeError:     # whoever reads the output has enough of it
        _discard_output()
    except OSError as error:    # a full disk, say
        import contextlib       # here, since nothing else needs it
        with contextlib.suppress(OSError):      # stderr may be on it, too
            print('rocon_uri: %s' % _failure(error), file=sys.stderr)
        _discard_output()
        return 2
    return status


def _failure(error: OSError) -> str:
    """What failed: an error of what is printed names no file, nor does that of os.getcwd()."""
    if error.filename is not None:
        from rocon_uri.sources.wording import quoted_path
        return 'cannot read %s: %s' % (quoted_path(os.fsdecode(error.filename)), error.strerror)
    if isinstance(error, FileNotFoundError):
        return 'the working directory does not exist'
    return 'cannot write: %s' % (error.strerror or error)


def _prepare_streams() -> None:
    """Python has None for a stream that is closed, and prints to the other one instead."""
    for name in ('stdout', 'stderr'):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, 'w'))       # noqa: SIM115, open until the end
    # Python 3.8 buffers all of stderr if it is not a terminal: errors would come after the output,
    # and be lost where it cannot be written.
    if isinstance(sys.stderr, io.TextIOWrapper):
        sys.stderr.reconfigure(line_buffering=True)


def _discard_output() -> None:
    """Leave nothing for the interpreter to write when it ends, which it would complain about."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream, own in (sys.stdout, sys.__stdout__), (sys.stderr, sys.__stderr__):
        if own is not None and stream is own:       # another one is the caller's
            os.dup2(nowhere, own.fileno())


def _without_remappings(argv: Iterable[str]) -> List[str]:
    """The arguments without those that roslaunch adds, as rospy.myargv leaves them."""
    return [argument for argument in argv
            if ':=' not in argument or not re.fullmatch(r'[~/_A-Za-z][\w/]*:=.*', argument)]


def _run(argv: List[str]) -> int:
    if '_ARGCOMPLETE' in os.environ:
        _complete(whole_parser(__doc__, VERBS))
    shared = []
    while argv[:1] == ['--json']:   # it can also stand before the verb
        shared = [argv.pop(0)]
    if argv and argv[0] in _HELP:
        return _help([name for name in argv if name not in _HELP])
    if argv and argv[0] in VERBS:
        # The common case, without importing the other verbs and telling argparse of them.
        args = verb_parser(argv[0]).parse_args(shared + argv[1:])
        return _do(args, argv[0])
    if argv and argv[0].startswith('-'):
        whole_parser(__doc__, VERBS).parse_args(argv)       # shows the version or what is wrong
    if argv:
        from rocon_uri.sources.wording import did_you_mean, near_misses, quoted
        print('rocon_uri: %s is not a verb%s; rocon_uri help lists them' % (
            quoted(argv[0]), did_you_mean(near_misses(argv[0], (*VERBS, 'help')))),
            file=sys.stderr)
    else:
        print(overview(VERBS), file=sys.stderr)
    return 2


def _help(names: List[str]) -> int:
    """Show the help of a verb, that of a verb's own verb, the forms of JSON, or that of it all."""
    if not names:
        whole_parser(__doc__, VERBS).print_help()
        return 0
    if names[0] in ('json', '--json'):
        from rocon_uri.cli.json_forms import json_forms
        print(json_forms(VERBS))
        return 0
    return _run([*names, '--help'])


def _do(args: argparse.Namespace, verb: str) -> int:
    """What a verb does; a Python module that it needs and that is not installed is one line."""
    try:
        status: int = args.main(args)
        return status
    except ModuleNotFoundError as error:
        module = (error.name or '').partition('.')[0]
        if module in ('', 'rocon_uri', 'capabilities'):
            raise
    from rocon_uri.cli.display import print_json
    from rocon_uri.cli.given import Report, say
    report = Report(args.json)
    message = '%s needs the Python module %s, which %s does not have' % (
        verb, module, sys.executable)
    if module in _INSTALLED_BY:
        message += ': install it with apt-get install %s, or pip install %s' % _INSTALLED_BY[module]
    say('rocon_uri: ' + message)
    report.note(message, None)
    if args.json:
        print_json({'errors': report.errors})
    return report.status


def _complete(parser: argparse.ArgumentParser) -> None:
    """Tell the shell, which asks, what could follow, and end there."""
    try:    # it is not everywhere, and takes longer to import than all the rest
        argcomplete = import_module('argcomplete')
    except ImportError:
        if 'COMP_LINE' in os.environ:   # who presses Tab does not want the command to be done
            raise SystemExit(1) from None
        return
    argcomplete.autocomplete(parser)
