"""The public names of the package that are no subpackages."""

from inspect import ismodule

import linkwright as lw

PUBLIC = {name: getattr(lw, name) for name in lw.__all__ if not ismodule(getattr(lw, name))}
