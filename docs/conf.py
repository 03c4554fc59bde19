"""Settings of the documentation."""

import re
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

from docutils.nodes import SkipNode
from latex2mathml.converter import convert
from sphinx.ext.napoleon import GoogleDocstring
from sphinx.search.en import SearchEnglish

sys.path.insert(0, str(Path(__file__).parent))

import pages

pages.make()

project = "Linkwright"
author = "Linkwright contributors"
copyright = "2026, Linkwright contributors"
extensions = ["myst_parser", "sphinx_design", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "navigation"]
autodoc_default_options = {
    "members": True,
    "inherited-members": "BaseException, Exception, tuple",
    "member-order": "bysource",
}
autodoc_typehints_format = "short"
autodoc_type_aliases = {"ArrayLike": "ArrayLike", "Floats": "Floats"}
maximum_signature_line_length = 100
napoleon_google_docstring = napoleon_numpy_docstring = False  # see sections_of_docstrings
default_role = "code"
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
        "sidebar/brand.html",
        "sidebar/language.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
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
    """The target of the language switch in the sidebar."""
    page, language = other_language(name, set(app.env.found_docs))
    context["other_page"], context["other_language"] = page, {"zh": "中文", "en": "English"}[language]


#: Texts of the theme on Chinese pages; texts of its footer that are not listed are in English.
THEME = {
    "Search": "搜索",
    "Next": "下一页",
    "Previous": "上一页",
    "Home": "首页",
    "On this page": "本页内容",
    "Contents": "目录",
    "Back to top": "回到页首",
    "Index": "索引",
    "Skip to content": "跳到正文",
}


def theme_words(app: Any, name: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """The theme's texts in the language of the page."""
    if "/zh/" in f"/{name}":
        context["language"] = "zh-CN"
        context["_"] = context["gettext"] = lambda text: THEME.get(text, text)


class BothLanguages(SearchEnglish):
    """English words, and every two neighbouring Chinese characters: Chinese has no spaces between its words."""

    lang = "en"
    js_splitter_code = """
const pairs = (run) => Array.from({length: run.length - 1}, (_, k) => run.slice(k, k + 2));
var splitQuery = (query) =>
  query.split(/[^\\p{L}\\p{N}_]+/gu).filter(Boolean)
    .flatMap((word) => word.match(/[\u4e00-\u9fff]+|[^\u4e00-\u9fff]+/gu))
    .flatMap((run) => (/^[\u4e00-\u9fff]{3,}$/.test(run) ? pairs(run) : [run]));
"""

    def split(self, input: str) -> list[str]:
        words = super().split(input)
        pairs = (two for word in words for two in map("".join, pairwise(word)))
        return [*words, *(two for two in pairs if re.fullmatch(f"{CHINESE}{{2}}", two))]


NAMES = "(?:arc(?:sin|cos|tan)|sin|cos|tan|det|min|max|sign|exp|log)"
THIN = '<mspace width="0.17em"/>'
#: Positions of thin spaces: after the name of a function, and between it and a factor; bars have none.
BEHIND = re.compile(rf"(?<!<msup>)(?<!<msub>)(?<!<msubsup>)<mi>{NAMES}</mi>")
BEFORE = re.compile(rf"</(?:mi|mn|msub|msup|mfrac|msqrt)>(?=<mi>{NAMES}</mi>|<msup><mi>{NAMES}</mi>)")
BAR = re.compile(r'<mo(?: stretchy="false")?>(&#x0007C;)</mo>')


def mathml(text: str, display: str) -> str:
    """A formula as MathML; bars without space around them, thin spaces around names of functions."""
    found = BEFORE.sub(rf"\g<0>{THIN}", convert(text, display=display))
    found = BEHIND.sub(rf"\g<0>{THIN}", found)
    return BAR.sub(r'<mo lspace="0" rspace="0" stretchy="false">\1</mo>', found)


def inline_formula(page: Any, node: Any) -> None:
    """A formula within a line as MathML, which browsers show without scripts."""
    page.body.append(mathml(node.astext(), "inline"))
    raise SkipNode


def formula(page: Any, node: Any) -> None:
    """A formula on lines of its own."""
    page.body.append(f'<div class="math">{mathml(node.astext(), "block")}</div>')
    raise SkipNode


def joined_lines(app: Any, name: str, source: list[str]) -> None:
    """Join Chinese lines of a paragraph without a space; headings and code are unchanged."""
    joined: list[str] = []
    code = False
    for line in source[0].split("\n"):
        code ^= line.lstrip().startswith("```")
        before = joined[-1] if joined else ""
        if not code and not before.startswith("#") and re.search(f"{CHINESE}$", before) and re.match(CHINESE, line):
            joined[-1] = before + line
        else:
            joined.append(line)
    source[0] = "\n".join(joined)


def sections_of_docstrings(app: Any, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    """Google's sections as fields; in properties, Napoleon would take what is before a colon for a type."""
    if what != "property":
        lines[:] = GoogleDocstring(lines, app.config, app, what, name, value, options).lines()


def short_signature(
    app: Any, what: str, name: str, value: Any, options: Any, arguments: str | None, returned: str | None
) -> tuple[str | None, str | None]:
    """Aliases by name; ``...`` for defaults from a factory, so that Sphinx can parse and wrap the signature."""
    texts = (text and re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", text) for text in (arguments, returned))
    arguments, returned = texts
    return arguments and arguments.replace("<factory>", "..."), returned


def setup(app: Any) -> None:
    app.connect("html-page-context", language_link)
    app.connect("html-page-context", theme_words)
    app.connect("source-read", joined_lines)
    app.connect("autodoc-process-docstring", sections_of_docstrings)
    app.connect("autodoc-process-signature", short_signature)
    app.add_search_language(BothLanguages)
    app.add_html_math_renderer("mathml", (inline_formula, None), (formula, None))
