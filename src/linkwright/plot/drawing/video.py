"""Frames as GIF (Pillow) and MP4 (PyAV)."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

from linkwright.errors import LinkwrightError
from linkwright.pictures.drawing import COLOURS
from linkwright.words import _


def gif(frames: Iterator[bytes], seconds_per_frame: float) -> bytes:
    """An endless GIF of PNG frames, all in the colours of the drawings and their way to white."""
    try:
        from PIL import Image
    except ImportError:
        raise LinkwrightError(
            _(
                'GIF animations need Pillow; install it with: pip install "linkwright[plot]"',
                code="picture.gif_needs",
            )
        ) from None
    pictures = [Image.open(io.BytesIO(each)).convert("RGB") for each in frames]
    palette = Image.new("P", (1, 1))
    palette.putpalette(_palette())
    small = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in pictures]
    stream = io.BytesIO()
    duration = max(20, round(1000 * seconds_per_frame))
    small[0].save(
        stream, "GIF", save_all=True, append_images=small[1:], duration=duration, loop=0, optimize=False
    )
    return stream.getvalue()


def _palette() -> bytes:
    """256 colours: each colour of the drawings in even steps to white, as at the edges of strokes."""
    steps = 256 // len(COLOURS)
    found = bytearray()
    for colour in COLOURS:
        start = bytes.fromhex(colour.removeprefix("#"))
        for step in range(steps):
            found += bytes(round(c + (255 - c) * step / (steps - 1)) for c in start)
    return bytes(found).ljust(768, b"\xff")


def mp4(frames: Iterator[bytes], rate: int) -> bytes:
    """An MP4 (H.264) of PNG frames."""
    try:
        import av
        import numpy as np
        from PIL import Image
    except ImportError:
        raise LinkwrightError(
            _(
                'MP4 animations need PyAV and Pillow; install them with: pip install "linkwright[video]"',
                code="picture.mp4_needs",
            )
        ) from None
    stream = io.BytesIO()
    with av.open(stream, "w", format="mp4") as container:
        track: Any = None
        for each in frames:
            picture = Image.open(io.BytesIO(each)).convert("RGB")
            even = picture.crop(
                (0, 0, picture.width - picture.width % 2, picture.height - picture.height % 2)
            )
            if track is None:
                track = container.add_stream("libx264", rate=rate)
                track.width, track.height, track.pix_fmt = even.width, even.height, "yuv420p"
                track.options = {"crf": "20"}
            frame = av.VideoFrame.from_ndarray(np.asarray(even), format="rgb24")
            container.mux(track.encode(frame))
        container.mux(track.encode())
    return stream.getvalue()
