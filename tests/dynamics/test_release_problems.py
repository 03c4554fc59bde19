"""Accelerations and joint forces of machines that are released, against answers by hand."""

from __future__ import annotations

import numpy as np
import pytest
from tests.dynamics.release_problems import PROBLEMS, compare
from tests.multibody import FreeMultibody
from tests.reference.geared import Geared
from tests.reference.multibody import Array

import linkwright as lw


@pytest.mark.parametrize("made", PROBLEMS, ids=lambda made: made.__name__)
def test_the_independent_integration_gives_the_answers(made) -> None:  # type: ignore[no-untyped-def]
    problem = made()
    owner = FreeMultibody(lw.loads(problem.text))
    found = owner.run(owner.start(rates=problem.rates), np.zeros(1))
    forces, beside = found.pressed if isinstance(owner.system, Geared) else (found.forces, {})

    def acceleration(link: str, point: str) -> Array:
        return found.motion.point(link, owner.mechanism.links[link].points[point])[2][0]

    def force(joint: str, link: str) -> Array:
        more = [wrench.force[0] for wrench in beside.get(joint, ()) if wrench.body == link]
        return forces.on(joint, link)[0][0] + np.sum(more, axis=0)

    compare(problem, lambda link: float(found.motion.angle(link)[2][0]), acceleration, force)
