"""Free-body diagrams of the links."""

WORDS = {
    "text": "{figure} shows every link by itself, as it stands at {place}, with all that acts on it; the links come "
    "in the order of the force analysis. A joint force F with the index 12 is what link 1 exerts on link 2.",
    "text_rest": "{figure} shows every link by itself with all that acts on it; the links come in the order of the "
    "force analysis. A joint force F with the index 12 is what link 1 exerts on link 2.",
    "caption": "Free-body diagrams of the links",
    "page": "{caption} ({number} of {count})",
    "title": "{number} {link}",
    "direction": "angle",
    "sum": "sum",
    "moment_sum": "sum of moments about the mass centre: {value}",
    "reaction": "F, M: joint force, couple of a joint",
    "weight": "G: weight",
    "inertia": "F_I = −m·a, M_I = −J·α: inertia",
    "friction": "index f: friction",
    "driver": "index d: driver",
    "load": "loads by their names",
    "apart": "; ",
    "shortened": "dashed arrows are shorter than {least} mm to scale and drawn {drawn} mm long",
    "idle": "Not acting at this position: {names}.",
    "none": "no forces act on the moving links at this position",
}
