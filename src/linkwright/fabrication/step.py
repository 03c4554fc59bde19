"""STEP (ISO 10303-21, AP214): every body exactly, by planes and cylinders, in an assembly, in mm."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from linkwright.fabrication.body import Body, Pose, Section, regions
from linkwright.fabrication.brep import Brep, Curve, Face, Place, brep_of
from linkwright.words.characters import printable

_HEAD = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('parts of a machine'),'2;1');
FILE_NAME({name},'1970-01-01T00:00:00',(''),(''),'','Linkwright','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
"""
#: What wraps a colour until a solid can have it.
_STYLES = (
    "FILL_AREA_STYLE_COLOUR('',{})",
    "FILL_AREA_STYLE('',({}))",
    "SURFACE_STYLE_FILL_AREA({})",
    "SURFACE_SIDE_STYLE('',({}))",
    "SURFACE_STYLE_USAGE(.BOTH.,{})",
    "PRESENTATION_STYLE_ASSIGNMENT(({}))",
)
_FOOT = "ENDSEC;\nEND-ISO-10303-21;\n"


def step_content(bodies: Sequence[Body], name: str) -> bytes:
    """A STEP file: an assembly ``name`` of all bodies at their places; of one body in its own axes a part."""
    file = _File()
    if len(bodies) == 1:
        file.part(bodies[0])
    else:
        file.assembly(bodies, name)
    text = _HEAD.format(name=_text(name)) + "".join(file.lines) + _FOOT
    return text.encode("ascii")


def _text(words: str) -> str:
    """A string of STEP: printable ASCII as it is, the rest by its code in UTF-16 or UTF-32."""
    found = ""
    for letter in printable(words):
        code = ord(letter)
        if 32 <= code < 127:
            found += {"'": "''", "\\": "\\\\"}.get(letter, letter)
        else:
            found += f"\\X2\\{code:04X}\\X0\\" if code < 0x10000 else f"\\X4\\{code:08X}\\X0\\"
    return f"'{found}'"


def _real(value: float) -> str:
    """A real number of STEP, which has a point and a capital E."""
    mantissa, e, exponent = f"{value + 0.0:.13g}".partition("e")
    return f"{mantissa}{'' if '.' in mantissa else '.'}{e.upper()}{exponent}"


def _list(items: Iterable[str]) -> str:
    return f"({','.join(items)})"


class _File:
    """The instances of a file, each a line; a method returns the number of what it adds, as ``#12``."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        context = self.add("APPLICATION_CONTEXT('automotive design')")
        self.add(f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{context})")
        self.product_context = self.add(f"PRODUCT_CONTEXT('',{context},'mechanical')")
        self.design = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{context},'design')")
        self.space = self._space()
        self.origin = self.axes()

    def add(self, instance: str) -> str:
        """One instance."""
        number = f"#{len(self.lines) + 1}"
        self.lines.append(f"{number}={instance};\n")
        return number

    def _space(self) -> str:
        """The space of all geometry: mm, rad."""
        length = self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
        angle = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        solid = self.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        exact = self.add(
            f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),{length},'distance_accuracy_value','')"
        )
        return self.add(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({exact}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid}))REPRESENTATION_CONTEXT('','3D'))"
        )

    def point(self, place: Place) -> str:
        """A point, m."""
        return self.add(f"CARTESIAN_POINT('',{_list(_real(1e3 * each) for each in place)})")

    def direction(self, way: Place) -> str:
        """A direction."""
        return self.add(f"DIRECTION('',{_list(map(_real, way))})")

    def axes(self, place: Place = (0.0, 0.0, 0.0), z: Place = (0.0, 0.0, 1.0), x: Place = (1.0, 0.0, 0.0)) -> str:
        """A place with the directions of its axes z and x."""
        return self.add(f"AXIS2_PLACEMENT_3D('',{self.point(place)},{self.direction(z)},{self.direction(x)})")

    def solid(self, brep: Brep, name: str) -> str:
        """A solid by its faces."""
        vertices = [self.add(f"VERTEX_POINT('',{self.point(each)})") for each in brep.vertices]
        edges = [self._edge(brep, vertices, *each) for each in brep.edges]
        faces = [self._face(edges, each) for each in brep.faces]
        shell = self.add(f"CLOSED_SHELL('',{_list(faces)})")
        return self.add(f"MANIFOLD_SOLID_BREP({_text(name)},{shell})")

    def _edge(self, brep: Brep, vertices: Sequence[str], start: int, end: int, curve: Curve) -> str:
        if curve.radius:
            line = self.add(f"CIRCLE('',{self.axes(curve.centre)},{_real(1e3 * curve.radius)})")
        else:
            a, b = brep.vertices[start], brep.vertices[end]
            vector = self.add(f"VECTOR('',{self.direction((b[0] - a[0], b[1] - a[1], b[2] - a[2]))},1.)")
            line = self.add(f"LINE('',{self.point(a)},{vector})")
        sense = ".T." if curve.counter_clockwise else ".F."
        return self.add(f"EDGE_CURVE('',{vertices[start]},{vertices[end]},{line},{sense})")

    def _face(self, edges: Sequence[str], face: Face) -> str:
        surface = face.surface
        if surface.radius:
            about = self.add(f"CYLINDRICAL_SURFACE('',{self.axes(surface.place)},{_real(1e3 * surface.radius)})")
        else:
            level = surface.normal[2] != 0.0
            x = (1.0, 0.0, 0.0) if level else (0.0, 0.0, 1.0)
            about = self.add(f"PLANE('',{self.axes(surface.place, surface.normal, x)})")
        bounds = []
        for k, passed in enumerate(face.bounds):
            sides = [self.add(f"ORIENTED_EDGE('',*,*,{edges[i]},{'.T.' if on else '.F.'})") for i, on in passed]
            loop = self.add(f"EDGE_LOOP('',{_list(sides)})")
            bounds.append(self.add(f"{'FACE_BOUND' if k else 'FACE_OUTER_BOUND'}('',{loop},.T.)"))
        return self.add(f"ADVANCED_FACE('',{_list(bounds)},{about},{'.T.' if face.outward else '.F.'})")

    def product(self, name: str) -> str:
        """The definition of a product."""
        product = self.add(f"PRODUCT({_text(name)},{_text(name)},'',({self.product_context}))")
        self.add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))")
        formation = self.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
        return self.add(f"PRODUCT_DEFINITION('design','',{formation},{self.design})")

    def part(self, body: Body) -> tuple[str, str]:
        """A part with its shape, in its own axes: its definition and its representation."""
        definition = self.product(body.name)
        solids = [self.solid(brep_of(each), body.name) for each in _solids(body)]
        shape = self.add(f"ADVANCED_BREP_SHAPE_REPRESENTATION('',{_list((self.origin, *solids))},{self.space})")
        self._shaped(definition, shape)
        self._coloured(solids, body.colour)
        return definition, shape

    def _shaped(self, definition: str, shape: str) -> None:
        has = self.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
        self.add(f"SHAPE_DEFINITION_REPRESENTATION({has},{shape})")

    def _coloured(self, solids: Sequence[str], colour: str) -> None:
        red, green, blue = (_real(int(colour[k : k + 2], 16) / 255) for k in (1, 3, 5))
        style = self.add(f"COLOUR_RGB('',{red},{green},{blue})")
        for about in _STYLES:
            style = self.add(about.format(style))
        items = [self.add(f"STYLED_ITEM('',({style}),{solid})") for solid in solids]
        self.add(f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{_list(items)},{self.space})")

    def assembly(self, bodies: Sequence[Body], name: str) -> None:
        """All bodies as parts of one product, each at its places."""
        whole = self.product(name)
        parts = [self.part(body) for body in bodies]
        uses = [(body.name, part, pose) for body, part in zip(bodies, parts, strict=True) for pose in body.poses]
        places = [self._placed(pose) for *_unused, pose in uses]
        shape = self.add(f"SHAPE_REPRESENTATION('',{_list((self.origin, *places))},{self.space})")
        self._shaped(whole, shape)
        for k, ((called, (definition, own), _unused), place) in enumerate(zip(uses, places, strict=True), 1):
            use = f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{k}',{_text(called)},'',{whole},{definition},$)"
            used = self.add(f"PRODUCT_DEFINITION_SHAPE('','',{self.add(use)})")
            moved = self.add(f"ITEM_DEFINED_TRANSFORMATION('','',{self.origin},{place})")
            relation = self.add(
                f"(REPRESENTATION_RELATIONSHIP('','',{own},{shape})"
                f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved})SHAPE_REPRESENTATION_RELATIONSHIP())"
            )
            self.add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{used})")

    def _placed(self, pose: Pose) -> str:
        place, along = (pose.at.real, pose.at.imag, pose.z), (pose.along.real, pose.along.imag, 0.0)
        return self.axes(place, x=along)


def _solids(body: Body) -> list[tuple[Section, ...]]:
    """The connected solids of a body: a plate in several pieces is several."""
    if len(body.sections) > 1:
        return [body.sections]
    (section,) = body.sections
    return [(Section(loops, section.low, section.high),) for loops in regions(section.loops)]
