"""Results as files for other programs: ``export(result, path)``."""
