"""How published numbers are found here: a probe takes input data and returns SI values by name."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from linkwright.files.model_file import load
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.table import results_of
from linkwright.units import parse

_DATA = Path(str(files(__package__) / "data"))
Find = Callable[[str], float]
Probe = Callable[[Mapping[str, Any]], Find]


def machine(inputs: Mapping[str, Any]) -> Find:
    """Results of a model at one input (``at``, ``input``), time, or at rest, by the names of its columns."""
    mechanism = load(_source(inputs))
    if "time" in inputs:
        motion = solve_motion(mechanism, times=[parse(inputs["time"], "time")])
    elif at := inputs.get("at", inputs.get("input")):
        motion = solve_motion(mechanism, at=[parse(at, mechanism.across)])
    else:
        motion = solve_motion(mechanism)
    return _by_column(motion, _forces(motion))


def run(inputs: Mapping[str, Any]) -> Find:
    """Results of a model at the end of its run under forces, by the names of its columns."""
    from linkwright.dynamics.run import run as run_of

    found = run_of(load(_source(inputs)), tolerance=float(inputs["tolerance"]))
    return _by_column(found.motion(times=[found.end]), found.joint_forces(times=[found.end]))


def _by_column(motion: Motion, forces: Forces | None) -> Find:
    values = {output.column: column[0] for output, column in results_of(motion, forces).items()}

    def find(what: str) -> float:
        if what == "input_torque" and forces is not None:
            return float(forces.input_torque[0])
        if what in values:
            return float(values[what])
        if " on " in what and forces is not None:
            output = output_meant(motion.mechanism, f"reaction {what}")
            return float(forces.reaction(output.owner, on=output.on)[0]["xy".index(output.component)])
        return float(motion.read(output_meant(motion.mechanism, what))[0])

    return find


def _source(inputs: Mapping[str, Any]) -> str:
    """The address of the gallery's ``model``, or of a ``file`` among the data."""
    return f"gallery:{inputs['model']}" if "model" in inputs else str(_DATA / inputs["file"])


def _forces(motion: Any) -> Forces | None:
    return solve_forces(motion) if motion.mechanism.has_loads else None


def limits(inputs: Mapping[str, Any]) -> Find:
    """Input and angle of a link's limit positions: ``jaw max input``."""
    from linkwright.events.limit_positions import limit_positions

    motion = _motion(_source(inputs), 360)

    def find(what: str) -> float:
        link, kind, value = what.split()
        found = next(each for each in limit_positions(motion, link) if each.kind == kind)
        return found.input if value == "input" else found.value

    return find


@lru_cache(maxsize=8)
def _motion(source: str, steps: int) -> Any:
    return solve_motion(load(source), steps=steps)


def metrics(inputs: Mapping[str, Any]) -> Find:
    """Metrics: ``stroke``, or ``stroke guide`` with its subject."""
    from linkwright.analysis import metrics as table_of

    motion = _motion(_source(inputs), 90)

    def find(what: str) -> float:
        name, _, subject = what.partition(" ")
        name = name.removesuffix("_min")
        table = table_of(motion, [name])
        return float(table[name, subject].value if subject else table.value(name))

    return find


def structure(inputs: Mapping[str, Any]) -> Find:
    """Mobility and class."""
    from linkwright.topology import structure as analysis

    found = analysis(load(f"gallery:{inputs['model']}"))
    values = {"mobility": found.mobility, "grubler": found.grubler, "class": found.mechanism_class}
    return lambda what: float(values[what])


def gear_pair(inputs: Mapping[str, Any]) -> Find:
    """Attributes of a gear pair."""
    from linkwright.gears.pair import gear_pair as pair_of

    options = {key: value for key, value in inputs.items() if key not in ("teeth", "module")}
    options["profile_shift"] = tuple(options["profile_shift"])
    return partial(_attribute, pair_of(tuple(inputs["teeth"]), inputs["module"], **options))


def _attribute(owner: Any, path: str) -> float:
    for name in path.split("."):
        owner = getattr(owner, name)
    return float(owner)


def involute(inputs: Mapping[str, Any]) -> Find:
    """The involute function of an angle."""
    from linkwright.gears.gear import involute as value

    return lambda what: float(value(parse(what, "angle")))


def areas(inputs: Mapping[str, Any]) -> Find:
    """Energy and speed fluctuation of areas of a turning moment diagram."""
    from linkwright.machine.flywheel import speed_fluctuation
    from linkwright.machine.torque_curve import fluctuation_from_areas

    scale = parse(inputs["angle_scale"], "angle")
    energy = fluctuation_from_areas(inputs["areas"], torque_scale=inputs["torque_scale"], angle_scale=scale).value
    speed = parse(inputs["speed"], "angular_velocity")
    values = {"energy_fluctuation": energy, "speed_fluctuation": speed_fluctuation(energy, speed, inputs["inertia"])}
    return values.__getitem__


def torque(inputs: Mapping[str, Any]) -> Find:
    """Motor, energy fluctuation and flywheel of torque curves."""
    from linkwright.machine import TorqueCurve, energy_fluctuation, flywheel_inertia, motor, speed_fluctuation

    driver = TorqueCurve.from_function(inputs["torque"])
    load_curve = TorqueCurve.from_function(inputs["load"]) if "load" in inputs else None
    speed = parse(inputs["speed"], "angular_velocity")
    energy = energy_fluctuation(driver, load_curve) if load_curve else energy_fluctuation(driver)
    values = {"energy_fluctuation": energy.value, "power": motor(driver.mean, speed).power}
    if "fluctuation" in inputs:
        values["flywheel"] = flywheel_inertia(energy.value, speed, inputs["fluctuation"])
    if load_curve is not None:
        values["speed_fluctuation"] = speed_fluctuation(energy.value, speed, inputs["inertia"])
        values["largest_acceleration"] = driver.minus(load_curve).extremes()[1][1] / inputs["inertia"]
    return values.__getitem__


def calculation(inputs: Mapping[str, Any]) -> Find:
    """Results of a calculation of the gallery, by the path in its data."""
    from linkwright.parts import load

    data = load(f"gallery:{inputs['model']}").solve().data()

    def find(what: str) -> float:
        here: Any = data
        rest = what
        while rest:
            key = rest if rest in here else next(k for k in here if rest.startswith(f"{k}."))
            here, rest = here[key], rest[len(key) + 1 :]
        return float(here["value"] if isinstance(here, Mapping) else here)

    return find


def path(inputs: Mapping[str, Any]) -> Find:
    """Sum of squares of the best four-bar through timed points."""
    from linkwright.synthesis.path_generation.generate import path_generation

    points = [tuple(each) for each in inputs["points"]]
    angles = inputs.get("angles")
    turned = np.radians(angles) if angles else np.arange(len(points)) * 2.0 * np.pi / len(points)
    options: dict[str, Any] = {}
    if inputs.get("fixed"):
        options = {"phase": False, "pivot": (0, 0), "direction": 0.0}
    best = path_generation(points, angles=turned, seed=0, **options).best
    return lambda what: float(best.error)


def function(inputs: Mapping[str, Any]) -> Find:
    """Lengths of the four-bar through pairs of angles that are measured from the frame."""
    from linkwright.synthesis.function_generation.generate import function_generation

    pairs = (np.radians(inputs[name]) for name in ("inputs", "outputs"))
    best = function_generation(*pairs, input_zero=0, output_zero=0, frame=parse(inputs["frame"], "length")).best
    return best.linkage.lengths().__getitem__


def double_crank(inputs: Mapping[str, Any]) -> Find:
    """Lengths of the double crank of least squares in Freudenstein's equation, and the coefficients of
    cos φ = P0 cos ψ + P1 cos(ψ - φ) + P2, through the pairs of a table."""
    from linkwright.synthesis.function_generation.generate import function_generation

    rows = list(csv.DictReader((_DATA / inputs["table"]).read_text("utf-8").splitlines()))
    pairs = (np.radians([float(row[inputs[name]]) for row in rows]) for name in ("inputs", "outputs"))
    frame = parse(inputs["frame"], "length")
    best = function_generation(*pairs, input_zero=0, output_zero=0, frame=frame, equation_error=True).best
    a, b, c, d = (best.linkage.lengths()[name] for name in ("input", "coupler", "output", "frame"))
    values = {"driving crank": a, "coupler": b, "follower": c}
    values |= {"P0": c / a, "P1": -c / d, "P2": (a * a + c * c + d * d - b * b) / (2.0 * a * d)}
    return values.__getitem__


def slider_crank(inputs: Mapping[str, Any]) -> Find:
    """Lengths of a slider-crank from stroke and ratios."""
    from linkwright.synthesis.requirements.slider_crank import slider_crank_from_ratios

    best = slider_crank_from_ratios(inputs["stroke"], inputs["rod_ratio"], inputs["eccentricity"]).best
    return lambda what: float(best.values[what])


def motion_law(inputs: Mapping[str, Any]) -> Find:
    """Largest velocity, acceleration, jerk of a motion law for a rise of 1 over 1."""
    from linkwright.laws.fitting import motion_law as law

    def find(what: str) -> float:
        name, kind = what.split()
        return float(getattr(law(name).peaks, kind))

    return find


def regression(inputs: Mapping[str, Any]) -> Find:
    """A straight line through samples."""
    from linkwright.parts import Fitting, Numbers, Samples

    held = {name: Numbers(tuple(inputs[name])) for name in ("x", "y")}
    found = Samples(held, regressions={"r": Fitting("y", ("x",))}).solve().regressions["r"]
    coefficients = zip(("intercept", "slope"), found.coefficients, found.errors, strict=True)
    values = {"deviation": found.deviation, "determination": found.determination}
    for name, value, error in coefficients:
        values |= {name: value, f"error of {name}": error}
    return lambda what: float(values[what])


PROBES: Mapping[str, Probe] = {
    each.__name__: each
    for each in (
        machine,
        run,
        limits,
        metrics,
        structure,
        gear_pair,
        involute,
        areas,
        torque,
        calculation,
        path,
        function,
        double_crank,
        slider_crank,
        motion_law,
        regression,
    )
}
