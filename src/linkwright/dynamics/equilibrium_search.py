"""What is found of a position at rest: stiffness, small vibrations, loads; sizes that tell zero from rounding."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.equilibria import Equilibrium
from linkwright.dynamics.static_forces import StaticForces
from linkwright.dynamics.vibration import Stability, small_vibrations, stability

#: Efforts of this share of what acts are zero; positions nearer than this, in rad or shares of the size, one; shares
#: of loads that are rounding.
BALANCED, SAME, ROUNDING = 1e-10, 1e-6, 1e-13


class EquilibriumSearch:
    """What both searches share: sizes, and what is found at a position."""

    def __init__(self, forces: StaticForces) -> None:
        self.forces = forces
        rotary = [forces.equation.rotary[name] for name in forces.free]
        self.units = np.where(rotary, 1.0, forces.mechanism.size)
        self.scale: Floats = np.ones(len(rotary))

    def acting(self, q: Floats) -> Floats:
        """Sizes of all that acts along the inputs, (freedoms, n), N·m or N."""
        return np.asarray(np.abs(self.forces.shares(q)).sum(axis=0))

    def sizes(self, q: Floats) -> Floats:
        """A usual size of what acts along every input, (freedoms,), N·m or N; 1 where nothing does."""
        acting = self.acting(q)
        found = [row[np.isfinite(row)] for row in acting]
        return np.array([float(np.median(row)) or float(row.max()) or 1.0 if len(row) else 1.0 for row in found])

    def described(self, q: Floats, stated: Stability | None = None, **more: object) -> Equilibrium:
        """The position at rest (freedoms,) with its stiffness, vibrations and loads."""
        forces, at = self.forces, q[:, None]
        stiffness, inertia, damping = (
            matrix[:, :, 0] for matrix in (forces.slopes(at), forces.inertia(at), forces.damping(at))
        )
        energy = float((self.scale * self.units).max())
        scaled = stiffness * np.outer(self.units, self.units) / energy
        vibrations = small_vibrations(inertia, stiffness, damping)
        found = forces.shares(at)[:, :, 0]
        shares = dict(
            zip(forces.loads, np.where(np.abs(found) <= ROUNDING * self.scale[:, None].T, 0.0, found), strict=True)
        )
        places = dict(zip(forces.free, map(float, q), strict=True)) | forces.held
        inputs = {name: places[name] for name in forces.equation.names}
        state = stated or stability(scaled, vibrations)
        return Equilibrium(
            inputs,
            state,
            stiffness,
            inertia,
            damping,
            vibrations,
            shares,
            forces,
            **more,  # type: ignore[arg-type]
        )
