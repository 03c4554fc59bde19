"""The graphs of pylinkage: nodes with roles, edges, hyperedges, components; their sizes are in the dimensions."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from linkwright.importers.json_tree import Json
from linkwright.importers.pylinkage.mechanism import USUAL_RATE, pair
from linkwright.importers.pylinkage.pin_plan import Driver, Joint, Line, Member, PinPlan
from linkwright.words import _


@dataclass
class Edge:
    """An edge between two nodes; ``body``: edges of one body are rigid together."""

    key: str
    a: str
    b: str
    body: str
    json: Json


@dataclass
class Graph:
    """Nodes, edges and rigid groups of nodes."""

    nodes: dict[str, Json] = field(default_factory=dict)
    edges: list[Edge] = field(default_factory=list)
    groups: list[tuple[str, list[str], Json]] = field(default_factory=list)

    def role(self, key: str) -> str:
        """GROUND, DRIVER or DRIVEN."""
        return self.nodes[key].text("role", "DRIVEN").upper()

    def kind(self, key: str) -> str:
        """REVOLUTE, PRISMATIC, GROUND, TRACKER."""
        return self.nodes[key].text("joint_type", "REVOLUTE").upper()

    def fixed(self, key: str) -> bool:
        """Whether a node is part of the frame."""
        return self.role(key) == "GROUND" or self.kind(key) == "GROUND"

    def slides(self, key: str) -> bool:
        """Whether a node slides on a line."""
        return self.kind(key) == "PRISMATIC" and not self.fixed(key)

    def line(self, key: str) -> tuple[str, str] | None:
        """The nodes whose line a slider moves on: the second and the third to which its edges lead."""
        found = self.neighbours(key)
        return (found[1], found[2]) if len(found) > 2 else None

    def guides(self, edge: Edge) -> bool:
        """Whether an edge only says on which line a slider moves."""
        ends = ((edge.a, edge.b), (edge.b, edge.a))
        return any(self.slides(one) and other in (self.line(one) or ()) for one, other in ends)

    def neighbours(self, key: str) -> list[str]:
        """The nodes to which edges and groups lead, in their order."""
        found = [edge.b if edge.a == key else edge.a for edge in self.edges if key in (edge.a, edge.b)]
        found += [each for _name, nodes, _json in self.groups if key in nodes for each in nodes if each != key]
        return list(dict.fromkeys(found))


def read_graph(root: Json, sizes: Json | None) -> PinPlan | None:
    """The plan of a graph; None, with an error, where it has no sizes."""
    graph = _components(root) if "instances" in root else _flat(root)
    _complete(graph)
    if not graph.nodes:
        root.remark("error", _("the file has no joints"), _("choose another file"), "import.empty")
        return None
    if sizes is None:
        _structure_only(root, graph)
        return None
    plan, places = PinPlan(root), sizes.entries("node_positions")
    for key, node in graph.nodes.items():
        place = pair(places.get(key))
        joint = plan.joints[key] = Joint(node.text("name") or key, node, place, graph.fixed(key))
        if graph.slides(key):
            joint.line = Line(joints=graph.line(key)) if graph.line(key) else _level(joint)
    plan.members = [Member(name, nodes, root) for name, nodes in _rigid(graph)]
    _lengths(plan, graph, sizes)
    for key in graph.nodes:
        if graph.role(key) == "DRIVER":
            _driver(plan, graph, key, sizes.entries("driver_angles").get(key))
    return plan


def _complete(graph: Graph) -> None:
    """Leaves out edges and groups of nodes that are not there, and nodes that only watch."""
    for key in [key for key in graph.nodes if graph.kind(key) == "TRACKER"]:
        message = _('"{key}" watches without saying what: left out', key=key)
        graph.nodes.pop(key).remark("warning", message, _("add it as a point of a link"), "import.skipped")
    for edge in graph.edges:
        if not {edge.a, edge.b} <= graph.nodes.keys():
            message = _('"{key}" needs joints that are there: left out', key=edge.key)
            edge.json.remark("warning", message, _("mend it here"), "import.skipped")
    graph.edges = [edge for edge in graph.edges if {edge.a, edge.b} <= graph.nodes.keys()]
    graph.groups = [(key, [each for each in nodes if each in graph.nodes], json) for key, nodes, json in graph.groups]


def _level(joint: Joint) -> Line:
    """The line of a slider to which no two nodes give one."""
    message = _('no two nodes give the line of "{key}": a level one is taken', key=joint.name)
    joint.json.remark("warning", message, _("join it to two nodes of its line"), "import.line")
    return Line(joint.place or (0.0, 0.0), 0.0)


def _flat(root: Json, prefix: str = "", merged: dict[str, str] | None = None) -> Graph:
    """The nodes and edges of one graph, their names behind a prefix, or those with which they are merged."""
    graph, same = Graph(), merged or {}

    def named(key: str) -> str:
        return same.get(prefix + key, prefix + key)

    for each in root.each("nodes"):
        graph.nodes.setdefault(named(each.text("id")), each)
    for each in root.each("edges"):
        a, b = named(each.text("source")), named(each.text("target"))
        if a != b:
            graph.edges.append(Edge(prefix + each.text("id"), a, b, each.text("body_id"), each))
    for each in root.each("hyperedges"):
        nodes = list(dict.fromkeys(named(node.word) for node in each.each("nodes")))
        graph.groups.append((prefix + each.text("id"), nodes, each))
    return graph


def _components(root: Json) -> Graph:
    """Instances of graphs, connected at their ports; a port's node is that of the connection's first instance."""
    instances, merged = root.entries("instances"), dict[str, str]()
    for each in root.each("connections"):
        ends = []
        for side in ("from", "to"):
            name, port = each.text(f"{side}_instance"), each.text(f"{side}_port")
            ports = instances[name].entries("ports") if name in instances else {}
            if port not in ports:
                message = _('there is no port "{port}" of "{name}"', port=port, name=name)
                each.remark("error", message, _("mend it here"), "import.missing")
                return Graph()
            ends.append(f"{name}.{ports[port].word}")
        first, second = (merged.get(end, end) for end in ends)
        if first != second:
            merged = {key: first if value == second else value for key, value in merged.items()} | {second: first}
    found = Graph()
    for name, instance in instances.items():
        part = _flat(instance.get("topology") or instance, f"{name}.", merged)
        for key, node in part.nodes.items():
            found.nodes.setdefault(key, node)
        found.edges += part.edges
        found.groups += part.groups
    return found


def _structure_only(root: Json, graph: Graph) -> None:
    """An error that says what can be known of a structure without sizes."""
    groups = [set(nodes) for _name, nodes in _rigid(graph)]
    moving = [each for each in groups if not all(graph.fixed(key) for key in each)]
    pins = sum(sum(key in each for each in moving) - (0 if graph.fixed(key) else 1) for key in graph.nodes)
    message = _(
        "this is a structure without sizes: {links} moving links, {pins} pins, mobility {mobility}",
        links=len(moving),
        pins=pins,
        mobility=3 * len(moving) - 2 * pins,
    )
    remedy = _("put its dimensions beside it, as NAME.dimensions.json, or into it as dimensions")
    root.remark("error", message, remedy, "import.no_sizes")


def _rigid(graph: Graph) -> list[tuple[str, list[str]]]:
    """The rigid groups of nodes: edges of one body, hyperedges, and each other edge."""
    bodies: dict[tuple[str, bool], list[str]] = {}
    for edge in graph.edges:
        if not graph.guides(edge):
            bodies.setdefault((edge.body or edge.key, bool(edge.body)), []).extend((edge.a, edge.b))
    found = [(name, list(dict.fromkeys(nodes))) for (name, _body), nodes in bodies.items()]
    return [*found, *((name, nodes) for name, nodes, _json in graph.groups)]


def _lengths(plan: PinPlan, graph: Graph, sizes: Json) -> None:
    """Distances that are given beside the places."""
    given = sizes.entries("edge_distances")
    for edge in graph.edges:
        if edge.key in given and not graph.guides(edge):
            plan.lengths[edge.a, edge.b] = given[edge.key].value
    for each in sizes.entries("hyperedge_constraints").values():
        for row in each.items():
            parts = list(row.items())
            if len(parts) == 3:
                plan.lengths[parts[0].word, parts[1].word] = parts[2].value
            else:
                row.expected(_("a list of two joints and their distance"))
        for key, distance in each.own_entries().items():
            ends = [
                part.strip(" '\"") for part in key.strip("()[] ").split(",")
            ]  # "('a', 'b')", as older files have it
            if len(ends) == 2:
                plan.lengths[ends[0], ends[1]] = distance.value


def _driver(plan: PinPlan, graph: Graph, key: str, angles: Json | None) -> None:
    """The member of a driven node and a fixed one turns about the fixed one, from where it is drawn."""
    node, motor = graph.nodes[key], next((each for each in graph.neighbours(key) if graph.fixed(each)), None)
    member = None if motor is None else plan.holder(motor, key)
    if motor is None or member is None:
        message = _('the driver "{key}" has no fixed joint to turn about, or no other one', key=key)
        node.remark("error", message, _("join it to a node of the role GROUND"), "import.driver")
        return
    rate = USUAL_RATE if angles is None else angles.number("angular_velocity", USUAL_RATE)
    plan.drivers.append(Driver(member, motor, key, rate, None, node))
    start, place = plan.joints[motor].place, plan.joints[key].place
    if angles is None or "initial_angle" not in angles or start is None or place is None:
        return
    drawn = math.atan2(place[1] - start[1], place[0] - start[0])
    if abs(math.remainder(drawn - angles.number("initial_angle"), math.tau)) > 1e-6:
        message = _("initial_angle is not where the positions have it: the positions are taken")
        angles.remark("note", message, _("give both alike"), "import.angle")
