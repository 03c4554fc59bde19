"""Contexts of texts that are still found by their keys."""

CONTEXTS = {
    "study.number": "study",
    "nouns.angle": "nouns",
    "nouns.pair_cam": "nouns",
}
