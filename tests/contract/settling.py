"""A driver law as a package of its own writes it."""

LAW = '''

from collections.abc import Mapping
import numpy as np
from linkwright.drivers.base import Law

@dataclass(frozen=True)
class Settling(Law):
    """q = way (1 - exp(-t / 1 s))."""
    key: ClassVar[str] = "settling"
    way: float
    rotary: bool = True
    def coordinate(self, t):
        left = np.exp(-t)
        return self.way * (1.0 - left), self.way * left, -self.way * left
    @classmethod
    def fields(cls, rotary):
        return {"settling": Quantity("angle" if rotary else "length", doc="way after all time")}
    @classmethod
    def from_values(cls, values, rotary, parameters):
        return cls(values["settling"], rotary)
    def text_values(self):
        return {"settling": self.way}
'''
