"""The command ``program``."""

WORDS = {
    "summary": "minimise or maximise under constraints: linear, integer, nonlinear",
    "description": """\
Solves the optimisation program of a small file: variables with bounds (continuous,
whole, or from a list), an expression to minimise or maximise, constraints by name.
Explains which constraints are active and what one more unit of each is worth; says
which constraints cannot hold together where there is no solution.""",
    "examples": """\
linkwright program gallery:production_mix
linkwright program gallery:lightest_spring --worked
linkwright program gallery:gear_pair --json""",
    "optimum": "Optimum",
    "minimum": "minimum",
    "maximum": "maximum",
    "constraints": "Constraints",
    "active": "active",
    "slack": "{slack} left",
    "at_lower": "at its lower bound",
    "at_upper": "at its upper bound",
    "linear": "Linear program (simplex method): the optimum of all.",
    "integer": "Mixed-integer linear program (branch and cut): the optimum of all.",
    "nonlinear": "Nonlinear program (sequential quadratic programming): {agreed} of {starts} starts came to "
    "this optimum; it is a local one, the best that was found.",
    "enumerated": "All {count} combinations of the discrete values were tried: the optimum of all.",
    "branched": "Mixed nonlinear program (branch and bound over local optima): the best that was found.",
    "price": "One more {unit} on the right side of {name} changes the objective by {price}.",
    "step_1": "The program",
    "step_2": "The optimum",
    "step_3": "Constraints at the optimum",
    "kkt": "Condition of Karush, Kuhn and Tucker, scaled:",
    "whole_numbers": "the whole numbers or choices of the variables",
    "no_variables": "there is no variable",
    "no_variables_remedy": "write variables: {{x: {{from: 0, to: 10}}}}",
    "one_objective": "there must be exactly one of minimize and maximize",
    "one_objective_remedy": "write minimize: 3*x + 2*y",
    "bounds": "the lower bound {low} lies above the upper bound {high}",
    "bounds_remedy": "exchange them",
    "infeasible": "no solution: these cannot hold together: {set}",
    "infeasible_remedy": "loosen one of them; any one is enough for these",
    "not_found": "no point was found that keeps all constraints; from no start did these hold together: {set}",
    "not_found_remedy": "loosen one of them, or give a start near a point that keeps them",
    "unbounded": "no limit: the objective improves without end along {variables}",
    "unbounded_remedy": "give these variables bounds, or a constraint that stops them",
    "no_constraint": '"{text}" is no constraint',
    "no_constraint_remedy": "write left <= right, left >= right or left = right",
    "sides_differ": "the left side is {left}, the right side {right}",
    "sides_differ_remedy": "compare values of one kind",
}
