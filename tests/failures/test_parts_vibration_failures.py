"""Vibration that has no answer is refused with the reason."""

import pytest
from tests import store
from tests.refusals import faulty

from linkwright import parts

HEAD = "format: 1\nkind: vibration\nmasses: {body: 25 kg}\n"
HEAD += "springs: {k: {between: [ground, body], stiffness: 10 kN/m}}\n"


@pytest.mark.parametrize(
    ("text", "key", "code", "values"),
    [
        (
            HEAD + "excitation: {on: body, force: 5 N, frequency: 3.1830988618379066 Hz}\n",
            "excitation",
            "resonance",
            {"hertz": "3.1831"},
        ),
        (HEAD + "excitation: {on: body, force: 5 N}\n", "excitation", "excitation_form", {}),
        (
            HEAD + "excitation: {on: head, force: 5 N, frequency: 3 Hz}\n",
            "excitation.on",
            "no_such_mass",
            {"name": "head"},
        ),
        (HEAD + "excitation: {on: body, force: 0 N, frequency: 3 Hz}\n", "excitation.force", "no_amplitude", {}),
        (
            HEAD + "excitation: {on: body, force: 20 mm, frequency: 3 Hz}\n",
            "excitation.force",
            "mixed",
            {"needed": "force"},
        ),
        (HEAD + "excitation: {base: 5 N, frequency: 3 Hz}\n", "excitation.base", "mixed", {"needed": "length"}),
        (HEAD + "start: {body: {displacement: 10 deg}}\n", "start.body.displacement", "mixed", {"needed": "length"}),
        (
            HEAD + "excitation: {on: body, table: {time: [0 s, 1 s], force: [1 N, 1 N·m]}}\n",
            "excitation.table.force.1",
            "mixed",
            {"needed": "force"},
        ),
        (
            HEAD.replace("25 kg", "1 kg·m²").replace("kN/m", "kN·m/rad")
            + "excitation: {on: body, unbalance: 1 kg·m, frequency: 3 Hz}\n",
            "excitation.unbalance",
            "turning_unbalance",
            {},
        ),
        (HEAD + "excitation: {base: 0 mm, frequency: 3 Hz}\n", "excitation.base", "no_amplitude", {}),
        (HEAD.replace("[ground, body]", "[ground, bodi]"), "springs.k.between", "no_such_mass", {"name": "bodi"}),
        (HEAD.replace("[ground, body]", "[body, body]"), "springs.k.between", "two_ends", {}),
        (HEAD.replace("25 kg}", "25 kg, disc: 3 kg·m²}"), "masses.body", "mixed", {"needed": "inertia"}),
        (HEAD.replace("10 kN/m", "10 kN·m"), "springs.k.stiffness", "mixed", {"needed": "stiffness"}),
        (HEAD.replace("25 kg", "-25 kg"), "masses.body", "mass_above_zero", {}),
        (HEAD + "absorber: {on: bodi, mass: 3 kg}\n", "absorber", "absorber_alone", {}),
        (
            HEAD + "excitation: {on: body, table: {time: [0 s, 0 s], force: [1 N, 1 N]}}\n",
            "excitation.table",
            "table",
            {"message": "the measured force must be a table of increasing times"},
        ),
    ],
)
def test_systems(text: str, key: str, code: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.loads(text, "v.yaml").solve()


@pytest.mark.parametrize(
    ("law", "key", "code", "values"),
    [
        ("cyclical", "law", "law", {"law": "cyclical", "name": "cyclical"}),
        ("u^2*3", "law", "law_ends", {"first": "0", "last": "3"}),
        ("u/0", "law", "law", {"law": "u/0", "text": "u/0"}),
    ],
)
def test_followers(law: str, key: str, code: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.FollowerSpring(1.0, 1e4, 0.01, 0.1, law).solve()


def test_mounts() -> None:
    with faulty("nothing_shakes", "mechanism"):
        parts.Mounts(store.machine("crank_rocker"), 100.0, 1e6, 1e6).solve()
    crusher = store.machine("jaw_crusher_sixbar")
    with faulty("too_light", "mass", moving="1800"):
        parts.Mounts(crusher, 100.0, 1e6, 1e6).solve()
    own = 8000.0 * (2 * 3.141592653589793 * 170 / 60) ** 2
    with faulty("resonance", "mass", hertz="2.83333"):
        parts.Mounts(crusher, 8000.0, own, 1e6).solve()
