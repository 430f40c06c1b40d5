"""How Sphinx builds the documentation: ``sphinx-build -W doc build/doc``."""
import os
import re
import sys
import xml.etree.ElementTree

from docutils.nodes import reference as _reference
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
autodoc_default_options = {'members': True}
default_role = 'py:obj'
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


def setup(app):
    """Called by Sphinx."""
    app.connect('doctree-resolved', _link_pages)
