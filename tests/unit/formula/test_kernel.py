"""Kernels: what the compiled functions give is what Python's own arithmetic gives."""

import ast
import gc
from concurrent.futures import ThreadPoolExecutor
from math import cos, exp, fabs, log, sin, sqrt
from time import sleep
from types import SimpleNamespace

import numpy as np
import pytest

from linkwright.formula import machine_code
from linkwright.formula import machine_code as cache
from linkwright.formula.kernel import (
    Kernels,
    Reals,
    Wholes,
    choose,
    fetch,
    inverse,
    load,
    mark_of,
    marked,
    minimum,
    put,
    ramp,
    root,
    smallest,
    spread,
    square,
    store,
    total,
)

pytestmark = pytest.mark.skipif(not machine_code.available(), reason="llvmlite does not run here")
SHIFT = 3


def series(x: float, terms: int) -> float:
    value, term = 0.0, 1.0
    for k in range(terms):
        if k % 2 == 1 and k != 0:
            value += term
        else:
            value -= term if k > SHIFT or k < 1 else -term
        term = term * x / (k + 1)
        if fabs(term) < 1e-12:
            break
    return value


def norms(n: int, x: Reals, y: Reals, order: Wholes, out: Reals) -> int:
    low = spread(1e9)
    total_ = spread(0.0)
    for t in range(0, n, 8):
        r = root(load(x, t) * load(x, t) + load(y, t) * load(y, t))
        store(out, t, r)
        total_ += r
        low = minimum(low, marked(r, ramp(t)))
    out[n] = total(total_)
    out[n + 1] = exp(log(2.0)) + sin(1.0) * cos(1.0) + sqrt(4)
    k = 0
    while k < n:
        if order[k] < 0:
            k += 1
            continue
        out[order[k]] = (out + 0)[order[k]] + series(0.5, k // 2)
        k += 1
    return mark_of(smallest(low))


def test_kernels_compute_what_python_says() -> None:
    kernels = Kernels([series, norms])
    assert [kernels("series", 0.7, n) for n in range(9)] == pytest.approx(
        [series(0.7, n) for n in range(9)], rel=1e-14
    )
    draw = np.random.default_rng(1)
    x, y, out = draw.normal(size=24), draw.normal(size=24), np.zeros(26)
    order = np.array(draw.permutation(24), dtype=np.int64)
    order[::3] = -1
    nearest = kernels("norms", 24, *(each.ctypes.data for each in (x, y, order, out)))
    expected = np.hypot(x, y)
    assert nearest == int(expected.argmin())
    assert out[24] == pytest.approx(expected.sum(), rel=1e-12)
    assert out[25] == pytest.approx(2 + np.sin(1) * np.cos(1) + 2, rel=1e-14)
    for k, at in enumerate(order):
        if at >= 0:
            expected[at] += series(0.5, k // 2)
    assert out[:24] == pytest.approx(expected, rel=1e-13)


def mixture(x: Reals, y: Reals, out: Reals) -> None:
    a, b = fetch(x, 0), fetch(y, 1)
    put(out, 0, (a - 2.0) * b + root(square(b)) * a - (1.0 - b) * 3.0)
    put(out, 1, choose(square(a) > square(b), inverse(a), -b + a))


def test_kernels_compute_with_complex_numbers() -> None:
    draw = np.random.default_rng(2)
    x, y, out = (draw.normal(size=(2, 2, 8)) for _ in range(3))
    Kernels([mixture])("mixture", *(each.ctypes.data for each in (x, y, out)))
    a, b = x[0, 0] + 1j * x[0, 1], y[1, 0] + 1j * y[1, 1]
    first, second = out[:, 0] + 1j * out[:, 1]
    assert first == pytest.approx((a - 2) * b + np.abs(b) * a - (1 - b) * 3, rel=1e-13)
    assert second == pytest.approx(np.where(np.abs(a) > np.abs(b), 1 / a, a - b), rel=1e-13)


def test_functions_keep_their_code_when_others_push_it_out_of_the_memory() -> None:
    kernels = Kernels([series])
    before = kernels("series", 0.5, 8)
    cache.forget()
    gc.collect()
    assert [kernels("series", 0.5, 8) for _ in range(100)] == [before] * 100


def before(row: Reals, k: int) -> float:
    there = row - k
    return there[0]


def test_an_address_goes_forward_only() -> None:
    with pytest.raises(TypeError, match="row - k"):
        Kernels([before]).text()


def test_threads_read_kernels_one_after_another(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two trees made at once end in a SystemError of Python 3.11, where a collection lets another thread in."""
    inside, most, parse = [], [], ast.parse

    def watched(source: str) -> ast.Module:
        inside.append(source)
        sleep(0.002)
        most.append(len(inside))
        inside.pop()
        return parse(source)

    monkeypatch.setattr("linkwright.formula.kernel.ast", SimpleNamespace(parse=watched, FunctionDef=ast.FunctionDef))
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda _: Kernels([before]).trees["before"].name, range(12)))
    assert found == ["before"] * 12 and most == [1] * 12
