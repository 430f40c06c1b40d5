"""What ``python3 -m rocon_uri`` does: the same as the command ``rocon_uri``."""
from rocon_uri.cli import main

if __name__ == '__main__':      # what looks for doctests imports it, too
    raise SystemExit(main())
