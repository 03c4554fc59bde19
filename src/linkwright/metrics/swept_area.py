"""Room that the mechanism needs."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import ClassVar

import numpy as np

from linkwright.core.outputs import row_names
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue, Remark
from linkwright.metrics.plane import area, convex_hull
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
        moving = dict.fromkeys(chain.from_iterable(keys.values()))
        motion.evaluate_together(chain.from_iterable(row_names("position", key) for key in moving))
        tracks = {key: _track(motion, key) for key in moving}
        hulls = {name: convex_hull(np.vstack([tracks[key] for key in own])) for name, own in keys.items()}
        frame = np.array(list(motion.mechanism.frame.points.values())).reshape(-1, 2)
        whole = convex_hull(np.vstack([*hulls.values(), frame]))
        width, height = (shown(float(side), "length") for side in np.ptp(whole, axis=0))
        remark = Remark("swept_area.box", {"width": width, "height": height})
        yield self.value(analysis, motion.mechanism.name, area(whole), remarks=(remark,), exact=False)
        for name, corners in hulls.items():
            yield self.value(analysis, name, area(corners), exact=False)


def _track(motion: Motion, key: str) -> Floats:
    """The places of a point, (n, 2) m; one where it is at rest."""
    places: Floats = motion.vector("position", key)[motion.ok]
    return places[:1] if (places == places[0]).all() else places
