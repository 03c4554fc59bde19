"""Makes the pictures of the studio, in both languages: ``PYTHONPATH=. python docs/pictures/studio.py [PICTURE ...]``.

A hand draws each of them in Chromium, as the tests of the workbench do.
"""

from __future__ import annotations

import io
import math
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from PIL import Image
from tests.ui.browser import browser
from tests.ui.workbench.hand import DESK, PHONE, Hand, hand

import linkwright as lw

HERE = Path(__file__).parent
SIZE = {"width": 1280, "height": 800}
SIZES = {"gap": DESK, "phone": PHONE}
#: The machine that is opened on a phone.
SMALL = "crank_rocker"


def begin(of: Hand, frame: float) -> None:
    """Two pivots, and a crank of 60 mm on the first."""
    of.look(-0.12, -0.09, frame + 0.08, 0.17)
    of.take("pivot")
    of.click((0.0, 0.0), (frame, 0.0))
    of.take("link")
    of.click((0.0, 0.0))
    of.go((0.03, 0.05))
    of.type("60 mm", "60")
    of.settle()


def drive(of: Hand) -> None:
    """Drives the crank."""
    of.key("Escape")
    of.take("drive")
    of.click(of.middle("O1", "A"))
    of.settle()
    of.key("v", "Escape")


def torque(of: Hand) -> None:
    """The curves of a four-bar under a torque on its rocker."""
    begin(of, 0.2)
    of.go((0.18, 0.12))
    of.type("180 mm", "22.2")
    of.settle()
    of.click((0.2, 0.0))
    of.settle()
    drive(of)
    of.take("torque")
    of.drag(of.middle("O2", "B"), (0.16, 0.1))
    of.settle()
    of.key("v", "Escape")
    of.tab.evaluate("() => { bench.dock.value = 'curves'; bench.show('transmission', true); bench.view.fit(); }")
    of.settle()


def length(of: Hand) -> None:
    """A coupler in hand whose length is typed."""
    begin(of, 0.2)
    of.go((0.18, 0.12))
    of.tab.keyboard.type("180")
    of.frame()


def gap(of: Hand) -> None:
    """Lengths that do not meet, with remedies."""
    begin(of, 0.22)
    of.go((0.14, 0.05))
    of.type("110 mm", "-10")
    of.settle()
    of.go((0.22, 0.0))
    of.type("90 mm")
    of.settle()
    drive(of)
    of.look(-0.1, -0.13, 0.4, 0.15)
    of.go((0.2, -0.06))


def synthesis(of: Hand) -> None:
    """A curve drawn by hand, and linkages that follow it."""
    of.tab.evaluate("() => { bench.dock.value = 'synthesis'; }")
    of.frame()
    of.look(-0.26, -0.16, 0.26, 0.12)
    of.take("target")
    bean = [(0.05 * math.cos(t), 0.028 * math.sin(t) - 0.012 * math.cos(2 * t)) for t in _turn(48)]
    of.go(bean[0])
    of.tab.mouse.down()
    for place in bean[1:]:
        of.go(place)
    of.tab.mouse.up()
    of.tab.wait_for_function("() => document.querySelectorAll('.candidate').length > 3")
    of.tab.wait_for_function("() => !desk.sought.value?.running", timeout=120_000)
    of.key("v")
    of.tab.locator(".candidate").nth(2).hover()
    of.frame()


def _turn(count: int) -> list[float]:
    return [2 * math.pi * k / count for k in range(count)]


def phone(of: Hand) -> None:
    """The drawer of a phone half open."""
    of.tab.evaluate("() => { bench.drawer.value = 'half'; bench.dock.value = 'curves'; bench.view.fit(); }")


PICTURES: dict[str, Callable[[Hand], None]] = {
    "torque": torque, "length": length, "gap": gap, "synthesis": synthesis, "phone": phone,
}  # fmt: skip


def main(names: list[str]) -> None:
    """Writes every picture, or those that are named."""
    with browser() as chromium:
        for name in names or PICTURES:
            for language in ("en", "zh"):
                with tempfile.TemporaryDirectory() as folder:
                    small, file = name == "phone", None
                    if small:
                        file = f"{SMALL}.yaml"
                        (Path(folder) / file).write_text(lw.read_document(f"gallery:{SMALL}").text, encoding="utf-8")
                    with hand(chromium, Path(folder), file, size=SIZES.get(name, SIZE), touch=small) as of:
                        if language == "zh":
                            of.tab.evaluate("() => desk.speak('zh')")
                            of.settle()
                        PICTURES[name](of)
                        of.tab.wait_for_timeout(500)
                        picture = Image.open(io.BytesIO(of.tab.screenshot())).convert("RGB")
                few = picture.quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
                few.save(HERE / f"studio_{name}_{language}.png", optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
