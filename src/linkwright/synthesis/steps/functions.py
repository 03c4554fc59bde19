"""Steps of function generation: Freudenstein's equation for three to five pairs and by least squares, and the search.

cos φ = P₀ cos ψ + P₁ cos γ + P₂ with γ = ψ - φ, P₀ = c/a, P₁ = -c/d, P₂ = (a² + c² + d² - b²)/(2 a d).
"""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.equations.matrix import Entries
from linkwright.equations.steps import Step
from linkwright.equations.terms import TWO, Term, cosine, root, sine, symbol
from linkwright.synthesis.function_generation.exact import Freudenstein
from linkwright.synthesis.function_generation.fit import FunctionDerivation
from linkwright.synthesis.names import TYPE_NAMES
from linkwright.synthesis.steps.requirements import rounded
from linkwright.synthesis.steps.writing import (
    Writer,
    coordinates,
    decimals,
    degrees,
    examine,
    four_bar_lengths,
    matrix,
    numbers,
    product,
    small,
)
from linkwright.words import _, pgettext

#: Pairs up to which every equation is printed.
ALL_ROWS = 8
P = ("P_0", "P_1", "P_2")


def function(w: Writer, d: FunctionDerivation) -> None:
    """The pairs, the equations and their solution, the error at every pair, and what the linkage is like."""
    _requirements(w, d)
    four_bar = w.found.best.linkage.kind == "four_bar"
    if d.method == "search":
        _search(w, d)
    else:
        _equation(w, d)
        _residuals(w, w.steps[-1], d)
    if d.unrounded is not None:
        rounded(w, "abcd", d.unrounded, [each.amount / w.scale for each in four_bar_lengths(w, w.found.best)])
    _errors(w, d)
    if four_bar:
        examine(w, w.found.best)


def _requirements(w: Writer, d: FunctionDerivation) -> None:
    step = w.step(pgettext("synthesis_steps", "Given"))
    places = w.found.error_name == "length"
    outputs = w.lengths(d.outputs) if places else degrees(d.outputs)
    step.note(w.translate(_("{count} pairs of input φ and output.", count=len(d.inputs))))
    columns = [
        (w.translate(_("pair")), numbers(len(d.inputs))),
        ("φ / °", degrees(d.inputs)),
        (w.over("s") if places else "ψ / °", outputs),
    ]
    w.table(step, _("Pairs of input and output"), columns)
    if w.found.best.linkage.kind != "slider_crank":
        step.give(w.length("d", d.frame), w.unit)
    for index, free, zero in zip(("φ", "ψ"), d.free, d.zeros, strict=True):
        of_slider = places and index == "ψ"
        if free:
            step.note(
                w.translate(
                    (
                        _("The zero of the slider's place is free.")
                        if of_slider
                        else _("The zero angle {zero} is free.")
                    ).format(zero=f"ζ_{index}")
                )
            )
        elif of_slider:
            step.give(w.length("s", zero, "0"), w.unit)
        else:
            step.give(w.angle("ζ", zero, index), "°")


# Freudenstein's equation ------------------------------------------------------------------------
def _equation(w: Writer, d: FunctionDerivation) -> None:
    step = w.step(_("Freudenstein's equation"))
    step.note(w.translate(_("With input a, coupler b, output c and frame d, the coupler's constant length gives:")))
    a, b, c, frame = _free_symbols(w)
    p = [symbol(name, 0.5) for name in P]
    phi, psi, gamma = (w.angle(name, 1.0) for name in ("φ", "ψ", "γ"))
    step.relate(cosine(phi), p[0] * cosine(psi) + p[1] * cosine(gamma) + p[2])
    step.relate(gamma, psi - phi)
    step.relate(p[0], c / a)
    step.relate(p[1], -(c / frame))
    step.relate(p[2], (a.squared + c.squared + frame.squared - b.squared) / (TWO * a * frame))
    if d.method == "zero_angle":
        _zero_angle(w, d)
    if d.equation is None:
        _five_pairs(w, d)
        return
    _cosines(w, d.equation, any(d.zeros))
    _solved(w, d)
    _from_coefficients(w, d)


def _free_symbols(w: Writer) -> tuple[Term, ...]:
    return tuple(symbol(name, 1.0) for name in "abcd")


def _cosines(w: Writer, equation: Freudenstein, moved: bool) -> None:
    """Every pair's angles with the zero angles added, and their cosines."""
    step = w.step(_("Angles and cosines of the pairs"))
    if moved:
        step.note(w.translate(_("The angles of the links are those of the pairs plus the zero angles:")))
    columns = [
        (w.translate(_("pair")), numbers(len(equation.phi))),
        ("φ / °", degrees(equation.phi)),
        ("ψ / °", degrees(equation.psi)),
        ("γ = ψ − φ / °", degrees(equation.psi - equation.phi)),
        ("cos ψ", decimals(equation.rows[:, 0], 6)),
        ("cos γ", decimals(equation.rows[:, 1], 6)),
        ("cos φ", decimals(equation.right, 6)),
    ]
    w.table(step, _("Angles and cosines"), columns)


def _solved(w: Writer, d: FunctionDerivation) -> None:
    """The system of equations as matrices, with symbols and with numbers, and its solution."""
    equation = d.equation
    assert equation is not None
    unknown, count = Entries.of(P), len(equation.phi)
    step = w.step(_("System of equations and its solution"))
    if count <= ALL_ROWS:
        rows = [(f"cos ψ_{i}", f"cos γ_{i}", "1") for i in range(1, count + 1)]
        right = Entries.of([f"cos φ_{i}" for i in range(1, count + 1)])
        product(step, Entries(tuple(rows)), unknown, "=", right)
        product(step, matrix(equation.rows), unknown, "=", matrix(equation.right))
    if d.method == "equation" and count > 3:
        step.note(
            w.translate(
                _(
                    "There are more pairs than unknowns, so the sum of the squared residuals is made "
                    "smallest. Normal equations, with sums over all pairs:"
                )
            )
        )
        product(step, _sums(count), unknown, "=", Entries.of(_sums_right()))
        product(step, matrix(equation.normal), unknown, "=", matrix(equation.moment))
    step.note(
        w.translate(
            _("Solution:")
            if count == 3
            else (
                _("Solution of least squares:")
                if d.method == "equation"
                else _("With the zero angle found, the equations agree; solution:")
            )
        )
    )
    product(step, unknown, "=", matrix(equation.p))


def _sum(*names: str) -> str:
    """A sum over all pairs of a product of cosines."""
    if len(names) == 2 and names[0] == names[1]:
        return f"Σcos²{names[0]}"
    return "Σ" + " ".join(f"cos {name}" for name in names)


def _sums(count: int) -> Entries:
    names = ("ψ", "γ")
    rows = [(*(_sum(first, second) for second in names), _sum(first)) for first in names]
    return Entries((*rows, (*map(_sum, names), str(count))))


def _sums_right() -> list[str]:
    return [_sum("φ", "ψ"), _sum("φ", "γ"), _sum("φ")]


def _from_coefficients(w: Writer, d: FunctionDerivation) -> None:
    """Lengths from P₀, P₁, P₂; negative ones point the other way."""
    equation = d.equation
    assert equation is not None
    step = w.step(_("Link lengths"))
    p = [symbol(name, float(value)) for name, value in zip(P, equation.p, strict=True)]
    frame = w.length("d", d.frame)
    c = step.find(w.length("c", float(equation.lengths[2]) * d.frame), -(p[1] * frame), w.unit)
    a = step.find(w.length("a", float(equation.lengths[0]) * d.frame), c / p[0], w.unit)
    square = a.squared + c.squared + frame.squared - TWO * a * frame * p[2]
    step.find(w.length("b", float(equation.lengths[1]) * d.frame), root(square), w.unit)
    turned = [term.plain for term in (a, c) if term.amount < 0.0]
    if turned:
        step.note(
            w.translate(
                _(
                    "Negative: {names}. Such a link points the opposite way, so its angle is larger by "
                    "180°; its length is the absolute value.",
                    names=", ".join(turned),
                )
            )
        )


def _zero_angle(w: Writer, d: FunctionDerivation) -> None:
    """The free zero angle as a root of the determinant."""
    step = w.step(_("Free zero angle"))
    h = d.harmonics
    assert h is not None
    step.note(
        w.translate(
            _(
                "Four pairs agree for three unknowns where the determinant of the four equations "
                "vanishes. In the free zero angle ζ it is D(ζ) = k_0 + k_1 cos ζ + k_2 sin ζ + k_3 "
                "cos 2ζ + k_4 sin 2ζ with"
            )
        )
    )
    which = 1 if d.free[1] else 0
    zeta = w.angle("ζ", d.zeros[which])
    factors = (h[0].real, 2 * h[1].real, -2 * h[1].imag, 2 * h[2].real, -2 * h[2].imag)
    k = [step.give(w.value("k", float(each), str(i)), "") for i, each in enumerate(factors)]
    twice = TWO * zeta
    value = k[0] + k[1] * cosine(zeta) + k[2] * sine(zeta) + k[3] * cosine(twice) + k[4] * sine(twice)
    if all(d.free):
        fixed = w.angle("ζ", d.zeros[0], "φ")
        step.note(
            w.translate(_("The input's zero angle is free as well and was tried at evenly spaced values; taken was"))
        )
        step.give(fixed, "°")
    step.give(zeta, "°")
    step.note(w.translate(_("Root of the determinant, found from the quartic in e^(iζ); put into D:")))
    step.find(symbol("D", 0.0), value, "")


def _five_pairs(w: Writer, d: FunctionDerivation) -> None:
    """Five pairs: Burmester's points of the motion of the output link against the input link."""
    step = w.step(_("Five pairs by Burmester's points"))
    step.note(
        w.translate(
            _(
                "Relative to the output link, the input link takes five poses; pins that stay on "
                "circles about points of the output are Burmester's, at most four, one of which is "
                "the pair of fixed pivots. {count} real four-bars follow; the first has",
                count=w.found.counts.get("solutions", len(w.found)),
            )
        )
    )
    for index, zero in zip(("φ", "ψ"), d.zeros, strict=True):
        step.give(w.angle("ζ", zero, index), "°")
    a, b, c, frame = _lengths(w, d)
    for term in (a, b, c):
        step.give(term, w.unit)
    for name, formula in zip(P, _coefficients((a, b, c, frame)), strict=True):
        step.define(name, formula, "")


def _lengths(w: Writer, d: FunctionDerivation) -> tuple[Term, Term, Term, Term]:
    """Lengths a, b, c, d as they were found, before they were rounded."""
    if d.unrounded is None:
        return four_bar_lengths(w, w.found.best)
    a, b, c, frame = (w.length(name, each) for name, each in zip("abcd", d.unrounded, strict=True))
    return a, b, c, frame


def _coefficients(sides: tuple[Term, Term, Term, Term]) -> tuple[Term, Term, Term]:
    a, b, c, frame = sides
    return (c / a, -(c / frame), (a.squared + c.squared + frame.squared - b.squared) / (TWO * a * frame))


# errors -----------------------------------------------------------------------------------------
def _search(w: Writer, d: FunctionDerivation) -> None:
    step = w.step(_("What is searched, and how"))
    names = w.translate(TYPE_NAMES[d.kind])
    step.note(
        w.translate(
            _(
                "No closed form: the {linkage} with the smallest root mean square structural error "
                "is searched, by Levenberg–Marquardt in {unknowns} free numbers, from the best of "
                "{starts} random starts; {optima} optima were compared.",
                linkage=names,
                unknowns=d.unknowns,
                starts=d.starts,
                optima=d.optima,
            )
        )
    )
    best = w.found.best
    step.give(w.angle("ζ", best.values["input_zero [rad]"], "φ"), "°")
    constant, scale = best.values["output_constant"], best.values["scale"]
    places = w.found.error_name == "length"
    values = {
        "symbol": "s" if places else "ψ",
        "constant": w.length_text(constant) if places else shown(constant, "angle"),
    }
    if scale == 1.0:
        step.note(
            w.translate(_("The output {symbol} is the output link's coordinate plus {constant}.").format(**values))
        )
    else:
        step.note(
            w.translate(
                _("The output {symbol} is the output link's coordinate times {scale}, plus {constant}.").format(
                    scale=f"{scale:.6g}", **values
                )
            )
        )


def _errors(w: Writer, d: FunctionDerivation) -> None:
    """What Freudenstein's equation leaves, and the structural error, at every pair."""
    best = w.found.best
    step = w.step(_("Error at every position"))
    places = w.found.error_name == "length"
    if d.method == "search":
        step.note(
            w.translate(_("Coordinates of the moving points at every pair, from which the output can be measured:"))
        )
        moving = [name for name in best.positions if name not in best.linkage.frame]
        columns = [(w.translate(_("pair")), numbers(len(d.inputs))), *coordinates(w, best, moving)]
        w.table(step, _("Positions of the moving points"), columns)
    found = d.outputs + best.deviations
    shown = w.lengths if places else degrees
    off = small(best.deviations * w.scale, w.scale) if places else small(np.degrees(best.deviations))
    letter = "s" if places else "ψ"
    unit = w.unit if places else "°"
    columns = [
        (w.translate(_("pair")), numbers(len(d.inputs))),
        ("φ / °", degrees(d.inputs)),
        (f"{letter} / {unit}", shown(d.outputs)),
        (w.translate(_("{symbol} generated / {unit}", symbol=letter, unit=unit)), shown(found)),
        (f"Δ{letter} / {unit}", off),
    ]
    w.table(step, _("Deviation at every position"), columns)
    if w.found.error_name != "none":
        rms, worst = (_shown(w, each, places) for each in (_rms(best.deviations), np.abs(best.deviations).max()))
        step.note(w.translate(_("Structural error: root mean square {rms}, maximum {worst}.", rms=rms, worst=worst)))
    w.picture("structural_error")


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _shown(w: Writer, value: float, places: bool) -> str:
    if places:
        return f"{small([value * w.scale], w.scale)[0]} {w.unit}"
    return f"{small([math.degrees(value)])[0]}°"


def _residuals(w: Writer, step: Step, d: FunctionDerivation) -> None:
    """Both sides of Freudenstein's equation at every pair."""
    if d.equation is not None:
        rows, right, p = d.equation.rows, d.equation.right, d.equation.p
    else:
        phi, psi = d.inputs + d.zeros[0], d.outputs + d.zeros[1]
        rows = np.stack([np.cos(psi), np.cos(phi - psi), np.ones_like(phi)], 1)
        right = np.cos(phi)
        terms = _coefficients(_lengths(w, d))
        p = np.array([term.value for term in terms])
    step.note(w.translate(_("Both sides of Freudenstein's equation at every pair:")))
    columns = [
        (w.translate(_("pair")), numbers(len(right))),
        ("cos φ", decimals(right, 6)),
        ("P_0 cos ψ + P_1 cos γ + P_2", decimals(rows @ p, 6)),
        (w.translate(_("residual")), small(rows @ p - right)),
    ]
    w.table(step, _("Residual of Freudenstein's equation"), columns)
