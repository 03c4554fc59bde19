"""USD scenes (UsdPhysics): rigid bodies, joints, those of loops left out of the articulation, drives."""

from __future__ import annotations

from linkwright.errors import LinkwrightError
from linkwright.exporters.export import FORMATS, Format, package
from linkwright.exporters.mjcf.bodies import Chains
from linkwright.exporters.results import Results
from linkwright.exporters.usd.scene import Scene
from linkwright.words import _

#: What a scene needs of the package.
MODULES = ("Gf", "Tf", "Usd", "UsdGeom", "UsdPhysics")


def usd_content(results: Results) -> bytes:
    """A scene at the first position that was reached, y up, in m and kg.

    Links are rigid bodies with their points as prims, the frame is fixed to the world. Joints of the tree form an
    articulation; those that close loops are left out of it. Drivers are drives: of constant speed, or with samples of
    their laws over the time. Angles of joints are 0 at the start. Wheels, racks and cams are refused.
    """
    chains = Chains(results.motion, results.first_ok())
    pairs = tuple(cut.joint for cut in chains.cuts if cut.higher)
    if pairs:
        message = _(
            "USD physics has no joints for wheels, racks and cams: {joints}; export to MuJoCo or URDF",
            code="export.usd_pairs",
            joints=pairs,
        )
        raise LinkwrightError(message)
    pxr = {name: package(f"pxr.{name}", _("USD scenes"), "usd-core") for name in MODULES}
    return Scene(pxr, results, chains).text().encode()


FORMATS.register("usd")(Format((".usda", ".usd"), usd_content))
