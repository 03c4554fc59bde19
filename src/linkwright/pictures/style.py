"""Colours, strokes and fonts of drawings; every class begins with ``lw-``."""

from __future__ import annotations

from linkwright.pictures.svg.text import FAMILY_LIST
from linkwright.pictures.symbols.base import LINE

INK, GROUND, BLUE, RED, GREEN, ORANGE, PURPLE, TEAL = (
    "#1c2733", "#5b6672", "#1565c0", "#c62828", "#2e7d32", "#d9730d", "#7b1fa2", "#00838f",
)  # fmt: skip
COLOURS = (INK, GROUND, BLUE, RED, GREEN, ORANGE, PURPLE, TEAL)


def arrow_rules(name: str, colour: str, width: float = 2.0) -> str:
    """The rules of an arrow's line, head and name."""
    return (
        f".lw-{name}-line{{fill:none;stroke:{colour};stroke-width:{width}}}"
        f".lw-{name}-head{{fill:{colour};stroke:none}}.lw-{name}-name{{fill:{colour};font-style:italic}}"
    )


CSS = "".join((
    ".lw-paper{fill:#fff}",
    f".lw-bar,.lw-spring{{fill:none;stroke:{INK};stroke-linecap:round;stroke-linejoin:round}}",
    f".lw-bar{{stroke-width:{LINE}}}.lw-spring{{stroke-width:1.5}}",
    f".lw-plate{{fill:#c3d5e8;fill-opacity:.6;stroke:{INK};stroke-width:2;stroke-linejoin:round}}",
    f".lw-block{{fill:#f3f6f9;stroke:{INK};stroke-width:2;stroke-linejoin:round}}",
    f".lw-pin,.lw-mass-ring{{fill:#fff;stroke:{INK};stroke-width:1.8}}",
    f".lw-point,.lw-weld,.lw-mass{{fill:{INK}}}",
    f".lw-support,.lw-rim{{fill:#fff;stroke:{INK};stroke-width:1.6;stroke-linejoin:round}}",
    f".lw-ground{{fill:none;stroke:{INK};stroke-width:1.8;stroke-linecap:round}}",
    f".lw-hatch{{fill:none;stroke:{GROUND};stroke-width:1}}",
    f".lw-strand{{fill:none;stroke:{INK};stroke-width:1.6}}",
    f".lw-pitch{{fill:none;stroke:{GROUND};stroke-width:.9;stroke-dasharray:9 2.5 1.5 2.5}}",
    f".lw-gear{{fill:#eef3f8;stroke:{INK};stroke-width:1.4;stroke-linejoin:round}}",
    f".lw-dimension{{fill:none;stroke:{GROUND};stroke-width:1}}.lw-dimension-head{{fill:{GROUND}}}",
    ".lw-trace{fill:none;stroke:#1565c0;stroke-width:1.3;stroke-opacity:.8;stroke-linejoin:round}",
    ".lw-trace-1{stroke:#2e7d32}.lw-trace-2{stroke:#d9730d}.lw-trace-3{stroke:#7b1fa2}",
    ".lw-dot{fill:#1565c0}",
    ".lw-leader{fill:none;stroke:#9aa4ae;stroke-width:.8}",
    arrow_rules("input", ORANGE),
    arrow_rules("force", RED),
    arrow_rules("load", PURPLE, 2.4),
    f".lw-load-ring{{fill:#fff;stroke:{PURPLE};stroke-width:1.6}}",
    f".lw-load-thin{{fill:none;stroke:{PURPLE};stroke-width:1.6}}",
    ".lw-load-dashed{stroke-dasharray:6 4}",
    arrow_rules("driver", TEAL, 2.4),
    arrow_rules("weight", GREEN),
    arrow_rules("inertia", BLUE),
    arrow_rules("velocity", BLUE),
    arrow_rules("acceleration", GREEN),
    f"text{{font-family:{FAMILY_LIST}}}",
    f".lw-name{{fill:{INK};font-style:italic}}.lw-link{{fill:#52606d}}.lw-value{{fill:{GROUND}}}",
    f".lw-legend{{fill:{INK}}}.lw-axis{{fill:none;stroke:{GROUND};stroke-width:1}}",
    f".lw-flow{{fill:#fff;stroke:{INK};stroke-width:1.5;stroke-linejoin:round}}.lw-flow-call{{font-weight:bold}}",
    f".lw-flow-line{{fill:none;stroke:{INK};stroke-width:1.3}}.lw-flow-head{{fill:{INK}}}",
    ".lw-short path{stroke-dasharray:3 2.2}.lw-rule{fill:none;stroke:#9aa4ae;stroke-width:.9}",
    ".lw-faded{opacity:.28}",
    ".lw-dashed{opacity:.62}.lw-dashed path,.lw-dashed circle{stroke-dasharray:5 3.5;fill-opacity:.25}",
))  # fmt: skip
