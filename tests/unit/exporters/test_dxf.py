"""Layers of DXF drawings are seen on any sheet."""

import pytest
from tests.every import every

from linkwright.exporters.dxf import LAYERS


def luminance(colour: tuple[int, int, int]) -> float:
    """Relative luminance as WCAG 2.2 defines it."""
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in (c / 255 for c in colour)]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("sheet", [(0, 0, 0), (33, 40, 48), (255, 255, 255)])
def test_every_layer_is_seen_on_dark_and_on_white_sheets(sheet: tuple[int, int, int]) -> None:
    colours = pytest.importorskip("ezdxf.colors")
    ground = luminance(sheet)
    for name, index in every(LAYERS.items(), least=6):
        if index == 7:
            continue  # white on dark, black on white, by definition of the format
        ink = luminance(tuple(colours.aci2rgb(index)))
        contrast = (max(ink, ground) + 0.05) / (min(ink, ground) + 0.05)
        assert contrast >= 3.0, name
    assert len(set(LAYERS.values())) == len(LAYERS)
