"""Exudyn: one revolution of the six-bar by implicit time steps."""

from __future__ import annotations

import contextlib
import io
import math
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.utilities import (
    CoordinateConstraint,
    LoadForceVector,
    MarkerBodyPosition,
    MarkerNodeCoordinate,
    NodePointGround,
    NodeRigidBody2D,
    ObjectGround,
    ObjectRigidBody2D,
    RevoluteJoint2D,
)

from benchmarks import by_numpy
from benchmarks.cases import Floats, Work
from benchmarks.peers import Peer

_CRANK_INERTIA = 1e-3


class _Model:
    """The crusher's bodies, joints and drive in one container."""

    def __init__(self, container: Any, work: Work) -> None:
        row = work.nominal()
        self.row, self.steps = row, work.positions.count
        self.first = [float(np.ravel(v)[0]) for v in by_numpy.sixbar(work.cosine, work.sine, row)]
        container.Reset()
        self.system = container.AddSystem()
        self.ground = self.system.AddObject(ObjectGround())
        self._assemble()

    def _body(self, p: Floats, q: Floats, vp: Floats, vq: Floats, rate: float, mass: float, inertia: float) -> Any:
        system, centre, speed = self.system, 0.5 * (p + q), 0.5 * (vp + vq)
        angle = math.atan2(q[1] - p[1], q[0] - p[0])
        node = system.AddNode(
            NodeRigidBody2D(referenceCoordinates=[*centre, angle], initialVelocities=[*speed, rate])
        )
        body = system.AddObject(ObjectRigidBody2D(physicsMass=mass, physicsInertia=inertia, nodeNumber=node))
        half = 0.5 * float(np.hypot(*(q - p)))
        middle, low, high = (self._marker(body, x) for x in (0.0, -half, half))
        system.AddLoad(LoadForceVector(markerNumber=middle, loadVector=[0.0, -self.row[20] * mass, 0.0]))
        return low, high

    def _marker(self, body: Any, x: float, y: float = 0.0) -> Any:
        return self.system.AddMarker(MarkerBodyPosition(bodyNumber=body, localPosition=[x, y, 0.0]))

    def _assemble(self) -> None:
        system, row, f = self.system, self.row, self.first
        a, b, c = (np.array(f[k : k + 2]) for k in (0, 2, 4))
        va, vb, vc, rest = (*(np.array(f[k : k + 2]) for k in (6, 8, 10)), np.zeros(2))
        o3, o5 = row[2:4], row[7:9]
        node = system.AddNode(
            NodeRigidBody2D(referenceCoordinates=[0.0, 0.0, 0.0], initialVelocities=[0.0, 0.0, row[1]])
        )
        crank = system.AddObject(ObjectRigidBody2D(physicsMass=1.0, physicsInertia=_CRANK_INERTIA, nodeNumber=node))
        ends = ((a, b, va, vb), (o3, b, rest, vb), (b, c, vb, vc), (o5, c, rest, vc))
        (a2, b2), (a3, b3), (a4, b4), (a5, b5) = (
            self._body(*each, f[18 + k], row[12 + k], row[16 + k]) for k, each in enumerate(ends)
        )
        fixed = [self._marker(self.ground, *place) for place in ((0.0, 0.0), o3, o5)]
        pins = ((fixed[0], self._marker(crank, 0.0)), (self._marker(crank, row[0]), a2), (b2, b3))
        for pair in (*pins, (fixed[1], a3), (b3, a4), (b4, b5), (fixed[2], a5)):
            system.AddObject(RevoluteJoint2D(markerNumbers=list(pair)))
        still = system.AddNode(NodePointGround())
        drive = [
            system.AddMarker(MarkerNodeCoordinate(nodeNumber=number, coordinate=place))
            for number, place in ((still, 0), (node, 2))
        ]
        system.AddObject(CoordinateConstraint(markerNumbers=drive, velocityLevel=True, offset=row[1]))
        system.Assemble()

    def solve(self) -> None:
        settings = exu.SimulationSettings()
        integration = settings.timeIntegration
        integration.numberOfSteps = self.steps
        integration.endTime = 2.0 * math.pi / abs(float(self.row[1]))
        integration.verboseMode = 0
        settings.solutionSettings.writeSolutionToFile = False
        integration.generalizedAlpha.computeInitialAccelerations = True
        integration.generalizedAlpha.spectralRadius = 0.8
        settings.linearSolverType = exu.LinearSolverType.EigenSparse
        self.system.SolveDynamic(settings)


def sixbar(work: Work) -> list[Peer]:
    """W3 as a simulation in time, the model's assembly included."""
    container = exu.SystemContainer()

    def run() -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            _Model(container, work).solve()

    return [Peer("Exudyn", run, note=f"{work.positions.count} implicit steps in time")]
