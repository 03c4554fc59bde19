"""A loop of guides prevents a rotation twice: the forces still balance, and what statics cannot tell is said."""

import numpy as np

import linkwright as lw


def test_the_indeterminate_couple_is_named() -> None:
    forces = lw.solve_forces(lw.load("gallery:wedge"))
    assert len(forces.notes) == 1
    assert "couple of guide 'column' is statically indeterminate" in forces.notes[0]
    assert np.abs(forces.couple("column")).max() == 0.0
    assert forces.balance_residual.max() < 1e-12 * np.abs(forces.reaction("column")).max()


def test_a_determinate_mechanism_has_no_such_note() -> None:
    assert lw.solve_forces(lw.load("gallery:scotch_yoke")).notes == ()
