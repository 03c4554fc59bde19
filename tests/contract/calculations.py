"""Calculations of the gallery, loaded and solved once for each worker: tests share them."""

from functools import cache

from linkwright import parts


@cache
def problem(name: str) -> parts.Problem:
    return parts.load(f"gallery:{name}")


@cache
def solved(name: str) -> parts.Result:
    return problem(name).solve()
