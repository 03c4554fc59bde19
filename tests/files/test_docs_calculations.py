"""The how-to pages hold a full example of every kind of calculation, which is read and solved."""

import re
from pathlib import Path

import pytest
from tests.every import every

import linkwright as lw
from linkwright import parts

ROOT = Path(__file__).parents[2] / "docs"


def examples(language: str) -> list[str]:
    """Files with a kind in the pages of a language."""
    pages = sorted((ROOT / language / "how-to").glob("*.md"))
    blocks = [
        block for page in pages for block in re.findall(r"```yaml\n(.*?)```", page.read_text("utf-8"), re.DOTALL)
    ]
    return [block for block in blocks if re.search(r"(?m)^kind: \w+", block) and block.startswith("format: 1")]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_kind_has_an_example_in_the_docs(language: str) -> None:
    shown = {re.findall(r"(?m)^kind: (\w+)", text)[0] for text in every(examples(language))}
    assert shown == {type(parts.load(f"gallery:{name}")).kind for name in parts.gallery_names()}


@pytest.mark.rotating
@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_example_is_read_without_a_word_and_solved(language: str, tmp_path: Path) -> None:
    for number, text in enumerate(every(examples(language))):
        path = tmp_path / f"{number}.yaml"
        path.write_text(text, encoding="utf-8")
        assert lw.check(path) == []
        assert parts.load(path).solve().data()
