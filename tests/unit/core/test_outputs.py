"""The one type of outputs: the names that it reads and writes."""

from __future__ import annotations

import pickle

import pytest

from linkwright.core.outputs import KINDS, Output, kind_of

#: A row of a program, the output in it, its name in words, over a column, in a file; its dimension.
NAMES = [
    ("p:C.x", Output("position", "C", "x"), "C.x", "C.position.x", "C.x", "length"),
    ("v:jaw.D.y", Output("velocity", "jaw.D", "y"), "jaw.D.velocity.y", "jaw.D.velocity.y", None, "velocity"),
    ("a:jaw.@centre.x", Output("acceleration", "jaw.@centre", "x"), None, None, None, "acceleration"),
    ("e:jaw.y", Output("direction", "jaw", "y"), None, None, None, "dimensionless"),
    (
        "w:jaw",
        Output("angular_velocity", "jaw"),
        "jaw.angular_velocity",
        "jaw.angular_velocity",
        None,
        "angular_velocity",
    ),
    ("s:ram", Output("displacement", "ram"), "ram.displacement", "ram.displacement", "ram", "length"),
    ("sv:ram", Output("slide_velocity", "ram"), "ram.velocity", "ram.velocity", None, "velocity"),
    ("fact:RRR:a|distance²", Output("fact", "RRR:a", on="distance²"), None, None, None, "dimensionless"),
    ("load:press", Output("magnitude", "press"), None, None, None, ""),
    ("friction:O5|jaw", Output("friction", "O5", on="jaw"), None, None, None, ""),
    ("outcome", Output("outcome"), None, None, None, "dimensionless"),
    ("r:O5|jaw.x", Output("reaction", "O5", "x", "jaw"), "reaction O5 on jaw.x", "O5 on jaw.x", None, "force"),
    (
        "c:ram|block",
        Output("couple", "ram", on="block"),
        "couple ram on block",
        "ram on block.couple",
        None,
        "torque",
    ),
    ("effort:crank", Output("effort", "crank"), "crank.effort", "crank.effort", None, "torque"),
    ("on:jaw.m", Output("applied", "jaw", "m"), None, None, None, "torque"),
    ("shake.x", Output("shaking_force", "", "x"), "shaking_force.x", "shaking_force.x", None, "force"),
    ("shake_moment", Output("shaking_moment"), "shaking_moment", "shaking_moment", None, "torque"),
    ("driver_power", Output("power"), "power", None, None, "power"),
]


@pytest.mark.parametrize(("row", "output", "words", "column", "file", "dimension"), NAMES)
def test_an_output_reads_and_writes_its_names(
    row: str, output: Output, words: str | None, column: str | None, file: str | None, dimension: str
) -> None:
    assert Output.of_row(row) == output
    assert kind_of(row) == output.kind
    written = (output.row, output.name, output.column, str(output), output.dimension)
    wanted = (row, words, column, file, dimension)
    assert [found for found, want in zip(written, wanted, strict=True) if want is not None] == [
        want for want in wanted if want is not None
    ]
    assert pickle.loads(pickle.dumps(output)) == output


def test_what_is_no_output_has_no_kind() -> None:
    assert kind_of("mode:RRR") == kind_of("words:C.x") == ""
    with pytest.raises(KeyError):
        Output.of_row("mode:RRR")


def test_rows_of_kinds_are_different() -> None:
    rows = [kind.row for kind in KINDS.values() if kind.row]
    assert len(set(rows)) == len(rows)


def test_sliding_drivers_have_forces() -> None:
    assert Output("effort", "ram", slides=True).dimension == "force"
    assert Output("input", "ram", slides=True).dimension == "length"


def test_rates_follow_their_outputs() -> None:
    assert [each.row for each in Output("displacement", "ram").course] == ["s:ram", "sv:ram", "sa:ram"]
    assert Output("position", "C", "y", written="it").rate == Output("velocity", "C", "y")


def test_columns_have_owners_quantities_and_units() -> None:
    force = Output("shaking_force", "", "x")
    assert (force.place, force.quantity, force.heading) == ("shaking_force", "x", "shaking_force.x [N]")
    size = Output("reaction", "A", on="rod")
    assert (size.place, size.quantity, size.heading) == ("A on rod", "magnitude", "A on rod.magnitude [N]")
    lift = Output("input", "lift", slides=True)
    assert (lift.place, lift.quantity, lift.heading) == ("", "lift", "lift [m]")
