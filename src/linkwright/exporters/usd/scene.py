"""The prims of a scene: bodies with their points, joints whose frames are prims on both bodies, drives."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from linkwright.elements import Connection
from linkwright.exporters.mjcf.bodies import Body, Chains
from linkwright.exporters.mjcf.drives import reflected_inertia
from linkwright.exporters.mjcf.elements import MIN_MASS, size
from linkwright.exporters.results import Results, seconds
from linkwright.fields.colour import as_rgb
from linkwright.mechanism.link import Link

#: The prim of everything, and the one of the joints.
ROOT, JOINTS = "/Machine", "/Machine/joints"
#: A drive follows its law within this share of the cycle; samples of a law.
DELAY, SAMPLES = 1e-3, 241
#: Radius of drawn links as a share of the largest one.
THICK = 0.012


class Scene:
    """Writes one machine to a stage. ``pxr`` has the modules Gf, Tf, Usd, UsdGeom and UsdPhysics by their names.

    A joint's frames are prims of their own on both bodies, in double precision, since the places that a physics joint
    holds itself are single: at the start both are one.
    """

    def __init__(self, pxr: Mapping[str, Any], results: Results, chains: Chains) -> None:
        self.gf, self.tf, self.usd = pxr["Gf"], pxr["Tf"], pxr["Usd"]
        self.geom, self.physics = pxr["UsdGeom"], pxr["UsdPhysics"]
        self.results, self.chains, self.large = results, chains, size(chains)
        self.stage = self.usd.Stage.CreateInMemory()
        self.paths: dict[str, str] = {}
        self.taken: set[str] = {JOINTS}

    def text(self) -> str:
        """The scene as text."""
        self._stage()
        mechanism = self.chains.mechanism
        for link in (mechanism.frame, *mechanism.links.values()):
            self._body(link)
        ground = self.physics.FixedJoint.Define(self.stage, self._path(JOINTS, "ground"))
        ground.CreateBody1Rel().SetTargets([self.paths["frame"]])
        for body in self.chains.bodies:
            if body.link is not None:
                self._tree_joint(body)
        for cut in self.chains.cuts:
            self._loop_joint(cut)
        found: str = self.stage.GetRootLayer().ExportToString()
        return found

    def _stage(self) -> None:
        self.geom.SetStageUpAxis(self.stage, "Y")
        self.geom.SetStageMetersPerUnit(self.stage, 1.0)
        self.physics.SetStageKilogramsPerUnit(self.stage, 1.0)
        self.stage.SetTimeCodesPerSecond(1.0)
        root = self.geom.Xform.Define(self.stage, ROOT)
        root.GetPrim().SetCustomDataByKey("name", self.chains.mechanism.name)
        self.physics.ArticulationRootAPI.Apply(root.GetPrim())
        self.stage.SetDefaultPrim(root.GetPrim())
        self.geom.Scope.Define(self.stage, JOINTS)
        scene = self.physics.Scene.Define(self.stage, f"{ROOT}/physics")
        x, y = self.chains.mechanism.gravity
        strength = math.hypot(x, y)
        scene.CreateGravityMagnitudeAttr(strength)
        down = (x / strength, y / strength) if strength else (0.0, -1.0)
        scene.CreateGravityDirectionAttr(self.gf.Vec3f(*down, 0.0))

    def _path(self, parent: str, name: str) -> str:
        """A path that is not taken yet, with a name that USD takes."""
        wanted = f"{parent}/{self.tf.MakeValidIdentifier(name)}"
        path, number = wanted, 1
        while path in self.taken:
            number += 1
            path = f"{wanted}_{number}"
        self.taken.add(path)
        return path

    def _placed(self, path: str, place: complex, turn: complex) -> Any:
        """A prim at a place, turned in the plane, both in double precision."""
        prim = self.geom.Xform.Define(self.stage, path)
        double = self.geom.XformOp.PrecisionDouble
        half = 0.5 * cmath.phase(turn)
        prim.AddTranslateOp(double).Set(self.gf.Vec3d(place.real, place.imag, 0.0))
        prim.AddOrientOp(double).Set(self.gf.Quatd(math.cos(half), 0.0, 0.0, math.sin(half)))
        return prim

    # -- bodies

    def _body(self, link: Link) -> None:
        path = self.paths[link.name] = self._path(ROOT, link.name)
        origin, turn = self.chains.start(link.name)
        prim = self._placed(path, origin, turn).GetPrim()
        self.physics.RigidBodyAPI.Apply(prim)
        heaviest = max((each.mass for each in self.chains.mechanism.links.values()), default=0.0) or 1.0
        mass = link.mass or MIN_MASS * heaviest
        inertia = link.inertia or mass * self.large**2 / 12
        matter = self.physics.MassAPI.Apply(prim)
        matter.CreateMassAttr(mass)
        matter.CreateCenterOfMassAttr(self.gf.Vec3f(*link.centre, 0.0))
        matter.CreateDiagonalInertiaAttr(self.gf.Vec3f(inertia, inertia, inertia))
        for point, place in link.points.items():
            self._placed(self._path(path, point), complex(*place), turn.conjugate())
        if link.name != "frame":
            self._shapes(path, link)

    def _shapes(self, path: str, link: Link) -> None:
        """A capsule between each two points."""
        places = [complex(*each) for each in link.points.values()]
        pairs = zip(places, places[1:] + (places[:1] if len(places) > 2 else []), strict=False)
        colour = as_rgb(link.colour)
        for a, b in pairs:
            if abs(b - a) <= 1e-3 * self.large:
                continue
            shape = self._placed(self._path(path, "shape"), 0.5 * (a + b), (b - a) / abs(b - a))
            capsule = self.geom.Capsule.Define(self.stage, f"{shape.GetPath()}/capsule")
            capsule.CreateAxisAttr("X")
            capsule.CreateHeightAttr(abs(b - a))
            capsule.CreateRadiusAttr(THICK * self.large)
            if colour:
                shares = (each / 255 for each in bytes.fromhex(colour[1:]))
                capsule.CreateDisplayColorAttr([self.gf.Vec3f(*shares)])

    # -- joints

    def _tree_joint(self, body: Body) -> None:
        each, ends = body.coordinate, (body.parent, body.name)
        frame = self._at(body.name, 0j)
        if each is None:
            self._joint("FixedJoint", f"{body.name}_fixed", ends, (frame, frame))
            return
        if each.slides:
            frame = self._at(body.name, 0j, complex(*each.axis))
        else:
            frame = self._at(body.name, complex(*each.at))
            ends = ends if each.axis[0] > 0 else (body.name, body.parent)
        joint = self._joint("PrismaticJoint" if each.slides else "RevoluteJoint", each.name, ends, (frame, frame))
        if each.driver is not None:
            self._drive(joint.GetPrim(), each.driver, "linear" if each.slides else "angular")

    def _loop_joint(self, cut: Connection) -> None:
        """A joint that is left out of the articulation, which is a tree."""
        a, b = self.chains.mechanism.link(cut.a), self.chains.mechanism.link(cut.b)
        if cut.turns:
            kind, frames = "RevoluteJoint", [self._at(link.name, complex(*link.points[cut.joint])) for link in (a, b)]
        elif cut.slides:
            guide = self.chains.mechanism.guides[cut.joint]
            along = cmath.rect(1.0, guide.block_angle)
            kind, frames = "PrismaticJoint", [self._at(cut.b, complex(*b.points[guide.at]), along)] * 2
        else:
            kind, frames = "FixedJoint", [self._at(cut.b, 0j)] * 2
        joint = self._joint(kind, cut.joint, (cut.a, cut.b), (frames[0], frames[1]))
        joint.CreateExcludeFromArticulationAttr(True)

    def _at(self, link: str, place: complex, along: complex = 1 + 0j) -> tuple[complex, complex]:
        """Where a place on a link is at the start, and a direction of it."""
        origin, turn = self.chains.start(link)
        return origin + turn * place, turn * along

    def _joint(self, kind: str, name: str, ends: tuple[str, str], frames: tuple[tuple[complex, complex], ...]) -> Any:
        """A joint with a frame on each of its bodies: where it is at the start, and the direction of its x axis."""
        joint = getattr(self.physics, kind).Define(self.stage, self._path(JOINTS, name))
        if kind != "FixedJoint":
            joint.CreateAxisAttr("Z" if kind == "RevoluteJoint" else "X")
        along = frames[-1][1]
        relations = (joint.CreateBody0Rel(), joint.CreateBody1Rel())
        for link, relation, (at, _unused) in zip(ends, relations, frames, strict=True):
            (base, turned), path = self.chains.start(link), self._path(self.paths[link], f"{name}_frame")
            self._placed(path, (at - base) * turned.conjugate(), along * turned.conjugate())
            relation.SetTargets([path])
        return joint

    def _drive(self, prim: Any, driver: str, kind: str) -> None:
        """Holds a constant speed, or follows samples of its law over the time in s; angles in degrees."""
        law, motion = self.chains.mechanism.drivers[driver].law, self.chains.motion
        unit = math.degrees(1.0) if kind == "angular" else 1.0
        inertia = reflected_inertia(self.chains)[driver] / unit
        delay = DELAY * seconds(motion)
        drive = self.physics.DriveAPI.Apply(prim, kind)
        drive.CreateTypeAttr("force")
        drive.CreateDampingAttr(inertia / delay)
        if law.constant_speed is not None:
            drive.CreateTargetVelocityAttr(law.constant_speed * unit)
            return
        drive.CreateStiffnessAttr(inertia / delay**2)
        target = drive.CreateTargetPositionAttr()
        start = float(motion.time[self.chains.index])
        for time in np.linspace(float(motion.time.min()), float(motion.time.max()), SAMPLES):
            moved = float(law.coordinate(np.array([time]))[0][0]) - float(motion.inputs[driver][self.chains.index])
            target.Set(moved * unit, float(time) - start)
