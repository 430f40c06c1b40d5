"""The parsers of arguments: one a verb, with help as wide as the terminal and near misses."""
from __future__ import annotations

import argparse
from functools import partial
from importlib import import_module

from rocon_uri.cli.display import columns

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Callable, Iterable, List, Optional, Sequence, Tuple

__all__ = ['Parser', 'described', 'overview', 'summary', 'verb_parser', 'whole_parser']

_WIDEST = 100       # columns of help; longer lines are hard to read
_JSON = '\nJSON: '  # what a docstring says after it is for ``rocon_uri help json``


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """
    Help as wide as the terminal, 80 columns where there is none, and at most 100.

    Paragraphs of a description are filled; lines that are indented stay as they are.
    """

    def __init__(self, prog: str) -> None:
        # argparse imports a lot to find out the width
        super().__init__(prog, width=min(columns(), _WIDEST))

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        import textwrap
        fill = partial(textwrap.fill, width=width, break_long_words=False, break_on_hyphens=False)
        lines: List[str] = []
        paragraph: List[str] = []
        for line in [*text.splitlines(), '']:
            is_kept = not line or line[0].isspace()
            if paragraph and (is_kept or line.startswith('Exit status')):
                lines.append(fill(' '.join(paragraph)))
                paragraph = []
            if is_kept:
                lines.append(line)
            else:
                paragraph.append(line)
        return '\n'.join(lines[:-1])


class Parser(argparse.ArgumentParser):
    """A parser whose errors say what was probably meant by an option or a verb."""

    def __init__(self, prog: Optional[str] = None, **settings: Any) -> None:
        super().__init__(prog, formatter_class=HelpFormatter, allow_abbrev=False, **settings)

    def parse_known_args(       # type: ignore[override]
            self, args: Optional[Sequence[str]] = None,
            namespace: Optional[argparse.Namespace] = None
            ) -> Tuple[argparse.Namespace, List[str]]:
        """
        As argparse does, but options may stand between arguments, as in ``parse URI -q URI``.

        An unknown option is the first error, with the near misses.
        """
        for argument in args or ():
            option = argument.partition('=')[0]
            if argument == '--' or self._subparsers is not None and option[:1] != '-':
                break       # the rest may be options of a verb
            if (option.startswith('--') and ' ' not in option
                    and option not in self._option_string_actions):
                from rocon_uri.sources.wording import did_you_mean, near_misses
                self.error('%s is not an option%s' % (option, did_you_mean(
                    near_misses(option, self._option_string_actions))))
        return super().parse_known_args(
            args if args is None or self._subparsers else self._options_first(args), namespace)

    def _options_first(self, args: Sequence[str]) -> Sequence[str]:
        """The arguments in an order in which argparse takes all that are not options together."""
        options: List[str] = []
        others: List[str] = []
        rest = iter(args)
        for argument in rest:
            if argument == '--':
                others += [argument, *rest]
            elif self._parse_optional(argument) is None:
                others.append(argument)
            else:
                options.append(argument)
                action = self._option_string_actions.get(argument)
                if action is not None and action.nargs is None:     # its value is the next one
                    value = next(rest, None)
                    if value is None:
                        return args         # argparse says that it is missing
                    options.append(value)
        return options + others

    def _check_value(self, action: argparse.Action, value: object) -> None:
        if action.choices is not None and value not in action.choices:
            choices = list(map(str, action.choices))
            from rocon_uri.sources.wording import did_you_mean, near_misses, quoted
            raise argparse.ArgumentError(action, '%s is none of %s%s' % (
                quoted(str(value)), ', '.join(choices),
                did_you_mean(near_misses(str(value), choices))))


def whole_parser(doc: Optional[str], verbs: Iterable[str]) -> Parser:
    """
    The parser of the command: its help, and what completion walks.

    :param doc: what is said about it all
    :param verbs: iterable of str, the names of the verbs
    """
    description, _, details = (doc or '').strip().partition('\n\n')
    parser = Parser('rocon_uri', description=description, epilog=details)
    from rocon_uri.version import __version__
    parser.add_argument('--version', action='version', version='rocon_uri ' + __version__)
    _add_json(parser)
    subparsers = parser.add_subparsers(metavar='VERB', title='verbs', prog='rocon_uri',
                                       description='rocon_uri help VERB says more about each')
    for name in verbs:
        verb_parser(name, partial(subparsers.add_parser, name, help=summary(name)))
    return parser


def verb_parser(name: str, make: Optional[Callable[..., Parser]] = None) -> Parser:
    """The parser of a verb, which ``make`` makes where it is one of several."""
    verb = import_module('rocon_uri.cli.' + name)
    parser = (make or partial(Parser, 'rocon_uri ' + name))(description=described(verb.__doc__))
    verb.add_arguments(parser)
    _add_json(parser)
    parser.set_defaults(main=verb.main)
    return parser


def _add_json(parser: Parser) -> None:
    parser.add_argument('--json', action='store_true',
                        help='print one JSON object; rocon_uri help json says what is in it')


def described(doc: Optional[str]) -> str:
    """What the docstring of a verb says for its help: all but the form of its JSON."""
    return (doc or '').partition(_JSON)[0].strip()


def json_form(doc: Optional[str]) -> str:
    """What the docstring of a verb says about the form of its JSON."""
    return (doc or '').partition(_JSON)[2].strip()


def summary(name: str) -> str:
    """What a verb does, in one line."""
    return described(import_module('rocon_uri.cli.' + name).__doc__).partition('\n')[0].rstrip('.')


def overview(verbs: Iterable[str], verb: str = '') -> str:
    """
    A line for each verb, or each verb of a verb, and one that says how to learn more.

    >>> print(overview(['list', 'show'], 'specs'))
    usage: rocon_uri specs VERB ...    (rocon_uri help specs VERB says more)
      list          List capability interfaces, semantic interfaces and providers
      show          Show a capability spec and what it takes to run it
    """
    command = verb + ' VERB' if verb else 'VERB'
    lines = ['usage: rocon_uri %s ...    (rocon_uri help %s says more)' % (command, command)]
    lines += ['  %-14s%s' % (name, summary('%s.%s' % (verb, name) if verb else name))
              for name in verbs]
    return '\n'.join(lines)
