"""The gear pair: two toothed wheels on one carrier, outside each other or one in the other."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import atan, atan2, dist, pi
from math import cos as cos_of
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import Mask, Scalar, absolute, cos, maximum, reciprocal, select, sqrt, stop, tan
from linkwright.engine.vector import Vec
from linkwright.fields.base import Field, Quantity, Word
from linkwright.joints.base import JOINTS, Contact, Entry, Joint, Poses
from linkwright.joints.marks import Mark, WheelSizes
from linkwright.joints.toothed import FITS, WheelCut, WheelPair, length
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.kinematics.cycle import Floats
    from linkwright.kinematics.dimensions import Dimensions
    from linkwright.kinematics.motion import Motion
    from linkwright.mechanism.mechanism import Mechanism
    from linkwright.structure.group import Connection

#: The pressure angle of standard teeth, and the clearance at their bottom in modules (ISO 53): by so much the centres
#: of involute wheels may be off, as tolerances and sweeps have it, before teeth touch the bottom or let go.
STANDARD, CLEARANCE = pi / 9, 0.25


@JOINTS.register("gear")
@dataclass(frozen=True)
class GearPair(WheelPair):
    """Two gears; ``mesh`` is external or internal (the larger one is the ring).

    With d = |AB| and the ratio i, negative for an external pair, the pitch point C lies at ρ_a = d i / (i - 1) from A
    and at ρ_b = d / (i - 1) from B on the ray A→B, and the row is ρ_a (θ_a - θ_c) - ρ_b (θ_b - θ_c) = const. Its
    multiplier is the tangential force on a along AB turned left; the teeth press the wheels apart with the separating
    force |F_t| tan α along AB, ``pressure_angle`` α (Norton, Design of Machinery, ch. 9 and 11).
    """

    kind: ClassVar[str] = "gear"
    letter: ClassVar[str] = "G"
    toothed: ClassVar[bool] = True
    mesh: str = "external"
    module: float | None = None
    pressure_angle: float = STANDARD

    @property
    def sense(self) -> float:
        return 1.0 if self.mesh == "internal" else -1.0

    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            **super().fields(),
            "ratio": Quantity(
                "dimensionless",
                nonzero=True,
                doc="ratio of b's speed to a's on the carrier: negative external, positive internal",
            ),
            "mesh": Word(
                ("external", "internal"), doc="default external; internal: the larger one is the ring"
            ),
            "module": Quantity(
                "length", above=0, doc="module; with teeth it is checked against the centre distance"
            ),
            "pressure_angle": Quantity(
                "angle", minimum=0, below=0.5 * pi, doc="pressure angle in mesh (default 20 deg)"
            ),
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        values = entry.values
        ratio = values.get("ratio")
        if values.get("module") and not values.get("teeth") and (ratio or values.get("radii")):
            remedy = Sentence("joints.teeth_or_no_module")
            entry.say("module", Sentence("joints.module_without_teeth"), remedy, "choice")
            return None
        if ratio is not None and not (values.get("teeth") or values.get("radii")):
            values["mesh"] = "internal" if ratio > 0 else "external"
        return super().read(entry)

    def check(self, entry: Entry, distance: float) -> None:
        i = self.transmission
        given = self.teeth or self.radii
        if self.ratio is not None and given is not None:
            own = self.sense * given[0] / given[1]
            if abs(self.ratio - own) > FITS * abs(own):
                key = "teeth" if self.teeth else "radii"
                problem = Sentence("joints.ratio_misfit", ratio=self.ratio, key_=key, own=own)
                entry.say("ratio", problem, Sentence("joints.leave_ratio"), "choice")
                return
        if i == 1.0:
            entry.say("", Sentence("joints.equal_internal"), Sentence("joints.unequal"), "range")
            return
        if distance == 0.0:
            problem = Sentence("joints.same_centre", centres=self.centres)
            entry.say("links", problem, Sentence("joints.centres_apart"), "range")
            return
        apart = self._apart(distance)
        if apart is not None:
            entry.say("radii" if self.radii else "module", apart, Sentence("joints.fit_distance"), "range")

    @property
    def asked(self) -> float:
        """The distance of the centres that the sizes ask for, m; 0 where they take any."""
        size = 1.0 if self.radii else 0.5 * (self.module or 0.0)
        a, b = self.radii or self.teeth or (0.0, 0.0)
        return size * abs(a - self.sense * b)

    def _apart(self, distance: float, slack: float = 0.0) -> Sentence | None:
        """What is wrong where the sizes ask for another distance of the centres, by more than the slack, m."""
        wanted = self.asked
        if not wanted or abs(wanted - distance) <= max(FITS * distance, slack):
            return None
        return Sentence(
            "joints.distance_misfit",
            centres=self.centres,
            carrier=self.carrier,
            distance=length(distance),
            wanted=length(wanted),
            mesh=Sentence("joints.internal" if self.sense > 0 else "joints.external"),
        )

    def misfit(self, mechanism: Mechanism) -> Sentence | None:
        distance = abs(self.line(mechanism))
        base = self.asked * cos_of(self.pressure_angle) if self.involute else 0.0
        return self._apart(distance, CLEARANCE * (self.module or 0.0) if distance >= base else 0.0)

    @property
    def involute(self) -> bool:
        """Whether the teeth are known so well that their working pressure angle follows from the distance."""
        return self.radii is None and self.teeth is not None and self.module is not None

    def _asked(self, dimensions: Dimensions) -> Scalar:
        """Traced, with the sign of the mesh."""
        key = "radii" if self.radii else "teeth"
        first, second = (dimensions(f"{self.name}.{key}.{k}") for k in (0, 1))
        wanted = first - self.sense * second
        return wanted if self.radii else 0.5 * dimensions(f"{self.name}.module") * wanted

    def fits(self, dimensions: Dimensions) -> Mask:
        """Radii, or teeth and module, ask for their distance of the centres; a ratio or teeth alone take any."""
        if self.radii is None and not self.involute:
            return True
        a, b = (dimensions.point(self.carrier, each) for each in self.centres)
        wanted, line = self._asked(dimensions), b - a
        if not self.involute:
            return absolute(wanted * wanted - line.square) <= 2.0 * FITS * line.square
        base = wanted * cos(dimensions(f"{self.name}.pressure_angle"))
        off = absolute(absolute(wanted) - sqrt(line.square))
        near = off <= CLEARANCE * dimensions(f"{self.name}.module")
        return dimensions.trace.logic("and", near, base * base <= line.square * (1.0 + 2.0 * FITS))

    def _slope(self, angle: Scalar, wanted: Scalar, square: Scalar) -> Scalar:
        """tan of the pressure angle in mesh, traced or a number, at the square of the distance.

        A distance that fits, as a file rounds it, has the given angle to the last digit.
        """
        if not self.involute or (isinstance(angle, float) and angle == 0.0):
            return tan(angle)
        root = cos(angle)
        off = square * reciprocal(wanted * wanted) - 1.0
        rounded = select(absolute(off) <= 2.0 * FITS * (1.0 + FITS), off, 0.0)
        return sqrt(maximum((1.0 + off - stop(rounded)) * reciprocal(root * root) - 1.0, 0.0))

    def written(self) -> dict[str, Any]:
        found = super().written()
        if self.mesh == "internal" and self.ratio is None:
            found["mesh"] = self.mesh
        if self.module is not None:
            found["module"] = self.module
        if self.pressure_angle != type(self).pressure_angle:
            found["pressure_angle"] = self.pressure_angle
        return found

    def dimensions(self) -> Mapping[str, float]:
        own = {f"{self.name}.pressure_angle": self.pressure_angle}
        return {
            **super().dimensions(),
            **own,
            **({f"{self.name}.module": self.module} if self.module else {}),
        }

    def arms(self, mechanism: Mechanism) -> tuple[float, float]:
        points, i = mechanism.link(self.carrier).points, self.transmission
        d = dist(*(points[each] for each in self.centres))
        return d * i / (i - 1.0), -d / (i - 1.0)

    def wheel_sizes(self, mechanism: Mechanism) -> WheelSizes:
        found = super().wheel_sizes(mechanism)
        if not self.toothed:
            return found
        own = {"module": self.module, "pressure_angle": self.pressure_angle, "involute": self.involute}
        return replace(found, **own)  # type: ignore[arg-type]

    def acts_at(self, motion: Motion) -> Floats:
        """The pitch point."""
        a, b = (motion.point(f"{self.carrier}.{each}").position for each in self.centres)
        i = self.transmission
        return a + (b - a) * (i / (i - 1.0))

    def marks(self, mechanism: Mechanism, tooth: dict[tuple[str, str], float]) -> Iterable[Mark]:
        """Two gears whose teeth mesh, where their numbers are known; else two wheels of the pitch radii."""
        radii = [abs(each) for each in self.arms(mechanism)]
        turned = self._meshing(mechanism, tooth) if self.teeth is not None else (0.0, 0.0)
        for k, link in enumerate(self.links):
            yield Mark(
                "gear" if self.toothed else "disc",
                link,
                mechanism.link(link).points[self.centres[k]],
                radii[k],
                turned[k],
                self.mesh == "internal" and radii[k] > radii[1 - k],
                None if self.teeth is None else int(self.teeth[k]),
            )

    def _meshing(self, mechanism: Mechanism, tooth: dict[tuple[str, str], float]) -> tuple[float, float]:
        """Where a tooth of each wheel is, rad in its axes, so that teeth of one lie in gaps of the other.

        With the numbers of pitches u, v from a tooth to the pitch point, counter-clockwise: u + v (external) or v - u
        (internal) is a whole number and a half, in all positions if it is in one.
        """
        assert self.teeth is not None
        points = mechanism.link(self.carrier).points
        (ax, ay), (bx, by) = (points[each] for each in self.centres)
        line, (za, zb), phase = atan2(by - ay, bx - ax), self.teeth, self.phase or 0.0
        from_a = line if self.arms(mechanism)[0] > 0 else line + pi
        from_b = line + pi if self.arms(mechanism)[1] > 0 else line
        a, b = ((link, centre) for link, centre in zip(self.links, self.centres, strict=True))
        sense = -self.sense

        def other(z: float, toward: float, mine: float, own: float) -> float:
            """Tooth of one wheel from that of the other: sense · u z + v z' = half a pitch."""
            return (toward * z + sense * mine - pi) / z - own

        if a not in tooth and b in tooth:
            tooth[a] = other(za, from_a, (from_b - phase - tooth[b]) * zb, 0.0)
        tooth.setdefault(a, 0.0)
        if b not in tooth:
            tooth[b] = other(zb, from_b - phase, (from_a - tooth[a]) * za, 0.0)
        return tooth[a], tooth[b]

    def contact(self, mechanism: Mechanism) -> Contact:
        _, other = self.arms(mechanism)
        angle, at = cmath.phase(self.line(mechanism)), (self.carrier, self.centres[0])
        slope = self._slope(self.pressure_angle, self.asked, abs(self.line(mechanism)) ** 2)
        assert isinstance(slope, float)
        return Contact(-other, self.carrier, angle, at, atan(slope), press=self.sense)

    def cut(self, connection: Connection, dimensions: Dimensions) -> GearCut:
        a, b = (dimensions.point(self.carrier, each) for each in self.centres)
        line = b - a
        d = sqrt(line.square)
        i = self.traced_ratio(dimensions)
        part = d * reciprocal(i - 1.0)
        phase = dimensions(f"{self.name}.phase")
        wanted = self._asked(dimensions) if self.involute else 0.0
        slope = self._slope(dimensions(f"{self.name}.pressure_angle"), wanted, line.square)
        unit = line * reciprocal(d)
        return GearCut(
            connection, self.carrier, (part * i, -part, -d), part * phase, a, b, unit, slope, self.sense
        )


@dataclass(frozen=True)
class GearCut(WheelCut):
    """``unit``: from A to B in the carrier's axes; ``slope``: tan α; ``sense``: -1 external, 1 internal."""

    unit: Vec
    slope: Scalar
    sense: float

    def place(self, end: str, poses: Poses) -> Vec:
        """The pitch point."""
        return poses[self.carrier].point(self.centre_a + self.unit * self.k[0])

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Poses) -> tuple[Vec, Scalar]:
        force = poses[self.carrier].spin(self.unit).perp * multipliers[0]
        return (force if end == self.connection.a else -force), 0.0

    def pressing(self, multipliers: Sequence[Scalar], poses: Poses) -> Vec | None:
        """Away from the teeth of the other: an external a to its own centre, a ring outwards."""
        if isinstance(self.slope, float) and self.slope == 0.0:
            return None
        return poses[self.carrier].spin(self.unit) * (self.sense * self.slope * absolute(multipliers[0]))
