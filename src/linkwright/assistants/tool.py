"""A tool: its words, its hints, and the function that answers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from inspect import Parameter, getdoc, signature
from typing import Annotated, Any

from pydantic import Field

from linkwright.assistants.answers import Answer
from linkwright.assistants.folder import Folder, Source
from linkwright.assistants.foreign import refuse_foreign

#: The model that most tools take.
Model = Annotated[
    str,
    Field(
        description=(
            "The model, in one of three forms: the whole YAML text of a model file (begins with 'format: 1'); the "
            "name of a file in the server's folder, such as 'crusher.yaml'; or 'gallery:NAME' of a model that comes "
            "with Linkwright, such as 'gallery:crank_rocker'."
        )
    ),
]
SaveAs = Annotated[
    str,
    Field(
        description=(
            "File in the server's folder to write the new model text to, such as 'better.yaml'. Empty (default): "
            "nothing is written and the text is only returned."
        )
    ),
]
Overwrite = Annotated[
    bool,
    Field(description="true: a file of that name that is already there is replaced. Default false: it is refused."),
]


@dataclass(frozen=True)
class Desk:
    """What tools work with: the folder, and the language of findings."""

    folder: Folder
    language: str = "en"

    def source(self, model: str) -> Source:
        """The model that an argument means; raises LinkwrightError, for one of another program as well."""
        refuse_foreign(self.folder, model)
        return self.folder.source(model)


@dataclass(frozen=True)
class Tool:
    """A tool of the server.

    ``work(desk, **arguments)`` answers; its docstring is the description, its arguments' annotations their schema,
    its return type the schema of what comes back. ``writes``: it can write a file into the folder; ``repeats``:
    called again with the same arguments it changes nothing more.
    """

    title: str
    work: Callable[..., Answer]
    writes: bool = False
    repeats: bool = True

    @property
    def name(self) -> str:
        """By which it is called."""
        return self.work.__name__

    @property
    def description(self) -> str:
        """When to use it, and what comes back."""
        paragraphs = (getdoc(self.work) or "").split("\n\n")
        return "\n\n".join(" ".join(each.split()) for each in paragraphs)

    @property
    def parameters(self) -> list[Parameter]:
        """Its arguments, without the desk."""
        _desk, *found = signature(self.work, eval_str=True).parameters.values()
        return found

    @property
    def answer(self) -> Any:
        """The type of what it answers."""
        return signature(self.work, eval_str=True).return_annotation
