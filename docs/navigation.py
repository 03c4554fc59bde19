"""The tree of all pages in the sidebar, resolved once for each folder.

Sphinx resolves it anew for every page, which took most of the time of a build: pages of one folder differ only in
what is marked as current.
"""

import re
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from sphinx.environment.adapters.toctree import global_toctree_for_doc

#: A name that no page has; links of a tree resolved for it go from its folder.
NOBODY = "-"
PRIORITY = 400  # before the theme, 500, which asks for the tree


def setup(app: Any) -> Mapping[str, bool]:
    trees: Callable[..., str] = lru_cache(lambda folder, **asked: _tree(app, folder + NOBODY, asked))

    def share(_app: Any, name: str, _template: str, context: dict[str, Any], _doctree: Any) -> None:
        def tree(**asked: Any) -> str:
            return _marked(app, name, trees(name[: name.rfind("/") + 1], **asked))

        context["toctree"] = tree

    app.connect("html-page-context", share, priority=PRIORITY)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _tree(app: Any, name: str, asked: Mapping[str, Any]) -> str:
    """The tree as HTML with links from the folder of a page, nothing current."""
    found = global_toctree_for_doc(app.env, name, app.builder, tags=app.tags, **asked)
    return str(app.builder.render_partial(found)["fragment"])


def _marked(app: Any, name: str, tree: str) -> str:
    """The tree with a page and what it belongs to marked as current."""
    above = {child: page for page, children in app.env.toctree_includes.items() for child in children}
    nobody, page, link = name[: name.rfind("/") + 1] + NOBODY, name, r'<a class="current \2" href="#">'
    while page in above:
        uri = re.escape(app.builder.get_relative_uri(nobody, page))
        entry = rf'<li class="(toctree-l\d+)"><a class="(reference internal)" href="({uri})">'
        tree = re.sub(entry, rf'<li class="\1 current">{link}', tree)
        page, link = above[page], r'<a class="\2" href="\3">'
    return tree
