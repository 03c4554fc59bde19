"""Settings of the documentation."""

import re
import sys
from pathlib import Path
from typing import Any

from docutils.nodes import SkipNode
from latex2mathml.converter import convert

sys.path.insert(0, str(Path(__file__).parent))

import pages

pages.make()

project = "Linkwright"
author = "Linkwright contributors"
copyright = "2026, Linkwright contributors"
extensions = ["myst_parser", "sphinx_design"]
myst_enable_extensions = ["dollarmath", "amsmath", "deflist", "colon_fence", "html_image"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown", ".markdown": "markdown"}
exclude_patterns = ["_build", "made/extra", "made/*/validation_table.markdown"]
templates_path = ["_templates"]
html_static_path = ["_static"]
html_extra_path = ["made/extra"]
html_css_files = ["linkwright.css"]
html_theme = "furo"
html_math_renderer = "mathml"
html_title = "Linkwright"
html_show_sourcelink = False
html_copy_source = False
html_sidebars = {
    "**": [
        "sidebar/brand.html", "sidebar/language.html", "sidebar/search.html", "sidebar/scroll-start.html",
        "sidebar/navigation.html", "sidebar/scroll-end.html",
    ]
}  # fmt: skip
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1565c0", "color-brand-content": "#1565c0"},
    "dark_css_variables": {"color-brand-primary": "#7cb8ff", "color-brand-content": "#7cb8ff"},
}
#: A Chinese character or mark.
CHINESE = "[\u3001-\u3011\u4e00-\u9fff\uff01-\uff1f]"


def other_language(name: str, known: set[str]) -> tuple[str, str]:
    """The page of the other language, and that language; its entrance where there is no such page."""
    for own, other in (("zh", "en"), ("en", "zh")):
        if f"/{own}/" in f"/{name}":
            found = f"/{name}".replace(f"/{own}/", f"/{other}/", 1)[1:]
            return (found if found in known else f"{other}/index"), other
    return "zh/index", "zh"


def language_link(app: Any, name: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """What the switch in the sidebar leads to."""
    page, language = other_language(name, set(app.env.found_docs))
    context["other_page"], context["other_language"] = page, {"zh": "中文", "en": "English"}[language]


def inline_formula(page: Any, node: Any) -> None:
    """A formula within a line as MathML, which browsers show without scripts."""
    page.body.append(convert(node.astext()))
    raise SkipNode


def formula(page: Any, node: Any) -> None:
    """A formula on lines of its own."""
    page.body.append(f'<div class="math">{convert(node.astext(), display="block")}</div>')
    raise SkipNode


def joined_lines(app: Any, name: str, source: list[str]) -> None:
    """Chinese lines of one paragraph follow each other without a space."""
    source[0] = re.sub(rf"(?<={CHINESE})\n(?={CHINESE})", "", source[0])


def setup(app: Any) -> None:
    app.connect("html-page-context", language_link)
    app.connect("source-read", joined_lines)
    app.add_html_math_renderer("mathml", (inline_formula, None), (formula, None))
