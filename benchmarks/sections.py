"""The sections of the report: what is measured, and what it must reach."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import process_time

from benchmarks import by_c, by_numpy, kernels_alone, machine, public
from benchmarks.cases import Work, fourbar, sixbar
from benchmarks.gradients import BOTH, VALUE, GradientWork
from benchmarks.kernels_alone import COMPILED, HAND, C
from benchmarks.peers import Peer, error, found
from benchmarks.report import Goal, Section, short, timings
from benchmarks.sweeps import TWO, SweepWork
from benchmarks.timing import Candidate, in_turns

_TITLES = {
    "fourbar": "W2: crank-rocker, positions, velocities, accelerations of all joints and links",
    "sixbar": "W3: six-bar, the same with all reactions and the balancing torque",
}


@dataclass(frozen=True)
class Size:
    """How much is measured."""

    steps: int = 360
    rounds: int = 11
    slice_s: float = 0.05
    fourbars: int = 100_000
    sixbars: int = 10_000
    gradients: int = 1000
    peer_designs: int = 200
    accuracy_steps: int = 72
    starts: int = 11
    chains: tuple[int, ...] = (10, 50, 100, 200)
    run_ups: int = 1000
    windows: tuple[int, ...] = (2, 10, 40)


QUICK = Size(36, 3, 0.002, 2000, 500, 64, 8, 8, 3, (2, 5, 10), 64, (2, 4))


def _agreement(gaps: Mapping[str, float]) -> str:
    told = ", ".join(f"{way} {gap:.1e}" for way, gap in gaps.items())
    return f"largest relative difference from {HAND}: {told}"


def _crowded() -> list[str]:
    """What is said where two threads cannot have had a core each."""
    if machine.load() < 1.5:
        return []
    return ["other processes were at work, so the figures of two threads are below what a free machine gives"]


def _peers(peers: list[Peer]) -> list[Candidate]:
    return [Candidate(peer.name, peer.run, peer.share, peer.note) for peer in peers]


def _reference(candidates: list[Candidate]) -> str:
    return C if any(each.name == C for each in candidates) else HAND


def kernels(name: str, size: Size) -> Section:
    """W2 or W3, one design."""
    work = fourbar(size.steps) if name == "fourbar" else sixbar(size.steps)
    rows = getattr(by_numpy, name)(work.cosine, work.sine, work.nominal())
    truth = dict(zip(work.outputs, rows, strict=True))
    peers, missing = found(name, work)
    candidates = kernels_alone.candidates(name, work)
    reference = _reference(candidates)
    rounds = in_turns([*candidates, *_peers(peers)], size.rounds, size.slice_s)
    errors = {peer.name: error(peer, work, truth) for peer in peers}
    notes = [_agreement({**kernels_alone.disagreement(name, work), **errors}), *missing]
    goals = []
    if COMPILED in rounds and C in rounds:
        label = "W2" if name == "fourbar" else "W3"
        goals.append(Goal(f"{label}: speed of the kernel ÷ speed of C", rounds.ratio(C, COMPILED), 0.9, True))
    return Section(_TITLES[name], *timings(rounds, reference, "µs"), goals, notes)


def public_api(size: Size) -> Section:
    """W3 through the public API."""
    work = sixbar(size.steps)
    candidates = public.candidates(work)
    rounds = in_turns(candidates, size.rounds, size.slice_s)
    label = "W3 through the public API:"
    slow = rounds.ratio(public.NUMPY_ROUTE, HAND)
    goals = [Goal(f"{label} NumPy route ÷ NumPy by hand, time", slow, 1.5, False)]
    if C in rounds and public.COMPILED in rounds:
        goals.append(Goal(f"{label} compiled route ÷ C, time", rounds.ratio(public.COMPILED, C), 4.0, False))
    title = "W3 through the public API, new dimensions each time"
    header, rows = timings(rounds, _reference(candidates), "µs")
    return Section(title, header, rows, goals, [_agreement(public.disagreement(work))])


def sweeps(name: str, size: Size) -> Section:
    """W4, four-bars or six-bars."""
    four = name == "fourbar"
    work: Work = fourbar(size.steps) if four else sixbar(size.steps)
    sweep = SweepWork(name, work, size.fourbars if four else size.sixbars)
    peers, missing = found("fourbar_sweep", work, sweep.designs, size.peer_designs) if four else ([], [])
    candidates = sweep.candidates()
    rounds = in_turns([*candidates, *_peers(peers)], size.rounds, size.slice_s)
    what = "four-bars, five metrics" if four else "six-bars, reactions and six metrics"
    label = f"W4, {what.split(',', maxsplit=1)[0]}:"
    goals = []
    if COMPILED in rounds and C in rounds:
        goals.append(Goal(f"{label} speed ÷ speed of C", rounds.ratio(C, COMPILED), 0.9, True))
    if COMPILED in rounds:
        goals.append(Goal(f"{label} two threads ÷ one, speed", rounds.ratio(COMPILED, TWO), 1.8, True))
    if "pylinkage" in rounds and COMPILED in rounds:
        goals.append(Goal(f"{label} speed ÷ speed of pylinkage", rounds.ratio("pylinkage", COMPILED), 150.0, True))
    configurations = len(sweep.designs) * size.steps
    title = f"W4: {len(sweep.designs)} {what}, {size.steps} positions"
    header, rows = timings(rounds, _reference(candidates), "ms", configurations)
    notes = [_agreement(sweep.disagreement()), *_crowded(), *missing]
    return Section(title, header, rows, goals, notes)


def gradients(size: Size) -> Section:
    """Value and gradient against the value."""
    rows, goals, notes = [], [], []
    header: list[str] = []
    for name, what in (("fourbar", "path error of the four-bar"), ("sixbar", "forces of the six-bar")):
        work = fourbar(size.steps) if name == "fourbar" else sixbar(size.steps)
        gradient = GradientWork(name, work, size.gradients)
        rounds = in_turns(gradient.candidates(), size.rounds, size.slice_s)
        header, part = timings(rounds, VALUE, "ms", size.gradients * size.steps)
        rows += [[f"{what}, {row[0]}", *row[1:]] for row in part]
        goals.append(Goal(f"{what}: value and gradient ÷ value, time", rounds.ratio(BOTH, VALUE), 5.0, False))
        gap = GradientWork(name, work, min(32, size.gradients)).disagreement()
        notes.append(f"{what}: {len(gradient.wrt)} derivatives; largest gap to central differences {gap:.1e}")
    return Section("Value and reverse gradient, one thread", header, rows, goals, notes)


def objectives(size: Size) -> Section:
    """Objectives through the public API."""
    from benchmarks import objectives as public_objectives

    path = public_objectives.PathWork()
    torque = public_objectives.TorqueWork(size.gradients, size.steps)
    rows, header = [], [""]
    ratios = []
    for what, work, slow, fast in (
        ("path error", path, public_objectives.OURS, public_objectives.HAND),
        ("torque", torque, public_objectives.BOTH, public_objectives.ALONE),
    ):
        rounds = in_turns(work.candidates(), size.rounds, size.slice_s)
        header, part = timings(rounds, fast, "ms")
        rows += [[f"{what}: {row[0]}", *row[1:]] for row in part]
        ratios.append(rounds.ratio(slow, fast))
    header[3] = "time ÷ reference"
    goals = [
        Goal("path error, 60 points: value and gradient ÷ complex step by hand, time", ratios[0], 0.8, False),
        Goal("six-bar's torque RMS with its load: value and gradient ÷ value, time", ratios[1], 5.0, False),
    ]
    notes = [
        f"path error: one design, {len(public_objectives.PATH)} derivatives; "
        f"largest difference from the complex step {path.disagreement():.1e}",
        f"torque: {size.gradients} designs, {len(public_objectives.VARIED)} derivatives; "
        f"largest difference of the values {torque.disagreement():.1e}",
    ]
    return Section("Objectives through the public API", header, rows, goals, notes)


def numbers(size: Size) -> Section:
    """Metrics of one machine."""
    from benchmarks import numbers as design_numbers

    work = design_numbers.NumbersWork(size.steps)
    rounds = in_turns(work.candidates(), size.rounds, size.slice_s)
    header, rows = timings(rounds, HAND, "ms")
    bounds = {design_numbers.METRICS_OF: 45.0, design_numbers.RUNNING: 40.0, design_numbers.COMPARED: 120.0}
    goals = [
        Goal(f"{name} ÷ NumPy cycle of the six-bar by hand, time", rounds.ratio(name, HAND), bound, False)
        for name, bound in bounds.items()
    ]
    ratio = rounds.ratio(design_numbers.PREPARED, design_numbers.UNLOADED)
    goals.append(Goal("prepared crusher: with its load ÷ without, time", ratio, 10.0, False))
    ratio = rounds.ratio(design_numbers.EDITED, design_numbers.BY_NUMPY)
    goals.append(Goal("edited crusher with its load ÷ prepared by NumPy without, time", ratio, 2.5, False))
    note = f"largest difference of numbers of many designs from one alone {work.disagreement():.1e}"
    return Section("Metrics of the six-bar crusher with its load", header, rows, goals, [note])


def cycles(size: Size) -> Section:
    """Metrics of many designs, with their gradients, and of machines that are harder to follow."""
    from benchmarks import cycles as over_cycle

    work = over_cycle.CycleWork(size.gradients, size.peer_designs, size.steps)
    rounds = in_turns(work.candidates(), min(size.rounds, 5), size.slice_s, process_time)
    header, rows = timings(rounds, HAND, "µs")
    goals = [
        Goal(f"{text}, speed", rounds.ratio(plain, metrics), bound, True)
        for text, plain, metrics, bound in over_cycle.PACES
    ]
    goals += [
        Goal(f"{name} ÷ NumPy cycle of the six-bar by hand, time", rounds.ratio(name, HAND), bound, False)
        for name, bound in over_cycle.BOUNDS.items()
    ]
    megabytes = over_cycle.memory(100 * size.sixbars)
    goals.append(Goal(f"memory of a sweep of {100 * size.sixbars} designs, MB", megabytes, 64.0, False))
    note = "times of many designs are those of one; processor time"
    return Section("Metrics over the cycle of many designs, one thread", header, rows, goals, [note])


def growing(size: Size) -> Section:
    """Every step from the model to the numbers, for chains of more and more dyads."""
    from benchmarks import growth

    few, many = size.chains[0], size.chains[-1]
    rounds = growth.measure(size.chains, size.steps, min(size.rounds, 5), size.slice_s)
    header, rows = growth.table(rounds, size.chains)
    goals = [
        Goal(f"{row[0]}: power of n by which its time grows", growth.exponent(rounds, row[0], few, many), 1.15, False)
        for row in rows
    ]
    if 100 in size.chains and any(row[0] == growth.COMPILE for row in rows):
        goals.append(Goal("100 dyads compiled, seconds", growth.compile_time(rounds, 100), 0.5, False))
    return Section("Chains of n dyads with all forces", header, rows, goals)


def cold_start(size: Size) -> Section:
    """Process start to the printed table."""
    from benchmarks import cold

    rounds = cold.measure(size.starts)
    goals = [
        Goal(
            f"linkwright {command} ÷ starting NumPy, time",
            rounds.ratio(cold.named(command), cold.NUMPY),
            bound,
            False,
        )
        for command, bound in cold.COMMANDS.items()
    ]
    parts = cold.parts()
    whole = 1e3 * rounds.timings[cold.named("solve")].best
    rest = whole - sum(parts.values())
    told = ", ".join(f"{owner} {ms:.0f} ms" for owner, ms in parts.items() if ms >= 0.5)
    note = f"imports of solve, each without what it imports: {told}; the interpreter, solving, printing {rest:.0f} ms"
    header, rows = timings(rounds, cold.NUMPY, "ms")
    return Section("Cold start", header, rows, goals, [note])


def accuracy(size: Size) -> Section:
    """Errors against 50 digits."""
    from benchmarks import accuracy as precise

    rows, worst = [], 0.0
    works = {"fourbar": fourbar(size.accuracy_steps), "sixbar": sixbar(size.accuracy_steps)}
    for name, work in works.items():
        for route, errors in precise.cycle(name, work).items():
            largest = max(errors, key=lambda each: errors[each])
            worst = max(worst, errors[largest])
            rows.append(
                [f"{'W2' if name == 'fourbar' else 'W3'}, {route}", f"{errors[largest]:.1e}", f"in {largest}"]
            )
    for near in precise.near_singular(works["fourbar"], [10.0**-k for k in (1, 2, 4, 6, 8)]):
        told = ", ".join(
            f"{what} {gap:.1e} = {short(multiple)} {unit}"
            for what, gap, multiple, unit in zip(
                ("position", "velocity", "acceleration"),
                near.errors,
                near.multiples,
                ("u κ", "u κ²", "u κ²"),
                strict=True,
            )
        )
        rows.append([f"dead point nearly reached, κ = {short(near.condition)}", f"{max(near.errors):.1e}", told])
    title = "Accuracy against an evaluation with 50 digits"
    header = ["", "largest relative error", "where; u = 1.1e-16"]
    goal = Goal("relative error away from singular positions", worst, 1e-12, False)
    return Section(title, header, rows, [goal])


def dynamics(size: Size) -> Section:
    """Right-hand sides, run-ups of many designs, chains."""
    from benchmarks import dynamics as motion

    work = motion.SixbarRuns(size.run_ups)
    few = min(size.run_ups, 20)
    rounds = in_turns(work.right_hand_sides(), size.rounds, size.slice_s, process_time)
    header, rows = timings(rounds, motion.NUMPY_ROUTE if motion.IN_LOOP not in rounds else motion.IN_LOOP, "µs")
    goals, notes = [], []
    if motion.IN_LOOP in rounds:
        pace = 1e-6 / rounds.timings[motion.IN_LOOP].median
        goals.append(Goal("right-hand sides of the six-bar in the loop, million/s on one core", pace, 1.0, True))
        runs = in_turns(work.run_ups(few), min(size.rounds, 5), size.slice_s, process_time)
        rows += timings(runs, motion.TOGETHER, "µs")[1]
        label = f"{size.run_ups} run-ups:"
        ratio = runs.ratio(motion.SCIPY, motion.TOGETHER)
        goals.append(Goal(f"{label} side by side ÷ SciPy one after the other, speed", ratio, 20.0, True))
        gap = work.disagreement(few)
        notes.append(f"largest relative difference of the ends from SciPy's at the same tolerance {gap:.1e}")
    chains, power = motion.growth(size.windows, size.rounds, size.slice_s)
    rows += timings(chains, next(iter(chains.timings)), "µs")[1]
    few_windows, many = size.windows[-2:]
    goals.append(Goal(f"windows, {few_windows} to {many}: power of n of a right-hand side", power, 1.3, False))
    header[3] = "time ÷ first of its kind"
    return Section("Motion under forces: Watt six-bar, chains of four-bars", header, rows, goals, notes)


def gaps(size: Size) -> Section:
    """Smallest gaps of a machine over its cycle."""
    from benchmarks import collisions

    work = collisions.SixbarGaps()
    rounds = in_turns(work.candidates(), size.rounds, size.slice_s, process_time)
    header, rows = timings(rounds, collisions.DENSE, "ms")
    ratio = rounds.ratio(collisions.SOLVED, collisions.DENSE)
    goals = [
        Goal(f"gaps of the six-bar ÷ shapely in {collisions.POSITIONS} positions, time", ratio, 0.25, False),
        Goal("gaps of the six-bar, motion solved, ms", 1e3 * rounds.timings[collisions.SOLVED].median, 50.0, False),
    ]
    larger, smaller = work.disagreement()
    note = f"{len(work.pairs)} pairs; at most {larger:.1e} m larger than by shapely, {smaller:.1e} m smaller"
    return Section("Smallest gaps over the cycle: Watt six-bar", header, rows, goals, [note])


SECTIONS: Mapping[str, Callable[[Size], Section]] = {
    "w2": lambda size: kernels("fourbar", size),
    "w3": lambda size: kernels("sixbar", size),
    "public": public_api,
    "w4-fourbar": lambda size: sweeps("fourbar", size),
    "w4-sixbar": lambda size: sweeps("sixbar", size),
    "gradient": gradients,
    "objective": objectives,
    "numbers": numbers,
    "cycles": cycles,
    "growth": growing,
    "dynamics": dynamics,
    "gaps": gaps,
    "cold": cold_start,
    "accuracy": accuracy,
}


def missing_compiler() -> list[str]:
    """What is said where the C kernels cannot be made."""
    return [] if by_c.compiler() else ["no gcc found, so ratios to C are left out"]
