"""Random sequences of every action of drawing: the text is always read, and lengths agree with the picture."""

from __future__ import annotations

import math
import random
from typing import Any

import pytest
from tests.unit.server.drawing import NEW, PIVOTS, bar, done

import linkwright as lw
from linkwright.core.expressions import amount
from linkwright.files.model_file import read_text
from linkwright.server.outline import outline

STEPS = 25
#: Findings about names that are gone, which no action may leave behind.
BROKEN = {"unknown-name", "duplicate", "yaml", "type", "wrong-dimension", "conflict"}


@pytest.mark.parametrize("seed", range(16))
def test_whatever_is_drawn_lengths_agree_with_the_picture(seed: int) -> None:
    """A link whose length no places meet is told by the picture; nothing mentions what is gone."""
    rng = random.Random(seed)
    text = done(NEW, *PIVOTS).text
    for _unused in range(STEPS):
        try:
            now = done(text, drawing_action(rng, text))
        except lw.LinkwrightError:
            continue
        text, places = now.text, now.picture["points"]
        entries = outline(text)["entries"]
        assert entries
        for name, entry in entries.get("links", {}).items():
            ends = entry["points"][:2] if "length" in entry else []
            if ends and name not in now.picture["unmet"] and set(ends) <= {*places}:
                apart = math.dist(*(places[each] for each in ends))
                assert apart == pytest.approx(amount(entry["length"], "length"), abs=1.6e-4, rel=1e-3), text
        left = {each.code for each in read_text(text, "m")[1] if each.severity == "error"}
        assert not left & BROKEN, text


def drawing_action(rng: random.Random, text: str) -> dict[str, Any]:
    """One of all actions, about what there is, a new point or a link at a place at random."""
    shown, entries = done(text).picture, outline(text)["entries"]
    points, links = [*shown["points"], "O9"], [*shown["links"], "none"]
    pairs, loads = [*entries.get("joints", {}), "none"], [*entries.get("loads", {}), "none"]
    place, new = [rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)], f"N{rng.randrange(10**6)}"
    a, b, link = rng.choice(points), rng.choice(points), rng.choice(links)
    on = rng.choice(shown["links"].get(link) or ["none"])
    section = {"shape": "round", "size": ["9 mm"], "density": "7850 kg/m³"}
    spring = {"kind": "spring", "between": [f"frame.{rng.choice(points)}", f"{link}.{on}"], "stiffness": "1 N/mm"}
    removed = [
        {"kind": "point", "name": a},
        {"kind": "link", "name": link},
        {"kind": "pair", "name": rng.choice(pairs)},
    ]
    actions: list[dict[str, Any]] = [
        {"do": "point", "at": place, "fixed": True},
        bar([a, new], places={new: place}),
        bar([a, new], "77", places={new: place}),
        bar([a, b], rng.choice([None, "123.4"])),
        bar([a, b, new], places={new: place}),
        {"do": "add_point", "link": link, "at": place},
        {"do": "add_point", "link": link, "point": a},
        {"do": "split", "link": link, "at": place},
        {"do": "move", "points": {a: place}, "locked": [f"{link}.length"]},
        {"do": "fix", "point": a, "fixed": rng.random() < 0.5},
        {"do": "merge", "from": a, "into": b},
        {"do": "weld", "point": a, "on": rng.random() < 0.6},
        {"do": "guide", "at": a, "angle": rng.choice([0, 90, 33.3])},
        {"do": "slot", "along": link, "at": a},
        {"do": "driver", "link": link},
        {"do": "gear", "links": [link, rng.choice(links)], "teeth": "20:40"},
        {"do": "mass", "link": link, "section": section},
        {"do": "load", "link": link, "at": on, "force": "10 N", "angle": -60},
        *([{"do": "add", "section": "loads", "stem": "spring", "entry": spring}] if len(links) > 1 else []),
        {"do": "set", "path": ["links", link, "length"], "value": "88 mm"},
        {"do": "rename", "what": "link", "from": link, "to": new},
        {"do": "rename", "what": "point", "from": a, "to": new},
        {"do": "paste", "items": removed[:2], "shift": place, "mirror": rng.choice(["", "x", "y"])},
        {"do": "remove", "items": removed[: rng.randint(1, 3)]},
        {"do": "remove", "items": [{"kind": "load", "name": rng.choice(loads)}]},
    ]
    return rng.choice(actions)
