"""`python -m openppmc.cli`."""

import sys

from . import main

sys.exit(main())
