"""MuJoCo models: links as bodies in the chains of the Assur groups, what closes the loops, servos, a key frame."""

from __future__ import annotations

from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.mjcf.closure import loops_of
from linkwright.exporters.mjcf.document import mjcf_content

FORMATS.register("mjcf")(Format((".xml", ".mjcf"), mjcf_content, report=loops_of))
