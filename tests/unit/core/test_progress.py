"""Progress of work: pieces of a time that is aimed at, and parts of a whole."""

from types import SimpleNamespace

import pytest

import linkwright as lw
from linkwright.core.progress import PACE, paced, part_of
from linkwright.validation.validate import from_gallery


def test_pieces_take_as_long_as_they_should(monkeypatch: pytest.MonkeyPatch) -> None:
    """3 ms an item by a clock of its own: after the first ones, pieces of the time that is aimed at."""
    clock = [0.0]
    monkeypatch.setattr("linkwright.core.progress.time", SimpleNamespace(perf_counter=lambda: clock[0]))
    taken = []
    for first, last in paced(600):
        clock[0] += 0.003 * (last - first)
        taken.append(0.003 * (last - first))
    assert sum(taken) == pytest.approx(0.003 * 600)
    assert max(taken) <= PACE and taken[2] == pytest.approx(PACE, abs=0.003)


def test_parts_are_one_whole() -> None:
    calls: list[tuple[int, int]] = []
    for number in range(3):
        tell = part_of(lambda done, total: calls.append((done, total)), number, 3)
        assert tell is not None
        for done in (150, 300):
            tell(done, 300)
    assert calls == [(done, 300) for done in (50, 100, 150, 200, 250, 300)]
    assert part_of(None, 0, 3) is None


def test_validations_tell_of_their_cases() -> None:
    cases = [*from_gallery("swing_conveyor"), *from_gallery("crank_rocker")]
    calls: list[tuple[int, int]] = []
    with lw.reporting(lambda done, total: calls.append((done, total))):
        lw.validate(cases)
    assert calls == [(k, len(cases)) for k in range(1, len(cases) + 1)]
