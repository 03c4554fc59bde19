"""What a drag costs the browser's processor, and how smoothly ghost curves move: ``python -m tests.ui.pace``.

From a pointer's move to new curves the page's main thread works (script, style, layout, recording), threads fill the
picture and the compositor puts it together; a trace says how much processor time each takes for every move. This is
what a move needs where it waits for nothing, neither the display's next frame nor other programs, and fills pictures
without a graphics card. Beside it stand times by the clock from the move to the frame after it, which hold up to one
interval of the display (16.7 ms) and which a loaded machine makes longer.
"""

from __future__ import annotations

import sys
import tempfile
from bisect import bisect_right
from pathlib import Path
from typing import Any

from tests.ui.browser import Opened, browser

import linkwright as lw

MOVES, FRAMES, STEPS = 120, 120, 360
_DRAG = """async ([moves]) => {
  const s = linkwright.sessions[0], v = s.view, box = v.svg.getBoundingClientRect();
  const h = v.svg.querySelector('.handle[data-key="B"]'), found = [];
  const x0 = +h.getAttribute('cx') + box.left, y0 = +h.getAttribute('cy') + box.top;
  h.setPointerCapture = () => {};
  const send = (kind, x, y) => h.dispatchEvent(new PointerEvent(kind,
    {bubbles: true, clientX: x, clientY: y, pointerId: 1, buttons: 1}));
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
  }
  send('pointerup', x0, y0);
  return found;
}"""
_PLAY = """async ([frames]) => {
  linkwright.play(true);
  const times = [];
  for (let k = 0; k < frames; k++) times.push(await new Promise(requestAnimationFrame));
  linkwright.play(false);
  return times.slice(1).map((t, k) => t - times[k]);
}"""


def measured(page: Opened, script: str, count: int) -> list[float]:
    """Sorted times by the clock (ms) of the script's parts."""
    return sorted(page.tab.evaluate(script, [count]))


def traced(page: Opened) -> tuple[list[float], dict[str, list[float]]]:
    """The same for a drag, and processor times (ms) of every move by what works: page, filling, compositor."""
    client = page.tab.context.browser.new_browser_cdp_session()
    events: list[dict[str, Any]] = []
    ended: list[bool] = []
    client.on("Tracing.dataCollected", lambda found: events.extend(found["value"]))
    client.on("Tracing.tracingComplete", lambda _: ended.append(True))
    categories = [
        "devtools.timeline",
        "disabled-by-default-devtools.timeline",
        "toplevel",
        "cc",
        "viz",
        "__metadata",
    ]
    config = {"includedCategories": categories}
    client.send("Tracing.start", {"transferMode": "ReportEvents", "traceConfig": config})
    times = measured(page, _DRAG, MOVES)
    client.send("Tracing.end")
    while not ended:
        page.tab.wait_for_timeout(50)
    return times, _by_move(events)


_WORKERS = {"CrRendererMain": "page", "ThreadPoolForegroundWorker": "filling"}
_COMPOSITORS = ("Compositor", "VizCompositorThread")


def _by_move(events: list[dict[str, Any]]) -> dict[str, list[float]]:
    """Processor times of the outermost pieces of work, between the marks of the moves."""
    marks = [each for each in events if each["name"] == "TimeStamp"]
    threads = {
        (each["pid"], each["tid"]): each["args"]["name"]
        for each in events
        if each["name"] == "thread_name" and each.get("ph") == "M"
    }
    own, begins = marks[0]["pid"], sorted(each["ts"] for each in marks)
    found = {name: [0.0] * len(begins) for name in ("page", "filling", "compositor")}
    inside: dict[tuple[int, int], float] = {}
    for each in sorted((e for e in events if "tdur" in e), key=lambda e: (e["ts"], -e["dur"])):
        thread, key = threads.get((each["pid"], each["tid"]), ""), (each["pid"], each["tid"])
        work = "compositor" if thread in _COMPOSITORS else _WORKERS.get(thread)
        move = bisect_right(begins, each["ts"]) - 1
        if work is None or move < 0 or each["ts"] < inside.get(key, 0.0):
            continue
        if each["pid"] == own or work == "compositor":
            inside[key] = each["ts"] + each["dur"]
            found[work][move] += each["tdur"] / 1e3
    return found


def said(title: str, times: list[float]) -> str:
    """A title with the median and the 95th percentile."""
    ordered = sorted(times)
    middle, late = ordered[len(ordered) // 2], ordered[int(0.95 * len(ordered))]
    return f"{title}: median {middle:.1f} ms, 95th percentile {late:.1f} ms"


def said_of_drag(title: str, found: tuple[list[float], dict[str, list[float]]]) -> str:
    """All of a drag: each kind of work, their sum, and the clock."""
    clock, work = found
    parts = [f"  {said(name, times)}" for name, times in work.items()]
    whole = [sum(each) for each in zip(*work.values(), strict=True)]
    return "\n".join(
        [
            f"{title}, processor time of a move",
            *parts,
            f"  {said('together', whole)}",
            f"  {said('by the clock', clock)}",
        ]
    )


def main() -> int:
    """The six-bar crusher with all reactions and six curves open: a drag, then playing over 500 ghost curves."""
    with browser() as chromium, tempfile.TemporaryDirectory() as folder:
        document = lw.read_document("gallery:jaw_crusher_sixbar")
        motion = lw.solve_motion(document.mechanism, steps=STEPS)
        path = lw.export(motion, Path(folder) / "page.html", text=document.text)
        page = Opened(chromium.new_context(viewport={"width": 1280, "height": 900}).new_page())
        page.open(path)
        page.run("s => { s.curves.value = s.data.signals.slice(-6).map(x => x.id); s.shown.paths.add('B'); }")
        measured(page, _DRAG, 30)
        print(said_of_drag("drag with six curves", traced(page)))
        print(said("playing", measured(page, _PLAY, FRAMES)))
        page.run(
            "s => s.view.ghosts(Array.from({length: 500}, (_, k) => ['x', 'y'].map(a =>"
            " s.model.main.row('p:B.' + a).map(v => v + 0.0005 * (k - 250))).reduce((x, y) => ({x, y}))))"
        )
        print(said("playing over 500 ghost curves", measured(page, _PLAY, FRAMES)))
        print(said_of_drag("drag over 500 ghost curves", traced(page)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
