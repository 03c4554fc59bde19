"""Makes the pictures of this folder: ``python docs/pictures/make.py``."""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import linkwright as lw
from linkwright.pictures.drawing import bounds, document
from linkwright.pictures.picture import Text, as_runs
from linkwright.pictures.svg import group
from linkwright.pictures.symbols.base import SYMBOLS
from linkwright.plotting.animation import animate
from linkwright.plotting.drawing import draw

HERE = Path(__file__).parent
STILL: dict[str, tuple[str, dict[str, Any]]] = {
    "jaw_crusher": ("jaw_crusher_sixbar", {"overlay": "limits", "at": 0.0}),
    "jaw_crusher_forces": ("jaw_crusher_sixbar", {"at": 2.0, "forces": True}),
    "crank_rocker": ("crank_rocker", {"overlay": "faded:8", "paths": ("P",)}),
    "swing_conveyor": ("swing_conveyor", {"overlay": "limits", "dimensions": ("crank", "coupler", "rod")}),
    "swing_conveyor_velocities": ("swing_conveyor", {"velocities": True}),
    "excavator": ("excavator", {}),
    "oldham_coupling": ("oldham_coupling", {"at": 0.5}),
    "scotch_yoke": ("scotch_yoke", {"at": 0.8, "overlay": "faded:4"}),
    "shaper_quick_return": ("shaper_quick_return", {"overlay": "limits"}),
    "triad": ("triad", {}),
}
MOVING: dict[str, tuple[str, dict[str, Any]]] = {
    "jaw_crusher_moving": ("jaw_crusher_sixbar", {"paths": ("C",), "forces": True, "curves": ("jaw.angle",)}),
    "theo_jansen_leg_moving": ("theo_jansen_leg", {"paths": ("leg.T",), "frames": 36}),
}


def symbols(columns: int = 5, wide: float = 150.0, high: float = 120.0) -> str:
    """A table of all symbols with their names, as SVG text."""
    content = []
    names = sorted(SYMBOLS)
    for k, name in enumerate(names):
        shape = SYMBOLS[name]()
        left, top, right, bottom = bounds(shape.ink)
        x, y = (k % columns + 0.5) * wide, (k // columns + 0.42) * high
        shift = f"translate({x - (left + right) / 2:.2f} {y - (top + bottom) / 2:.2f})"
        content.append(group(shape.elements, transform=shift))
        content.append(Text((x, y + 0.46 * high), as_runs(name.replace("_", " ")), "lw-link", 12.0, "middle"))
    box = (0.0, 0.0, columns * wide, -(-len(names) // columns) * high)
    return document(content, box, "Symbols", None)


def sheet(model: str, size: tuple[float, float]) -> None:
    """Writes the first sheet with the plates of a machine, its size in m."""
    with TemporaryDirectory() as folder:
        files = lw.cut_parts(lw.load(f"gallery:{model}")).save(folder, ["svg"], sheet=size)
        first = next(each for each in files if each.name.startswith("sheet-1"))
        (HERE / f"{model}_sheet.svg").write_bytes(first.read_bytes())


def main() -> None:
    """Writes every picture."""
    (HERE / "symbols.svg").write_text(symbols(), encoding="utf-8")
    lw.gear_pair((12, 24), 3e-3, profile_shift=(0.6, 0.36)).draw(0.1).save(HERE / "gear_pair.svg", force=True)
    sheet("theo_jansen_leg", (0.12, 0.1))
    for kind in ("side", "exploded"):
        view = lw.plot(lw.layers(lw.load("gallery:theo_jansen_leg")), kind, title="")
        view.save(HERE / f"theo_jansen_leg_{kind}.svg", force=True)
    for name, (model, options) in STILL.items():
        draw(lw.load(f"gallery:{model}"), **options).save(HERE / f"{name}.svg", force=True)
    for name, (model, options) in MOVING.items():
        motion = lw.solve_motion(lw.load(f"gallery:{model}"), steps=180)
        animate(motion, **options).save(HERE / f"{name}.svg", force=True)


if __name__ == "__main__":
    main()
