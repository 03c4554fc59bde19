"""Solid models of a machine's parts in their layers at one position: STL, 3MF, STEP."""

from __future__ import annotations

from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.results import Results
from linkwright.fabrication.cut_parts import cut_parts
from linkwright.fabrication.solid_files import machine_file


def stl(results: Results, *, position: int | None = None) -> bytes:
    """Triangles of all parts, binary, mm, z up from the frame; ``position``: index, default the first reached."""
    return _solid(results, position, "stl")


def three_mf(results: Results, *, position: int | None = None) -> bytes:
    """The same with names and colours, every part once with all its places."""
    return _solid(results, position, "3mf")


def step(results: Results, *, position: int | None = None) -> bytes:
    """An assembly of exact solids by AP214, bounded by planes and cylinders, mm."""
    return _solid(results, position, "step")


def _solid(results: Results, position: int | None, form: str) -> bytes:
    return machine_file(cut_parts(results.mechanism), results.motion, results.index(position), form)


FORMATS.register("stl")(Format((".stl",), stl))
FORMATS.register("3mf")(Format((".3mf",), three_mf))
FORMATS.register("step")(Format((".step", ".stp"), step))
