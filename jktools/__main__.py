"""`python -m jktools`."""

import sys

from jktools.cli import main

sys.exit(main())
