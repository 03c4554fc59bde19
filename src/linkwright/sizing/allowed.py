"""What material, pins and running surfaces may bear."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.mechanism.construction import MATERIALS, Material

#: Pins are of steel.
PIN = MATERIALS["steel"]
#: Pressure of a steel pin that turns in a bronze bush, Pa: Roloff/Matek, Maschinenelemente, table TB 9-1.
IN_BUSH = 8e6
#: A plate that is weaker than a metal bears a running pin itself, with this share of its strength.
IN_PLATE = 1.0 / 25.0
#: Safety against buckling as a multiple of that against yield: Roloff/Matek, Maschinenelemente, section 6.3.1, asks
#: for 3 where a machine part shall have 2 against yield.
BUCKLING = 1.5


@dataclass(frozen=True)
class Allowed:
    """What a link of a ``material`` may bear with a ``safety`` factor against its strength.

    ``running``: pressure, Pa, of a pin that turns in it.
    """

    material: Material
    safety: float
    running: float

    @classmethod
    def of(cls, material: Material, safety: float, running: float | None = None) -> Allowed:
        """With the usual pressure of running pins unless one is given."""
        return cls(material, safety, running or min(IN_BUSH, IN_PLATE * material.strength))

    @property
    def stress(self) -> float:
        """Normal stress, Pa."""
        return self.material.strength / self.safety

    @property
    def resting(self) -> float:
        """Pressure of a pin that rests in it, Pa.

        EN 1993-1-8, table 3.10, allows 1.5 times the smaller yield strength; this is the smaller one itself.
        """
        return min(self.material.strength, PIN.strength) / self.safety

    @property
    def buckling(self) -> float:
        """Safety factor against buckling."""
        return BUCKLING * self.safety
