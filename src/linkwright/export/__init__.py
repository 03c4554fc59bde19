"""Results as files for other programs: ``export(result, path)``."""

from linkwright.export.export import export as export
