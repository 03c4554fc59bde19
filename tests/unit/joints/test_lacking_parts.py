"""What a kind of joint says, and rooms say of it, where it supplies no more than its links."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, ClassVar

from tests.refusals import refused

from linkwright.joints.base import Joint, LackingError
from linkwright.mechanism.wheels_and_cams import disc_radii, wheel_sizes
from linkwright.page.glyphs import contact_shape
from linkwright.plotting.drawing.joint_marks import marks as marks_of
from linkwright.worked_solutions.higher_pairs import contact_of
from linkwright.worked_solutions.wheels import own_form


@dataclass(frozen=True)
class Bare(Joint):
    """A kind of another package that supplies its links and nothing else."""

    kind: ClassVar[str] = "bare"
    freedoms: ClassVar[int] = 1

    @property
    def joined(self) -> tuple[str, ...]:
        return ("one", "two")

    def dimensions(self) -> Mapping[str, float]:
        return {}

    def with_dimensions(self, value: Any) -> Joint:
        return self


def test_a_kind_says_which_of_its_parts_is_lacking() -> None:
    bare, any_ = Bare("j"), SimpleNamespace(mechanism=None)
    calls = {
        "fields": Bare.fields,
        "residual": lambda: bare.residual(any_),
        "hang": lambda: bare.hang(any_, any_, 0.0),
        "slide_direction": lambda: bare.slide_direction(any_),
        "turned": lambda: bare.turned(any_, any_),
        "turn_of": lambda: bare.turn_of("one", any_),
        "sums": lambda: bare.sums(any_),
        "contact": lambda: contact_of(bare, any_),
        "seats": lambda: bare.seats,
    }
    for part, call in calls.items():
        with refused("model.kind_lacks", LackingError, kind="bare", what=part):
            call()
    assert (bare.ties, bare.turning, bare.pairs, bare.friction_arm) == ((), (), 1, 0.0)
    assert bare.point_on("one") == "j" and bare.fits(any_) is True
    assert bare.misfit(any_) is None and bare.pulls(dict) is None and contact_shape(bare, any_) is None
    assert wheel_sizes(bare, any_) is None and disc_radii(bare, any_) == {}
    assert tuple(marks_of(bare, any_, {})) == () and own_form(bare, any_) is None
