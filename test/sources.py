"""Where the Python packages that are tested are: in this tree or, where it has none, installed."""
from pathlib import Path

import rocon_uri

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / 'src' if (ROOT / 'src').is_dir() else Path(rocon_uri.__file__).resolve().parents[1]
