"""
Say whether two URIs are compatible, and why.

Example:
  rocon_uri check 'rocon:/robot/arm_*/ros' 'rocon:/ur5e/.*_left/noetic/focal'

They are compatible if a resource can match both. Prints the answer; the relation
of the resources that A matches to those that B matches, which is equal, subset,
superset, overlap or disjoint; and what each field has in common, with an example
for two name patterns. There is no relation if one URI has unregistered values and
the other is rocon:/, which is compatible with everything.

Exit status: 0 if they are compatible, 1 if they are not, 2 if one is not legal or
their name patterns are too complex to compare.
JSON: {"uris": [URI of A, URI of B], "compatible": BOOL, "relation": TEXT,
"example": NAME, "fields": [{"field", "a", "b", "compatible": BOOL, "in_common"},
...], "errors": [ERROR, ...]}; null for what is not known, and for the example
where no name is in both
"""
from __future__ import annotations

from rocon_uri.cli.completion import offer, uris
from rocon_uri.cli.display import fields_as_json, painter, print_json
from rocon_uri.cli.given import GivenURI, Report, say
from rocon_uri.cli.notes import Notes
from rocon_uri.compatibility import Relation, explain, is_compatible, relation
from rocon_uri.exceptions import PatternTooComplex, RoconURIValueError, UnregisteredValue
from rocon_uri.uri import parse
from rocon_uri.vocabulary import Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import List, Optional
    from rocon_uri.compatibility import Explanation

__all__ = ['add_arguments', 'main']

_MEANINGS = {
    Relation.EQUAL: 'both match the same resources',
    Relation.SUBSET: 'the second matches all that the first matches, and more',
    Relation.SUPERSET: 'the first matches all that the second matches, and more',
    Relation.OVERLAP: 'they have resources in common, and each has others too',
    Relation.DISJOINT: 'they have no resource in common',
}


class Answer:
    """
    What there is to say about two URIs, given as texts; None for what could not be found out.

    :param Report report: gets what is bad
    """

    def __init__(self, a: str, b: str, report: Report) -> None:
        self.uris: List[GivenURI] = []
        self.compatible: Optional[bool] = None
        self.explanation: Optional[Explanation] = None
        self.relation: Optional[Relation] = None
        self.example: Optional[str] = None
        try:
            self.uris = [_read_any(a), _read_any(b)]
            self.compatible = is_compatible(a, b)
            self.explanation = explain(a, b)
            names = self.explanation.a.name.pattern, self.explanation.b.name.pattern
            self.example = names[0].example(names[1])
            self.relation = relation(a, b)
        except PatternTooComplex as error:
            report.bad_uri(error)
        except RoconURIValueError as error:
            if self.compatible is None:
                self.uris = [given for given in map(report.read, (a, b)) if given]
            else:       # compatible since one of them is so with anything
                say('rocon_uri: note: %s' % error)


def _read_any(text: str) -> GivenURI:
    """A URI that may be unregistered, which is for `is_compatible` to judge."""
    try:
        return GivenURI(parse(text), text)
    except UnregisteredValue:
        return GivenURI(parse(text, Vocabulary.open()), text)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    offer(uris, parser.add_argument('a', metavar='A', help='a URI, as what an app runs on'),
          parser.add_argument('b', metavar='B', help='another one, as a robot'))


def main(args: argparse.Namespace) -> int:
    report = Report(args.json)
    answer = Answer(args.a, args.b, report)
    if args.json:
        _print_json(answer, report)
    else:
        _show(answer)
    notes = Notes()
    for given in answer.uris:
        notes.mention(given)
    notes.say_others()
    return report.status or (0 if answer.compatible else 1)


def _show(answer: Answer) -> None:
    paint = painter()
    if answer.compatible is not None:
        print(paint('compatible', 'green') if answer.compatible else paint('not compatible', 'red'))
    if answer.relation is not None:
        print('relation: %s (%s)' % (paint(answer.relation.value, 'bold'),
                                     _MEANINGS[answer.relation]))
    if answer.explanation is not None:
        for line in str(answer.explanation).splitlines()[1:]:   # without the verdict
            print(paint(line, 'red') if line.startswith('. ') else line)


def _print_json(answer: Answer, report: Report) -> None:
    print_json({
        'uris': [given.as_json() for given in answer.uris],
        'compatible': answer.compatible,
        'relation': answer.relation and answer.relation.value,
        'example': answer.example,
        # an explanation is false where they are not compatible
        'fields': [] if answer.explanation is None else fields_as_json(answer.explanation),
        'errors': report.errors,
    })
