"""How long a drag takes the browser's processor, and how smoothly ghost curves move: ``python -m tests.ui.pace``.

Beside the times by the clock, which a loaded machine makes longer, stands the processor time of the page's process
(scripts, style, layout, recording and filling of pictures) and of the one that puts them together. A frame of 60 a
second has 16.7 ms.
"""

from __future__ import annotations

import sys
import tempfile
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


def _spent(client: Any) -> dict[str, float]:
    """Processor time so far of the page's process and of the one that paints, s."""
    found: dict[str, float] = {}
    for each in client.send("SystemInfo.getProcessInfo")["processInfo"]:
        found[each["type"]] = found.get(each["type"], 0.0) + each["cpuTime"]
    return {"page": found.get("renderer", 0.0), "painting": found.get("GPU", 0.0)}


def measured(page: Opened, script: str, count: int) -> tuple[list[float], dict[str, float]]:
    """Sorted times (ms) of the script's parts, and the processor's mean for each by process (ms)."""
    client = page.tab.context.browser.new_browser_cdp_session()
    before = _spent(client)
    times = page.tab.evaluate(script, [count])
    after = _spent(client)
    return sorted(times), {name: 1e3 * (after[name] - before[name]) / count for name in after}


def said(title: str, found: tuple[list[float], dict[str, float]]) -> str:
    times, mean = found
    middle, late = times[len(times) // 2], times[int(0.95 * len(times))]
    parts = ", ".join(f"{name} {mean[name]:.2f} ms" for name in mean)
    return f"{title}: median {middle:.1f} ms, 95th percentile {late:.1f} ms; processor a step: {parts}"


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
        print(said("drag with six curves", measured(page, _DRAG, MOVES)))
        print(said("playing", measured(page, _PLAY, FRAMES)))
        page.run(
            "s => s.view.ghosts(Array.from({length: 500}, (_, k) => ['x', 'y'].map(a =>"
            " s.model.main.row('p:B.' + a).map(v => v + 0.0005 * (k - 250))).reduce((x, y) => ({x, y}))))"
        )
        print(said("playing over 500 ghost curves", measured(page, _PLAY, FRAMES)))
        print(said("drag over 500 ghost curves", measured(page, _DRAG, MOVES)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
