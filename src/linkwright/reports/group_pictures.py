"""Pictures of Assur groups, each separate from the machine, which is drawn faded behind it."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.core.arrays import Floats
from linkwright.elements.topology import Group
from linkwright.pictures.drawing import Sketch, bounds, document
from linkwright.pictures.svg import group, natural_size
from linkwright.plotting.drawing.draw import laid_out_with_ghosts
from linkwright.plotting.drawing.machine import Part
from linkwright.plotting.drawing.scene import Scene, Shown, point_labels
from linkwright.reports.machine_results import ReportContext


def group_picture(case: ReportContext, chosen: Group) -> str:
    """SVG of one group at the worked position, with its joints, the rest of the machine faded."""
    motion, index = case.worked_motion
    scene, place, _ = laid_out_with_ghosts(motion, Shown(motion, index), (), inputs=False, centres=False)
    own = Scene(scene.machine, tuple(part for part in scene.parts if _belongs(scene, part, chosen)))
    sketch = Sketch()
    ink = own.ink(place)
    sketch.draw([group(scene.at(place), "lw-faded"), *own.at(place)], ink)
    names = {connection.joint for connection in chosen.joints}
    inside = bounds(ink)
    sketch.labels = [
        label
        for label in point_labels(scene.machine, place)
        if label.point.partition(".")[0] in chosen.links or label.text in names
    ]
    sketch.write_names()
    box = bounds([*_corners(inside), *sketch.extent])
    return str(document(sketch.content, box, chosen.name, None))


def to_one_scale(pictures: Sequence[str]) -> tuple[tuple[str, float], ...]:
    """Pictures with the shares of the page's width that show them all to one scale, two or more in a row."""
    most = 0.48 if len(pictures) <= 4 else 0.31 if len(pictures) <= 9 else 0.23
    widths = [natural_size(svg)[0] for svg in pictures]
    return tuple((svg, most * width / max(widths)) for svg, width in zip(pictures, widths, strict=True))


def _belongs(scene: Scene, part: Part, chosen: Group) -> bool:
    """Whether a part is of the group's links, or one of its pins that another link carries."""
    if part.carrier in chosen.links:
        return part.layer != "marks"
    if part.layer not in ("pins", "blocks") or not part.shape.ink:
        return False
    machine = scene.machine
    pins = [
        machine.local(part.carrier, c.joint)
        for c in chosen.joints
        if c.joint in machine.pins and part.carrier in machine.pins[c.joint].joined
    ]
    cloud = part.shape.ink[0]
    middle = (cloud.min(axis=0) + cloud.max(axis=0)) / 2.0
    return any(abs(middle[0] - x) < 1.0 and abs(middle[1] - y) < 1.0 for x, y in pins)


def _corners(box: tuple[float, float, float, float]) -> list[Floats]:
    from linkwright.pictures.symbols.base import points

    left, top, right, bottom = box
    return [points([(left - 10.0, top - 10.0), (right + 10.0, bottom + 10.0)])]
