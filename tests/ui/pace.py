"""What a drag costs the browser on a page and on the workbench, how ghost curves move, how long opening takes:
``python -m tests.ui.pace``.

From a pointer's move to new curves on the screen the page's main thread works (scripts, style, layout, recording of
what is painted), threads fill the picture and the compositor puts it together. Chromium draws frames here as soon as
they are ready instead of sixty times a second, so the clock from a move to its frame holds what the move needs and no
waiting for the display; moves come at the pace of a display. Where other programs run beside it the clock is theirs
too: a trace says the processor time of every kind of work. Playing is measured at the display's own pace, opening a
page from navigation to the frame with its drawing, a studio from the command to that frame, in a running browser and
from compiled modules, as an installer leaves them.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.ui.browser import Opened, browser
from tests.ui.studio import address_in
from tests.ui.workbench.hand import hand

import linkwright as lw

MOVES, FRAMES, STEPS, OPENINGS = 240, 120, 360, 7
UNLIMITED = ("--disable-frame-rate-limit", "--disable-gpu-vsync")
#: The window of which the workbench shows six curves.
LARGE = {"width": 1920, "height": 1200}
#: Between two moves, ms: a display's frame.
DISPLAY = 1000 / 60
_DRAG = """async ([moves, pause]) => {
  const {element, x: x0, y: y0} = (GRASP)(), found = [];
  element.setPointerCapture = () => {};
  const send = (kind, x, y) => element.dispatchEvent(new PointerEvent(kind,
    {bubbles: true, clientX: x, clientY: y, pointerId: 1, buttons: 1, pointerType: 'mouse'}));
  send('pointerdown', x0, y0);
  for (let k = 0; k < moves; k++) {
    const angle = 0.2 * k;
    const start = performance.now();
    console.timeStamp('move');
    send('pointermove', x0 + 5 * Math.sin(angle), y0 + 5 * Math.cos(angle) - 5);
    await new Promise(done => requestAnimationFrame(() => {
      const channel = new MessageChannel();
      channel.port1.onmessage = done;
      channel.port2.postMessage(0);
    }));
    found.push(performance.now() - start);
    await new Promise(done => setTimeout(done, Math.max(0, pause - found[k])));
  }
  send('pointerup', x0, y0);
  return found;
}"""
#: A joint of a page, and one on the sheet of the workbench.
_HANDLE = _DRAG.replace(
    "GRASP",
    """() => {
      const {svg} = linkwright.sessions[0].view, box = svg.getBoundingClientRect();
      const element = svg.querySelector('.handle[data-key="B"]');
      return {element, x: +element.getAttribute('cx') + box.left, y: +element.getAttribute('cy') + box.top};
    }""",
)
_JOINT = _DRAG.replace(
    "GRASP",
    """() => {
      const element = document.querySelector('.paper'), box = element.getBoundingClientRect();
      const {camera, scene} = bench.sheet.value, [x, y] = camera.screen(scene.at('B'));
      return {element, x: x + box.left, y: y + box.top};
    }""",
)
_PLAY = """async ([frames]) => {
  linkwright.play(true);
  const times = [];
  for (let k = 0; k < frames; k++) times.push(await new Promise(requestAnimationFrame));
  linkwright.play(false);
  return times.slice(1).map((t, k) => t - times[k]);
}"""
_SOLVE = """s => {
  let best = Infinity;
  for (let k = 0; k < 400; k++) {
    const start = performance.now();
    for (let j = 0; j < 10; j++) s.model.main.run();
    best = Math.min(best, (performance.now() - start) / 10);
  }
  return best;
}"""
_CATEGORIES = ("devtools.timeline", "disabled-by-default-devtools.timeline", "toplevel", "cc", "viz", "__metadata")
_MAIN = {
    "UpdateLayoutTree": "style",
    "Layout": "layout",
    "PrePaint": "recording",
    "Paint": "recording",
    "Layerize": "recording",
    "Commit": "recording",
    "FunctionCall": "scripts",
    "EventDispatch": "scripts",
    "FireAnimationFrame": "scripts",
    "MinorGC": "scripts",
    "MajorGC": "scripts",
}
_COMPOSITORS = ("Compositor", "VizCompositorThread")


def traced(tab: Any, drag: str) -> tuple[list[float], dict[str, list[float]]]:
    """Times by the clock (ms) from each move of a drag to its frame; of a second one, which a trace makes slower,
    processor times (ms) by kind of work."""
    times = tab.evaluate(drag, [MOVES, DISPLAY])
    client = tab.context.browser.new_browser_cdp_session()
    events: list[dict[str, Any]] = []
    ended: list[bool] = []
    client.on("Tracing.dataCollected", lambda found: events.extend(found["value"]))
    client.on("Tracing.tracingComplete", lambda _: ended.append(True))
    config = {"includedCategories": list(_CATEGORIES)}
    client.send("Tracing.start", {"transferMode": "ReportEvents", "traceConfig": config})
    tab.evaluate(drag, [MOVES, DISPLAY])
    client.send("Tracing.end")
    while not ended:
        tab.wait_for_timeout(50)
    return times, _by_move(events)


def _by_move(events: list[dict[str, Any]]) -> dict[str, list[float]]:
    """Processor times by kind of work, between the marks of the moves."""
    marks = [each for each in events if each["name"] == "TimeStamp"]
    page, begins = (marks[0]["pid"], marks[0]["tid"]), sorted(each["ts"] for each in marks)
    names = {
        (each["pid"], each["tid"]): each["args"]["name"]
        for each in events
        if each["name"] == "thread_name" and each.get("ph") == "M"
    }
    found: dict[str, list[float]] = defaultdict(lambda: [0.0] * len(begins))
    for thread, each, own in _own_times(events):
        move = bisect_right(begins, each["ts"]) - 1
        name = names.get(thread, "")
        if move < 0:
            continue
        if thread == page:
            found["page"][move] += own
            found["  " + _MAIN.get(each["name"], "other")][move] += own
        elif name in _COMPOSITORS:
            found["compositor"][move] += own
        elif name == "ThreadPoolForegroundWorker" and thread[0] == page[0]:
            found["filling"][move] += own
    return dict(sorted(found.items(), key=lambda item: (not item[0].startswith((" ", "page")), item[0][:1] == " ")))


def _own_times(events: list[dict[str, Any]]) -> Iterator[tuple[tuple[int, int], dict[str, Any], float]]:
    """Thread, event, and the processor time (ms) that none of the events within it has."""
    timed = sorted((e for e in events if "tdur" in e), key=lambda e: (e["ts"], -e["dur"]))
    open_: dict[tuple[int, int], list[dict[str, Any]]] = defaultdict(list)
    inner: dict[int, float] = defaultdict(float)
    for each in timed:
        stack = open_[each["pid"], each["tid"]]
        while stack and stack[-1]["ts"] + stack[-1]["dur"] <= each["ts"]:
            stack.pop()
        if stack:
            inner[id(stack[-1])] += each["tdur"]
        stack.append(each)
    for each in timed:
        yield (each["pid"], each["tid"]), each, (each["tdur"] - inner[id(each)]) / 1e3


def said(title: str, times: list[float]) -> dict[str, Any]:
    """A title with the median and the 95th percentile, printed and as data."""
    ordered = sorted(times)
    middle, late = ordered[len(ordered) // 2], ordered[int(0.95 * len(ordered))]
    print(f"{title:<44} median {middle:6.2f} ms   95th percentile {late:6.2f} ms")
    return {"what": title.strip(), "median_ms": round(middle, 3), "p95_ms": round(late, 3)}


def said_of_drag(title: str, clock: list[float], work: Mapping[str, list[float]]) -> list[dict[str, Any]]:
    """The clock of a drag, all of its kinds of work, and their sum."""
    whole = [sum(each) for each in zip(*(work[name] for name in ("page", "filling", "compositor")), strict=True)]
    print(f"{title}")
    rows = {"from a move to its frame, by the clock": clock, "processor time of a move": whole, **work}
    return [{**said(f"  {name}", times), "of": title} for name, times in rows.items()]


@contextmanager
def opened(folder: Path, *arguments: str) -> Iterator[Opened]:
    """The six-bar crusher with all reactions and six curves open."""
    document = lw.read_document("gallery:jaw_crusher_sixbar")
    motion = lw.solve_motion(document.mechanism, steps=STEPS)
    path = lw.export(motion, folder / "page.html", text=document.text, force=True)
    with browser(*arguments) as chromium:
        page = Opened(chromium.new_context(viewport={"width": 1280, "height": 900}).new_page())
        page.open(path)
        page.run("s => { s.curves.value = s.data.signals.slice(-6).map(x => x.id); s.shown.paths.add('B'); }")
        page.tab.evaluate(_HANDLE, [60, 0])
        yield page


@contextmanager
def workbench(folder: Path, *arguments: str) -> Iterator[Any]:
    """The six-bar crusher on the workbench, velocities and forces shown, six curves in the dock."""
    (folder / "machine.yaml").write_text(lw.read_document("gallery:jaw_crusher_sixbar").text, encoding="utf-8")
    with browser(*arguments) as chromium, hand(chromium, folder, "machine.yaml", size=LARGE) as found:
        found.tab.evaluate("""() => {
          bench.dock.value = 'curves';
          for (const name of ['velocities', 'forces']) bench.show(name, true);
        }""")
        found.tab.wait_for_function("() => document.querySelectorAll('.dock .plot canvas').length === 6")
        found.tab.evaluate(_JOINT, [60, 0])
        found.settle()
        yield found.tab


_GHOSTS = (
    "s => s.view.ghosts(Array.from({length: 500}, (_, k) => ['x', 'y'].map(a =>"
    " s.model.main.row('p:B.' + a).map(v => v + 0.0005 * (k - 250))).reduce((x, y) => ({x, y}))))"
)


#: Notes the first frame in which the machine is drawn, ms since navigation.
_OPENED = """
  const look = () => requestAnimationFrame(() => {
    if (!document.querySelector('svg.machine .lw-pins *')) return look();
    requestAnimationFrame(() => { window.drawnAt = performance.now(); });
  });
  look();
"""


def opening(folder: Path) -> Iterator[float]:
    """Times (ms) of the six-bar's page from the disk."""
    with browser() as chromium:
        for _ in range(OPENINGS):
            tab = chromium.new_context(viewport={"width": 1280, "height": 900}).new_page()
            tab.add_init_script(_OPENED)
            tab.goto((folder / "page.html").as_uri())
            tab.wait_for_function("() => window.drawnAt")
            yield float(tab.evaluate("() => window.drawnAt"))
            tab.context.close()


def studio_opening(folder: Path) -> Iterator[float]:
    """Times (ms) of the studio from its command to the first picture; a first start compiles the modules."""
    (folder / "machine.yaml").write_text(lw.read_document("gallery:jaw_crusher_sixbar").text, encoding="utf-8")
    command = [sys.executable, "-m", "linkwright", "studio", "machine.yaml", "--no-browser"]
    compiled = {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(folder / "compiled")}
    with browser() as chromium:
        for start in range(1 + OPENINGS):
            tab = chromium.new_context(viewport={"width": 1280, "height": 900}).new_page()
            begin = time.perf_counter()
            with subprocess.Popen(
                command,
                cwd=folder,
                stdout=subprocess.PIPE,
                text=True,
                env={**os.environ, **compiled, "PYTHONUNBUFFERED": "1"},
            ) as process:
                assert process.stdout is not None
                tab.goto(f"{address_in(process.stdout.readline())}&bench=1")
                tab.wait_for_selector("svg.machine .lw-pins *", state="attached")
                tab.evaluate("() => new Promise(requestAnimationFrame)")
                taken = 1e3 * (time.perf_counter() - begin)
                process.terminate()
            if start:
                yield taken
            tab.context.close()


def main(arguments: list[str]) -> int:
    """All measurements; with a file's name they are written there as JSON too."""
    found: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory() as folder:
        with opened(Path(folder), *UNLIMITED) as page:
            found.append(said("solving 360 positions, all reactions", [page.run(_SOLVE)]))
            found += said_of_drag("drag with six curves", *traced(page.tab, _HANDLE))
            page.run(_GHOSTS)
            found += said_of_drag("drag over 500 ghost curves", *traced(page.tab, _HANDLE))
        with workbench(Path(folder), *UNLIMITED) as tab:
            found += said_of_drag("drag on the workbench, vectors and six curves", *traced(tab, _JOINT))
        with opened(Path(folder)) as page:
            found.append(said("playing, from frame to frame", page.tab.evaluate(_PLAY, [FRAMES])))
            page.run(_GHOSTS)
            found.append(said("playing over 500 ghost curves", page.tab.evaluate(_PLAY, [FRAMES])))
        found.append(said("a page opens from the disk", list(opening(Path(folder)))))
        found.append(said("studio, from the command to its picture", list(studio_opening(Path(folder)))))
    if arguments:
        Path(arguments[0]).write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
