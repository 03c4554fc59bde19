"""How a machine is put together once it is driven otherwise: the drawing replaces words of groups that are gone."""

from __future__ import annotations

from linkwright.errors import LinkwrightError
from linkwright.files.model_file import read_text
from linkwright.server.draft import Draft

_SECTION = "assembly"


def reassemble(draft: Draft) -> None:
    """Takes out the words of assembly that no group knows any more; the drawing then says what they have said."""
    gone = [joint for joint in _unknown(draft) if joint in dict(draft.section(_SECTION) or ())]
    if not gone:
        return
    drawn = draft.picture()["points"]
    for point in {point for points in draft.shown()["links"].values() for point in points} - set(drawn):
        if point in draft.places:
            draft.draw(point, complex(*draft.places[point]))
    for joint in gone:
        draft.take_out(_SECTION, joint)


def _unknown(draft: Draft) -> list[str]:
    """Joints that the file has a word for, and the machine as it is driven has none."""
    from linkwright.kinematics.assembly import AssemblyError, assemble
    from linkwright.topology import structure

    mechanism, _unused = read_text(draft.text, draft.name)
    if mechanism is None or not mechanism.assembly:
        return []
    try:
        assemble(mechanism, structure(mechanism))
    except AssemblyError as error:
        return [key.partition(".")[2] for key, _unused in error.parts if key.startswith(f"{_SECTION}.")]
    except LinkwrightError:
        pass
    return []
