"""One choice of the dimensions of a mechanism."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.core.inputs import mode_inputs
from linkwright.kinematics.rest import paces
from linkwright.mechanism.mechanism import Mechanism


class Design:
    """A mechanism, perhaps with changed dimensions, and the signs of its assembly modes."""

    __slots__ = ("_mechanism", "_parameters", "base", "changes", "modes")

    def __init__(self, base: Mechanism, modes: Mapping[str, float], changes: Mapping[str, float]) -> None:
        self.base = base
        self.modes = modes
        self.changes = changes
        self._mechanism: Mechanism | None = None
        self._parameters: dict[str, float] | None = None

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism with the changes made."""
        if self._mechanism is None:
            self._mechanism = self.base.with_dimensions(self.changes) if self.changes else self.base
        return self._mechanism

    @property
    def parameters(self) -> dict[str, float]:
        """Values of all parameters of the programs: dimensions, signs of the assembly modes, paces."""
        if self._parameters is None:
            known = self.mechanism
            self._parameters = {**known.dimensions(), **mode_inputs(self.modes), **paces(known)}
        return self._parameters
