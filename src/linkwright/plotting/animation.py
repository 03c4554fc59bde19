"""Moving drawings: SVG that moves by itself, GIF and MP4."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.core.arguments import integer, one_or_more, real, require
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.core.progress import Progress, current_progress
from linkwright.dynamics.result import Run
from linkwright.errors import LinkwrightError, RequestError, require_language
from linkwright.filesystem import atomic_write, refuse_target
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import of_forces, point_key, result_meant
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.table import results_of
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.drawing import COLOURS, Box, bounds, document
from linkwright.pictures.labels import Label, Obstacles, place_moving, written
from linkwright.pictures.picture import Circle, SvgNode
from linkwright.pictures.svg import group, png
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.plotting.drawing.draw import Legend, Names, all_arrows, followed, solved
from linkwright.plotting.drawing.loads import load_marks, moving_springs
from linkwright.plotting.drawing.moving import (
    Panel,
    moving_links,
    moving_torques,
    moving_vectors,
    panel,
    shift_text,
    shifted,
)
from linkwright.plotting.drawing.scene import Scene, frame_indices, key_indices, laid_out, point_labels, usual_seconds
from linkwright.plotting.drawing.vectors import Arrows, scale_of
from linkwright.words import _
from linkwright.words.message import in_language

if TYPE_CHECKING:
    from linkwright.kinetostatics.forces import Forces


def gif(frames: Iterator[bytes], seconds_per_frame: float) -> bytes:
    """An endless GIF of PNG frames, all in the colours of the drawings and their way to white."""
    try:
        from PIL import Image
    except ImportError:
        raise LinkwrightError(
            _('GIF animations need Pillow; install it with: pip install "linkwright[plot]"', code="picture.gif_needs")
        ) from None
    pictures = [Image.open(io.BytesIO(each)).convert("RGB") for each in frames]
    palette = Image.new("P", (1, 1))
    palette.putpalette(_palette())
    small = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in pictures]
    stream = io.BytesIO()
    duration = max(20, round(1000 * seconds_per_frame))
    small[0].save(stream, "GIF", save_all=True, append_images=small[1:], duration=duration, loop=0, optimize=False)
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
            even = picture.crop((0, 0, picture.width - picture.width % 2, picture.height - picture.height % 2))
            if track is None:
                track = container.add_stream("libx264", rate=rate)
                track.width, track.height, track.pix_fmt = even.width, even.height, "yuv420p"
                track.options = {"crf": "20"}
            frame = av.VideoFrame.from_ndarray(np.asarray(even), format="rgb24")
            container.mux(track.encode(frame))
        container.mux(track.encode())
    return stream.getvalue()


#: Positions of a cycle on the screen, and of all that is shown at most.
FRAMES, MOST_FRAMES = 60, 2000
FILM_RATE = 25
LABEL_FRAMES = 12
#: Smallest and largest width of GIF and MP4, pixels.
WIDTHS = (16, 3840)


def animate(
    source: Motion | Mechanism | Run,
    *,
    paths: Sequence[str] = (),
    velocities: Names = (),
    accelerations: Names = (),
    forces: Forces | bool | None = None,
    reactions_of: Sequence[str] | None = None,
    curves: Sequence[str] = (),
    seconds: float | None = None,
    frames: int | None = None,
    centres: bool = False,
    outlines: bool = False,
    labels: bool = True,
    size: float | None = None,
    language: str = "en",
) -> Animation:
    """A moving drawing of a cycle; an open cycle runs to and fro.

    Args:
        source: a motion, a mechanism whose cycle is solved first, or a run, which is shown in true time.
        paths: points whose paths are shown, with a dot that runs along; default the one that follows a path.
        velocities, accelerations, forces, reactions_of, centres, outlines, size, language: as for ``draw``.
        curves: results drawn below with a cursor that runs with the drawing (``"jaw.angle"``, ``"driver.effort"``, a
            column of ``motion.columns()`` or of the forces').
        seconds: time of one cycle on the screen; default that of the motion, within 2 to 6 s.
        frames: number of positions shown in one cycle (default: 60, of a run 25 in a second); the moving SVG takes
            more where pins would part visibly between them.
        labels: names of the points, moving with them.

    Returns:
        The animation, with ``.svg`` and ``.save``.

    Raises:
        LinkwrightError: an unknown name, no position reached, a time or number of frames that makes no sense.
    """
    require(source, Motion, Mechanism, Run)
    require_language(language)
    if frames is None:
        frames = min(max(2, round(FILM_RATE * source.end)), MOST_FRAMES) if isinstance(source, Run) else FRAMES
    if not 2 <= integer("frames", frames) <= MOST_FRAMES:
        raise RequestError(
            _(
                "an animation of {frames} frames cannot be made; give 2 to 2000",
                code="picture.bad_frames",
                frames=frames,
            )
        )
    if seconds is not None and not 0.05 <= real("seconds", seconds) <= 3600:
        raise RequestError(
            _(
                "a cycle of {seconds} s cannot be shown; give 0.05 to 3600 s",
                code="picture.bad_seconds",
                seconds=seconds,
            )
        )
    if isinstance(source, Run):
        source = source.motion(frames)
    machine = source.mechanism if isinstance(source, Motion) else source
    paths, curves = one_or_more(paths) or followed(machine), one_or_more(curves)
    for name in paths:
        point_key(machine, name)
    motion = source if isinstance(source, Motion) else solve_motion(source, failures="mark")
    run = frame_indices(motion, frames)
    scene = laid_out(motion, run[0], centres=centres, outlines=outlines)
    known = solved(motion, forces)
    arrows = all_arrows(motion, velocities, accelerations, known, reactions_of)
    shown, used = curves_named(scene.machine.motion, known, curves)
    return Animation(
        scene=scene,
        run=tuple(run),
        keys=tuple(key_indices(scene.machine, frames)),
        seconds=seconds or usual_seconds(motion),
        paths=paths,
        arrows=tuple((each, scale_of(each.vectors, run)) for each in arrows),
        results=shown,
        forces=used,
        labelled=labels,
        size=size,
        language=language,
    )


def curves_named(
    motion: Motion, forces: Forces | None, names: Sequence[str]
) -> tuple[dict[Output, Floats], Forces | None]:
    """Results (n,) of a motion, and of its forces where one of them is among these, by their names; these forces.

    Raises LinkwrightError for an unknown name, and where forces are asked for that cannot be found.
    """
    if forces is None and of_forces(motion.mechanism, names):
        forces = solved(motion, True)
    results = results_of(motion, forces) if names else {}
    source = PlotInput(motion if forces is None else forces)
    asked = dict.fromkeys(result_meant(motion.mechanism, name, results) for name in names)
    courses = {output: source.course_of(output) for output in asked}
    return {output: read(known) for output, (known, read, _) in courses.items()}, forces


@dataclass(frozen=True)
class Moving:
    """A name that goes with the places ``track`` (n, 2) on the paper; ``elements`` stand at the first frame, in a
    ``box``."""

    track: Floats
    elements: tuple[SvgNode, ...]
    box: Box


@dataclass(frozen=True)
class Animation:
    """A moving drawing; ``svg`` moves by itself, ``save`` writes .svg, .gif or .mp4.

    ``run``: positions of the frames; ``keys``: those of the keyframes of the moving SVG.
    """

    scene: Scene
    run: tuple[int, ...]
    keys: tuple[int, ...]
    seconds: float
    paths: tuple[str, ...]
    arrows: tuple[tuple[Arrows, float], ...]
    results: Mapping[Output, Floats]
    forces: Forces | None
    labelled: bool
    size: float | None
    language: str

    @cached_property
    def svg(self) -> str:
        """SVG text that moves by itself in browsers, notebooks and readme files."""
        scene, run, seconds = self.scene, self.keys, self.seconds
        content = scene.traces(self.paths)
        content += moving_springs(scene, run, seconds)
        content += moving_links(scene, run, seconds)
        for name in self.paths:
            content.append(shifted(self._track(name), seconds, [Circle((0, 0), 3.2, "lw-dot")]))
        for arrows, scale in self.arrows:
            for vectors in arrows.vectors:
                content += moving_vectors(scene, vectors, scale, run, seconds)
            for torques in arrows.torques:
                content += moving_torques(scene, torques, run, seconds)
        for label in self._labels:
            track = label.track[list(run)]
            content.append(shifted(track - label.track[self.run[0]], seconds, label.elements))
        content += self._still
        if self._panel is not None:
            x = [(self._panel.cursor_x(self._share(index)), 0.0) for index in run]
            content.append(shifted(np.array(x), seconds, [self._panel.cursor()]))
        return document(content, self._box, self._title, self.size)

    def frame(self, index: int) -> str:
        """SVG text of the still picture at one position of the motion."""
        scene = self.scene
        content = scene.traces(self.paths)
        content += load_marks(scene.machine, index, forces=False).elements
        content += scene.at(index)
        for name in self.paths:
            x, y = scene.trace(name)[index]
            content.append(Circle((float(x), float(y)), 3.2, "lw-dot"))
        for arrows, scale in self.arrows:
            content += arrows.shape(index, scene.machine.view, scale).elements
        for label in self._labels:
            shift = label.track[index] - label.track[self.run[0]]
            content.append(group(label.elements, transform=shift_text(shift)))
        content += self._still
        if self._panel is not None:
            content.append(self._panel.cursor(self._panel.cursor_x(self._share(index))))
        return document(content, self._box, self._title, self.size)

    def save(
        self,
        path: str | Path,
        *,
        width: int = 640,
        fonts: Sequence[str | Path] = (),
        progress: Progress | None = None,
        force: bool = False,
    ) -> Path:
        """Write it as .svg, .gif or .mp4, atomically.

        ``width``: pixels across of GIF and MP4; ``progress`` is called with the frames done and their number.
        GIF needs ``linkwright[plot]``, MP4 ``linkwright[video]``. Raises LinkwrightError for another suffix, a
        missing package or font, a folder that cannot be written, and for a file that is there already unless
        ``force``.
        """
        refuse_target(path, force=force)
        suffix = Path(path).suffix.lower()
        if suffix != ".svg" and not WIDTHS[0] <= integer("width", width) <= WIDTHS[1]:
            raise RequestError(
                _(
                    "a film cannot be {width:.12g} pixels wide; give a width from {minimum} to {maximum}",
                    code="picture.bad_film_width",
                    width=width,
                    minimum=WIDTHS[0],
                    maximum=WIDTHS[1],
                )
            )
        if suffix == ".svg":
            return atomic_write(path, self.svg.encode(), force=force)
        if suffix == ".gif":
            run = list(self.run[:-1])
            film = gif(self._pictures(run, width, fonts, progress), self.seconds / len(run))
            return atomic_write(path, film, force=force)
        if suffix == ".mp4":
            run = [self.run[k] for k in self._film()]
            film = mp4(self._pictures(run, width, fonts, progress), FILM_RATE)
            return atomic_write(path, film, force=force)
        raise RequestError(
            _(
                '{path}: unknown animation format "{suffix}"; use .svg, .gif or .mp4',
                code="picture.no_film_suffix",
                path=path,
                suffix=suffix,
            )
        )

    def _pictures(
        self, run: Sequence[int], width: int, fonts: Sequence[str | Path], progress: Progress | None
    ) -> Iterator[bytes]:
        progress = progress or current_progress()
        for done, index in enumerate(run, start=1):
            yield png(self.frame(index), width=width, fonts=fonts)
            if progress is not None:
                progress(done, len(run))

    def _film(self) -> list[int]:
        count = max(2, round(self.seconds * FILM_RATE))
        return [int(k * (len(self.run) - 1) / count) for k in range(count)]

    def _track(self, point: str) -> Floats:
        motion = self.scene.machine.motion
        return self.scene.machine.view.paper(motion.point(point).position[list(self.keys)])

    def _share(self, index: int) -> float:
        return index / max(self.scene.machine.motion.steps - 1, 1)

    @cached_property
    def _title(self) -> str:
        return _(
            "Moving drawing of {name}", name=in_language(self.scene.machine.motion.mechanism.name, self.language)
        ).translate(self.language)

    @cached_property
    def _ink(self) -> list[Floats]:
        """Everything over the full motion."""
        ink = [line for index in self.run for line in self.scene.ink(index)]
        ink += [line for index in self.run for line in load_marks(self.scene.machine, index, forces=False).ink]
        view = self.scene.machine.view
        for arrows, scale in self.arrows:
            ink += [line for index in self.run for line in arrows.shape(index, view, scale).ink]
        return ink

    @cached_property
    def _labels(self) -> list[Moving]:
        """Names of points and of arrows, placed where they keep clear over the motion."""
        machine, first = self.scene.machine, self.run[0]
        labels: list[Label] = []
        tracks: list[Floats] = []
        if self.labelled:
            for label in point_labels(machine, first):
                labels.append(label)
                tracks.append(machine.view.paper(machine.motion.point(label.point).position))
        for arrows, scale in self.arrows:
            for label, track in arrows.tips(self.run, machine.view, scale):
                labels.append(label)
                tracks.append(track)
        frames = []
        for index in self.run[:: max(1, len(self.run) // LABEL_FRAMES)]:
            ink = [*self.scene.ink(index), *load_marks(machine, index, forces=False).ink]
            shifts = np.array([track[index] - track[first] for track in tracks]).reshape(-1, 2)
            frames.append((Obstacles.of(ink), shifts))
        chosen = place_moving(labels, frames)
        placed = zip(labels, tracks, chosen, strict=True)
        return [Moving(track, tuple(written(label, each)), each.box) for label, track, each in placed]

    @cached_property
    def _drawn_box(self) -> Box:
        names = [
            np.reshape(each.box, (2, 1, 2)) + (each.track[list(self.run)] - each.track[self.run[0]])
            for each in self._labels
        ]
        return bounds([*self._ink, *(each.reshape(-1, 2) for each in names)])

    @cached_property
    def _panel(self) -> Panel | None:
        if not self.results:
            return None
        alone = len(self.scene.machine.motion.mechanism.drivers) == 1
        return panel(self.results, self._drawn_box, self.language, alone=alone, ends=self._ends)

    def _ends(self, output: Output) -> tuple[float, float]:
        """Smallest and largest value of a result: between the positions where it is found there."""
        values = self.results[output]
        source = PlotInput(self.scene.machine.motion if self.forces is None else self.forces)
        _, read, of = source.course_of(output)
        exact = source.angle_extremes(read, values) if output.kind == "angle" else source.extremes(read, of)
        found = [exact(kind) if exact is not None else None for kind in ("min", "max")]
        samples = float(np.nanmin(values)), float(np.nanmax(values))
        low, high = (s if e is None else e.value for s, e in zip(samples, found, strict=True))
        return low, high

    @cached_property
    def _legend(self) -> Legend:
        box = self._drawn_box
        if self._panel is not None:
            box = bounds([np.reshape(box, (2, 2)), self._panel.extent])
        below = Legend(box)
        below.scales([arrows for arrows, _unused in self.arrows], self.run, self.language)
        if any(arrows.kind == "force" and not arrows.empty(self.run) for arrows, _unused in self.arrows):
            below.numbers(self.scene.machine.motion.mechanism, self.language)
        return below

    @cached_property
    def _still(self) -> list[SvgNode]:
        return [*(self._panel.elements if self._panel is not None else ()), *self._legend.content]

    @cached_property
    def _box(self) -> Box:
        extent = [] if self._panel is None else [self._panel.extent]
        return bounds([np.reshape(self._drawn_box, (2, 2)), *extent, *self._legend.extent])

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"Animation({len(self.run) - 1} frames, {self.seconds:g} s)"
