"""Contexts of texts that are still found by their keys."""

CONTEXTS = {
    "nouns.angle": "nouns",
    "nouns.pair_cam": "nouns",
}
