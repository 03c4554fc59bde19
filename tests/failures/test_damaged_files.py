"""Damaged model files: whatever was cut, doubled or mistyped, the answer is findings at places or a model."""

import random
from contextlib import suppress

import pytest
from tests import store
from tests.damage import EVERY_VALUE, VALUES, damaged
from tests.failures.placed import is_placed
from tests.refusals import findings, said
from tests.work import AT_ONCE, counted

import linkwright as lw


def answered(batch: int, count: int = 25) -> None:
    """Some damage is harmless and reads as the model that it writes again; most is found, at places, at once."""
    rng = random.Random(batch)
    read = 0
    for number in range(count):
        name = rng.choice(store.names())
        text = damaged(store.text(name), rng)
        try:
            found, calls = counted(lambda text=text: findings(text, "m.yaml"))
        except Exception as error:
            raise AssertionError(f"{name}, batch {batch}, number {number}: {text!r}") from error
        assert calls < AT_ONCE, text
        assert all(is_placed(each, text) for each in found), (found, text)
        if any(each.severity == "error" for each in found):
            with pytest.raises(lw.ModelError):
                lw.loads(text, "m.yaml")
            continue
        read += 1
        mechanism = lw.loads(text, "m.yaml")
        assert lw.loads(lw.dump(mechanism), "m.yaml").dimensions() == mechanism.dimensions(), text
    assert 0 < read < count


def test_damage_is_answered_at_once() -> None:
    answered(0)


@pytest.mark.rotating
@pytest.mark.parametrize("batch", range(1, 15))
def test_more_damage_is_answered_at_once(batch: int) -> None:
    answered(batch)


@pytest.mark.long
@pytest.mark.parametrize("batch", range(100, 130))
def test_much_damage_is_answered_at_once(batch: int) -> None:
    answered(batch, 125)


def readable(number: int) -> lw.Mechanism:
    """The first damaged text of many that still reads as a model."""
    rng = random.Random(1000 + number)
    for _ in range(400):
        with suppress(lw.ModelError):
            return lw.loads(damaged(store.text(rng.choice(store.names())), rng))
    raise AssertionError("nothing of four hundred reads")


def solved_or_refused(number: int) -> bool:
    """Whether what still reads as a model is solved; else it is refused with a code."""
    mechanism = readable(number)
    with suppress(lw.LinkwrightError):
        lw.solve_forces(lw.solve_motion(mechanism, steps=12))
        return True
    with pytest.raises(lw.LinkwrightError) as caught:
        lw.solve_forces(lw.solve_motion(mechanism, steps=12))
    assert caught.value.code
    return False


def test_damage_that_reads_solves_or_is_refused() -> None:
    assert True in {solved_or_refused(number) for number in range(8)}


@pytest.mark.long
def test_much_damage_that_reads_solves_or_is_refused() -> None:
    assert {solved_or_refused(number) for number in range(8, 200)} == {True, False}


def test_a_wrong_parameter_is_told_once_wherever_it_stands() -> None:
    """The value that cannot be read is told; what it would have been used for is no error of its own."""
    assert len(VALUES) > 35
    for each in VALUES:
        text = f"{EVERY_VALUE[: each.start()]}wrong{EVERY_VALUE[each.end() :]}"
        told = [found.key for found in findings(text) if found.severity == "error"]
        assert told == ["parameters.wrong"], (text[each.start() - 20 : each.start() + 6], told)


def test_a_unit_with_two_exponents_is_unknown() -> None:
    text = EVERY_VALUE.replace("0.01 kg·m²", "0.01 kg·m7²")
    said(findings(text), "unknown-name", "links.crank.inertia", name="m7")
