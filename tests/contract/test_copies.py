"""Every public result can be copied and pickled, and what comes back gives the same numbers."""

import copy
import dataclasses
import pickle
from collections.abc import Callable
from functools import cache, partial
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.contract.calculations import solved
from tests.public import PUBLIC

import linkwright as lw
from linkwright import parts
from linkwright.analysis import coupler_curve
from linkwright.validation.validate import from_gallery


def crusher(steps: int = 24) -> lw.Forces:
    return store.forces("jaw_crusher_sixbar", steps)


def triad() -> lw.Forces:
    return store.forces("stephenson_sixbar_triad", 24)


def broken() -> lw.Motion:
    """A motion with positions out of reach: outcomes, notes and NaN."""
    model = lw.load("gallery:crank_rocker")
    return lw.solve_motion(model.with_dimensions({"coupler.length": 0.4}), steps=24, failures="mark")


def position_error() -> lw.PositionError:
    with pytest.raises(lw.PositionError) as refused:
        lw.solve_motion(broken().mechanism, steps=24)
    return refused.value


def model_error() -> lw.ModelError:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads("format: 2\n")
    return refused.value


def synthesis_error() -> Exception:
    with pytest.raises(lw.LinkwrightError) as refused:
        lw.synthesize("no such task")
    return refused.value


def model() -> lw.Model:
    found = lw.Model("four-bar")
    found.frame(O1=(0, 0), O2=(4, 0))
    return found


@cache
def motion_program() -> lw.MotionProgram:
    return lw.MotionProgram((lw.Segment(2.0, rise=0.02, law="cycloidal"), lw.Segment(4.28318530717958647, to=0.0)))


def cam() -> lw.Cam:
    return lw.Cam(motion_program(), lw.Follower(roller_radius=0.008, offset=0.004), base_radius=0.045)


@cache
def variants() -> lw.Variants:
    return lw.variants("gallery:jaw_crusher_fourbar", 1, seed=7)


def grades() -> lw.Grades:
    key = variants().key()
    answers = {question["name"]: "1" for question in key["questions"]}
    return lw.grade(key, [{"student": "A. Student", "variant": "1", **answers}])


SIX = "gallery:jaw_crusher_sixbar"
CRUSHER = partial(store.machine, "jaw_crusher_sixbar")
RESULTS: dict[str, Callable[[], Any]] = {
    "mechanism": CRUSHER,
    "model under construction": model,
    "document": lambda: lw.read_document("gallery:kite"),
    "findings": lambda: list(model_error().findings),
    "structure": lambda: lw.structure(CRUSHER()),
    "motion": lambda: crusher().motion,
    "motion of a triad": lambda: triad().motion,
    "motion with gaps": broken,
    "link": lambda: crusher().motion.link("jaw"),
    "point": lambda: crusher().motion.point("C"),
    "joint": lambda: lw.solve_motion(lw.load("gallery:slider_crank_offset"), steps=24).joint("guide"),
    "outcomes": lambda: broken().outcomes,
    "forces": crusher,
    "forces of a triad": triad,
    "load": lambda: crusher().load("crushing"),
    "limits": lambda: lw.limit_positions(crusher(72).motion, "jaw"),
    "range": lambda: lw.input_range(CRUSHER()),
    "metrics": lambda: lw.metrics(crusher()),
    "coupler curve": lambda: coupler_curve(lw.solve_motion(lw.load("gallery:chebyshev_lambda"), steps=48), "P"),
    "interference": lambda: lw.interference(lw.load("gallery:crank_rocker")),
    "steady running": lambda: lw.steady_running(crusher(), fluctuation=0.03),
    "drive margin": lambda: lw.drive_margin(CRUSHER(), steps=24),
    "motor choice": lambda: lw.choose_motor(lw.load("gallery:jaw_crusher_fourbar"), steps=24),
    "motor duty": lambda: lw.motor_duty(made("motor choice").mechanism, by="law", steps=24),
    "catalogue": lw.read_catalogue,
    "braking": lambda: lw.braking(lw.load("gallery:jaw_crusher_fourbar"), torque=2000.0, positions=2),
    "equilibria": lambda: lw.equilibrium(lw.load("gallery:lid_on_gas_strut")),
    "equilibrium": lambda: lw.equilibrium(lw.load("gallery:toggle_press"))[1],
    "displacement": lambda: lw.equilibrium(lw.load("gallery:toggle_press"))[1].displaced("K", (3.0, 0.0)),
    "torque table": lambda: lw.TorqueCurve.from_table([0.3, 1.0, 2.0], [1.0, 2.0, 3.0]),
    "torque expression": lambda: lw.TorqueCurve.from_function("100 + 20*sin(theta)"),
    "torque difference": lambda: lw.TorqueCurve.constant(3.0).minus(lw.TorqueCurve.from_function("1 + sin(theta)")),
    "foreign": lambda: lw.read_foreign(
        '<linkage2><connector id="0" x="0" y="0" anchor="true" input="true" rpm="15"/>'
        '<connector id="1" x="0" y="96"/><Link id="0"><connector id="0"/><connector id="1"/></Link></linkage2>'
    ),
    "expectations": lambda: lw.expectations(dataclasses.replace(CRUSHER(), expect={"mobility": 1})),
    "expectation": lambda: made("expectations").rows[0],
    "parts to make": lambda: lw.cut_parts(store.machine("kite")),
    "layers": lambda: lw.layers(lw.load("gallery:crank_rocker")),
    "conflict": lambda: lw.layers(lw.load("gallery:whitworth")).conflicts[0],
    "loops in MuJoCo": lambda: lw.mujoco_loops(lw.load("gallery:kite"), steps=24),
    "sizes of links": lambda: lw.size_links(lw.load("gallery:kite"), steps=24),
    "balancing": lambda: lw.balance(lw.load("gallery:crank_rocker"), radius=0.1),
    "release": lambda: lw.release(CRUSHER(), at=0.5),
    "run": lambda: lw.run(lw.load("gallery:watt_sixbar"), duration=0.1),
    "runs": lambda: lw.run_designs(lw.load("gallery:watt_sixbar"), {"coupler.mass": [1.8, 2.2]}, duration=0.1),
    "worked": lambda: lw.worked(crusher(), 0),
    "comparison": lambda: lw.compare([SIX, "gallery:jaw_crusher_fourbar"], steps=48),
    "study": lambda: lw.study(CRUSHER(), {"crank.length": "90..100 mm:3"}, steps=48),
    "sweep": lambda: lw.sweep(
        CRUSHER(), {"crank.length": np.linspace(0.09, 0.1, 3)}, outputs=["driver.effort rms"], steps=48
    ),
    "sensitivity": lambda: lw.sensitivity(CRUSHER(), of=["driver.effort rms"], by=["crank.length"], steps=48),
    "prepared": lambda: lw.prepare(CRUSHER(), vary=["crank.length"], steps=24),
    "position error": position_error,
    "model error": model_error,
    "synthesis error": synthesis_error,
    "drawing": lambda: lw.draw(lw.load("gallery:kite")),
    "animation": lambda: lw.animate(lw.load("gallery:kite")),
    "diagram": lambda: lw.plot(lw.solve_motion(lw.load("gallery:kite"), steps=24)),
    "gear": lambda: lw.Gear(20, 0.002),
    "optimum": lambda: lw.optimize(
        CRUSHER(), vary={"pitman.length": "1.2..1.3 m"}, minimize="peak_input_torque", evaluations=48
    ),
    "motion law": lambda: lw.motion_law("modified_sine"),
    "motion program": motion_program,
    "found program": lambda: lw.FoundProgram(points=((1.5, 0.02),), windows=(lw.Window(2.5, 4.0, 0.0, 0.0),)),
    "cam": cam,
    "cam, solved": lambda: cam().solve(),
    "follower": lambda: cam().follower,
    "report": lambda: lw.report("gallery:crank_rocker", sections=["task", "structure"]),
    "validation": lambda: lw.validate(islice(from_gallery("jaw_crusher_sixbar"), 4)),
    "variants": variants,
    "grades": grades,
    "interruption": lambda: lw.Interrupted(Path("crank.state")),
    "compensating cam": lambda: lw.compensating_cam(lw.load("gallery:printing_press"), "lead", span=9.0, steps=240),
    "synthesis": lambda: lw.synthesize("slider_crank", stroke=0.3, rod_ratio=3.5),
}


#: Public types that hold compiled programs or are parts of another result, and errors of the same make as others.
MADE_OF_CODE = {
    "Candidate",
    "GearPair",
    "Objective",
    "OptimizeError",
    "PathError",
    "SelfCheckError",
    "Rack",
    "SweepParts",
    "SynthesisError",
} | {f"Cam{part}" for part in ("Choice", "Conjugate", "Elasticity", "Limits", "Loading", "Material", "Spring")}
MADE_OF_CODE |= {"Segment", "Window", "LivingPage", "Sheet"}


@cache
def made(name: str) -> Any:
    return RESULTS[name]()


WAYS: dict[str, Callable[[Any], Any]] = {
    "pickle": lambda each: pickle.loads(pickle.dumps(each)),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
}


def numbers(value: Any, depth: int = 0) -> list[Any]:
    """What a result says: its text, its columns and its plain fields, to compare with those of a copy."""
    if isinstance(value, BaseException):
        return [type(value), str(value)]
    if isinstance(value, np.ndarray):
        return [value.shape, value.tobytes()]
    if isinstance(value, str | int | float | bool | None):
        return [value]
    if isinstance(value, list | tuple):
        return [each for item in value for each in numbers(item, depth + 1)]
    if isinstance(value, dict):
        return [each for key, item in value.items() for each in (key, *numbers(item, depth + 1))]
    found: list[Any] = [type(value)]
    if depth == 0 and callable(getattr(value, "columns", None)):
        found += numbers(value.columns(), 1)
    if isinstance(value, lw.TorqueCurve):
        found += numbers(value(np.linspace(0.0, 6.0, 25)))
    if isinstance(value, lw.Prepared):
        found += numbers(value.solve({"crank.length": 0.09}).input_torque)
    if dataclasses.is_dataclass(value) and depth < 2:
        compared = [getattr(value, each.name) for each in dataclasses.fields(value) if each.compare]
        found += numbers(compared, depth + 1)
    return found


@pytest.mark.parametrize("name", RESULTS)
def test_a_copy_says_the_same(name: str) -> None:
    copies_say_the_same(made(name))


@pytest.mark.rotating
@pytest.mark.parametrize("name", parts.gallery_names())
def test_a_copy_of_a_calculation_says_the_same(name: str) -> None:
    copies_say_the_same(solved(name))


def copies_say_the_same(result: Any) -> None:
    said = numbers(result)
    for way, copied in WAYS.items():
        again = copied(result)
        assert type(again) is type(result), way
        assert numbers(again) == said, way


@pytest.mark.rotating
def test_every_public_type_is_among_them() -> None:
    found = {type(each) for name in RESULTS for each in _flat(made(name))}

    types = {each for each in PUBLIC.values() if isinstance(each, type)}
    bases = {lw.LinkwrightError, lw.StructureError}
    missing = {each.__name__ for each in types - bases if not any(issubclass(kind, each) for kind in found)}
    assert missing <= MADE_OF_CODE, missing


def _flat(value: Any) -> list[Any]:
    return [value, *(value if isinstance(value, list | tuple | lw.Grades) else ())]


def test_a_pickled_motion_answers_what_was_not_asked_before() -> None:
    """The programs are not pickled: another process traces them again, with the same numbers to the last bit."""
    forces = crusher()
    again = pickle.loads(pickle.dumps(forces))
    np.testing.assert_array_equal(
        again.motion.link("jaw").centre.acceleration, forces.motion.link("jaw").centre.acceleration
    )
    np.testing.assert_array_equal(again.reaction("B", on="rocker"), forces.reaction("B", on="rocker"))
    np.testing.assert_array_equal(again.shaking_force, forces.shaking_force)
    assert len(pickle.dumps(forces)) < 200_000
