"""Vibration that has no answer is refused with the reason."""

import pytest

import linkwright as lw
from linkwright import parts

HEAD = "format: 1\nkind: vibration\nmasses: {body: 25 kg}\n"
HEAD += "springs: {k: {between: [ground, body], stiffness: 10 kN/m}}\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (HEAD + "excitation: {on: body, force: 5 N, frequency: 3.1830988618379066 Hz}\n", "resonance"),
        (HEAD + "excitation: {on: body, force: 5 N}\n", "neither complete nor unique"),
        (HEAD + "excitation: {on: head, force: 5 N, frequency: 3 Hz}\n", 'no mass "head"'),
        (
            HEAD + "excitation: {on: body, force: 0 N, frequency: 3 Hz}\n",
            "excitation.force: an amplitude of zero",
        ),
        (
            HEAD + "excitation: {on: body, force: 20 mm, frequency: 3 Hz}\n",
            "excitation.force: .* a force is needed",
        ),
        (HEAD + "excitation: {base: 5 N, frequency: 3 Hz}\n", "excitation.base: .* a length is needed"),
        (HEAD + "start: {body: {displacement: 10 deg}}\n", "start.body.displacement: .* a length is needed"),
        (
            HEAD + "excitation: {on: body, table: {time: [0 s, 1 s], force: [1 N, 1 N·m]}}\n",
            "excitation.table.force.1: .* a force is needed",
        ),
        (
            HEAD.replace("25 kg", "1 kg·m²").replace("kN/m", "kN·m/rad")
            + "excitation: {on: body, unbalance: 1 kg·m, frequency: 3 Hz}\n",
            "shakes masses, not discs",
        ),
        (HEAD + "excitation: {base: 0 mm, frequency: 3 Hz}\n", "excitation.base: an amplitude of zero"),
        (HEAD.replace("[ground, body]", "[ground, bodi]"), 'no mass "bodi"'),
        (HEAD.replace("[ground, body]", "[body, body]"), "two different ends"),
        (HEAD.replace("25 kg}", "25 kg, disc: 3 kg·m²}"), "stand together"),
        (HEAD.replace("10 kN/m", "10 kN·m"), "a stiffness is needed here"),
        (HEAD.replace("25 kg", "-25 kg"), "not above 1e-12 kg"),
        (HEAD + "absorber: {on: bodi, mass: 3 kg}\n", "one mass without dampers"),
        (HEAD + "excitation: {on: body, table: {time: [0 s, 0 s], force: [1 N, 1 N]}}\n", "increasing times"),
    ],
)
def test_systems(text: str, words: str) -> None:
    with pytest.raises(lw.ModelError, match=words) as error:
        parts.loads(text, "v.yaml").solve()
    assert error.value.say("zh") != str(error.value)


@pytest.mark.parametrize(
    ("law", "words"),
    [("cyclical", "cannot be read"), ("u^2*3", "goes from 0 to 3"), ("u/0", "cannot be read")],
)
def test_followers(law: str, words: str) -> None:
    with pytest.raises(lw.ModelError, match=words):
        parts.FollowerSpring(1.0, 1e4, 0.01, 0.1, law).solve()


def test_mounts() -> None:
    with pytest.raises(lw.ModelError, match="nothing shakes the machine"):
        parts.Mounts(lw.load("gallery:crank_rocker"), 100.0, 1e6, 1e6).solve()
    crusher = lw.load("gallery:jaw_crusher_sixbar")
    with pytest.raises(lw.ModelError, match="lighter than its moving links"):
        parts.Mounts(crusher, 100.0, 1e6, 1e6).solve()
    own = 8000.0 * (2 * 3.141592653589793 * 170 / 60) ** 2
    with pytest.raises(lw.ModelError, match="resonance"):
        parts.Mounts(crusher, 8000.0, own, 1e6).solve()
