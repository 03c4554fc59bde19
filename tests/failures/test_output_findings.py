"""Formulas of outputs that are refused, each at its place."""

from __future__ import annotations

import pytest
from tests.refusals import findings, refused, said

import linkwright as lw

TEXT = """
format: 1
name: four-bar
parameters: {radius: 50 mm}
frame: {points: {O: [0 m, 0 m], D: [200 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 50 mm}
  coupler: {points: [A, B], length: 180 mm}
  rocker: {points: [D, B], length: 120 mm}
assembly: {B: left}
driver: {turn: crank, about: O, speed: 60 rpm}
outputs:
"""


@pytest.mark.parametrize(
    ("line", "code", "key"),
    [
        ("gap: rockr - crank", "unknown-name", "outputs.gap"),
        ("gap: rocker - radius", "wrong-dimension", "outputs.gap"),
        ("gap: 2*radius", "expression", "outputs.gap"),
        ("gap: B.x^5", "wrong-dimension", "outputs.gap"),
        ("rocker: B.x", "duplicate", "outputs.rocker"),
        ("B: B.x", "duplicate", "outputs.B"),
        ("radius: B.x", "duplicate", "outputs.radius"),
        ("sin: B.x", "name", "outputs.sin"),
        ("mm: B.x", "name", "outputs.mm"),
        ("a b: B.x", "name", "outputs.a b"),
        ("gap: [B.x]", "type", "outputs.gap"),
        ("first: second\n  second: B.x", "unknown-name", "outputs.first"),
    ],
)
def test_a_formula_that_is_none_is_told_at_its_place(line: str, code: str, key: str) -> None:
    said(findings(f"{TEXT}  {line}\n"), code, key)


def test_all_formulas_are_looked_at() -> None:
    found = findings(f"{TEXT}  one: rockr\n  two: B.x + 1 s\n  three: one + B.x\n")
    assert {each.key for each in found if each.severity == "error"} == {"outputs.one", "outputs.two"}


def test_a_structure_without_a_driver_has_no_input() -> None:
    text = TEXT.replace("driver: {turn: crank, about: O, speed: 60 rpm}\n", "")
    said(findings(f"{text}  gap: A.y + 1 m*input/(1 rad)\n"), "unknown-name", "outputs.gap")


def test_limits_of_a_formula_are_refused() -> None:
    machine = lw.loads(f"{TEXT}  gap: B.x - 2*A.y\n")
    with refused("motion.no_limits_of_formula", name="gap"):
        lw.limit_positions(lw.solve_motion(machine), "gap")
