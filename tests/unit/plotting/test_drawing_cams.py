"""A drawn cam: its profile touches the follower's drawn part at every position, nowhere deeper, and turns with it."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from tests import store
from tests.drawn_cams import CASES, text_of
from tests.every import every

import linkwright as lw
from linkwright.kinematics.placement import placements
from linkwright.mechanism.wheels_and_cams import CamShape
from linkwright.plotting.drawing.joint_marks import Mark, marks
from linkwright.plotting.drawing.vectors import force_vectors

BASE = 0.07


def drawn(held: dict[str, str], side: str, touch: str, sense: str) -> tuple[lw.Motion, Mark, Mark]:
    """A motion whose positions are among those that the drawn curves were taken at, and the marks of the joint."""
    mechanism = lw.loads(text_of(held, side, touch, sense))
    cam, end = marks(mechanism.joints["lobe"], mechanism, {})
    return lw.solve_motion(mechanism, steps=72), cam, end


def seen(motion: lw.Motion, link: str, *points: tuple[float, float]) -> np.ndarray:
    """Points (k, 2) of a link as complex places (n, k) in the frame."""
    placed = placements(motion)[link]
    return np.stack([placed.world(point) @ [1, 1j] for point in points], axis=1)


@pytest.mark.rotating
@pytest.mark.parametrize("sense", ["counterclockwise", "clockwise"])
@pytest.mark.parametrize(("held", "side"), CASES)
@pytest.mark.parametrize("touch", ["roller", "knife", "groove"])
def test_the_profile_touches_roller_and_knife(held: dict[str, str], side: str, touch: str, sense: str) -> None:
    motion, cam, end = drawn(held, side, touch, sense)
    profile, *others = (seen(motion, "cam", *line) for line in cam.outlines if line)
    at = seen(motion, "held", end.at)
    assert end.radius == (0.0 if touch == "knife" else 0.01)
    assert len(others) == {"knife": 0, "roller": 1, "groove": 2}[touch]
    if others:
        assert np.abs(others[0] - at).min(axis=1) == pytest.approx(0, abs=1e-9 * BASE)
    for wall in (profile, *others[1:]):
        assert np.abs(wall - at).min(axis=1) == pytest.approx(end.radius, abs=1e-9 * BASE)
    middle = seen(motion, "frame", motion.mechanism.frame.points["O"])
    assert np.abs(profile - middle).min(axis=1) == pytest.approx(BASE, abs=1e-9 * BASE)


@pytest.mark.parametrize("sense", ["counterclockwise", "clockwise"])
@pytest.mark.parametrize(("held", "side"), CASES)
def test_the_profile_touches_a_flat_face_within_its_ends(held: dict[str, str], side: str, sense: str) -> None:
    motion, cam, face = drawn(held, side, "flat", sense)
    start, end = (seen(motion, "held", place) for place in (face.at, face.to))
    middle = seen(motion, "frame", motion.mechanism.frame.points["O"])

    def from_face(places: np.ndarray) -> np.ndarray:
        return (places - start) / (end - start)

    profile, inward = from_face(seen(motion, "cam", *cam.outlines[0])), np.sign(from_face(middle).imag)
    depth = profile.imag * inward * np.abs(end - start)
    assert depth.min(axis=1) == pytest.approx(0, abs=1e-9 * BASE)
    contact = np.take_along_axis(profile.real, depth.argmin(axis=1)[:, None], axis=1)
    assert 0 < contact.min() < contact.max() < 1


@pytest.mark.parametrize(("held", "side"), CASES)
@pytest.mark.parametrize("touch", ["roller", "flat"])
def test_the_contact_force_is_drawn_through_the_contact(held: dict[str, str], side: str, touch: str) -> None:
    """Through the roller's centre, and at the point of the profile that is deepest in the face; without a couple."""
    heavy = text_of(held, side, touch, "clockwise").replace("held: {points", "held: {mass: 3 kg, inertia: 0, points")
    motion = lw.solve_motion(lw.loads(heavy + "gravity: [0, -9.81 m/s²]\n"), steps=72)
    forces = force_vectors(lw.solve_forces(motion), ["cam.lobe"])
    feet = forces.vectors[0].feet["cam.lobe"] @ [1, 1j]
    cam, end = marks(motion.mechanism.joints["lobe"], motion.mechanism, {})
    assert "cam.lobe" not in forces.torques[0].values
    if touch == "roller":
        assert feet == pytest.approx(seen(motion, "held", end.at)[:, 0], abs=1e-9 * BASE)
        return
    profile = seen(motion, "cam", *cam.outlines[0])
    assert np.abs(profile - feet[:, None]).min(axis=1) == pytest.approx(0, abs=1e-6 * BASE)


def test_the_printing_press_shows_its_cam_under_its_roller() -> None:
    motion = store.motion("printing_press", 10)
    mechanism = motion.mechanism
    cam, roller = marks(mechanism.joints["compensating_cam"], mechanism, {})
    assert (cam.link, roller.link, roller.radius) == ("bell_crank", "lower_rack", 0.02)
    shape = CamShape.of(mechanism.joints["compensating_cam"], mechanism)  # type: ignore[arg-type]
    placed = placements(motion)["bell_crank"]
    for index, centre in enumerate(seen(motion, "lower_rack", roller.at)[:, 0]):
        turned = complex(*placed.direction[index]).conjugate()
        at = (centre - complex(*placed.origin[index])) * turned

        def gap(phi: float, at: complex = at) -> float:
            return float(np.abs(shape.profile(np.array([phi]))[0] - at))

        near = 2 * np.pi * np.abs(np.array(cam.outlines[0]) @ [1, 1j] - at).argmin() / len(cam.outlines[0])
        best = minimize_scalar(gap, bounds=(near - 0.02, near + 0.02), method="bounded", options={"xatol": 1e-9})
        assert best.fun == pytest.approx(roller.radius, abs=1e-9 * 0.06)


@pytest.mark.parametrize(("held", "side"), CASES)
@pytest.mark.parametrize("touch", ["roller", "knife", "flat", "groove"])
def test_every_drawn_line_goes_round_the_cam_once(held: dict[str, str], side: str, touch: str) -> None:
    """By the angle that its points turn about the cam's centre, each a little from the one before."""
    mechanism = lw.loads(text_of(held, side, touch, "counterclockwise"))
    cam, _ = marks(mechanism.joints["lobe"], mechanism, {})
    centre = complex(*mechanism.links["cam"].points["O"])
    count = {"knife": 1, "flat": 1, "roller": 2, "groove": 3}[touch]
    for line in every(filter(len, cam.outlines), least=count):
        place = np.array(line) @ [1, 1j] - centre
        turned = np.angle(np.roll(place, -1) / place)
        assert abs(turned.sum()) == pytest.approx(2.0 * np.pi)
        assert np.abs(turned).max() < 0.1
