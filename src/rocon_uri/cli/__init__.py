# PYTHON_ARGCOMPLETE_OK
"""
Read, check and compare rocon URIs: which app can run on which robot?

Examples:
  rocon_uri parse 'rocon:/turtlebot2|pr2/bob'
  rocon_uri check 'rocon:/kobuki/*/ros' rocon:/kobuki/bob/noetic/focal
  rocon_uri match --matrix --requests-in apps.txt --in fleet.txt

Exit status of every VERB:
  0  done, or the answer is yes
  1  the answer is no
  2  something given was bad, whatever else was answered

With --json a VERB prints one object. It always has "errors", a list of ERROR.
  ERROR  {"message", "uri", "field", "value", "span": [START, END],
         "suggestions": [TEXT, ...], "file", "line"}
         what is wrong, in which URI, where in it, and what was probably meant;
         null where that does not apply
  URI    {"text", "file", "line", "uri", "short", "fields": {"concert_name",
         "hardware_platform": [TEXT, ...], "name", "application_framework":
         [TEXT, ...], "operating_system": [TEXT, ...], "rocon_app"},
         "read_with_one_slash": BOOL}
         the text as it was given, the file and the line it stands on (null for
         an argument), the canonical text, the short one, the fields as in the
         message rocon_uri/RoconURI, and whether // was read as /
"""
from __future__ import annotations

import argparse
import io
import os
import re
import sys
from functools import partial
from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Iterable, List, Optional, Sequence

__all__ = ['main']

#: Each is a module of this package whose docstring is its help. Its ``add_arguments(parser)`` adds
#: what it takes; its ``main(args)`` does it and returns the exit status.
VERBS = ('parse', 'check', 'match', 'fields', 'rules', 'platform', 'apps', 'specs',
         'capabilities')


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
    if argv and argv[0] in VERBS and '_ARGCOMPLETE' not in os.environ:
        # The common case, without importing the other verbs and telling argparse of them.
        parser = _verb_parser(argv[0], partial(argparse.ArgumentParser, 'rocon_uri ' + argv[0]))
        args = parser.parse_args(argv[1:])
    else:
        parser = _whole_parser()
        _complete(parser)
        args = parser.parse_args(argv)
        if args.main is None:
            parser.print_help(sys.stderr)
            return 2
    status: int = args.main(args)
    return status


def _whole_parser() -> argparse.ArgumentParser:
    description, _, details = (__doc__ or '').strip().partition('\n\n')
    parser = argparse.ArgumentParser('rocon_uri', description=description, epilog=details,
                                     allow_abbrev=False, formatter_class=_formatter)
    parser.set_defaults(main=None)
    subparsers = parser.add_subparsers(metavar='VERB', title='verbs', prog='rocon_uri',
                                       description='rocon_uri VERB --help says more about each')
    for name in VERBS:
        summary = _description(name).partition('\n')[0].rstrip('.')
        _verb_parser(name, partial(subparsers.add_parser, name, help=summary))
    return parser


def _verb_parser(name: str, make: Callable[..., argparse.ArgumentParser]
                 ) -> argparse.ArgumentParser:
    verb = import_module('rocon_uri.cli.' + name)
    parser = make(description=_description(name), allow_abbrev=False, formatter_class=_formatter)
    verb.add_arguments(parser)
    parser.add_argument('--json', action='store_true',
                        help='print one JSON object; rocon_uri --help says what is in it')
    parser.set_defaults(main=verb.main)
    return parser


def _description(name: str) -> str:
    return (import_module('rocon_uri.cli.' + name).__doc__ or '').strip()


def _formatter(prog: str) -> argparse.HelpFormatter:
    """With a width of its own, since argparse imports a lot to find out that of the terminal."""
    return argparse.RawDescriptionHelpFormatter(prog, width=80)


def _complete(parser: argparse.ArgumentParser) -> None:
    """Answer the shell, if it is the shell that asks what could follow, and end there."""
    if '_ARGCOMPLETE' in os.environ:
        try:    # it is not everywhere, and takes longer to import than all the rest
            argcomplete = import_module('argcomplete')
        except ImportError:
            return
        argcomplete.autocomplete(parser)
