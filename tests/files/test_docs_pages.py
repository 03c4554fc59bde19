"""Pages that are made when the documentation is built hold everything that they promise."""

import importlib.util
from pathlib import Path

import pytest

import linkwright as lw
from linkwright import gallery

PAGES = Path(__file__).parents[2] / "docs" / "pages.py"
specification = importlib.util.spec_from_file_location("pages", PAGES)
assert specification is not None and specification.loader is not None
pages = importlib.util.module_from_spec(specification)
specification.loader.exec_module(pages)


def test_the_api_has_every_public_name_with_its_arguments() -> None:
    text = "\n".join(pages.api())
    for names in lw.PUBLIC.values():
        for name in names:
            assert f"## `{name}`" in text
    assert "- `steps`:" in text and "**Raises**" in text and "``" not in text.replace("```", "")


def test_the_reference_of_model_files_has_every_key_of_the_schema() -> None:
    text = "\n".join(pages.model_file())
    schema = lw.json_schema()
    for name in schema["properties"]:
        assert f"## `{name}`" in text
    for kind in schema["properties"]["loads"]["additionalProperties"]["oneOf"]:
        assert f"### {kind['title']}" in text
        assert all(f"| `{key}`" in text for key in kind["properties"])


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_gallery_shows_every_model(language: str) -> None:
    index = "\n".join(pages.gallery_index(language))
    assert all(f":link: {name}\n" in index and f"pictures/{name}.svg" in index for name in gallery.names())
    page = "\n".join(pages.gallery_page("truss", language))
    assert "linkwright structure gallery:truss" in page and gallery.file("truss").read_text("utf-8") in page
