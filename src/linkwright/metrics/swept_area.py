"""Room that the mechanism needs."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import ClassVar

import numpy as np

from linkwright.core.outputs import row_names
from linkwright.kinematics.motion import Motion
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue, Remark
from linkwright.metrics.plane import Places, area, convex_hull
from linkwright.metrics.quantities import shown


@METRICS.register("swept_area")
class SweptArea(Metric):
    """Area of the convex hull of all points of the links over all positions, m²: an upper bound of the swept area."""

    name = "swept_area"
    dimension = "area"
    source = "convex hull by Andrew's monotone chain"
    better: ClassVar[Better | None] = "lower"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        motion = analysis.motion
        if not motion.ok.any():
            return
        keys = {
            name: [motion.point(f"{name}.{point}").name for point in link.points]
            for name, link in motion.mechanism.links.items()
        }
        tracks = _tracks(motion, tuple(dict.fromkeys(chain.from_iterable(keys.values()))))
        hulls = {
            name: convex_hull(np.concatenate([tracks[key] for key in own])) for name, own in keys.items()
        }
        frame = [complex(*place) for place in motion.mechanism.frame.points.values()]
        whole = convex_hull(np.concatenate([*hulls.values(), frame]))
        width, height = (shown(float(np.ptp(side)), "length") for side in (whole.real, whole.imag))
        remark = Remark("swept_area.box", {"width": width, "height": height})
        yield self.value(analysis, motion.mechanism.name, area(whole), remarks=(remark,), exact=False)
        for name, corners in hulls.items():
            yield self.value(analysis, name, area(corners), exact=False)


def _tracks(motion: Motion, keys: tuple[str, ...]) -> dict[str, Places]:
    """The places of points, (n,) m; one where a point is at rest."""
    names = tuple(name for key in keys for name in row_names("position", key))
    rows = np.array(motion.rows.fetch(names, motion.evaluate))[:, motion.ok]
    places = rows[::2] + 1j * rows[1::2]
    moving = (places != places[:, :1]).any(axis=1).tolist()
    return {key: row if moves else row[:1] for key, row, moves in zip(keys, places, moving, strict=True)}
