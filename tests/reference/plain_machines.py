"""Machines of pins, guides and welds: those of the gallery, and batches of random ones."""

from __future__ import annotations

import numpy as np
import pytest
from tests import store
from tests.reference.multibody import Array

KNOWN = {"revolute", "prismatic", "weld"}
#: Those with wheels are in test_geared_mechanisms, cams in test_cam_joints.
GALLERY = [name for name in store.names() if {each.kind for each in store.machine(name).joints.values()} <= KNOWN]
BATCH = 25
#: The first batch is met every day.
BATCHES = [pytest.param(k, marks=pytest.mark.rotating if k else ()) for k in range(100 // BATCH)]


def gallery_inputs(name: str) -> Array | None:
    """Driver coordinates where not the whole cycle is meant: a change point itself has no answer."""
    return np.radians(np.arange(0, 175, 5)) if name == "change_point_fourbar" else None
