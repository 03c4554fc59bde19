"""Optimisation of any machine: a global search, all designs of a generation in one sweep, then exact gradients."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.errors import RequestError
from linkwright.files.document import Document
from linkwright.files.model_file import read_document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.optimisation.evolution import (
    State,
    begin,
    dominates,
    fronts,
    generation,
    idle,
    ranked,
    resumed,
    taken,
)
from linkwright.optimisation.optimum import Choice, OptimizeError, Optimum, hypervolume
from linkwright.optimisation.polish import Polish
from linkwright.optimisation.problem import problem
from linkwright.optimisation.task import Judged, Task
from linkwright.whole_files import write_whole
from linkwright.words.sentence import Sentence
from linkwright.words.titles import title_said

Progress = Callable[[int, int], None]
#: Evaluations where designs go one after the other and nobody says how many; seconds between two saved states.
SLOW, SAVED = 400, 2.0
#: Designs that are polished with one objective; twice as many between the ends of a front.
POLISHED = 3
#: Designs of a front are alike whose objectives differ by less than this share.
ALIKE = 1e-5


def optimize(
    source: Mechanism | Document | str | Path,
    *,
    state: str | Path | None = None,
    progress: Progress | None = None,
    leading: Callable[[Optimum], None] | None = None,
    **settings: Any,
) -> Optimum:
    """The dimensions of a machine that make one number or several least, within what must be kept.

    Args:
        source: a mechanism, or a document or model file whose section ``optimize`` has the settings.
        state: a file that the search keeps up to date; where it exists already, the search goes on from it.
        progress: called with (evaluations done, most); what it raises stops the search.
        leading: called after every generation with the best so far: designs that move, not polished yet, their
            demands not all met at first.
        settings: those of the section, by the same names, in place of it:
            ``vary``: by address or parameter a range ``"80..120 mm"``, ``{"values": [...]}`` (a catalogue) or
            ``{"whole": "18..40"}``; ``minimize``, ``maximize``: a number or several: a design number
            (``peak_reaction O5``), ``flywheel``, a summary (``jaw.angle range``), a dimension, a
            :class:`PathError`, or an expression of names that ``define`` gives to these; ``keep``: by number
            ``"at least 40 deg"``, ``"at most 60 kN"``, ``"1..2 m"``,
            ``"same within 1 %"`` (of the start); ``tolerance``: ± by address, with ``robust``: ``worst`` (objective
            and demands hold for the worst of the samples) or ``yield`` (a share ``yield`` of them meets the
            demands); ``fluctuation`` δ of flywheels; ``evaluations``, ``population``, ``seed``, ``steps``.

    Returns:
        The optimum, or the front of several objectives. All designs move over the whole cycle with the assembly modes
        of the start, so none has a branch defect or another order of positions.

    Raises:
        OptimizeError: the demands cannot be met together; ``nearest`` is the design that misses them least.
        ModelError: settings that cannot be read, with all findings.
        LinkwrightError: a state of another problem; nothing moves.
    """
    mechanism, document, given = _source(source, settings)
    asked = problem(mechanism, given, "" if document is None else document.name)
    task = Task(asked)
    if not task.measures.side_by_side and "evaluations" not in given:
        asked = replace(asked, evaluations=SLOW)
    size = asked.population or (64 if len(asked.goals) > 1 else min(64, max(24, 8 * len(asked.variables))))
    path = None if state is None else Path(state)
    run = _Run(task, size, asked.evaluations, path, progress, _digest(asked, given), document, leading)
    return run.optimum()


def _source(
    source: Mechanism | Document | str | Path, settings: Mapping[str, Any]
) -> tuple[Mechanism, Document | None, dict[str, Any]]:
    if isinstance(source, Mechanism):
        document, mechanism = None, source
    else:
        document = source if isinstance(source, Document) else read_document(source)
        mechanism = document.mechanism
    given = dict(mechanism.optimize) | {key: value for key, value in settings.items() if value is not None}
    if not given:
        raise RequestError(Sentence("optimize.no_section", name=partial(title_said, mechanism.name)))
    return mechanism, document, given


def _digest(asked: Any, given: Mapping[str, Any]) -> str:
    """What a state must agree with: the settings and the machine's dimensions."""
    known = sorted(asked.mechanism.dimensions().items())
    plain = {key: value for key, value in given.items() if key not in ("evaluations",)}
    return hashlib.blake2b(repr((plain, known)).encode(), digest_size=12).hexdigest()


def _between(front: Judged) -> NDArray[np.float64]:
    """Places of the cube along a front: its designs, and between those whose objectives lie far apart."""
    order = np.lexsort(front.goals.T[::-1])
    x, goals = front.x[order], front.goals[order]
    size = np.maximum(np.ptp(goals, axis=0), 1e-300)
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(goals / size, axis=0), axis=1))])
    wanted = np.linspace(0, along[-1], 2 * POLISHED + 2)[1:-1]
    return np.column_stack([np.interp(wanted, along, column) for column in x.T]) if len(x) > 1 else x


def _apart(judged: Judged) -> Judged:
    """Without designs whose objectives differ less than ``ALIKE`` from those of the one before."""
    rows = [0]
    for k in range(1, len(judged.x)):
        if (np.abs(judged.goals[k] - judged.goals[rows[-1]]) > ALIKE * np.abs(judged.goals[k])).any():
            rows.append(k)
    return taken(judged, np.array(rows, dtype=np.intp))


class _Run:
    """One search."""

    def __init__(
        self,
        task: Task,
        size: int,
        most: int,
        path: Path | None,
        progress: Progress | None,
        digest: str,
        document: Document | None,
        leading: Callable[[Optimum], None] | None,
    ) -> None:
        self.task, self.size, self.most, self.path = task, size, most, path
        self.progress, self.digest, self.stopped = progress, digest, False
        self.document, self.leading = document, leading

    def optimum(self) -> Optimum:
        state = self._searched()
        judged = state.judged if self.stopped else self._polished(state.judged)
        chosen = self._chosen(judged)
        if not np.isfinite(chosen.violations).all():
            raise RequestError(
                Sentence("optimize.nothing_moves", name=partial(title_said, self.task.problem.mechanism.name))
            )
        found = self._made(chosen, state, made=True)
        if not (judged.total == 0).any():
            raise OptimizeError(self._failing(found), found)
        return found

    @staticmethod
    def _chosen(judged: Judged) -> Judged:
        """The best design, or the front of those that meet all demands."""
        feasible = judged.total == 0
        several = judged.goals.shape[1] > 1
        if feasible.any() and several:
            good = taken(judged, np.flatnonzero(feasible))
            chosen = taken(good, np.flatnonzero(fronts(good) == 0))
            return _apart(taken(chosen, np.lexsort(chosen.goals.T[::-1])))
        return taken(judged, ranked(judged)[:1])

    def _tell(self, state: State) -> None:
        if self.progress is not None:
            self.progress(min(state.evaluations, self.most), self.most)
        if self.leading is not None:
            chosen = self._chosen(state.judged)
            if np.isfinite(chosen.violations).all():
                self.leading(self._made(chosen, state, made=False))

    def _searched(self) -> State:
        state = self._begun()
        snapshot, saved = state.data(), time.monotonic()
        try:
            while state.evaluations < self.most and not idle(state):
                generation(self.task, state)
                snapshot = state.data()
                if self.path is not None and time.monotonic() - saved > SAVED:
                    self._save(snapshot)
                    saved = time.monotonic()
                self._tell(state)
        except KeyboardInterrupt:
            self.stopped = True
            if self.path is None:
                self.path = Path(f"{self.task.problem.mechanism.name.replace(' ', '_')}.search.json")
            self._save(snapshot)
            return resumed(self.task, snapshot)
        if self.path is not None:
            self._save(snapshot)
        return state

    def _begun(self) -> State:
        if self.path is None or not self.path.exists():
            return begin(self.task, self.size)
        try:
            data = json.loads(self.path.read_text(encoding="utf-8"))
            if data["problem"] != self.digest:
                raise RequestError(Sentence("optimize.other_state", path=self.path))
            return resumed(self.task, data)
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            raise RequestError(Sentence("optimize.bad_state", path=self.path)) from None

    def _save(self, snapshot: dict[str, Any]) -> None:
        assert self.path is not None
        write_whole(self.path, json.dumps({"problem": self.digest, **snapshot}).encode())

    def _polished(self, judged: Judged) -> Judged:
        """The population with its best designs polished."""
        count = judged.goals.shape[1]
        polish = Polish(self.task)
        if count == 1 or not (judged.total == 0).any():
            rows = self._different(judged, ranked(judged), POLISHED)
            return self._bettered(judged, polish.polished(judged, rows, [~0] * len(rows)))
        inside = np.where(judged.total[:, None] == 0, judged.goals, np.inf)
        ends = [int(each) for each in inside.argmin(axis=0)]
        judged = self._bettered(judged, polish.polished(judged, ends, [~k for k in range(count)]))
        front = taken(judged, np.flatnonzero((fronts(judged) == 0) & (judged.total == 0)))
        between = self.task.judge(_between(front))
        middle = self._different(between, ranked(between), 2 * POLISHED)
        return self._bettered(
            judged, polish.polished(between, middle, [k % count for k in range(len(middle))])
        )

    @staticmethod
    def _bettered(judged: Judged, better: Judged) -> Judged:
        """The designs with the better ones, without those that these beat."""
        size = len(judged.x)
        values = {text: np.concatenate([each, better.values[text]]) for text, each in judged.values.items()}
        both = Judged(
            np.concatenate([judged.x, better.x]), np.concatenate([judged.goals, better.goals]),
            np.concatenate([judged.violations, better.violations]), values,
        )  # fmt: skip
        pairs = np.array([[i, j] for i in range(len(both.x)) for j in range(size, len(both.x))])
        beaten = pairs[dominates(both, both, pairs[:, 1], pairs[:, 0]), 0]
        return taken(both, np.setdiff1d(np.arange(len(both.x)), beaten))

    @staticmethod
    def _different(judged: Judged, order: NDArray[np.intp], most: int) -> list[int]:
        """The first rows that lie apart."""
        rows: list[int] = []
        for row in order:
            if all(np.abs(judged.x[row] - judged.x[other]).max() > 0.03 for other in rows):
                rows.append(int(row))
            if len(rows) == most:
                break
        return rows

    def _made(self, chosen: Judged, state: State, *, made: bool) -> Optimum:
        """The designs as an optimum; ``made``: at the end, with the share of machines that meet all demands and the
        variables that change nothing."""
        task, asked = self.task, self.task.problem
        values = task.place(chosen.x)
        idle = task.without_effect(values[0]) if made else ()
        for i, each in enumerate(asked.variables):
            if each.address in idle:
                values[:, i] = each.allowed(asked.start[i : i + 1])
        choices = []
        for k in range(len(chosen.x)):
            missed = tuple(
                each.text
                for each in task.bounds
                if each.violation(chosen.values[each.text][k : k + 1])[0] > 0
            )
            choices.append(Choice(
                {each.address: float(values[k, i]) for i, each in enumerate(asked.variables)},
                {text: float(each[k]) for text, each in chosen.values.items()}, missed,
                task.yield_of(values[k]) if made and asked.tolerances and k == 0 else None,
            ))  # fmt: skip
        share = None
        if len(asked.goals) > 1 and np.isfinite(chosen.goals).all():
            start = np.array([goal.sign * task.at_start[goal.text] for goal in asked.goals])
            worst = np.maximum(chosen.goals.max(axis=0), np.where(np.isfinite(start), start, -np.inf))
            share = hypervolume(chosen.goals, worst)
        return Optimum(
            asked, tuple(choices), dict(task.at_start), {each.text: (each.low, each.high) for each in task.bounds},
            {text: task.measures.dimension(text) for text in task.measures.expressions}, task.measures.evaluations,
            state.generation, tuple(state.history), share, task.measures.side_by_side, self.stopped, idle,
            self.document,
        )  # fmt: skip

    def _failing(self, found: Optimum) -> Sentence:
        """Which demands the nearest design misses, and by how much."""
        from linkwright.optimisation.report import missing

        return Sentence("optimize.failing", demands=tuple(missing(found)))
