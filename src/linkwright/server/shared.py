"""Models that come in links: what stands behind ``#model=`` is the text, deflated, in base 64 for addresses."""

from __future__ import annotations

import base64
import re
import zlib

from linkwright.errors import LinkwrightError
from linkwright.server.files import LARGEST
from linkwright.words import _

_MODEL = re.compile(r"(?:^|[#&\s])model=([\w-]+)", re.ASCII)


def holds_model(link: str) -> bool:
    """Whether a text is a link with a model in it."""
    return _MODEL.search(link) is not None


def model_of(link: str) -> str:
    """The text of the model in a link; raises LinkwrightError where there is none that can be read."""
    found = _MODEL.search(link)
    packed = found[1] if found else ""
    try:
        content = base64.urlsafe_b64decode(packed + "=" * (-len(packed) % 4))
        unpacking = zlib.decompressobj(-zlib.MAX_WBITS)
        text = unpacking.decompress(content, LARGEST + 1)
        if text.strip() and unpacking.eof and len(text) <= LARGEST:
            return text.decode()
    except (ValueError, zlib.error):
        pass
    raise LinkwrightError(_("this link holds no model; copy it again, whole", code="studio.no_model"))
