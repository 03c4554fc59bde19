"""Hands on the workbench, filmed: ``python -m tests.ui.workbench.film FOLDER [SCENE ...]`` writes a picture for every
step, and says how long each scene took and what axe found.

The scenes are the states of the studio's visual target, and what someone who never writes a model file must be able
to do: a four-bar with its torque curve, a press with an aimed load and its report, all of it by keys or by touch, and
at 200 % zoom.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from axe_playwright_python.sync_playwright import Axe
from tests.ui.browser import browser
from tests.ui.workbench.hand import PHONE, Hand, hand

import linkwright as lw

WIDE = {"width": 2560, "height": 1440}
HALF = {"width": 720, "height": 450}


class Film:
    """Pictures of a scene, numbered."""

    def __init__(self, folder: Path, chromium: Any) -> None:
        self.folder, self.chromium = folder, chromium
        self.name, self.number, self.axe = "", 0, list[str]()

    def shot(self, of: Hand, what: str) -> None:
        """A picture of the page as it is, and what axe finds on it."""
        of.frame()
        self.number += 1
        of.tab.screenshot(path=self.folder / f"{self.name}-{self.number:02d}-{what}.png")
        for each in Axe().run(of.tab).response["violations"]:
            nodes = "; ".join(node["html"][:120] for node in each["nodes"][:3])
            self.axe.append(f"{self.name}-{self.number:02d}-{what}: {each['id']} ({each['impact']}): {nodes}")

    @contextmanager
    def hand(
        self, gallery: str | None = None, *, dark: bool = False, zh: bool = False, **options: Any
    ) -> Iterator[Hand]:
        """A hand in a folder of its own, with a machine of the gallery where one is named."""
        with tempfile.TemporaryDirectory() as folder:
            name = None
            if gallery is not None:
                name = f"{gallery}.yaml"
                text = lw.read_document(f"gallery:{gallery}").text
                (Path(folder) / name).write_text(text, encoding="utf-8")
            with hand(self.chromium, Path(folder), name, **options) as found:
                if dark:
                    found.tab.evaluate("() => bench.set({theme: 'dark'})")
                if zh:
                    found.tab.evaluate("() => desk.speak('zh')")
                    found.settle()
                yield found


def fourbar(of: Hand) -> None:
    """Two pivots, three links with typed lengths, a drive."""
    of.take("pivot")
    of.click((0.0, 0.0), (0.18, -0.02))
    of.take("link")
    of.click((0.0, 0.0))
    of.go((0.03, 0.05))
    of.type("60 mm", "62")
    of.go((0.16, 0.1))
    of.type("140", "18")
    of.click((0.18, -0.02))
    of.settle()
    of.key("Escape")
    of.take("drive")
    of.click(of.middle("O1", "A"))
    of.settle()


def torque_in_a_minute(film: Film) -> None:
    with film.hand() as of:
        film.shot(of, "empty")
        begin = time.perf_counter()
        fourbar(of)
        film.shot(of, "driven")
        of.take("torque")
        of.drag(of.middle("O2", "B"), (0.24, 0.06))
        of.settle()
        of.key("v", "Escape")
        of.tab.evaluate("() => { bench.dock.value = 'curves'; }")
        film.shot(of, "curves")
        assert of.tab.locator(".dock svg, .dock canvas").count() > 0
        print(f"  a four-bar with its torque: {time.perf_counter() - begin:.1f} s by script")
        of.key("Space")
        of.tab.wait_for_timeout(600)
        film.shot(of, "plays")


def states(film: Film) -> None:
    """The states of the target."""
    for look in ({}, {"dark": True}, {"zh": True}, {"size": WIDE}):
        mark = "-".join(look) or "light"
        with film.hand(**look) as of:
            film.shot(of, f"empty-{mark}")
            fourbar(of)
            of.take("link")
            of.click(of.point("B"))
            of.go((0.15, -0.01))
            film.shot(of, f"draw-{mark}")
        with film.hand("jaw_crusher_sixbar", **look) as of:
            script = """() => { bench.dock.value = 'curves'; bench.tab.value = 'numbers';
              for (const name of ['velocities', 'forces', 'transmission', 'limits']) bench.show(name, true);
              linkwright.phase.value = 0.55; }"""
            of.tab.evaluate(script)
            of.tab.locator(".inspector table tbody tr").nth(5).wait_for()
            film.shot(of, f"analysis-{mark}")


def gap(film: Film) -> None:
    for look in ({}, {"dark": True}, {"zh": True}):
        with film.hand(**look) as of:
            of.take("pivot")
            of.click((0.0, 0.0), (0.22, 0.0))
            of.take("link")
            of.click((0.0, 0.0))
            of.go((0.04, 0.04))
            of.type("60 mm", "50")
            of.go((0.14, 0.05))
            of.type("110 mm", "-10")
            of.settle()
            of.go((0.22, 0.0))
            of.type("90 mm")
            of.settle()
            of.key("Escape")
            of.take("drive")
            of.click(of.middle("O1", "A"))
            of.settle()
            of.key("v", "Escape")
            film.shot(of, f"gap-{'-'.join(look) or 'light'}")


def press(film: Film) -> None:
    """A slider-crank with a force aimed along its guide, mass from a section, and a report of it."""
    with film.hand() as of:
        of.look(-0.08, -0.1, 0.34, 0.14)
        of.take("pivot")
        of.click((0.0, 0.0))
        of.take("link")
        of.click((0.0, 0.0))
        of.go((0.04, 0.05))
        of.type("60 mm", "52")
        of.go((0.2, 0.0))
        of.type("160 mm", "-17.2")
        of.settle()
        of.key("Escape")
        of.take("slider")
        end = of.point("B")
        of.click(end, (end[0] + 0.05, end[1]))
        of.settle()
        of.take("drive")
        of.click(of.middle("O1", "A"))
        of.settle()
        film.shot(of, "slider-crank")
        of.take("force")
        end = of.point("B")
        of.drag(end, (end[0] + 0.06, end[1]))
        of.settle()
        of.type("250 N")
        of.settle()
        film.shot(of, "aimed")
        of.key("v")
        of.click(of.middle("A", "B"))
        of.tab.get_by_role("button", name=of.translate("studio.insp.from_bar")).click()
        of.settle()
        film.shot(of, "mass")
        print("\n".join(f"    {line}" for line in of.text.splitlines()))
        for ending in (".report.pdf", ".svg", ".dxf"):
            with of.tab.expect_download(timeout=120_000) as taken:
                of.tab.evaluate("ending => desk.take(ending)", ending)
            taken.value.save_as(film.folder / f"press{ending}")


def keyboard(film: Film) -> None:
    """A four-bar by keys alone."""
    with film.hand() as of:
        of.tab.locator(".sheet, .paper").first.focus()
        of.key("p", "Enter", "Enter")
        of.key(*["ArrowRight"] * 6, "Enter")
        of.settle()
        film.shot(of, "pivots")
        of.key("l", "Enter", *["ArrowLeft"] * 1, *["ArrowUp"] * 6, "Enter")
        of.settle()
        of.key(*["ArrowLeft"] * 4, *["ArrowDown"] * 3, "Enter")
        of.settle()
        of.key(*["ArrowLeft"], *["ArrowDown"] * 3, "Enter")
        of.settle()
        of.key("Escape")
        film.shot(of, "links")
        of.key("d", *["ArrowUp"] * 1, "Enter")
        of.settle()
        film.shot(of, "driven")
        print("\n".join(f"    {line}" for line in of.text.splitlines()))


def touch(film: Film) -> None:
    for look in ({}, {"zh": True}, {"dark": True}):
        with film.hand(size=PHONE, touch=True, **look) as of:
            mark = "-".join(look) or "light"
            film.shot(of, f"empty-{mark}")
            of.rail("pivot")
            of.tap((0.0, 0.0), (0.06, 0.0))
            of.settle()
            of.rail("link")
            for way in (((0.0, 0.0), (0.01, 0.025)), ((0.01, 0.025), (0.05, 0.04)), ((0.05, 0.04), (0.06, 0.0))):
                of.tap(*way)
                of.settle()
                of.key("Escape")
            film.shot(of, f"drawn-{mark}")
        with film.hand("jaw_crusher_sixbar", size=PHONE, touch=True, **look) as of:
            film.shot(of, f"crusher-{mark}")
            of.tab.evaluate("() => { bench.dock.value = 'curves'; }")
            film.shot(of, f"curves-{mark}")


def zoomed(film: Film) -> None:
    """200 % zoom at 1440 px: half the pixels."""
    with film.hand("jaw_crusher_sixbar", size=HALF) as of:
        film.shot(of, "half")


#: What a key of a motor is called.
LABEL = """async key => (await desk.ask('actuators')).kinds.find(({kind}) => kind === 'dc')
    .fields.find((each) => each.key === key).label"""


def run(film: Film) -> None:
    """A motor and a brake by their forms, a run, the moment of an event."""
    for look in ({}, {"dark": True}, {"zh": True}, {"size": PHONE, "touch": True}):
        mark = "-".join(look) or "light"
        with film.hand("jaw_crusher_sixbar", **look) as of:
            of.tab.evaluate("() => { bench.dock.value = 'run'; }")
            if "touch" in look:
                of.tab.locator(".drawer-grip").click()
            of.labelled("studio.dock.add_actuator").select_option("dc")
            film.shot(of, f"motor-{mark}")
            for key, value in (("stall_torque", "40 N·m"), ("no_load_speed", "900 rpm")):
                of.tab.locator(".running label", has_text=of.tab.evaluate(LABEL, key)).locator("input").fill(value)
            of.button("studio.dock.add").click()
            of.settle()
            of.button("studio.dock.begin_run").click()
            of.tab.wait_for_function("() => desk.running.value")
            of.tab.locator(".run-course li button").last.click()
            of.tab.locator(".run-element summary").first.click()
            film.shot(of, f"ran-{mark}")


SCENES: dict[str, Callable[[Film], None]] = {
    "states": states,
    "torque": torque_in_a_minute,
    "gap": gap,
    "press": press,
    "keyboard": keyboard,
    "touch": touch,
    "run": run,
    "zoomed": zoomed,
}


def main(arguments: list[str]) -> int:
    """All scenes, or the named ones."""
    folder = Path(arguments[0])
    folder.mkdir(parents=True, exist_ok=True)
    bad = 0
    with browser() as chromium:
        film = Film(folder, chromium)
        for name in arguments[1:] or SCENES:
            film.name, film.number, film.axe = name, 0, []
            begin = time.perf_counter()
            try:
                SCENES[name](film)
                end = "done"
            except Exception as error:
                end, bad = f"STOPPED: {str(error).splitlines()[0]}", bad + 1
            print(f"{name}: {film.number} pictures, {time.perf_counter() - begin:.1f} s, {end}")
            for line in film.axe:
                print(f"  axe: {line}")
            bad += bool(film.axe)
    return int(bad > 0)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(str(__doc__).splitlines()[0])
    sys.exit(main(sys.argv[1:]))
