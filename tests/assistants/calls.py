"""Tools called by the client of the protocol's own package, with the server in the same process."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import anyio
from mcp import Client
from mcp.server.mcpserver import MCPServer

from linkwright.assistants.server import server

T = TypeVar("T")
#: A four-bar whose numbers are in its gallery file from an independent solution, lengths in m.
CRANK_ROCKER = "gallery:crank_rocker"


@dataclass(frozen=True)
class Called:
    """What came back: the data, the pictures, and whether it is an error."""

    data: dict[str, Any]
    pictures: tuple[str, ...]
    failed: bool

    @property
    def codes(self) -> list[str]:
        """Codes of the findings."""
        return [each["code"] for each in self.data["findings"]]

    def column(self, name: str) -> list[float]:
        """Values of a column of solve_machine."""
        return next(each["values"] for each in self.data["columns"] if each["name"] == name)


@cache
def kept(folder: str, language: str) -> MCPServer[Any]:
    """The server of a folder; it keeps nothing between calls."""
    return server(folder, language=language)


def asked(ask: Callable[[Client], Awaitable[T]], folder: Path | str = ".", language: str = "en") -> T:
    """What a client gets of a server of a folder."""

    async def run() -> T:
        async with Client(kept(str(folder), language)) as client:
            return await ask(client)

    return anyio.run(run)


def call(tool: str, folder: Path | str = ".", language: str = "en", /, **arguments: Any) -> Called:
    """The answer of a tool; it must fit the schema that the tool declares, also where it failed."""

    async def ask(client: Client) -> Called:
        answer = await client.call_tool(tool, arguments)
        answer_shown = answer.model_copy(update={"is_error": False})
        await client.session.validate_tool_result(tool, answer_shown)
        data = answer.structured_content
        assert isinstance(data, dict)
        images = tuple(each.data for each in answer.content if each.type == "image")
        return Called(data, images, bool(answer.is_error))

    return asked(ask, folder, language)
