"""Findings in the Static Analysis Results Interchange Format (SARIF) 2.1.0 of OASIS."""
from __future__ import annotations

import os
from typing import Dict, List, Sequence
from urllib.parse import quote

from rocon_uri.lint.explanations import EXPLANATIONS
from rocon_uri.lint.finding import Finding

__all__ = ['sarif_log']

_ROOT = '%SRCROOT%'     # as producers and readers of SARIF call the folder of the sources


def sarif_log(findings: Sequence[Finding]) -> Dict[str, object]:
    """
    A log of one run, which explains the findings that occur in it.

    Files below the working directory have URIs relative to ``%SRCROOT%``. Columns are counted in
    code points.

    :param findings: sequence of `Finding`
    :returns: dict, plain data to write as JSON

    >>> sarif_log([Finding('a.rapp', 3, 9, 'error', 'no', 'cycle')])['version']
    '2.1.0'
    """
    ids = list(dict.fromkeys(finding.id for finding in findings))
    return {
        '$schema': 'https://json.schemastore.org/sarif-2.1.0.json',
        'version': '2.1.0',
        'runs': [{
            'tool': {'driver': {'name': 'rocon_uri', 'rules': [_rule(id_) for id_ in ids]}},
            'columnKind': 'unicodeCodePoints',
            'originalUriBaseIds': {
                _ROOT: {'description': {'text': 'The working directory of the check.'}}},
            'results': [_result(finding, ids) for finding in findings]}]}


def _rule(fault_id: str) -> Dict[str, object]:
    explanation = EXPLANATIONS[fault_id]
    return {'id': fault_id,
            'shortDescription': {'text': explanation.what},
            'fullDescription': {'text': explanation.why},
            'help': {'text': explanation.mend}}


def _result(finding: Finding, ids: List[str]) -> Dict[str, object]:
    location: Dict[str, object] = {'artifactLocation': _artifact(finding.file_name)}
    if finding.line is not None:
        location['region'] = {'startLine': finding.line, 'startColumn': finding.column or 1}
    return {'ruleId': finding.id, 'ruleIndex': ids.index(finding.id), 'level': finding.severity,
            'message': {'text': finding.problem},
            'locations': [{'physicalLocation': location}]}


def _artifact(path: str) -> Dict[str, str]:
    uri = quote(os.fsencode(path))
    return {'uri': 'file://' + uri} if os.path.isabs(path) else {'uri': uri, 'uriBaseId': _ROOT}
