"""STL: triangles of bodies in binary, in mm."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.fabrication.body import Body
from linkwright.fabrication.mesh import mesh_of

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def stl_content(bodies: Iterable[Body]) -> bytes:
    """A binary STL file of bodies at their places, z up from the frame, mm."""
    corners = np.concatenate([placed for body in bodies for placed in _placed(body)])
    rows = np.zeros(len(corners), dtype=_TRIANGLE)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    rows["normal"] = np.divide(normal, size, out=np.zeros_like(normal), where=size > 0)
    rows["corners"] = 1e3 * corners
    return b"Linkwright, mm".ljust(80) + np.uint32(len(rows)).tobytes() + rows.tobytes()


def _placed(body: Body) -> Iterator[Floats]:
    """The corners (k, 3, 3) of all triangles of a body at every place, in the axes of the machine, m."""
    mesh = mesh_of(body)
    for pose in body.poses:
        plane = pose.of(np.asarray(mesh.corners[:, 0] + 1j * mesh.corners[:, 1]))
        yield np.column_stack([plane.real, plane.imag, pose.z + mesh.corners[:, 2]])[mesh.triangles]
