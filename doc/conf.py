"""How Sphinx builds the documentation: ``sphinx-build -W doc build/doc``."""
import inspect
import os
import re
import sys
import xml.etree.ElementTree

from docutils.nodes import reference as _reference
from sphinx import version_info as _sphinx_version
from sphinx.util import logging as _logging

_here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(_here, '..', 'src'))

_log = _logging.getLogger(__name__)

project = 'rocon_uri'
author = 'the rocon_uri authors'
copyright = author      # noqa: A001     # Sphinx wants it by this name
version = release = xml.etree.ElementTree.parse(
    os.path.join(_here, '..', 'package.xml')).findtext('version')

extensions = ['sphinx.ext.autodoc']
autodoc_member_order = 'bysource'
autodoc_default_options = {'members': None}
master_doc = 'index'     # Ubuntu 20.04's Sphinx looks for another
default_role = 'py:obj'
smartquotes = False     # '' is an empty text
nitpicky = _sphinx_version >= (5, 3)      # Debian 12; older ones do not find all types
nitpick_ignore = [      # others' types, and variables that stand for a type
    ('py:class', 'os.PathLike'), ('py:class', 'CatkinPackage'), ('py:class', 'Engine'),
    ('py:class', 'ColumnElement'), ('py:class', 'Message'), ('py:obj', 'sqlalchemy.engine.Engine'),
    ('py:obj', 'sqlalchemy.sql.ColumnElement'), ('py:obj', 'sqlalchemy.pool.StaticPool'),
    ('py:class', 'capabilities.specs._reading.Spec'),
    ('py:class', 'rocon_uri.sources.located.ErrorT')]
exclude_patterns = ['_build']
highlight_language = 'none'     # most blocks are output or URIs; others say what they are
html_theme = 'alabaster'
html_theme_options = {      # wide enough for 100 columns of code
    'body_max_width': 'auto', 'code_font_size': '0.8em', 'page_width': '1240px'}
html_static_path = ['_static']


def _link_pages(app, doctree, page):
    """Links to NAME.rst, which a code host follows too, lead to the page made of it."""
    find = getattr(doctree, 'findall', None) or doctree.traverse     # Ubuntu 20.04 has the old name
    for node in find(_reference):
        found = re.match(r'(\w+)\.rst(#.*)?$', node.get('refuri', ''))
        if found and found.group(1) in app.env.found_docs:
            node['refuri'] = app.builder.get_relative_uri(page, found.group(1)) + (
                found.group(2) or '')
        elif found:
            _log.warning('no page %s', found.group(1), location=node)


def _link_short_name(app, env, node, shown):
    """A name in a docstring is as in the code there: without the module that it comes from."""
    if node.get('refdomain') != 'py':
        return None
    domain, last_name = env.get_domain('py'), node['reftarget'].rpartition('.')[2]
    found = [full for full in domain.data['objects'] if full.endswith('.' + last_name)]
    if not found:
        return None
    near = node.get('py:module') or ''
    node['reftarget'] = max(
        sorted(found), key=lambda full: len(os.path.commonprefix([full, near])))
    return domain.resolve_xref(env, node.get('refdoc', ''), app.builder, 'obj', node['reftarget'],
                               node, shown)


def _document_slot(app, what, name, found, options, lines):
    """What `__slots__` says of an attribute; autodoc overlooks it in a class that inherits it."""
    if inspect.ismemberdescriptor(found) and not any(lines):
        lines[:] = [inspect.getdoc(found) or '']


def setup(app):
    """Called by Sphinx."""
    app.connect('autodoc-process-docstring', _document_slot)
    app.connect('missing-reference', _link_short_name)
    app.connect('doctree-resolved', _link_pages)
