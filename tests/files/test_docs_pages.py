"""Generated pages of the documentation hold everything that they promise; links lead to pages."""

import importlib.util
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.every import every
from tests.public import PUBLIC

import linkwright as lw
from linkwright import gallery
from linkwright.analysis import METRICS
from linkwright.words import in_language

DOCS = Path(__file__).parents[2] / "docs"
PAGES = DOCS / "pages.py"
specification = importlib.util.spec_from_file_location("pages", PAGES)
assert specification is not None and specification.loader is not None
pages = importlib.util.module_from_spec(specification)
specification.loader.exec_module(pages)


def test_the_api_reference_has_every_public_name() -> None:
    text = (DOCS / "en/api.md").read_text("utf-8")
    listed = re.findall(r"(?m)^\.\. auto(?:function|class|exception):: (\w+)$", text)
    assert sorted(listed) == sorted(PUBLIC)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_reference_of_model_files_has_every_key_of_the_schema(language: str) -> None:
    text = "\n".join(pages.model_file(language))
    schema = lw.json_schema()
    for name in schema["properties"]:
        assert f"## `{name}`" in text
    for kind in schema["properties"]["loads"]["additionalProperties"]["oneOf"]:
        assert f"### {kind['title']}" in text
        assert all(f"| `{key}`" in text for key in kind["properties"])


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_gallery_shows_every_model(language: str) -> None:
    index = "\n".join(pages.gallery_index(language))
    assert all(f":link: {name}\n" in index and f"pictures/{name}.svg" in index for name in every(gallery.names()))
    by_kinds = re.findall(r"(?m)^\| `(\w+)` \| .+ \| .+ \|$", "\n".join(pages.gallery_by_kinds(language)))
    assert sorted(by_kinds) == sorted(gallery.names())
    page = "\n".join(pages.gallery_page("truss", language))
    assert "linkwright structure gallery:truss" in page and gallery.file("truss").read_text("utf-8") in page


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_public_name_leads_to_its_example(language: str) -> None:
    rows = {line.split("`")[1]: line for line in pages.functions(language) if line.startswith("| [`")}
    assert set(rows) == set(PUBLIC)
    assert all(".md)" in line for line in every(rows.values()))


def test_the_reference_in_the_repository_is_up_to_date() -> None:
    made = pages.reference().items()
    old = [page.name for page, text in every(made, least=5) if page.read_text("utf-8") != text]
    assert old == [], "run: python docs/pages.py"


def test_a_page_in_one_language_is_there_in_the_other() -> None:
    en, zh = ({page.relative_to(DOCS / own) for page in (DOCS / own).rglob("*.md")} for own in ("en", "zh"))
    assert en - {Path("api.md")} == zh  # docstrings are English


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_design_number_is_named_with_how_it_is_had(language: str) -> None:
    """In the table of the page on metrics; a star where it has to be asked for."""
    rows = re.findall(r"`(\w+)`(\\\*)?", (DOCS / language / "theory/metrics.md").read_text("utf-8"))
    told = {name: bool(star) for name, star in rows if name in METRICS and (star or not METRICS[name].on_request)}
    assert told == {name: METRICS[name].on_request for name in METRICS}


def test_links_of_pages_lead_to_pages() -> None:
    """In a clone, which has no page that only a build makes; those outside of ``docs`` too, which no build looks at.
    What stands in code is no link of the page."""
    for page in (*DOCS.parent.glob("*.md"), *DOCS.parent.glob("examples/*.md"), *DOCS.rglob("*.md")):
        words = re.sub(r"^```.*?^```|`[^`\n]+`", "", page.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
        for target in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", words):
            found = page.parent / target
            assert "made" not in found.parts and found.exists(), f"{page}: {target}"


def test_every_key_and_every_name_is_told_in_chinese() -> None:
    """A changed docstring asks for its Chinese sentence in ``docs/chinese.py``."""

    def said(schema: object) -> Iterator[str]:
        if isinstance(schema, dict):
            if isinstance(schema.get("description"), str):
                yield schema["description"]
            schema = list(schema.values())
        if isinstance(schema, list):
            for each in schema:
                yield from said(each)

    given = set(every(said(lw.json_schema()), least=200)) - {""}
    assert {each for each in given if in_language(each, "zh") == each} == set(pages.LOADS)
    assert set(pages.NAMES) == set(PUBLIC)
