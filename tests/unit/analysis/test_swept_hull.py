"""The hull of curves that are placed here, finely sampled."""

from math import pi

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from linkwright.analysis.swept_hull import Curves, SweptHull
from linkwright.curves.curve import nodes


@pytest.mark.parametrize("pieces", [24, 25])
@pytest.mark.parametrize("phase", [0.0, 0.25, 0.4])
def test_areas_and_gradients_of_curves_that_turn_back_within_a_way(pieces: int, phase: float) -> None:
    """An arc and a bow, run to and fro: their hull, finely sampled, and its change with another shape of both."""

    def bent(angle: np.ndarray, share: float) -> tuple[np.ndarray, np.ndarray]:
        x, y = np.cos(angle) + share * np.sin(angle), (1.0 + 2.0 * share) * np.sin(angle)
        bow = 0.3 * angle**2 - 1.0 - share * angle, 0.5 + angle + share * angle**2
        return np.stack([x, y]), np.stack(bow)

    def hull(share: float) -> float:
        both = np.concatenate(bent(np.linspace(-1.2, 1.2, 40_001), share), axis=1)
        return float(ConvexHull(both.T).volume)

    angle = 1.2 * np.sin(2.0 * pi * nodes(np.linspace(0.0, 1.0, pieces + 1)).T + phase)
    never, step = np.zeros(pieces, dtype=bool), 1e-4
    values, ahead, behind = (np.stack(bent(angle, share)) for share in (0.0, step, -step))
    found = SweptHull(Curves(values, never, never, np.tile([0, angle.size], (2, 1))), [0, 1])
    assert found.area == pytest.approx(hull(0.0), rel=2e-8)
    slope = float((found.weights() * (ahead - behind)).sum()) / (2.0 * step)
    assert slope == pytest.approx((hull(step) - hull(-step)) / (2.0 * step), rel=1e-6)
