"""``python -m linkwright COMMAND``."""

import sys

from linkwright.cli import main

sys.exit(main())
