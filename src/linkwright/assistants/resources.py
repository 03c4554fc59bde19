"""What the server lets be read: the schema of files, the glossary, the gallery."""

from __future__ import annotations

import json
from importlib import resources
from typing import Any

from mcp.server.mcpserver import MCPServer
from mcp.server.mcpserver.exceptions import ResourceNotFoundError

from linkwright import gallery
from linkwright.core.data import json_text
from linkwright.files.gallery_entries import entries
from linkwright.files.model_file import json_schema
from linkwright.words import _
from linkwright.words.message import in_language

SCHEMA, GLOSSARY, GALLERY = "linkwright://schema", "linkwright://glossary", "linkwright://gallery"


def add_resources(server: MCPServer[Any], *, language: str) -> None:
    """Adds them to a server."""

    @server.resource(
        SCHEMA,
        name="schema",
        title="JSON Schema of model files",
        description="The whole JSON Schema (2020-12) of a model file, 160 kB; read_schema gives one section of it.",
        mime_type="application/schema+json",
    )
    def schema() -> str:
        return json.dumps(json_schema(), ensure_ascii=False)

    @server.resource(
        GLOSSARY,
        name="glossary",
        title="Glossary of the trade",
        description=(
            "What the words mean that tools and models use: dyad, assembly mode, change point, transmission angle."
        ),
        mime_type="text/markdown",
    )
    def glossary() -> str:
        return (resources.files(__package__) / f"glossary.{language}.md").read_text("utf-8")

    @server.resource(
        GALLERY,
        name="gallery",
        title="Models that come with Linkwright",
        description="Name, title and purpose of every model, calculation and task of synthesis of the gallery.",
        mime_type="application/json",
    )
    def listing() -> str:
        kinds = zip(("models", "calculations", "tasks"), entries(), strict=True)
        return json_text(
            {
                kind: [{key: in_language(text, language) for key, text in each.items()} for each in found]
                for kind, found in kinds
            }
        )

    @server.resource(
        f"{GALLERY}/{{name}}",
        name="gallery model",
        title="A model of the gallery",
        description="The text of one model file of the gallery, by its name.",
        mime_type="application/yaml",
    )
    def model(name: str) -> str:
        try:
            return gallery.content(name).decode()
        except KeyError:
            message = _('the gallery has no model "{name}"', code="gallery.unknown", name=name)
            raise ResourceNotFoundError(in_language(message, language)) from None
