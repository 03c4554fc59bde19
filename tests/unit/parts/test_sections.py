"""Sections of beams: profiles of the table, shapes, steps."""

import math

import pytest

from linkwright import parts
from linkwright.parts.beams import components as sections
from linkwright.parts.beams.components import SectionStep

E, J, L = 200e9, 3e-6, 3.0


def close(found: object, expected: object) -> None:
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-15)


def test_stepped_cantilever() -> None:
    p, thick, thin = 400.0, 2 * J, J
    wall, load = {"A": parts.BeamSupport("fixed", 0.0)}, {"P": parts.BeamLoad(force=-p, at=L)}
    steps = (SectionStep(L / 2, parts.Section(thin)),)
    beam = parts.Beam(L, parts.Material(E), parts.Section(thick), wall, load, steps=steps)
    close(beam.solve().deflection(L)[0], -p * L**3 / (24 * E) * (7 / thick + 1 / thin))


@pytest.mark.parametrize("name", sections.IPE)
def test_profiles_follow_from_their_measures(name: str) -> None:
    """Area and second moment of two flanges, web and four root fillets; W = 2I/h; digits of the table."""
    h, b, web, flange, r, area, second, modulus = sections.IPE[name]
    plain = sections.i_beam(h, b, web, flange)
    corner = (1 - math.pi / 4) * r * r
    centre = r * (10 - 3 * math.pi) / (12 - 3 * math.pi)
    own = r**4 * (1 / 3 - math.pi / 16 - 1 / (36 - 9 * math.pi))
    arm = h / 2 - flange - centre
    assert area == pytest.approx((plain.area or 0) + 4 * corner, rel=2e-3)
    assert second == pytest.approx(plain.second_moment + 4 * (corner * arm**2), rel=4e-3)
    assert abs(own) < second
    assert modulus == pytest.approx(2 * second / h, rel=4e-3)


def test_shapes() -> None:
    close(sections.tube(0.1, 0.01).second_moment, math.pi / 64 * (0.1**4 - 0.08**4))
    close(sections.circle(0.05).modulus, math.pi * 0.05**3 / 32)
    close(sections.box(0.1, 0.2, 0.01).second_moment, (0.1 * 0.2**3 - 0.08 * 0.18**3) / 12)
