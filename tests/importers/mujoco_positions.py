"""Positions of a planar MuJoCo model as MuJoCo itself has them: its constraints closed by Newton's method on qpos."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import mujoco
import numpy as np


class MujocoPositions:
    """A model with one driven joint, seen in a plane: ``right`` and ``up`` are axes of the model's space."""

    def __init__(self, path: Path, joint: str, right: np.ndarray, up: np.ndarray) -> None:
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        unused = mujoco.mjtDisableBit
        self.model.opt.disableflags |= int(unused.mjDSBL_CONTACT) | int(unused.mjDSBL_LIMIT)
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:] = self.model.key_qpos[0] if self.model.nkey else self.model.qpos0
        driven = self.model.joint(joint)
        self.right, self.up, self.at = right, up, int(driven.qposadr[0])
        self.free = np.ones(self.model.nv, dtype=bool)
        self.free[driven.dofadr[0]] = False

    def by_pins(self) -> None:
        """Pins and nothing else close the loops, also those that are not active."""
        self.data.eq_active[:] = self.model.eq_type == mujoco.mjtEq.mjEQ_CONNECT

    def bodies(self) -> set[str]:
        """Names of all bodies."""
        return {self.model.body(index).name for index in range(self.model.nbody)}

    def at_each(self, moved: Sequence[float]) -> Iterator[None]:
        """Brings the driven joint from its place at the start to each of these, and closes the loops."""
        start = float(self.data.qpos[self.at])
        for value in moved:
            self.data.qpos[self.at] = start + value
            self._close()
            yield

    def centre(self, body: str) -> np.ndarray:
        """The mass centre of a body."""
        return np.array([self.right @ self.data.body(body).xipos, self.up @ self.data.body(body).xipos])

    def direction(self, body: str) -> complex:
        """A direction that turns with a body."""
        turned = self.data.body(body).xmat.reshape(3, 3) @ (self.right + self.up)
        found = complex(self.right @ turned, self.up @ turned)
        return found / abs(found)

    def _close(self) -> None:
        model, data = self.model, self.data
        for _attempt in range(50):
            mujoco.mj_fwdPosition(model, data)
            rows = data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY
            wrong = data.efc_pos[rows]
            if np.abs(wrong).max(initial=0.0) < 1e-13:
                return
            slope = data.efc_J.reshape(-1, model.nv)[rows][:, self.free]
            step = np.zeros(model.nv)
            step[self.free] = np.linalg.lstsq(slope, -wrong, rcond=1e-9)[0]
            mujoco.mj_integratePos(model, data.qpos, step, 1.0)
        assert np.abs(wrong).max() < 1e-10, f"the model does not close: {np.abs(wrong).max():.2g}"
