"""What ``python3 -m rocon_uri`` does: the same as the command ``rocon_uri``."""
from rocon_uri.cli import main

raise SystemExit(main())
