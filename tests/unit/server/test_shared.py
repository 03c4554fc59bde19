"""Models in links: read as they were packed by another hand, refused where they are none."""

from __future__ import annotations

import base64
import zlib
from pathlib import Path

import pytest
from tests.ui.studio import asked, serving

import linkwright as lw
from linkwright.server.files import LARGEST
from linkwright.server.shared import holds_model, model_of

TEXT = "format: 1\nname: {en: Press, zh: 压力机}\n"


def link(content: bytes) -> str:
    packer = zlib.compressobj(wbits=-15)
    packed = packer.compress(content) + packer.flush()
    return "http://127.0.0.1:4711/#model=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def test_a_link_gives_its_text() -> None:
    assert model_of(link(TEXT.encode())) == TEXT
    assert model_of("see " + link(TEXT.encode()) + " here") == TEXT
    assert holds_model(link(b"x"))
    assert not any(map(holds_model, ("crusher.yaml", "model.yaml", "https://any.example/#0.crank.length=0.1")))


def test_the_command_opens_a_link_as_a_new_drawing_each_time(tmp_path: Path) -> None:
    for number in (1, 2):
        with serving(tmp_path, link(TEXT.encode())) as studio:
            status, found = asked(studio, "open", {"name": f"Drawing {number}.yaml"})
            assert (status, found["text"], found["version"], found["recovered"]) == (200, TEXT, "", True)
    assert list(tmp_path.glob("*.yaml")) == []


@pytest.mark.parametrize(
    "content", [b"", b" \n", b"\xff\xfe\xfd", b"x" * (LARGEST + 1)], ids=("empty", "blank", "no text", "bomb")
)
def test_what_holds_no_model_is_refused(content: bytes) -> None:
    with pytest.raises(lw.LinkwrightError, match="no model"):
        model_of(link(content))


@pytest.mark.parametrize("text", ["", "#model=", "#model=A", "#model=AAAA", link(TEXT.encode())[:-6]])
def test_broken_links_are_refused(text: str) -> None:
    with pytest.raises(lw.LinkwrightError, match="no model"):
        model_of(text)
