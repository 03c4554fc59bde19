"""Wheels fit a sweep where they fit a model."""

from __future__ import annotations

import pytest
from tests.contract.joints_of_every_kind import MODEL, WRITTEN
from tests.unit.joints.plain_dimensions import Numbers

import linkwright as lw
from linkwright.formula.trace import Trace

FITTED = [kind for kind in WRITTEN if kind.startswith(("gear", "rolling", "belt", "chain", "rack"))]


@pytest.mark.parametrize("kind", FITTED)
def test_what_fits_a_sweep_fits_a_model(kind: str) -> None:
    """One dimension changed by more and more: the traced judgement is that of the sentence, and both fall."""
    mechanism = lw.loads(MODEL.replace("JOINTS", WRITTEN[kind]))
    pair = mechanism.joints["pair"]
    assert pair.misfit(mechanism) is None and bool(pair.fits(Numbers(mechanism, Trace()))) is True
    addresses = [a for a in mechanism.dimensions() if a.split(".")[0] in ("pair", "slide", "base", "one", "two")]
    judged = set()
    for address in addresses:
        if address.endswith((".friction", ".mass", ".inertia")):
            continue
        for change in (1e-9, 3e-7, -2e-6, 1e-3, -7e-3, 0.7):
            value = mechanism.dimension(address) + change
            if value <= 0 < mechanism.dimension(address):
                continue
            changed = mechanism.with_dimensions({address: value})
            joint = changed.joints["pair"]
            traced = bool(joint.fits(Numbers(changed, Trace())))
            assert traced == (joint.misfit(changed) is None), (address, change)
            judged.add(traced)
    free = ("gear", "gear, internal", "gear, by ratio", "rolling")
    assert judged == ({True} if kind in free else {True, False})
