"""Dimensions of a mechanism as numbers, where the solvers trace them."""

from linkwright.kinematics.dimensions import Dimensions


class Numbers(Dimensions):
    """Every dimension as a plain number."""

    def __call__(self, address: str) -> float:
        return float(self.nominal[address])
