// Numbers that agree to a tolerance.
import assert from "node:assert/strict";

/** Absolutely, or to a share of what is wanted where that is larger than 1. */
export function near(found: number, wanted: number, tolerance = 1e-12): void {
  assert.ok(Math.abs(found - wanted) <= tolerance * Math.max(1, Math.abs(wanted)), `${found}, not ${wanted} within ${tolerance}`);
}

export function allNear(found: ArrayLike<number>, wanted: ArrayLike<number>, tolerance = 1e-12): void {
  assert.equal(found.length, wanted.length);
  Array.from(wanted).forEach((each, k) => near(found[k], each, tolerance));
}
