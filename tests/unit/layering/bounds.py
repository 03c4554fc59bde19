"""Problems of layers of machines, and how to ask for fewer layers without the integer program."""

from dataclasses import replace

import linkwright as lw
from linkwright.layering.demands import Demands
from linkwright.layering.problem import Fixed, Problem


def problem_of(found: lw.Layers) -> Problem:
    motion = lw.solve_motion(found.mechanism, failures="mark")
    construction = found.mechanism.construction
    return Demands(found.solids, motion, {} if construction is None else construction.layers, 0.0).problem()


def below_a_lid(problem: Problem, lid: int) -> Problem:
    """A problem whose plates all lie below a layer, by a cover that collides with nothing."""
    name = problem.cover or "lid above all"
    bodies = {**problem.bodies, name: (name,)}
    return replace(problem, bodies=bodies, demands=(*problem.demands, Fixed(name, lid)), cover=name)
