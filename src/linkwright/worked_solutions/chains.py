"""A group's chains as a textbook walks them: from a known point through pins and guides to the cut."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from linkwright.elements import Connection, Group, TreeJoint
from linkwright.equations.terms import NOWHERE, TWO, ZERO, Pair, Term, cosine, number, sine, symbol
from linkwright.worked_solutions.symbols import PointState, Slide, SymbolTable


@dataclass
class Piece:
    """Part of a chain in which nothing turns against anything else, from ``start`` to ``end``.

    ``link`` tells how it turns; ``slides`` with the sign of the direction in which they move the end.
    """

    link: str
    start: PointState
    end: PointState
    slides: list[tuple[TreeJoint, Slide, int]] = field(default_factory=list)

    @property
    def arm(self) -> Pair:
        """From start to end, frame axes."""
        return NOWHERE if self.start.key == self.end.key else self.end.place - self.start.place


@dataclass
class Turn:
    """A pin of a chain: the joint, its place, and where the part that it turns ends (next free pin, or the cut)."""

    step: TreeJoint
    pivot: PointState
    tip: PointState

    @property
    def arm(self) -> Pair:
        """What the pin turns, frame axes."""
        return self.tip.place - self.pivot.place


@dataclass
class Chain:
    """A chain from a solved link to one end of a cut (or to any point of its last link)."""

    base: PointState
    pieces: list[Piece]
    free: list[Turn]
    driven: list[Turn]
    owned: list[bool]

    def slides(self) -> Iterator[tuple[TreeJoint, Slide, int, str]]:
        """All guides with sign and the link whose turning they follow."""
        for piece in self.pieces:
            for step, slide, sign in piece.slides:
                yield step, slide, sign, piece.link


def attach(step: TreeJoint, link: str, book: SymbolTable) -> str:
    """Name of the point of a link at which a joint holds it."""
    return book.mechanism.joints[step.joint].point_on(link)


def walk(book: SymbolTable, group: Group, end: str, tip: PointState, point: str) -> Chain:
    """The chain to ``tip``; ``point`` is the point by which it starts if ``end`` is a solved link."""
    steps = list(reversed(list(group.path(end))))
    if not steps:
        base = book.spot(end, point)
        pieces = [] if base.key == tip.key else [Piece(end, base, tip)]
        return Chain(base, pieces, [], [], [False] * len(pieces))
    base = book.spot(steps[0].parent, attach(steps[0], steps[0].parent, book))
    chain = Chain(base, [], [], [], [])
    here, link, slides = base, steps[0].parent, []
    for step in steps:
        if step.slides:
            sign = 1 if step.child == step.connection.b else -1
            slides.append((step, book.slide(step.joint), sign))
        elif step.turns:
            pin = book.spot(step.parent, step.joint)
            _close(chain, Piece(link, here, pin, slides))
            here, link, slides = pin, step.child, []
            (chain.free if step.free else chain.driven).append(Turn(step, pin, tip))
    _close(chain, Piece(link, here, tip, slides))
    _end_turns(chain)
    return chain


def _close(chain: Chain, piece: Piece) -> None:
    if piece.start.key != piece.end.key or piece.slides:
        chain.pieces.append(piece)
        chain.owned.append(bool(chain.free))


def _end_turns(chain: Chain) -> None:
    """Every pin's part ends at the next free pin."""
    for i, turn in enumerate(chain.free[:-1]):
        turn.tip = chain.free[i + 1].pivot
    for turn in chain.driven:
        later = [free for free in chain.free if _after(chain, turn, free)]
        if later:
            turn.tip = later[0].pivot


def _after(chain: Chain, turn: Turn, free: Turn) -> bool:
    """Whether a free pin comes after a driven one along the chain."""
    starts = [piece.start.key for piece in chain.pieces]
    if turn.pivot.key not in starts or free.pivot.key not in starts:
        return False
    return starts.index(free.pivot.key) > starts.index(turn.pivot.key)


@dataclass(frozen=True)
class Drift:
    """A known part of a velocity or an acceleration, with the key of its name."""

    kind: str
    label: str
    vector: Pair


def columns(chain: Chain) -> dict[TreeJoint, Pair]:
    """What a unit rate of each unknown does to the tip."""
    found = {turn.step: turn.arm.perp for turn in chain.free}
    for step, slide, sign, _ in chain.slides():
        if step.free:
            found[step] = slide.along if sign > 0 else -slide.along
    return found


def drift(chain: Chain, book: SymbolTable) -> Pair:
    """Velocity of the tip with the unknown rates left out."""
    found = chain.base.velocity
    for piece, owned in zip(chain.pieces, chain.owned, strict=True):
        if not owned:
            found = found + piece.arm.perp.times(book.omega(piece.link))
    for turn, rate, _ in _driven(chain, book):
        found = found + turn.arm.perp.times(rate)
    for step, slide, sign, _ in chain.slides():
        if not step.free:
            found = found + slide.along.times(slide.rate if sign > 0 else -slide.rate)
    return found


def bends(chain: Chain, book: SymbolTable) -> list[Drift]:
    """Parts of the tip's acceleration with the unknown second derivatives left out, one by one."""
    found = [Drift("base", chain.base.label, chain.base.acceleration)]
    for piece, owned in zip(chain.pieces, chain.owned, strict=True):
        omega, label = book.omega(piece.link), f"{piece.start.label}{piece.end.label}"
        if not owned:
            found.append(Drift("tangential", label, piece.arm.perp.times(book.alpha(piece.link))))
        found.append(Drift("centripetal", label, -piece.arm.times(omega.squared)))
    for turn, _, second in _driven(chain, book):
        found.append(Drift("driven_turn", turn.pivot.label, turn.arm.perp.times(second)))
    for step, slide, sign, link in chain.slides():
        factor = TWO * book.omega(link) * slide.rate
        found.append(Drift("coriolis", step.joint, slide.along.perp.times(factor if sign > 0 else -factor)))
        if not step.free:
            second = slide.second if sign > 0 else -slide.second
            found.append(Drift("driven_slide", step.joint, slide.along.times(second)))
    return [each for each in found if not (each.vector.x.is_zero and each.vector.y.is_zero)]


def _driven(chain: Chain, book: SymbolTable) -> Iterator[tuple[Turn, Term, Term]]:
    """Driven pins inside parts whose rotation is unknown, with their rates as the chain counts them."""
    if not chain.free:
        return
    for turn in chain.driven:
        assert turn.step.driver is not None
        _, rate, second = book.drive(turn.step.driver)
        own = turn.step.child == book.mechanism.drivers[turn.step.driver].link
        yield turn, (rate if own else -rate), (second if own else -second)


class Closure(ABC):
    """Equations of a cut joint as a textbook differentiates them: linear in the rates of the group's unknowns."""

    cut: Connection

    @abstractmethod
    def column(self, step: TreeJoint) -> list[Term]:
        """What a unit rate of an unknown does to each equation."""

    @abstractmethod
    def known_rates(self, book: SymbolTable) -> list[Term]:
        """The equations differentiated, the unknown rates left out."""

    @abstractmethod
    def known_seconds(self, book: SymbolTable, bend: Callable[[ChainClosure], Pair]) -> list[Term]:
        """Differentiated twice, the unknown second derivatives left out; ``bend``: known part of the acceleration of
        one end of two chains against the other."""


@dataclass(frozen=True)
class ChainClosure(Closure):
    """A pin or a guide that was cut: two chains that meet, the sign of each, and the direction of its rows (both
    axes, or across the guide)."""

    cut: Connection
    chains: tuple[Chain, Chain]
    tip: PointState
    across: Slide | None

    def rows(self, vector: Pair) -> list[Term]:
        """A vector as the rows of this cut see it."""
        if self.across is None:
            return [vector.x, vector.y]
        return [self.across.along.cross(vector)]

    def joined(self, parts: Sequence[Pair]) -> Pair:
        """One vector of each chain, signs applied."""
        return parts[0] - parts[1] if self.across is None else parts[1] - parts[0]

    def moved(self, step: TreeJoint) -> Pair:
        """What a unit rate of an unknown does to one end against the other."""
        return self.joined([columns(chain).get(step, NOWHERE) for chain in self.chains])

    def drifted(self, book: SymbolTable) -> Pair:
        """Velocity of one end against the other, the unknown rates left out."""
        return self.joined([drift(chain, book) for chain in self.chains])

    def column(self, step: TreeJoint) -> list[Term]:
        return self.rows(self.moved(step))

    def known_rates(self, book: SymbolTable) -> list[Term]:
        return self.rows(self.drifted(book))

    def known_seconds(self, book: SymbolTable, bend: Callable[[ChainClosure], Pair]) -> list[Term]:
        rows = self.rows(bend(self))
        if self.across is None:
            return rows
        return [rows[0] - TWO * book.omega(self.cut.a) * self.across.rate]


def chain_closures(book: SymbolTable, group: Group) -> list[ChainClosure]:
    """The pins and guides at which a group was cut."""
    found = []
    for cut in group.cuts:
        if cut.higher:
            continue
        if cut.turns:
            tip, names = book.spot(cut.a, cut.joint), (cut.joint, cut.joint)
            across = None
        else:
            joint = book.mechanism.guides[cut.joint]
            tip, names = book.spot(cut.b, joint.at), (joint.through, joint.at)
            across = book.slide(cut.joint)
        chains = tuple(walk(book, group, end, tip, name) for end, name in zip((cut.a, cut.b), names, strict=True))
        found.append(ChainClosure(cut, chains, tip, across))  # type: ignore[arg-type]
    return found


def matrix(group: Group, cuts: Sequence[Closure]) -> list[list[Term]]:
    """Rows: equations of the cuts; columns: the unknowns."""
    rows: list[list[Term]] = []
    for closure in cuts:
        columns = [closure.column(step) for step in group.unknowns]
        rows += [[column[i] for column in columns] for i in range(len(columns[0]))]
    return rows


def unknown_names(book: SymbolTable, group: Group, order: int) -> list[Term]:
    """Symbols of the unknown rates (``order`` 1) or second derivatives (2)."""
    found = []
    for step in group.unknowns:
        if step.slides:
            slide = book.slide(step.joint)
            found.append(slide.rate if order == 1 else slide.second)
        else:
            found.append(book.omega(step.child) if order == 1 else book.alpha(step.child))
    return found


@dataclass
class Trail:
    """From a point to the end of a chain: ``reach`` with the free slides at zero, and their directions."""

    reach: Pair = NOWHERE
    slides: list[tuple[TreeJoint, Pair, Term]] = field(default_factory=list)


def turned(arm: Pair, angle: Term) -> Pair:
    """A vector of a link's axes, turned by an angle."""
    c, s = cosine(angle), sine(angle)
    return Pair(arm.x * c - arm.y * s, arm.x * s + arm.y * c)


def trail(book: SymbolTable, steps: Sequence[TreeJoint], link: str, point: str, end: str, *, local: bool) -> Trail:
    """From ``point`` of ``link`` along ``steps`` to the point ``end`` of the last link.

    ``local``: in the axes of ``link``; otherwise in frame axes, with the angles of all links known.
    """
    found = Trail()
    angle = ZERO if local else book.turn(link)
    for step in steps:
        held = attach(step, step.parent, book)
        found.reach = found.reach + turned(_arm(book, link, point, held), angle)
        if step.slides:
            _slide(book, step, angle, found, local=local)
        angle = _next(book, step, angle) if local else book.turn(step.child)
        link, point = step.child, attach(step, step.child, book)
    found.reach = found.reach + turned(_arm(book, link, point, end), angle)
    return found


def _arm(book: SymbolTable, link: str, start: str, end: str) -> Pair:
    if link == "frame":
        return book.spot(link, end).place - book.spot(link, start).place if start != end else NOWHERE
    return book.arm(link, start, end)


def _slide(book: SymbolTable, step: TreeJoint, angle: Term, found: Trail, *, local: bool) -> None:
    joint = book.mechanism.guides[step.joint]
    sign = 1 if step.child == joint.block else -1
    slide = book.slide(step.joint)
    along, turn = slide.along, ZERO
    if local:
        own = book.guide_angle(step) if sign > 0 else book.degrees(joint.block_angle)
        turn = merged(angle, own)
        along = Pair(cosine(turn), sine(turn))
    if step.free:
        heading = merged(turn, number(180.0, degrees=True)) if sign < 0 else turn
        found.slides.append((step, along if sign > 0 else -along, heading))
    else:
        shift = along.times(slide.s)
        found.reach = found.reach + (shift if sign > 0 else -shift)
    if joint.offset:
        name = f"h_{step.joint}"
        across = along.perp.times(symbol(name, joint.offset))
        found.reach = found.reach + across if sign > 0 else found.reach - across


def merged(a: Term, b: Term) -> Term:
    """Sum of two angles; of plain numbers as one number."""
    if a.op == b.op == "number":
        value = a.amount + b.amount
        return ZERO if value == 0.0 else number(value, degrees=True)
    return a + b


def _next(book: SymbolTable, step: TreeJoint, angle: Term) -> Term:
    if step.driver is not None and step.turns:
        q = book.drive(step.driver)[0]
        return angle + q if step.child == book.mechanism.drivers[step.driver].link else angle - q
    return merged(angle, book.turned(step))
