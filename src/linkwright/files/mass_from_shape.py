"""What the shapes of links have to do with the rest of a model file."""

from __future__ import annotations

from linkwright.fields.nodes import Node, Scalar, Sequence, below
from linkwright.fields.shape_of_link import LinkShape
from linkwright.files.reader import Reader


def shape_points_known(reader: Reader, node: Node, link: str, shape: LinkShape | None) -> bool:
    """Whether a link has the points through which its shape goes; a finding where it does not."""
    through = below(node, "shape", "through")
    key = f"{'frame' if link == 'frame' else f'links.{link}'}.shape.through"
    return all(
        reader.point_of(each, key, each.text, link)
        for each in (through.items if isinstance(through, Sequence) and shape is not None else ())
        if isinstance(each, Scalar)
    )
