"""Checks a ``package.xml`` that names its package, and its exports."""
from __future__ import annotations

import os
from typing import List, Sequence

from capabilities.discovery import EXPORTS, catkin_package
from rocon_uri.lint.checked_file import CheckedFile, is_inside
from rocon_uri.lint.finding import Finding
from rocon_uri.sources.located import Place
from rocon_uri.sources.packages import (
    Element, Export, Package, PackageError, manifest_elements)
from rocon_uri.sources.wording import cannot_be_read, did_you_mean, near_misses, quoted

__all__ = ['FILE_EXPORTS', 'check_manifest']

#: the tags of exports whose text is the path of a file
FILE_EXPORTS = EXPORTS + ('rocon_app',)

_ATTRIBUTES = {'rocon_uri': 'rules', 'app_manager': 'app_dir'}  # of exports that have one, no text
_TAGS = (*FILE_EXPORTS, *_ATTRIBUTES)
_DEPENDENCIES = ('depend', 'build_depend', 'build_export_depend', 'exec_depend', 'run_depend')


def check_manifest(package: Package) -> List[Finding]:
    """
    Check that catkin accepts a package, and that its exports are seen and name files that exist.

    :returns: list of `Finding`
    """
    file = CheckedFile(package.manifest, package.folder)
    elements: List[Element] = []
    try:
        elements = manifest_elements(package.manifest)
        catkin_package(package.manifest)
    except PackageError as error:
        place = _place(error.problem, elements) if error.line is None else error.place
        file.error(error.problem, place, error.id)
    seen = set()
    for export in package.exports:
        place = export.line, export.column
        if export.tag not in _TAGS:
            near = _near_tags(export.tag)
            if near:
                file.warn('unknown export %s, which nobody sees%s' % (
                    quoted('<%s>' % export.tag), did_you_mean(near)), place, 'unknown-export')
            continue
        _check_attributes(export, file)
        if export.tag == 'app_manager':
            _check_app_dir(export, package, file)
        name = export.file('rules' if export.tag == 'rocon_uri' else '')
        if export.tag not in FILE_EXPORTS and not (export.tag == 'rocon_uri' and name):
            continue
        exported = file.check_file(name, 'exported file', place, package.folder)
        if exported in seen:
            file.error('%s is exported twice' % quoted(name), place, 'duplicate-export')
        elif exported is not None:
            seen.add(exported)
    _check_app_manager(package, elements, file)
    return file.findings


def _near_tags(tag: str) -> List[str]:
    """The exports that were probably meant; other tools' tags, like velocity_interface, are not."""
    plain = _letters(tag)
    same = [other for other in _TAGS if _letters(other) == plain]
    return same or [other for other in near_misses(tag, _TAGS) if (
        abs(len(other) - len(tag)) <= 2 and other[0] == tag[0].lower())]


def _letters(tag: str) -> str:
    return tag.lower().replace('-', '').replace('_', '')


def _check_attributes(export: Export, file: CheckedFile) -> None:
    """Check that an export names its file in the attribute, or the text, that is read."""
    place = export.line, export.column
    expected = _ATTRIBUTES.get(export.tag)
    for attribute in export.attributes:
        if attribute != expected:
            file.warn('%s has an unknown attribute %s%s' % (
                quoted('<%s>' % export.tag), quoted(attribute),
                ', expected its path as text' if expected is None else
                ', expected %s' % quoted(expected)), place, 'export-attribute')
    if expected is not None and export.text:
        file.warn('%s has text, which nobody sees (expected %s)' % (
            quoted('<%s>' % export.tag), quoted('<%s %s="%s"/>' % (
                export.tag, expected, export.text))), place, 'export-attribute')
    elif expected is not None and not export.attributes:
        file.warn('%s has no attribute %s' % (quoted('<%s>' % export.tag), quoted(expected)),
                  place, 'export-attribute')
    elif expected is not None and export.attributes.get(expected) == '':
        file.warn('attribute %s of %s is empty, expected a path' % (
            quoted(expected), quoted('<%s>' % export.tag)), place, 'export-attribute')


def _check_app_dir(export: Export, package: Package, file: CheckedFile) -> None:
    """Check that the folder of a package that has its .installed files is there."""
    name = export.file('app_dir')
    path = os.path.normpath(os.path.join(package.folder, name))
    place = export.line, export.column
    if name and not is_inside(path, package.folder):
        file.error('exported folder %s is outside the package' % quoted(name), place,
                   'file-outside')
    elif name:
        try:
            os.listdir(path)
        except PermissionError as error:
            file.error('exported folder %s %s' % (quoted(name), cannot_be_read(error)),
                       place, 'cannot-read')
        except OSError as error:
            file.error('exported folder %s %s' % (
                quoted(name), 'is not a directory' if isinstance(error, NotADirectoryError)
                else 'does not exist'), place, 'file-missing')


def _place(problem: str, elements: Sequence[Element]) -> Place:
    """The place of the element that an error of catkin_pkg, which has none, quotes or names."""
    listed = problem.partition('following tags: ')[2].partition(' - ')[0].split(', ')

    def likeness(element: Element) -> int:
        is_lacking = not element.text or (
            'email' in problem and not element.attributes.get('email'))
        if element.tag != 'name' and any(
                value and (repr(value) in problem or '"%s"' % value in problem)
                for value in (element.text, *element.attributes.values())):
            return 5
        if '"%s"' % element.tag in problem or element.tag in listed:
            return 3 + is_lacking
        if element is elements[0] or element.tag not in problem.lower():
            return 0
        return 1 + is_lacking

    best = max(elements, key=likeness, default=None)
    if best is None:
        return 1, 1
    return best.place if likeness(best) else elements[0].place


def _check_app_manager(package: Package, elements: Sequence[Element], file: CheckedFile) -> None:
    """app_manager asks only the packages that depend on it."""
    exports = [export for export in package.exports if export.tag == 'app_manager']
    if exports and package.name != 'app_manager' and not any(
            element.tag in _DEPENDENCIES and element.text == 'app_manager' for element in elements):
        file.warn('the package does not depend on app_manager, which does not see its apps then',
                  (exports[0].line, exports[0].column), 'no-app-manager-dependency')
