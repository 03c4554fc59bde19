"""Messages and localized texts are plain texts to other packages."""

from __future__ import annotations

from linkwright.words import _
from linkwright.words.message import LocalizedText


def test_a_table_of_characters_is_taken_as_by_any_text() -> None:
    """As rich calls it to remove control characters."""
    message, title = _("links reach {reach}", reach="2 m"), LocalizedText({"en": "press", "zh": "压力机"})
    assert message.translate({ord("k"): None}) == "lins reach 2 m"
    assert title.translate({ord("p"): "P"}) == "Press"
    assert title.translate({ord("压"): "冲"}).translate("zh") == "冲力机"
