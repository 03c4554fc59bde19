"""What all joints have in common, and their registry."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar

from linkwright.registry import Registry


@dataclass(frozen=True)
class Joint(ABC):
    """A connection of links; ``name`` is its name in the model."""

    kind: ClassVar[str]
    freedoms: ClassVar[int]
    name: str

    @property
    @abstractmethod
    def joined(self) -> tuple[str, ...]:
        """Names of the links that the joint connects."""

    @abstractmethod
    def dimensions(self) -> Mapping[str, float]:
        """Addresses of the joint's dimensions (``guide.offset``) with their SI values."""

    @abstractmethod
    def with_dimensions(self, value: Callable[[str], float]) -> Joint:
        """The same joint with the values that ``value`` gives for the addresses of ``dimensions``."""

    def aligned(self, points: Mapping[str, tuple[float, float]]) -> Joint:
        """The same joint, with what follows from the points of its first link (a guide's direction) made
        anew."""
        return self


JOINTS: Registry[type[Joint]] = Registry("joint_kind", "linkwright.joints")
