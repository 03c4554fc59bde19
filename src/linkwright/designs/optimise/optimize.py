"""Optimisation of any machine: a global search, all designs of a generation in one sweep, then exact gradients."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from linkwright.core.arguments import require
from linkwright.core.arrays import Floats
from linkwright.core.progress import Progress, current_progress, reporting
from linkwright.designs.checkpoints import checkpointing, current_checkpoints
from linkwright.designs.optimise.evolution import (
    Scale,
    State,
    begin,
    dominates,
    fronts,
    generation,
    idle,
    joined,
    nearest,
    picked,
    ranked,
    resumed,
    spread,
    taken,
    without_own,
)
from linkwright.designs.optimise.local_search import Polish
from linkwright.designs.optimise.optimum import Choice, OptimizeError, Optimum, hypervolume
from linkwright.designs.optimise.problem import problem
from linkwright.designs.optimise.task import CHECKED, Judged, Task
from linkwright.errors import LinkwrightError, ModelError, RequestError
from linkwright.files.model_file import read_document
from linkwright.files.write import Document, dump
from linkwright.kinematics.motion import PositionError
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

#: Evaluations where designs go one after the other, by default; the key of a stored population.
SLOW, POPULATION = 400, "population"
#: Share of the evaluations that the first designs take, and the most that one sweep has; how many of them the local
#: search starts from, its steps, and their minimum distance in the cube.
SAMPLED, AT_ONCE, STARTS, FEW, SEPARATION = 0.5, 20_000, 16, 10, 0.1
#: Designs that are polished in the end for each objective; places along a front.
POLISHED, FRONT = 3, 48
#: What a step along a front must gain, as share of its width, and how often places without a design of their own are
#: tried again from the neighbouring designs.
EVEN, ROUNDS = 2e-5, 3
#: Steps of the last local search, and how near in the cube two of its designs may begin.
LAST, NEAR = 90, 0.03
#: The same where designs go one by one: designs for each objective, places along a front, steps.
POLISHED_ALONE, FRONT_ALONE, LAST_ALONE = 1, 6, 12
#: How often a design is polished again for a yield that it lacks, with so many samples.
AGAIN, FINER = 6, 2048
#: Most designs of catalogues that are all judged; the same where they are judged by expressions alone.
ALL, ALL_WRITTEN = 1024, 1_000_000
_NO_ROWS = np.array([], dtype=np.intp)
#: Designs of a front count as equal whose objectives differ by less than this share.
SAME_OBJECTIVES = 1e-5
#: Objectives below this share of the start's are none; so many times its size an objective lies below its aim that
#: does not count but where nothing else does.
NOTHING, ASIDE = 1e-9, 10.0


def optimize(
    source: Mechanism | Document | str | Path,
    *,
    state: str | Path | None = None,
    progress: Progress | None = None,
    leading: Callable[[Optimum], None] | None = None,
    **settings: Any,
) -> Optimum:
    """The dimensions of a machine that minimize one quantity or several, within demands.

    Args:
        source: a mechanism, or a document or model file whose section ``optimize`` has the settings.
        state: a file that the search keeps up to date; where it exists already, the search goes on from it.
        progress: called with (evaluations done, most); what it raises stops the search.
        leading: called after every generation with the best so far: designs that move, not polished yet, their
            demands not all met at first.
        settings: those of the section, by the same names, in place of it:
            ``vary``: by address or parameter a range ``"80..120 mm"``, ``{"values": [...]}`` (a catalogue) or
            ``{"whole": "18..40"}``; ``minimize``, ``maximize``: a number or several: a metric
            (``peak_reaction O5``), ``flywheel``, a summary (``jaw.angle range``), a dimension, a
            :class:`PathError`, or an expression of names that ``define`` gives to these; ``keep``: by number
            ``"at least 40 deg"``, ``"at most 60 kN"``, ``"1..2 m"``,
            ``"same within 1 %"`` (of the start); ``tolerance``: ± by address, with ``robust``: ``worst`` (objective
            and demands hold for the worst of the samples) or ``yield`` (a share ``yield`` of them meets the
            demands); ``fluctuation`` δ of flywheels; ``evaluations``, ``population``, ``seed``, ``steps``.

    Returns:
        The optimum, or the front of several objectives. All designs move over the full cycle with the assembly modes
        of the start, so none has a branch defect or another order of positions.

    Raises:
        OptimizeError: the demands cannot be met together; ``nearest`` has the smallest violation. A search
            that was stopped before any met them gives that design with what it misses.
        ModelError: settings that cannot be read, with all findings.
        Interrupted: a KeyboardInterrupt before the first designs were known, or one that moves: the search goes on
            from its file ``state``.
        LinkwrightError: a state of another problem; nothing moves.
    """
    mechanism, document, section = _source(source, settings)
    with _at_their_lines(document, settings):
        asked = problem(mechanism, section, "" if document is None else document.name)
    machine = dump(replace(asked.mechanism, optimize={}))
    depends = {key: value for key, value in section.items() if key != "evaluations"}
    progress = progress or current_progress()
    with checkpointing(state, asked.mechanism.name, machine, depends), reporting(None):
        with _at_their_lines(document, settings):
            task = Task(asked)
        if not task.measures.side_by_side and "evaluations" not in section:
            asked = replace(asked, evaluations=SLOW)
        size = asked.population or (64 if len(asked.goals) > 1 else min(64, max(24, 8 * len(asked.variables))))
        return _Run(task, size, asked.evaluations, progress, document, leading).optimum()


def _source(
    source: Mechanism | Document | str | Path, settings: Mapping[str, Any]
) -> tuple[Mechanism, Document | None, Mapping[str, Any]]:
    require(source, Mechanism, Document, str, PathLike)
    if isinstance(source, Mechanism):
        document, mechanism = None, source
    else:
        document = source if isinstance(source, Document) else read_document(source)
        mechanism = document.mechanism
    own = {key: value for key, value in settings.items() if value is not None}
    section = {**mechanism.optimize, **own} if own else mechanism.optimize
    if not section:
        raise RequestError(
            _(
                '{name} has no section "optimize"; add one with vary: and minimize:, or give them here',
                code="optimize.no_section",
                name=mechanism.name,
            )
        )
    return mechanism, document, section


@contextmanager
def _at_their_lines(document: Document | None, settings: Mapping[str, Any]) -> Iterator[None]:
    """Findings about the section of a document get its lines; those about ``settings`` in its place get none."""
    try:
        yield
    except ModelError as error:
        if document is None:
            raise
        replaced = [f"optimize.{key}" for key, value in settings.items() if value is not None]
        raise document.located(error, replaced) from None


def _distinct(judged: Judged) -> Judged:
    """Without designs whose objectives differ less than ``SAME_OBJECTIVES`` from those of the one before."""
    rows = [0]
    for k in range(1, len(judged.x)):
        if (np.abs(judged.goals[k] - judged.goals[rows[-1]]) > SAME_OBJECTIVES * np.abs(judged.goals[k])).any():
            rows.append(k)
    return taken(judged, np.array(rows, dtype=np.intp))


class _Run:
    """One search."""

    def __init__(
        self,
        task: Task,
        size: int,
        most: int,
        progress: Progress | None,
        document: Document | None,
        leading: Callable[[Optimum], None] | None,
    ) -> None:
        self.task, self.size, self.most = task, size, most
        self.progress, self.document, self.leading = progress, document, leading
        self.stopped: Path | None = None
        checkpoints = current_checkpoints()
        assert checkpoints is not None
        self.checkpoints = checkpoints
        self.polish = Polish(task)
        alone = not task.measures.side_by_side
        self.best, self.places = (POLISHED_ALONE, FRONT_ALONE) if alone else (POLISHED, FRONT)
        self.last = LAST_ALONE if alone else LAST

    def optimum(self) -> Optimum:
        try:
            state = self._searched()
            return self._found(state, self._made_sure(self._polished(self._sure(state))))
        except KeyboardInterrupt:
            left = self._left()
            if left is None:
                raise
            self.stopped = self.checkpoints.left()
            return self._found(left, left.judged)

    def _found(self, state: State, judged: Judged) -> Optimum:
        """The best of the designs, or their front; raises where none meets the demands."""
        chosen = self._chosen(judged)
        if not np.isfinite(chosen.violations).all():
            if self.stopped is not None:
                raise KeyboardInterrupt
            raise RequestError(self._nothing(judged))
        found = self._made(chosen, state, made=True)
        if self.stopped is None and not (judged.total == 0).any():
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
            return _distinct(taken(chosen, np.lexsort(chosen.goals.T[::-1])))
        return taken(judged, ranked(judged)[:1])

    def _tell(self, state: State) -> None:
        if self.progress is not None:
            self.progress(min(state.evaluations, self.most), self.most)
        if self.leading is not None:
            chosen = self._chosen(state.judged)
            if np.isfinite(chosen.violations).all():
                self.leading(self._made(chosen, state, made=False))

    def _searched(self) -> State:
        """The search's end, not polished."""
        state = self._left() or self._fresh()
        self._keep(state)
        while state.evaluations < self.most and not idle(state):
            generation(self.task, state)
            self._keep(state)
        return state

    def _keep(self, state: State) -> None:
        """Keeps a population, with the number of designs measured for it, and tells of it."""
        self.checkpoints.add(POPULATION, {**state.data(), "measured": self.task.measures.evaluations})
        self._tell(state)

    def _left(self) -> State | None:
        """The stored population; None: none is stored."""

        def made(data: dict[str, Any]) -> State:
            state = resumed(self.task, data)
            self.task.measures.evaluations = int(data["measured"])
            return state

        return self.checkpoints.resumed(POPULATION, made)

    def _fresh(self) -> State:
        """The first population: the best of many designs, some of them after a short local search; all designs, and
        the search's end, where they are few."""
        written = self.task.written and len(self.task.problem.goals) == 1
        every = self.task.every(ALL_WRITTEN if written else min(self.most, ALL))
        if every is not None:
            draw, judged = np.random.default_rng(self.task.problem.seed), self.task.judge(every)
            best = taken(judged, ranked(judged)[:ALL]) if len(every) > ALL else judged
            return State(best, 0, self.most, draw, [])
        if not self.task.measures.side_by_side:
            return begin(self.task, self.size)
        state = begin(self.task, max(self.size, min(int(SAMPLED * self.most), AT_ONCE)))
        goals = state.judged.goals.shape[1]
        better = self._descended(state.judged, spread(goals, STARTS), STARTS, SEPARATION, FEW)
        judged = joined(state.judged, better, _NO_ROWS, np.arange(len(better.x)))
        distance = nearest(judged, Scale.of(judged), spread(goals, self.size))
        rows = picked(judged, distance, self.size, 0.0)
        rows += np.setdiff1d(np.arange(len(judged.x)), rows)[: self.size - len(rows)].tolist()
        state.judged = taken(judged, np.array(rows, dtype=np.intp))
        return state

    def _descended(self, judged: Judged, points: Floats, count: int, separation: float, steps: int) -> Judged:
        """Designs by turns nearest to points between the best and the worst of each objective, moved nearer."""
        scale = Scale.of(judged)
        rows = picked(judged, nearest(judged, scale, points), count, separation)
        before = taken(judged, np.array(rows, dtype=np.intp))
        if before.goals.shape[1] == 1:
            return self.polish.polished(
                before, 1.0 / self._sizes(before, 0)[:, None], np.zeros_like(before.goals), steps
            )
        aims = np.resize(scale.aims(points), before.goals.shape)
        return self.polish.polished(before, np.tile(1.0 / scale.span, (len(rows), 1)), aims, steps, EVEN)

    def _sizes(self, judged: Judged, goal: int) -> Floats:
        """What counts as much of an objective, (K,): its value, but for values negligible against the start's."""
        start = abs(self.task.at_start[self.task.problem.goals[goal].text])
        floor = NOTHING * start if np.isfinite(start) and start > 0.0 else NOTHING
        found = np.abs(judged.goals[:, goal])
        return np.maximum(np.where(np.isfinite(found), found, 1.0), floor)

    def _sure(self, state: State) -> Judged:
        """The population, for a yield judged by as many samples as the result is checked with."""
        if self.task.problem.robust != "yield" or not self.task.measures.side_by_side:
            return state.judged
        self.task.samples = CHECKED
        return self.task.judge(state.judged.x)

    def _made_sure(self, judged: Judged) -> Judged:
        """For a yield: the best designs descend again, to a higher one while other samples find that they lack some.

        Samples by which a design was chosen flatter it. Where that leads nowhere the designs stay.
        """
        task, found = self.task, judged
        sampled = task.problem.robust == "yield" and task.measures.side_by_side
        if not sampled or judged.goals.shape[1] > 1 or not (judged.total == 0).any():
            return judged
        for _unused in range(AGAIN):
            best = self._chosen(found)
            if not np.isfinite(best.goals).all():
                break
            lack = task.problem.min_yield - task.yield_of(task.place(best.x)[0])
            if lack <= 0.0:
                return replace(best, violations=np.zeros_like(best.violations))
            task.wanted = min(task.wanted + lack, 1.0) if task.samples == FINER else task.wanted
            task.samples = FINER
            before = task.judge(found.x[ranked(found)[: self.best]])
            sizes = self._sizes(before, 0)[:, None]
            found = self.polish.polished(before, 1.0 / sizes, np.zeros_like(before.goals), self.last)
        return judged

    def _polished(self, judged: Judged) -> Judged:
        """The population with its best designs polished; of several objectives the front, evenly filled."""
        count = judged.goals.shape[1]
        if not (judged.total == 0).any():
            judged = self._bettered(judged, self._nearest(judged))
        if not (judged.total == 0).any():
            return judged
        if count == 1:
            better = self._descended(judged, np.zeros((1, count)), self.best, NEAR, self.last)
            return self._bettered(judged, better)
        for goal in range(count):
            judged = self._bettered(judged, self._end(judged, goal))
        points = spread(count, self.places)
        for _unused in range(ROUNDS):
            judged = self._bettered(judged, self._descended(judged, points, len(points), -1.0, self.last))
            points = points[without_own(judged, points)]
            if not len(points):
                break
        points = spread(count, FRONT)
        rows = picked(judged, nearest(judged, Scale.of(judged), points), len(points), 0.0)
        return taken(judged, np.array(rows, dtype=np.intp))

    def _nearest(self, judged: Judged) -> Judged:
        """Designs with the smallest violation of demands, whatever the objectives."""
        before = taken(judged, np.array(picked(judged, judged.total[None], self.best, NEAR), dtype=np.intp))
        none = np.zeros_like(before.goals)
        return self.polish.polished(before, none, none, self.last)

    def _end(self, judged: Judged, goal: int) -> Judged:
        """Designs with the minimum of one objective."""
        alone = np.where(judged.total == 0, judged.goals[:, goal], np.inf)
        rows = np.array(picked(judged, alone[None], self.best, NEAR), dtype=np.intp)
        before = taken(judged, rows)
        sizes = np.stack([self._sizes(before, k) for k in range(before.goals.shape[1])], axis=1)
        aims = before.goals + ASIDE * sizes
        aims[:, goal] = 0.0
        return self.polish.polished(before, 1.0 / sizes, aims, self.last)

    @staticmethod
    def _bettered(judged: Judged, better: Judged) -> Judged:
        """The designs with the better ones, without those that these beat."""
        if not len(better.x):
            return judged
        size = len(judged.x)
        values = {text: np.concatenate([each, better.values[text]]) for text, each in judged.values.items()}
        both = Judged(
            np.concatenate([judged.x, better.x]),
            np.concatenate([judged.goals, better.goals]),
            np.concatenate([judged.violations, better.violations]),
            values,
        )
        pairs = np.array([[i, j] for i in range(len(both.x)) for j in range(size, len(both.x))])
        beaten = pairs[dominates(both, both, pairs[:, 1], pairs[:, 0]), 0]
        return taken(both, np.setdiff1d(np.arange(len(both.x)), beaten))

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
            worst = task.worst_of(values[k]) if made and task.at_corners and k == 0 else {}
            missed = tuple(
                each.text
                for each in task.bounds
                if each.violation(np.array(worst.get(each.text, chosen.values[each.text][k]))).max() > 0
            )
            choices.append(
                Choice(
                    {each.address: float(values[k, i]) for i, each in enumerate(asked.variables)},
                    {text: float(each[k]) for text, each in chosen.values.items()},
                    missed,
                    task.yield_of(values[k]) if made and asked.tolerances and k == 0 else None,
                    worst,
                )
            )
        share = None
        if len(asked.goals) > 1 and np.isfinite(chosen.goals).all():
            start = np.array([goal.sign * task.at_start[goal.text] for goal in asked.goals])
            worst = np.maximum(chosen.goals.max(axis=0), np.where(np.isfinite(start), start, -np.inf))
            share = hypervolume(chosen.goals, worst)
        return Optimum(
            asked,
            tuple(choices),
            dict(task.at_start),
            {each.text: (each.low, each.high) for each in task.bounds},
            {text: task.measures.dimension(text) for text in task.measures.expressions},
            task.measures.evaluations,
            state.generation,
            tuple(state.history),
            share,
            task.exact,
            self.stopped,
            idle,
            self.document,
        )

    def _nothing(self, judged: Judged) -> Message:
        """Why no design has all numbers: none of them moves, or some numbers have no value for any."""
        name = self.task.problem.mechanism.name
        none = tuple(text for text, each in judged.values.items() if not np.isfinite(each).any())
        asked, nearest = self.task.problem, list[tuple[int, str, PositionError]]()
        addresses = [each.address for each in asked.variables]
        for values in self.task.place(judged.x).tolist():
            design = dict(zip(addresses, values, strict=True))
            dimensions = ", ".join(f"{each.address} {each.shown(design[each.address])}" for each in asked.variables)
            try:
                solve_motion(asked.mechanism.with_dimensions(design), steps=asked.steps)
            except PositionError as error:
                nearest.append((len(error.failed), dimensions, error))
            except LinkwrightError:
                continue
            else:
                if none:
                    return _(
                        "no design of {name} within the bounds has a value of {numbers}; name another "
                        "number, or give the machine what the number needs (a flywheel, for one, needs work "
                        "that the drivers do)",
                        code="optimize.no_values",
                        name=name,
                        numbers=none,
                    )
        if not nearest:
            return _(
                "no design of {name} within the bounds passes the full cycle; widen the bounds, or "
                "start from a machine that moves",
                name=name,
            )
        failed, dimensions, stuck = min(nearest, key=lambda each: each[0])
        reason = stuck.sentence if stuck.outcome is None else stuck.outcome.sentence
        counts = {"failed": failed, "steps": asked.steps}
        return _(
            "no design of {name} within the bounds passes the full cycle; the nearest that was "
            "tried ({design}) fails in {failed} of {steps} positions: {reason}; widen the bounds",
            code="optimize.none_whole",
        ).format(name=name, design=dimensions, reason=reason, **counts)

    def _failing(self, found: Optimum) -> Message:
        """Which demands the nearest design misses, and by how much."""
        from linkwright.designs.optimise.optimum import missing

        best, asked = found.best, found.problem
        if best.made is not None and not best.missed:
            shares = {"share": f"{100 * best.made:.1f}", "wanted": f"{100 * asked.min_yield:.6g}"}
            return _(
                "of the machines made within the tolerances {share} % meet all demands at best, not "
                "{wanted} %; tighten the tolerances, ask for a smaller yield:, or widen the bounds",
                code="optimize.failing_yield",
            ).format(**shares)
        return _(
            "the demands cannot be met together; the nearest design misses {demands}: change "
            "these demands, or widen the bounds",
            code="optimize.failing",
            demands=tuple(missing(found)),
        )
