"""Sweeps that outgrow memory: designs computed part by part, each part an atomically written Parquet file."""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from linkwright.analysis.base import METRICS
from linkwright.analysis.by_name import wanted
from linkwright.core import VERSION
from linkwright.core.arguments import integer, require
from linkwright.core.arrays import Floats
from linkwright.core.progress import Progress, current_progress, reporting
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.designs.cluster import connected, current, in_turn
from linkwright.designs.ranges import BAD_SEED, Range
from linkwright.designs.sweep import sweep
from linkwright.designs.varied_dimensions import varied_ranges
from linkwright.errors import RequestError
from linkwright.exporters.export import package
from linkwright.filesystem import atomic_write, make_folder
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _, pgettext
from linkwright.words.message import in_language

Sampling = Literal["grid", "sobol"]
#: Designs of a part; of a complete sweep, at most.
PART, MOST = 16384, 10**12


@dataclass(frozen=True, eq=False)
class Plan:
    """What is swept; designs have numbers, so any part of them can be made anywhere."""

    mechanism: Mechanism
    ranges: tuple[Range, ...]
    outputs: tuple[str, ...]
    sampling: Sampling
    designs: int
    seed: int
    steps: int | None
    part: int

    @property
    def parts(self) -> int:
        """Number of parts."""
        return -(-self.designs // self.part)

    def rows(self, number: int) -> int:
        """Designs of a part."""
        return min(self.part, self.designs - number * self.part)

    def columns(self, number: int) -> dict[str, Floats]:
        """Values of the designs of a part by address."""
        first, count = number * self.part, self.rows(number)
        if self.sampling == "grid":
            sizes = tuple(len(each.values) for each in self.ranges)
            places = np.unravel_index(np.arange(first, first + count), sizes)
            return {each.address: each.values[at] for each, at in zip(self.ranges, places, strict=True)}
        from scipy.stats import qmc

        drawn = qmc.Sobol(len(self.ranges), rng=np.random.default_rng(self.seed))
        if first:
            drawn.fast_forward(first)
        unit = drawn.random(self.part)[:count]
        return {each.address: each.low + unit[:, i] * (each.high - each.low) for i, each in enumerate(self.ranges)}

    @property
    def digest(self) -> str:
        """What finished parts must agree with."""
        known = sorted(self.mechanism.dimensions().items()), sorted(self.mechanism.assembly.items())
        values = [(each.address, each.values.tobytes()) for each in self.ranges]
        identity_data = (
            known,
            sorted(map(repr, self.mechanism.loads.items())),
            values,
            self.outputs,
            self.sampling,
            self.designs,
            self.seed,
            self.steps,
            self.part,
            VERSION,
        )
        return hashlib.blake2b(repr(identity_data).encode(), digest_size=16).hexdigest()


def part_content(plan: Plan, number: int, threads: int | None = 1) -> bytes:
    """A part as the bytes of a Parquet file: the same wherever it is made."""
    found = sweep(plan.mechanism, plan.columns(number), outputs=plan.outputs, steps=plan.steps, threads=threads)
    arrow, parquet = _arrow()
    columns = {name: np.ascontiguousarray(column) for name, column in found.columns().items()}
    stream = io.BytesIO()
    parquet.write_table(arrow.table(columns), stream, compression="zstd")
    return stream.getvalue()


def _arrow() -> tuple[Any, Any]:
    return package("pyarrow", _("Parquet files")), package("pyarrow.parquet", _("Parquet files"), "pyarrow")


class SweepParts(Tabular):
    """A sweep in a folder of Parquet files ``part-000000.parquet`` …; columns as :meth:`Sweep.columns`, SI.

    ``designs``, ``parts``: how many; ``skipped``: parts that were there already.
    """

    def __init__(self, folder: Path, plan: Plan, skipped: int = 0) -> None:
        self.folder, self.plan, self.skipped = folder, plan, skipped

    @property
    def designs(self) -> int:
        """Number of designs."""
        return self.plan.designs

    @property
    def parts(self) -> int:
        """Number of parts."""
        return self.plan.parts

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """As :attr:`Sweep.notes`."""
        plan = self.plan
        first = {each.address: each.values[:1] for each in plan.ranges}
        return sweep(plan.mechanism, first, outputs=plan.outputs, steps=plan.steps).notes

    def tables(self, language: str = "en", best: str | None = None) -> tuple[Table, ...]:
        """How many designs lie in the folder, the range of every column, SI, notes, and the ten designs that are best
        in a number."""
        title = _(
            "{designs} designs in {parts} parts in {folder} ({skipped} were there already); values in SI",
            designs=self.designs,
            parts=self.parts,
            skipped=self.skipped,
            folder=self.folder,
        )
        head = (_("column"), _("minimum"), _("maximum"), pgettext("sweep", "designs"))
        ranges = self.ranges().items()
        rows: list[list[Cell]] = [[name, Amount(a), Amount(b), count] for name, (a, b, count) in ranges]
        notes = [_("Note: {text}", text=note) for note in self.notes]
        found = [Table(head, rows, title=title, notes=notes)]
        if best is not None:
            columns = self.best(best)
            designs = [[Amount(float(value)) for value in row] for row in zip(*columns.values(), strict=True)]
            found.append(Table(list(columns), designs, ">" * len(columns), _("Best {number}:", number=best)))
        return tuple(found)

    def data(self, language: str = "en", best: str | None = None) -> dict[str, Any]:
        """What lies in the folder: how many designs, the range of every column, SI, notes in a language, and the ten
        designs that are best in a number."""
        columns = {
            name: {"least": low, "greatest": high, "designs": count}
            for name, (low, high, count) in self.ranges().items()
        }
        return {
            "folder": str(self.folder),
            "designs": self.designs,
            "parts": self.parts,
            "skipped": self.skipped,
            "columns": columns,
            "notes": [in_language(note, language) for note in self.notes],
            "best": {} if best is None else {name: each.tolist() for name, each in self.best(best).items()},
        }

    def path(self, number: int) -> Path:
        """The file of a part."""
        return self.folder / f"part-{number:06d}.parquet"

    def each(self, names: Iterable[str] | None = None) -> Iterator[dict[str, Floats]]:
        """The columns part by part, so that memory does not grow with the designs."""
        _unused, parquet = _arrow()
        chosen = None if names is None else list(names)
        for number in range(self.parts):
            table = parquet.read_table(self.path(number), columns=chosen)
            yield {name: table[name].to_numpy() for name in table.column_names}

    def columns(self, names: Iterable[str] | None = None) -> dict[str, Floats]:
        """All designs at once."""
        chosen = None if names is None else list(names)
        found = list(self.each(chosen))
        return {name: np.concatenate([part[name] for part in found]) for name in found[0]}

    def best(self, name: str, count: int = 10, *, largest: bool | None = None) -> dict[str, Floats]:
        """The columns of the designs with the smallest (``largest``: largest) values, in order; NaN is left out.

        Where ``largest`` is left out, the largest of metrics that are better when higher, else the smallest.
        """
        if largest is None:
            metric = METRICS.get(name.partition(" ")[0])
            largest = metric is not None and metric.better == "higher"
        best_columns: dict[str, Floats] = {}
        for part in self.each():
            if name not in part:
                raise RequestError(
                    _(
                        'the sweep has no column "{name}"; it has {names}',
                        code="study.no_column",
                        name=name,
                        names=tuple(part),
                    )
                )
            merged = (
                {key: np.concatenate([best_columns[key], each]) for key, each in part.items()}
                if best_columns
                else part
            )
            sizes = -merged[name] if largest else merged[name]
            order = np.argsort(sizes, kind="stable")
            order = order[np.isfinite(merged[name][order])][:count]
            best_columns = {key: each[order] for key, each in merged.items()}
        return best_columns

    def ranges(self) -> dict[str, tuple[float, float, int]]:
        """Minimum and maximum of every column, and how many designs have one."""
        found: dict[str, tuple[float, float, int]] = {}
        for part in self.each():
            for name, column in part.items():
                good = column[np.isfinite(column)]
                low, high, count = found.get(name, (np.inf, -np.inf, 0))
                if len(good):
                    low, high = min(low, float(good.min())), max(high, float(good.max()))
                found[name] = low, high, count + len(good)
        return found

    def __repr__(self) -> str:
        return f"SweepParts({str(self.folder)!r}: {self.designs} designs in {self.parts} parts)"


def sweep_parts(
    mechanism: Mechanism,
    vary: Mapping[str, str | ArrayLike],
    folder: str | Path,
    *,
    outputs: Iterable[str | tuple[str, str]],
    sampling: Sampling = "grid",
    samples: int = 65536,
    seed: int = 0,
    steps: int | None = None,
    part: int = PART,
    client: Any = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> SweepParts:
    """A sweep of any size, part by part into a folder; a part that is there already is not computed again.

    Args:
        mechanism, outputs, steps: as in :func:`sweep`.
        vary: by address a range ``1.2..1.3 m:11``, values ``1.2, 1.25 m``, or numbers in SI, as in :func:`study`.
        folder: where the Parquet files go; made where it does not exist. Files are written atomically, so
            the same call after an interruption goes on with the parts that are missing.
        sampling: ``grid``: every combination; ``sobol``: ``samples`` designs, scrambled by ``seed``.
        part: designs of a part, rounded up to a power of two.
        client: a Dask client or the address of a scheduler (extra ``cluster``), else ``threads`` of this machine.
            Parts are the same, to the bit, wherever they are computed; those of workers that die are given out again.
        progress: called with (designs done, designs), those of parts that are there already among them.

    Raises:
        LinkwrightError: unknown names, a folder with another sweep, no pyarrow or distributed, no cluster.
    """
    require(mechanism, Mechanism)
    if not str(folder):
        raise RequestError(
            _('the folder has no name; name one, or give "." for the folder you are in', code="study.no_folder")
        )
    plan = _plan(mechanism, vary, outputs, sampling, samples, seed, steps, part)
    found = SweepParts(Path(folder), plan)
    missing = _missing(found)
    found.skipped = plan.parts - len(missing)
    progress = progress or current_progress()
    done = plan.designs - sum(plan.rows(number) for number in missing)

    def within(share: int, total: int) -> None:
        if progress is not None:
            progress(min(done + plan.part * share // total, plan.designs), plan.designs)

    with reporting(None if progress is None else within):
        for number, content in _made(plan, missing, client if client is not None else current(), threads):
            atomic_write(found.path(number), content)
            done += plan.rows(number)
            within(0, 1)
    return found


def _plan(
    mechanism: Mechanism,
    vary: Mapping[str, str | ArrayLike],
    outputs: Iterable[str | tuple[str, str]],
    sampling: Sampling,
    samples: int,
    seed: int,
    steps: int | None,
    part: int,
) -> Plan:
    if sampling not in ("grid", "sobol"):
        raise RequestError(
            _("there is no sampling {sampling!r}; use grid or sobol", code="study.no_sampling", sampling=sampling)
        )
    ranges = varied_ranges(mechanism, vary, sampled=sampling == "sobol")
    count = samples if sampling == "sobol" else int(np.prod([float(len(each.values)) for each in ranges]))
    part = integer("part", part)
    if seed < 0:
        raise RequestError(BAD_SEED.format(seed=seed))
    if not 1 <= count <= MOST:
        raise RequestError(
            _("{samples} samples are asked for; give 1 to {most}", code="study.bad_samples", samples=count, most=MOST)
        )
    names = tuple(each.name for each in wanted(outputs))
    size = 1 << max(0, (min(part, count) - 1).bit_length()) if part > 0 else PART
    return Plan(mechanism, ranges, names, sampling, count, seed, steps, size)


def _missing(found: SweepParts) -> list[int]:
    """Parts that are not there yet, in a folder that belongs to the plan."""
    _unused, parquet = _arrow()
    make_folder(found.folder)
    note, digest = found.folder / "sweep.json", found.plan.digest
    found_data = {"plan": digest, "designs": found.designs, "parts": found.parts, "outputs": found.plan.outputs}
    try:
        atomic_write(note, json.dumps(found_data, indent=1).encode(), force=False)
    except RequestError:
        if not note.exists():
            raise
    try:
        same = json.loads(note.read_text(encoding="utf-8")).get("plan") == digest
    except (OSError, ValueError, AttributeError):
        same = False
    if not same:
        raise RequestError(
            _(
                'the folder "{folder}" holds another sweep; name another folder, or remove it',
                code="study.other_sweep",
                folder=found.folder,
            )
        )

    def there(number: int) -> bool:
        try:
            return bool(parquet.read_metadata(found.path(number)).num_rows == found.plan.rows(number))
        except (OSError, ValueError):
            return False

    return [number for number in range(found.parts) if not there(number)]


def _made(plan: Plan, missing: list[int], client: Any, threads: int | None) -> Iterator[tuple[int, bytes]]:
    """Contents of the missing parts with their numbers."""
    if client is None:
        for number in missing:
            yield number, part_content(plan, number, threads)
        return
    joined = connected(client)
    try:
        for place, content in in_turn(joined, part_content, [(plan, number) for number in missing]):
            yield missing[place], content
    finally:
        if joined is not client:
            joined.close()
