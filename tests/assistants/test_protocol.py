"""The server as a client sees it: tools with their words and schemas, resources, progress, cancelling, a process."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import anyio
import pytest
from mcp import Client
from mcp.client.stdio import StdioServerParameters, stdio_client
from tests.assistants.calls import CRANK_ROCKER, asked
from tests.cli.commands import is_refused

import linkwright as lw
from linkwright.assistants.server import server

MOST_TOOLS = 12


def tools() -> list[Any]:
    async def listed(client: Client) -> list[Any]:
        return list((await client.list_tools()).tools)

    return asked(listed)


def test_there_are_at_most_twelve_tools_with_words_hints_and_schemas() -> None:
    found = tools()
    assert 0 < len(found) <= MOST_TOOLS and len({each.name for each in found}) == len(found)
    for each in found:
        assert each.title and 200 < len(each.description) < 1200, each.name
        assert "Comes back" in each.description and "Use it" in each.description, each.name
        hints = each.annotations
        assert hints.open_world_hint is False and hints.idempotent_hint is True
        assert hints.read_only_hint is not ({"save_as", "file"} & set(each.input_schema["properties"]) != set())
        assert {"ok", "summary", "findings", "next"} <= set(each.output_schema["properties"])


def test_every_argument_and_every_field_of_an_answer_is_described() -> None:
    for each in tools():
        for name, shape in each.input_schema["properties"].items():
            assert len(shape["description"]) > 20, f"{each.name} {name}"
        shapes = [each.output_schema, *each.output_schema["$defs"].values()]
        for shape in shapes:
            assert all("description" in inner for inner in shape["properties"].values()), each.name


def test_calls_that_are_offered_next_are_calls_of_tools() -> None:
    """Names in descriptions too."""
    known = {each.name for each in tools()}
    named = {
        word.strip(".,;:()")
        for each in tools()
        for word in each.description.split()
        if word.count("_") == 1 and word.split("_")[0] in {name.split("_")[0] for name in known}
    }
    assert named <= known | {"read_only"}


def test_resources_are_the_schema_the_glossary_and_the_gallery() -> None:
    async def read(client: Client) -> dict[str, str]:
        listed = [str(each.uri) for each in (await client.list_resources()).resources]
        templates = [each.uri_template for each in (await client.list_resource_templates()).resource_templates]
        assert templates == ["linkwright://gallery/{name}"]
        uris = [*listed, "linkwright://gallery/kite"]
        return {uri: (await client.read_resource(uri)).contents[0].text for uri in uris}

    found = asked(read)
    assert '"$schema"' in found["linkwright://schema"]
    assert "dead point" in found["linkwright://glossary"]
    assert "crank_rocker" in found["linkwright://gallery"]
    assert found["linkwright://gallery/kite"] == lw.read_document("gallery:kite").text


def test_an_unknown_resource_is_refused() -> None:
    async def read(client: Client) -> str:
        with pytest.raises(Exception, match="gallery") as caught:
            await client.read_resource("linkwright://gallery/kiet")
        return str(caught.value)

    assert "kiet" in asked(read)


@pytest.mark.rotating
def test_long_work_tells_its_progress_and_ends_where_it_is_cancelled() -> None:
    told: list[float] = []
    asked_of = {
        "model": CRANK_ROCKER,
        "vary": {"coupler.length": "3.2..4 m", "rocker.length": "2.4..2.9 m", "coupler.P.x": "1..2 m"},
        "maximize": ["transmission_angle", "coupler_curve_length"],
        "evaluations": 20_000,
    }

    async def ask(client: Client) -> None:
        with anyio.CancelScope() as wanted, anyio.fail_after(30):

            async def heard(progress: float, total: float | None, message: str | None) -> None:
                told.append(progress)
                wanted.cancel()

            await client.call_tool("optimize_machine", asked_of, progress_callback=heard)
        assert wanted.cancelled_caught
        answer = await client.call_tool("check_model", {"model": CRANK_ROCKER})
        assert answer.structured_content["ok"]

    asked(ask)
    assert told and 0 < told[0] < 100


def test_the_command_serves_a_client_over_its_streams(tmp_path: Path) -> None:
    """A process of its own; what it prints besides would break the protocol."""
    (tmp_path / "own.yaml").write_text(lw.read_document(CRANK_ROCKER).text, "utf-8")
    parameters = StdioServerParameters(
        command=sys.executable, args=["-m", "linkwright", "mcp", "--folder", str(tmp_path)], env=environment()
    )

    async def ask() -> Any:
        async with Client(stdio_client(parameters)) as client:
            assert len((await client.list_tools()).tools) <= MOST_TOOLS
            return await client.call_tool(
                "solve_machine", {"model": "own.yaml", "at": "40 deg", "columns": ["rocker"]}
            )

    found = anyio.run(ask).structured_content
    angle = next(each for each in found["columns"] if each["name"] == "rocker.angle")
    assert angle["values"] == pytest.approx([1.6745706], rel=1e-7)


def environment() -> dict[str, str]:
    """The variables by which the package is found in its source."""
    names = ("PYTHONPATH", "PATH", "HOME", "LINKWRIGHT_CACHE")
    return {name: os.environ[name] for name in names if name in os.environ}


def test_without_the_package_the_command_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mcp", None)
    error = is_refused(["mcp"], "export.needs_package")
    assert "linkwright[assistants]" in str(error)


def test_a_folder_that_is_not_there_is_refused() -> None:
    is_refused(["mcp", "--folder", "/nowhere/at/all"], "file.no_folder")


def test_a_server_says_who_it_is() -> None:
    assert server(".").title == "Linkwright" and "check_model" in (server(".").instructions or "")
