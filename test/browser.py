"""Chromium without a window, for the tests of pages and for the pictures of the documentation."""
from __future__ import annotations

import os
import shutil
import tempfile
from contextlib import contextmanager
from typing import Any, Iterator

import pytest

__all__ = ['open_browser']


@contextmanager
def open_browser(*arguments: str, log: bool = False) -> Iterator[Any]:
    """Its driver; ``log`` keeps what pages say. The test is skipped where there is none."""
    webdriver = pytest.importorskip('selenium.webdriver', reason='selenium is not installed')
    browser, driver = shutil.which('chromium'), shutil.which('chromedriver')
    if browser is None or driver is None:
        pytest.skip('chromium and its driver are not installed')
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    for argument in ('--headless=new', '--no-sandbox', '--disable-dev-shm-usage', *arguments):
        options.add_argument(argument)
    options.binary_location = browser
    if log:
        options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
    folder = tempfile.mkdtemp()         # Chromium leaves a folder in it
    try:
        opened = webdriver.Chrome(service=Service(driver, env=dict(os.environ, TMPDIR=folder)),
                                  options=options)
        try:
            yield opened
        finally:
            opened.quit()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
