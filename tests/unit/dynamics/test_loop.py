"""The compiled loop: motions and events against closed forms, each motion with its own numbers and times."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from linkwright.dynamics.loop import Action, Event, Layout, Loop, Motions, Outcome
from linkwright.formula.llvm_backend import available
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar, Trace, sin, sqrt

pytestmark = pytest.mark.skipif(not available(), reason="no llvmlite")
GRAVITY = 9.81


def of_one(
    acceleration: Callable[[Trace, Scalar, Scalar], Scalar], **others: Callable[[Trace, Scalar, Scalar], Scalar]
) -> Program:
    """One freedom of unit mass, ``others`` outputs by name."""
    t = Trace()
    q, w = t.position("q:x"), t.position("qd:x")
    second = acceleration(t, q, w)
    found = {name: output(t, q, w) for name, output in others.items()}
    return Program.of(t, {"qdd:x": second, "power": second * w, **found})


def pendulum() -> Program:
    """Of unit mass, its length an input."""
    return of_one(lambda t, q, w: -GRAVITY / t.position("length") * sin(q), q=lambda t, q, w: q, w=lambda t, q, w: w)


def swings(*events: Event, count: int = 21) -> tuple[Loop, Motions, np.ndarray]:
    """Pendulums of different lengths let go at 1.2 rad, and their periods 4 √(l/g) K(sin² of half the amplitude)."""
    loop = Loop(pendulum(), {}, Layout(["x"], events, inputs=["length"]))
    motions = loop.start(count)
    lengths = motions.inputs[:, 0] = np.linspace(0.2, 2.0, count)
    motions.state[:, 0], motions.until[:] = 1.2, 100.0
    return loop, motions, 4.0 * np.sqrt(lengths / GRAVITY) * ellipk(np.sin(0.6) ** 2)


def test_periods_of_pendulums_by_the_elliptic_integral() -> None:
    loop, motions, period = swings()
    motions.until[:] = period
    loop.advance(motions, relative=1e-12, absolute=1e-12)
    assert motions.outcomes == [Outcome.ENDED] * 21
    assert motions.time.tolist() == period.tolist()
    assert np.abs(motions.state - [1.2, 0.0, 0.0]).max() < 1e-11


@pytest.mark.parametrize(("output", "share"), [("q", 0.25), ("w", 0.5)])
def test_an_event_stops_each_pendulum_at_its_own_time(output: str, share: float) -> None:
    loop, motions, period = swings(Event(output))
    loop.advance(motions, relative=1e-12, absolute=1e-12)
    assert motions.outcomes == [Outcome.STOPPED] * 21
    assert motions.time == pytest.approx(share * period, rel=1e-12)
    assert np.abs(motions.state[:, "qw".index(output)]).max() < 1e-14
    motions.sides *= -1.0
    loop.advance(motions, relative=1e-12, absolute=1e-12)
    assert motions.time == pytest.approx((0.5 + share) * period, rel=1e-12)
    assert motions.times[:, 0].tolist() == motions.time.tolist()


def test_an_event_that_is_noted_does_not_stop() -> None:
    loop, motions, period = swings(Event("q", Action.NOTE))
    motions.until[:] = period
    loop.advance(motions, relative=1e-12, absolute=1e-12)
    assert motions.outcomes == [Outcome.ENDED] * 21
    assert motions.times[:, 0] == pytest.approx(0.25 * period, rel=1e-12)


def test_threads_change_no_bit() -> None:
    found = []
    for threads in (1, 2):
        loop, motions, _ = swings(Event("q", Action.NOTE), count=50)
        motions.until[:] = 2.0
        loop.advance(motions, threads=threads)
        found.append(motions.records)
    assert np.array_equal(*found, equal_nan=True)


def test_steps_and_states_are_those_of_scipy() -> None:
    """The same method: the same error at the same tolerance, and as many steps but for the first ones."""
    loop, motions, _ = swings(count=1)
    motions.until[:] = 3.0
    loop.advance(motions)
    there = solve_ivp(
        lambda t, y: [y[1], -GRAVITY / 0.2 * np.sin(y[0]), -GRAVITY / 0.2 * np.sin(y[0]) * y[1]],
        (0.0, 3.0), [1.2, 0.0, 0.0], method="DOP853", rtol=1e-9, atol=1e-9,
    )  # fmt: skip
    assert abs(motions.steps[0] - (len(there.t) - 1)) <= 4
    assert motions.state[0] == pytest.approx(there.y[:, -1], abs=2e-8)


def test_samples_at_given_times() -> None:
    """Vibration x = cos(√k t), the starts at rest at 1."""
    loop = Loop(of_one(lambda t, q, w: -t.position("stiffness") * q), {}, Layout(["x"], inputs=["stiffness"]))
    grid = np.linspace(0.0, 5.0, 37)
    motions = loop.start(11, len(grid))
    stiffness = motions.inputs[:, 0] = np.linspace(1.0, 30.0, 11)
    motions.state[:, 0], motions.until[:] = 1.0, 5.0
    motions.until[0] = 2.0
    loop.advance(motions, relative=1e-11, absolute=1e-11, grid=grid)
    angle = np.sqrt(stiffness)[:, None] * grid
    inside = grid <= motions.until[:, None]
    assert np.array_equal(np.isnan(motions.samples[:, :, 0]), ~inside)
    assert motions.samples[inside][:, 0] == pytest.approx(np.cos(angle)[inside], abs=2e-9)
    assert motions.samples[1:, -1] == pytest.approx(motions.state[1:], abs=1e-13)


def test_peaks_and_squares_of_watched_outputs() -> None:
    """|q''| of x = cos 3 t over a period: 9 at most, its square in the mean 81/2."""
    layout = Layout(["x"], watched=["second"])
    loop = Loop(of_one(lambda t, q, w: -9.0 * q, second=lambda t, q, w: -9.0 * q), {}, layout)
    motions = loop.start(1)
    motions.state[:, 0], motions.until[:] = 0.0, 2.0 * np.pi / 3.0
    motions.state[:, 1] = 3.0
    loop.advance(motions, relative=1e-11, absolute=1e-11, inside=15)
    assert motions.peaks[0, 0] == pytest.approx(9.0, rel=1e-3)
    assert motions.state[0, 3] / motions.time[0] == pytest.approx(40.5, rel=1e-9)


def test_a_ball_bounces_shorter_than_a_step() -> None:
    """Times and speeds of flights in a geometric series; the caller reflects at each event."""
    layout = Layout(["x"], [Event("height")])
    loop = Loop(of_one(lambda t, q, w: -GRAVITY + 0.0 * q, height=lambda t, q, w: q), {}, layout)
    motions = loop.start(1)
    motions.state[0, :2], motions.until[:], motions.sides[:] = (1.0, 0.0), 10.0, 1.0
    speed, time = np.sqrt(2.0 * GRAVITY), np.sqrt(2.0 / GRAVITY)
    for _bounce in range(20):
        loop.advance(motions)
        assert motions.outcomes == [Outcome.STOPPED]
        assert motions.time[0] == pytest.approx(time, rel=1e-13)
        assert motions.state[0, 1] == pytest.approx(-speed, rel=1e-9)
        speed *= 0.5
        time += 2.0 * speed / GRAVITY
        motions.state[0, 1] *= -0.5


def rubbing(push: float) -> tuple[Loop, Motions]:
    """A block on a rough plane, 2 m/s² of friction against its sense, which is a switch; pushed steadily."""

    def second(t: Trace, q: Scalar, w: Scalar) -> Scalar:
        return push - t.select(t.position("switch:0") > 0.5, 2.0, -2.0)

    layout = Layout(["x"], [Event("gap:0", Action.FLIP, "switch:0")], inputs=["switch:0"])
    loop = Loop(of_one(second, **{"gap:0": lambda t, q, w: w}), {}, layout)
    motions = loop.start(1)
    motions.state[0, 1], motions.inputs[:], motions.sides[:], motions.until[:] = 3.0, 1.0, 1.0, 4.0
    return loop, motions


def test_a_switch_goes_over_where_its_function_does() -> None:
    """Slowed by 3 + 2, then back by 3 − 2 m/s²."""
    loop, motions = rubbing(-3.0)
    loop.advance(motions)
    assert motions.outcomes == [Outcome.ENDED]
    assert motions.times[0, 0] == pytest.approx(0.6, rel=1e-14)
    assert motions.inputs[0, 0] == 0.0
    assert motions.state[0, :2] == pytest.approx([0.9 - 0.5 * 3.4**2, -3.4], rel=1e-13)


def test_what_sticks_is_said() -> None:
    loop, motions = rubbing(-1.0)
    loop.advance(motions)
    assert motions.outcomes == [Outcome.RETURNED]
    assert motions.event.tolist() == [0]
    assert motions.time[0] == pytest.approx(1.0, abs=1e-8)
    assert motions.state[0, :2] == pytest.approx([1.5, 0.0], abs=1e-8)


def test_where_there_is_no_position() -> None:
    """No start beyond x = 1; towards it the steps become small; too many steps are refused."""
    program = of_one(lambda t, q, w: sqrt(1.0 - q))
    loop = Loop(program, {}, Layout(["x"]))
    motions = loop.start(3)
    motions.state[:, 0], motions.until[:] = [2.0, 0.5, 0.0], [10.0, 10.0, 0.5]
    loop.advance(motions)
    assert motions.outcomes == [Outcome.NO_START, Outcome.TOO_SMALL, Outcome.ENDED]
    assert motions.state[1, 0] == pytest.approx(1.0, abs=1e-6)
    loop.advance(again := loop.start(1), most=3)
    assert again.outcomes == [Outcome.ENDED]
    again.until[:] = 1.0
    loop.advance(again, most=3)
    assert again.outcomes == [Outcome.TOO_MANY]


def test_room_for_samples_is_checked() -> None:
    loop = swings(count=1)[0]
    with pytest.raises(ValueError, match="samples"):
        loop.advance(Motions(loop.layout, 1, 2), grid=[0.0])
