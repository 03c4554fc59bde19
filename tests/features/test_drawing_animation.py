"""Animations: frames, keyframes of the SVG, files."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.errors import RequestError
from linkwright.plotting.animation import animate

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def crusher() -> lw.Motion:
    return store.motion("jaw_crusher_sixbar", 72)


def test_closed_cycle_goes_round(crusher: lw.Motion) -> None:
    assert [*animate(crusher, frames=24).run] == [*range(0, 72, 3), 0]


def test_open_cycle_goes_to_and_fro() -> None:
    run = [*animate(store.motion("peaucellier", 40), frames=20).run]
    assert run == run[::-1] and run[0] == 0 and max(run) == 40


STUCK = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.9 m}
  coupler: {points: [A, B], length: 1.2 m}
  rocker: {points: [O2, B], length: 1.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s, start: 170 deg}
"""


def test_positions_that_were_not_reached_are_left_out() -> None:
    motion = lw.solve_motion(lw.loads(STUCK), steps=36, failures="mark")
    assert 10 < motion.ok.sum() < 36
    assert set(animate(motion, frames=60).run) == set(np.flatnonzero(motion.ok))


def test_keyframes_follow_the_links(crusher: lw.Motion) -> None:
    root = ET.fromstring(animate(crusher, frames=24, labels=False).svg)
    turns = [
        [float(x) for x in e.get("values", "").split(";")]
        for e in root.iter(f"{SVG}animateTransform")
        if e.get("type") == "rotate"
    ]
    assert {len(each) for each in turns} == {25}
    crank = next(each for each in turns if abs(each[-1] - each[0]) > 300)
    assert crank[-1] - crank[0] == pytest.approx(360.0, abs=0.02)  # the crank turns clockwise
    jaw = np.degrees(crusher.link("jaw").angle)[[*range(0, 72, 3), 0]]
    assert any(np.allclose(np.diff(each), -np.diff(jaw), atol=0.02) for each in turns)
    assert {e.get("repeatCount") for e in root.iter(f"{SVG}animateTransform")} == {"indefinite"}


def test_loads_and_joint_forces_keep_their_colours_in_a_gif(crusher: lw.Motion, tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    image = pytest.importorskip("PIL.Image")
    animation = animate(crusher, forces=lw.solve_forces(crusher), frames=4, seconds=1)
    with image.open(animation.save(tmp_path / "a.gif", width=500)) as picture:
        seen = {colour for _, colour in picture.convert("RGB").getcolors(1 << 20)}
    for colour in ((0xC6, 0x28, 0x28), (0x7B, 0x1F, 0xA2)):  # red of reactions, purple of loads
        assert any(max(abs(a - b) for a, b in zip(colour, each, strict=True)) < 12 for each in seen)


def test_traces_vectors_and_cursor(crusher: lw.Motion) -> None:
    forces = lw.solve_forces(crusher)
    animation = animate(crusher, paths=("B",), forces=forces, curves=("jaw.angle",), frames=12, seconds=3)
    root = ET.fromstring(animation.svg)
    durations = {e.get("dur") for e in root.iter() if e.get("dur")}
    assert durations == {"3s"}
    assert any(e.get("class") == "lw-dot" for e in root.iter())
    assert any(e.get("attributeName") == "points" for e in root.iter(f"{SVG}animate"))
    texts = ["".join(e.itertext()) for e in root.iter(f"{SVG}text")]
    assert [text for text in texts if text.endswith("jaw (°): −95.79 … −93.53")]
    assert ET.fromstring(animation.frame(30)).get("viewBox") == root.get("viewBox")


@pytest.mark.parametrize(
    ("options", "code", "values"),
    [
        ({"frames": 1}, "picture.bad_frames", {"frames": 1}),
        ({"seconds": 0.0}, "picture.bad_seconds", {"seconds": 0.0}),
        ({"paths": ("Q",)}, "names.no_such", {"name": "Q"}),
        ({"curves": ("jaw.angel",)}, "study.no_such_output", {"name": "jaw.angel", "offer": "jaw.angle"}),
    ],
)
def test_what_is_refused(
    crusher: lw.Motion, options: dict[str, object], code: str, values: dict[str, object]
) -> None:
    with refused(code, RequestError, **values):
        animate(crusher, **options)  # type: ignore[arg-type]


def test_a_text_alone_is_one_name(crusher: lw.Motion) -> None:
    assert animate(crusher, paths="jaw.D").paths == ("jaw.D",)
    assert lw.draw(crusher, paths="jaw.D", velocities="jaw.D").svg == (
        lw.draw(crusher, paths=["jaw.D"], velocities=["jaw.D"]).svg
    )


def test_files(crusher: lw.Motion, tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    image = pytest.importorskip("PIL.Image")
    animation = animate(crusher, frames=6, seconds=0.4)
    seen: list[tuple[int, int]] = []
    animation.save(tmp_path / "a.gif", width=160, progress=lambda done, count: seen.append((done, count)))
    assert seen == [(k, 6) for k in range(1, 7)]
    with image.open(tmp_path / "a.gif") as picture:
        assert picture.n_frames == 6 and picture.width == 160
    av = pytest.importorskip("av")
    animation.save(tmp_path / "a.mp4", width=161)
    with av.open(str(tmp_path / "a.mp4")) as film:
        assert film.streams.video[0].width == 160
        assert sum(1 for _ in film.decode(video=0)) == 10
    assert {file.name for file in tmp_path.iterdir()} == {"a.gif", "a.mp4"}
    with refused("picture.no_film_suffix", RequestError, suffix=".avi"):
        animation.save(tmp_path / "a.avi")


def test_names_of_arrows_stay_in_the_picture_over_the_whole_motion() -> None:
    """The tip of the bucket moves along the edge of the picture, with the name of its velocity."""
    animation = animate(store.motion("excavator", 40), velocities=True, frames=20)
    names: set[str] = set()
    for index in every(animation.run):
        root = ET.fromstring(animation.frame(index))
        left, top, width, height = map(float, root.get("viewBox", "").split())
        for group in root.iter(f"{SVG}g"):
            shift = re.fullmatch(r"translate\((\S+) (\S+)\)", group.get("transform", ""))
            for text in group.findall(f"{SVG}text") if shift else ():
                assert shift is not None
                x, y = (float(text.get(k, "nan")) + float(s) for k, s in zip("xy", shift.groups(), strict=True))
                assert left <= x <= left + width
                assert top <= y <= top + height
                names.add("".join(text.itertext()))
    assert "vT" in names
