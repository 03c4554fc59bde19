"""Long work tells how far it is: often, in order, to the end, and with the same results as without."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.course_sheets import FOUR_BAR
from tests.every import every

import linkwright as lw

LENGTHS = np.linspace(1.2, 1.3, 400)


def told(work: Callable[[], object]) -> tuple[object, list[tuple[int, int]]]:
    """What work gives, and what it tells."""
    calls: list[tuple[int, int]] = []
    with lw.reporting(lambda done, total: calls.append((done, total))):
        return work(), calls


def columns_of(found: object) -> dict[str, np.ndarray]:
    return dict(found.columns())


@pytest.mark.parametrize(
    ("name", "vary", "outputs"),
    [
        ("jaw_crusher_sixbar", {"pitman.length": LENGTHS}, ["jaw.angle range"]),
        ("jaw_crusher_sixbar", {"pitman.length": LENGTHS}, ["driver.effort rms"]),
        ("jaw_crusher_sixbar", {"pitman.length": np.linspace(1.2, 1.3, 600)}, ["flywheel", "jaw.angle max"]),
        ("triad", {"crank.A.x": np.linspace(0.98, 1.0, 60)}, []),
        ("kite", {"crank.mass": np.linspace(1.0, 2.0, 60)}, ["driver.effort rms"]),
    ],
)
def test_a_sweep_tells_of_its_designs_and_finds_the_same_bits(
    name: str, vary: dict[str, np.ndarray], outputs: list[str]
) -> None:
    mechanism = store.machine(name)
    if name == "triad":
        vary = {a: mechanism.dimension(a) * column for a, column in vary.items()}
        outputs = ["crank.angular_velocity max"]
    count = len(next(iter(vary.values())))
    found, calls = told(lambda: lw.sweep(mechanism, vary, outputs=outputs))
    alone = columns_of(lw.sweep(mechanism, vary, outputs=outputs))
    near = 1e-13 if "flywheel" in outputs else 0.0  # blocks of other sizes, sums by other instructions
    assert all(
        np.allclose(alone[key], each, rtol=near, atol=0.0, equal_nan=True)
        for key, each in every(columns_of(found).items())
    )
    together = outputs == ["driver.effort rms"] and name != "kite"  # one piece of so few
    assert len(calls) > (0 if together else 1) and {total for _, total in calls} == {count}
    assert [done for done, _ in calls] == sorted(done for done, _ in calls) and calls[-1][0] == count


def test_studies_parts_comparisons_and_courses_tell_it(tmp_path: Path) -> None:
    crusher = store.machine("jaw_crusher_sixbar")
    few = {"pitman.length": np.linspace(1.2, 1.3, 40)}
    both = ["gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"]
    hard = {"outputs": [0.0, 0.26, 0.73], "transmission_angle": 1.5, "least_squares": True}
    for work in (
        lambda: lw.study(crusher, {"pitman.length": "1.2..1.3 m:40"}),
        lambda: lw.sweep_parts(crusher, few, tmp_path / "parts", outputs=["jaw.angle range"], part=16),
        lambda: lw.compare(both, metrics=["mean_power", "peak_input_torque"]),
        lambda: lw.variants(lw.loads(FOUR_BAR), 3),
        lambda: lw.report(crusher, sections=["structure", "method"]),
    ):
        _, calls = told(work)
        shares = [done / total for done, total in calls]
        assert len(calls) > 1 and shares == sorted(shares) and shares[-1] > 0.4
    _, calls = told(lambda: lw.function_generation([0.0, 0.35, 0.7], **hard))
    assert len(calls) > 10


def test_a_function_s_own_callback_goes_before_the_surrounding_one() -> None:
    own: list[int] = []
    crusher = store.machine("jaw_crusher_sixbar")
    vary = {"pitman.length": LENGTHS[:20]}
    _, calls = told(
        lambda: lw.sweep(crusher, vary, outputs=["jaw.angle range"], progress=lambda done, _: own.append(done))
    )
    assert own[-1] == 20 and not calls


def test_what_the_callback_raises_stops_the_work() -> None:
    def stop(done: int, total: int) -> None:
        raise KeyboardInterrupt

    crusher = store.machine("jaw_crusher_sixbar")
    with pytest.raises(KeyboardInterrupt), lw.reporting(stop):
        lw.sweep(crusher, {"pitman.length": LENGTHS}, outputs=["jaw.angle range"])
