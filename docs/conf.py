"""Settings of the documentation."""

project = "Linkwright"
author = "Linkwright contributors"
copyright = "2026, Linkwright contributors"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "amsmath", "deflist"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
html_theme = "alabaster"
html_theme_options = {"description": "planar machines, from file to forces", "page_width": "72rem"}
html_show_sourcelink = False
