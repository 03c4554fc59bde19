"""Undercut of random cams against dense polygons."""

import numpy as np
import pytest
from tests.unit.cams.cam_offsets import disagreement, random_cam


@pytest.mark.rotating
def test_a_sample_of_random_cams_agrees_with_dense_polygons() -> None:
    """All of them: python -m tests.unit.cams.cam_offsets 1000."""
    rng = np.random.default_rng(7)
    cams = [random_cam(rng) for _ in range(7)]
    assert [told for cam in cams if (told := disagreement(cam))] == []
    assert 1 <= sum(bool(cam.found) for cam in cams) < 7
