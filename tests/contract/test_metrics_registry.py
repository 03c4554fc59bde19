"""Every registered metric keeps the contract, on every gallery machine."""

from math import isnan

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.analysis import METRICS, Analysis, MetricsTable, metrics
from linkwright.gallery import names

SKIPPED = {"truss", "two_bars_equilibrium"}


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "slider_crank_inline"])
def test_table_of_a_machine(name: str) -> None:
    is_a_table(name)


@pytest.mark.rotating
@pytest.mark.parametrize("name", sorted(set(names()) - SKIPPED))
def test_table_of_every_machine(name: str) -> None:
    is_a_table(name)


def is_a_table(name: str) -> None:
    forces = lw.solve_forces(lw.solve_motion(lw.load(f"gallery:{name}"), steps=72, failures="mark"))
    table = metrics(forces)
    asked = [name for name, metric in METRICS.items() if metric.on_request and metric().applies(forces)]
    rare = {"cusp", "dead_point", "limit_position", *(n for n, metric in METRICS.items() if metric.on_request)}
    assert set(table.names) | set(table.skipped) >= set(METRICS) - rare
    ranks = [METRICS[row.metric].rank for row in table]
    assert ranks == sorted(ranks)
    for row in every([*table, *(metrics(forces, asked) if asked else ())]):
        assert not isnan(row.value), row
        assert row.at is None or np.isfinite(row.at)
    for language in ("en", "zh"):
        assert len(table.text(language).splitlines()) >= len(table) + 3
    keys = [(row.metric, row.subject, row.at) for row in table]
    assert len(keys) == len(set(keys))


@pytest.mark.parametrize(
    ("name", "own"),
    [
        ("crank_rocker", {"transmission_angle", "peak_jerk"}),
        ("shaper_quick_return", {"transmission_angle", "peak_jerk", "stroke"}),
        ("jaw_crusher_sixbar", {"transmission_angle", "peak_jerk"}),
        ("stephenson_sixbar_triad", set()),
    ],
)
def test_extremes_do_not_depend_on_the_steps(name: str, own: set[str]) -> None:
    mechanism = lw.load(f"gallery:{name}")
    coarse, fine = (metrics(lw.solve_motion(mechanism, steps=n)) for n in (120, 360))
    for metric in {"peak_acceleration", "velocity_ratio", "swing_angle"} | own:
        for a, b in every(zip(coarse[metric], fine[metric], strict=True)):
            assert a.value == pytest.approx(b.value, rel=1e-6), (metric, a.subject)


#: What a table begins with: the output, its transmission, the torque, the reactions, the shaking; then the rest.
FIRST = (
    {"stroke", "swing_angle", "quick_return_ratio", "crank_angle_between_limits"},
    {"peak_acceleration"},
    {"transmission_angle", "transmission_angle_of_stroke", "pressure_angle"},
    {
        "peak_input_torque",
        "rms_input_torque",
        "peak_power",
        "mean_power",
        "efficiency",
        "holding_torque",
        "rms_holding_torque",
        "energy_fluctuation",
        "flywheel",
    },
    {"velocity_ratio", "mechanical_advantage"},
    {"peak_reaction", "rms_reaction", "bearing_pv"},
    {"peak_shaking_force", "peak_shaking_moment"},
)


def test_what_matters_first_stands_first() -> None:
    crusher, shaper = (
        metrics(lw.solve_forces(lw.load(f"gallery:{name}"), steps=72)).names
        for name in ("jaw_crusher_sixbar", "shaper_quick_return")
    )
    place = {name: k for k, group in enumerate(FIRST) for name in group}
    for found in (crusher, shaper):
        places = [place.get(name, len(FIRST)) for name in found]
        assert places == sorted(places)
        assert "instant_centre" not in found
    everything = sorted(METRICS, key=lambda name: METRICS[name].rank)
    assert [place.get(name, len(FIRST)) for name in everything] == sorted(
        place.get(name, len(FIRST)) for name in METRICS
    )
    ranks = [{METRICS[name].rank for name in group} for group in FIRST]
    assert all(len(own) == 1 for own in ranks) and len(set.union(*ranks)) == len(FIRST)


def test_a_single_position_has_numbers_as_well() -> None:
    motion = lw.solve_motion(lw.load("gallery:crank_rocker"), at=[0.5])
    table = metrics(motion)
    assert table.value("transmission_angle") > 0
    assert "range_of_motion" in table.skipped and "quick_return_ratio" in table.skipped


def test_indexing_the_table() -> None:
    table = metrics(store.motion("jaw_crusher_sixbar"))
    assert isinstance(table, MetricsTable)
    rows = table["transmission_angle"]
    assert table.value("transmission_angle") == min(row.value for row in rows)
    assert table["transmission_angle", rows[1].subject] is rows[1]
    assert table[0] in table and "swing_angle" in table and "stroke" not in table
    frame = table.to_dataframe()
    assert list(frame["metric"].unique()) == list(table.names)


def test_metric_by_itself() -> None:
    motion = lw.solve_motion(lw.load("gallery:crank_rocker"))
    metric = METRICS["swing_angle"]()
    assert metric.applies(motion) and not METRICS["peak_reaction"]().applies(motion)
    (found,) = metric.evaluate(Analysis.of(motion))
    assert found.subject == "rocker"


@pytest.mark.parametrize("name", ["crank_rocker", "jaw_crusher_sixbar"])
def test_a_repeated_first_position_changes_nothing(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    tables = [metrics(lw.solve_forces(lw.solve_motion(mechanism, endpoint=end))) for end in (False, True)]
    assert tables[0].names == tables[1].names
    for a, b in every(zip(*tables, strict=True)):
        assert a.subject == b.subject and a.value == pytest.approx(b.value, rel=1e-9, abs=1e-9), a.metric


def test_numbers_of_shaking_need_forces_and_masses() -> None:
    engine = lw.load("gallery:slider_crank_inline")
    bare = engine.with_dimensions({"rod.mass": 0.0, "rod.inertia": 0.0, "piston.mass": 0.0})
    heavy = bare.with_dimensions({"rod.inertia": 0.006})

    def shaking(result: lw.Motion | lw.Forces) -> set[str]:
        return {name for name in metrics(result).names if "shaking" in name}

    assert shaking(lw.solve_forces(engine, steps=36)) == {"peak_shaking_force", "peak_shaking_moment"}
    assert shaking(lw.solve_forces(heavy, steps=36)) == {"peak_shaking_force", "peak_shaking_moment"}
    assert shaking(lw.solve_forces(bare, steps=36)) == shaking(lw.solve_motion(engine, steps=36)) == set()
