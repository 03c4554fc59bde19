"""Small problems of layers by chance: plates, pins with heads, and what must not be in one layer."""

from random import Random

from linkwright.layering.problem import Apart, Demand, Fixed, Level, Problem


def random_problem(chance: Random) -> Problem:
    """Two or three plates above a base, at times below a cover, with one to three pins through some of them."""
    plates = [f"plate {i}" for i in range(chance.choice([2, 3, 3]))]
    cover = "cover" if chance.random() < 0.3 else ""
    bodies = {name: (name,) for name in (*plates, "base", *filter(None, [cover]))}
    pins = [f"pin {i}" for i in range(chance.choice([1, 2, 3]))]
    for pin in pins:
        through = chance.sample([*plates, "base"], chance.choice([1, 2, 2, 3]))
        bodies[pin] = (*through, *([cover] if cover and "base" in through else []))
    demands: list[Demand] = []
    density = chance.choice([0.15, 0.3, 0.5])
    names = [*bodies]
    for i, one in enumerate(names):
        for other in names[i + 1 :]:
            if one in bodies[other] or other in bodies[one]:
                continue
            ends = [("body", "heads"), ("heads", "heads")] if other in pins else []
            ends = [each for each in ends if each[0] == "body" or one in pins]
            if chance.random() < density:
                demands.append(Apart(one, other))
            demands += [Apart(one, other, each) for each in ends if chance.random() < density]
    if chance.random() < 0.3:
        demands.append(Level(*chance.sample(plates, 2)))
    if chance.random() < 0.3:
        demands.append(Fixed(chance.choice(plates), chance.choice([1, 2, 3, None])))
    if chance.random() < 0.1:
        demands.append(Fixed("base", None))
    return Problem(bodies, tuple(demands), "base", cover)
