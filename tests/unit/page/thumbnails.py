"""Small drawings of gallery machines for an empty sheet: ``python -m tests.unit.page.thumbnails`` writes them."""

from __future__ import annotations

import json
from pathlib import Path

import linkwright as lw
from linkwright.files.model_file import gallery_names
from linkwright.server import thumbnail
from linkwright.server.thumbnail import STEPS, Stroke

FILE = Path(__file__).parents[3] / "ui" / "src" / "studio" / "sheet" / "machines.ts"
#: Machines with the position of 24 that is drawn.
MACHINES = {
    "crank_rocker": 5,
    "slider_crank_offset": 4,
    "toggle_press": 9,
    "theo_jansen_leg": 3,
    "shaper_quick_return": 5,
}
HEAD = "// Small drawings of gallery machines, written by tests/unit/page/thumbnails.py: styles and strokes.\n"


def written() -> str:
    """The file of the front end."""
    drawings = {name: strokes(name, position) for name, position in MACHINES.items()}
    lines = [f"  {name}: {json.dumps(found, ensure_ascii=False)}," for name, found in drawings.items()]
    kind = "Record<string, [style: string, d: string][]>"
    count = f"/** How many machines the gallery has. */\nexport const GALLERY = {len(gallery_names())};\n"
    return f"{HEAD}export const MACHINES: {kind} = {{\n" + "\n".join(lines) + "\n};\n" + count


def strokes(name: str, index: int) -> list[Stroke]:
    """A machine at one position, in pixels."""
    return thumbnail.strokes(lw.solve_motion(lw.read_document(f"gallery:{name}").mechanism, steps=STEPS), index)


if __name__ == "__main__":
    FILE.write_text(written(), encoding="utf-8")
