"""Heights of layers and plates above the lower face of the base."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Layer:
    """One layer: its number counted from the base, the plates in it, heights z of its faces, m."""

    number: int
    plates: tuple[str, ...]
    low: float
    high: float

    @property
    def thickness(self) -> float:
        """That of its thickest plate, m; of a layer that has only heads in it that of the thinnest of all plates."""
        return self.high - self.low


def stacked(layer: Mapping[str, int], thickness: Mapping[str, float], washer: float) -> tuple[Layer, ...]:
    """The layers from below with a washer (m) between two of them, by the layers and thicknesses of plates."""
    found: list[Layer] = []
    heads = min(thickness.values(), default=0.0)
    for number in range(min(layer.values(), default=0), max(layer.values(), default=-1) + 1):
        plates = tuple(name for name, each in layer.items() if each == number)
        low = found[-1].high + washer if found else 0.0
        found.append(Layer(number, plates, low, low + max((thickness[each] for each in plates), default=heads)))
    return tuple(found)
