"""Programs and cycle programs as plain data beside their kernels, for machines other than this one."""

from __future__ import annotations

from typing import Any

from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.stage import Stage

Plain = dict[str, Any]


class Kernels:
    """A list of programs, each once; a program's number is the number of its kernel."""

    def __init__(self) -> None:
        self.programs: list[Program] = []

    def number(self, program: Program) -> int:
        """The number of a program, which joins the list if it is new."""
        if program not in self.programs:
            self.programs.append(program)
        return self.programs.index(program)

    def described(self) -> list[Plain]:
        """Names of the inputs and outputs of every program, in their order."""
        kinds = ("parameters", "positions", "fields", "states", "tables")
        return [
            {"outputs": list(each.output_names), **{kind: list(getattr(each, kind)) for kind in kinds}}
            for each in self.programs
        ]

    def stages(self, cycle: CycleProgram) -> list[Plain]:
        """The stages of a cycle program; their programs join the list."""
        return [self._stage(stage) for stage in cycle.stages]

    def _stage(self, stage: Stage) -> Plain:
        accumulation = stage.accumulation
        return {
            "kernel": self.number(accumulation.needed),
            "reductions": [
                {"name": name, "output": each.output, "kind": each.kind, "of": each.of}
                for name, each in stage.reductions.items()
            ],
            "valid": accumulation.valid,
            "count": stage.count,
            "complete": stage.complete,
            "steps": stage.steps,
            "starts": dict(stage.starts),
            "after": None if stage.after is None else self.number(stage.after),
            "keep": self.number(stage.kept) if stage.keep else None,
        }
