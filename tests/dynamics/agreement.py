"""What `lw.run` finds against the independent integration of the same machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from tests.multibody import FreeMotion, FreeMultibody, Loading, Rotor
from tests.reference.agreement import Comparison, floors, force_floors, motion_comparison
from tests.reference.geared import Geared

import linkwright as lw


def by_multibody(
    mechanism: lw.Mechanism,
    times: Sequence[float],
    *,
    at: Mapping[str, float] | None = None,
    speed: Mapping[str, float] | None = None,
    prescribed: Sequence[str] = (),
    loading: Sequence[Loading] = (),
    rotors: Sequence[Rotor] = (),
    rtol: float = 1e-12,
) -> FreeMotion:
    """The independent integration, begun as a run is."""
    owner = FreeMultibody(mechanism, prescribed=prescribed, loading=loading, rotors=rotors)
    return owner.run(owner.start(at, speed), np.asarray(times), rtol=rtol)


def disagreements(
    found: lw.Run,
    expected: FreeMotion,
    *,
    within: float = 1e-9,
    forces_within: float = 1e-8,
    unlike: Mapping[str, float] | None = None,
) -> list[str]:
    """What of motion and joint forces differs by more than the tolerance, relative to the largest of its kind;
    ``unlike``: tolerances of kinds of their own."""
    mechanism, motion = expected.owner.mechanism, found.motion(times=expected.time)
    compared = motion_comparison(mechanism, motion, expected.motion, derived=False)
    least = floors(mechanism, expected.motion)
    limits = dict.fromkeys(compared.pairs, within) | dict(unlike or {})
    lines = [line for kind in compared.pairs for line in _only(compared, kind).failures(limits[kind], least)]
    if expected.owner.system.redundant or mechanism.higher:
        return lines
    return lines + joint_forces(found, expected).failures(forces_within, force_floors(expected.forces))


def joint_forces(found: lw.Run, expected: FreeMotion) -> Comparison:
    """The forces on every link of every joint."""
    forces, compared = found.joint_forces(times=expected.time), Comparison()
    assert not isinstance(expected.owner.system, Geared)
    for joint in expected.owner.mechanism.joints.values():
        for link in joint.joined:
            own = forces.reaction(joint.name, on=link)
            compared.add("force", f"{joint.name} on {link}", own, expected.forces.on(joint.name, link)[0])
    return compared


def _only(compared: Comparison, kind: str) -> Comparison:
    one = Comparison()
    one.pairs = {kind: compared.pairs[kind]}
    return one
