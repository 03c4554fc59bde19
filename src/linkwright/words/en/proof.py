"""Proofs that a motion keeps its assembly."""

WORDS = {
    "all": "the assembly is proved to be kept in all {total} steps (smallest margin {margin})",
    "some": "the assembly is proved to be kept in {count} of {total} steps; the first one without proof is "
    "step {first}",
    "kind": "nothing can be proved of a motion with the joint {joint!r}: proofs know pins, guides, welds, and "
    "pairs of wheels, racks, belts and chains",
}
