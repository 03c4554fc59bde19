"""The server: tools and resources of the Model Context Protocol over the library, bound to one folder."""

from __future__ import annotations

import inspect
import json
import sys
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any

from mcp.server.mcpserver import Context, MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from mcp_types import CallToolResult, ContentBlock, ImageContent, InputRequiredResult, TextContent, ToolAnnotations
from pydantic import ValidationError

from linkwright.assistants.answers import Answer
from linkwright.assistants.failures import entries, of_error
from linkwright.assistants.folder import Folder
from linkwright.assistants.resources import add_resources
from linkwright.assistants.tool import Desk, Tool
from linkwright.assistants.tools import TOOLS
from linkwright.assistants.working import Stopped, worked_off
from linkwright.core import VERSION
from linkwright.errors import Finding, LinkwrightError
from linkwright.filesystem import confined
from linkwright.registry import offered
from linkwright.words import Message, _
from linkwright.words.message import code_of, in_language

#: Bytes of arguments that are taken.
LARGEST = 1_000_000
INSTRUCTIONS = """\
Linkwright analyses and designs planar machines (linkages, gears, cams, sliders) from a short YAML file, the model.
A model is given to every tool as its text, as a file in the server's folder, or as gallery:NAME.

Usual way: read_schema or search_gallery to learn the form of a model; write its text; check_model until it has no
errors; then solve_machine (motion and forces at inputs), get_metrics (design numbers), draw_machine (a picture);
change_dimension or optimize_machine to improve it, synthesize_machine where dimensions are not known yet,
compare_machines for alternatives, write_report in the end. explain_finding tells what the code of a finding means.

Numbers in answers are SI with their unit beside them (m, rad, s, kg, N, N·m), angles and moments counter-clockwise
positive, x to the right, y up. Numbers that you give carry their unit in the text: "120 mm", "30 deg", "60 rpm".
Every finding has a code, a place in the text, a remedy and the call that helps next. Read the warnings: a result that
has some may be right and yet not what is meant."""


def server(folder: str | Path = ".", *, language: str = "en") -> AssistantServer:
    """The server for a folder; ``run("stdio")`` serves until its input ends.

    Nothing outside of the folder is read or written, symbolic links followed, and no code is run.
    """
    return AssistantServer(Desk(Folder(Path(folder)), language))


class AssistantServer(MCPServer[Any]):
    """Tools whose failures are findings, and what they know as resources."""

    def __init__(self, desk: Desk) -> None:
        super().__init__(
            "linkwright", title="Linkwright", version=VERSION, instructions=INSTRUCTIONS, log_level="ERROR"
        )
        self.desk = desk
        self.by_name: Mapping[str, Tool] = {each.name: each for each in TOOLS}
        for each in TOOLS:
            hints = ToolAnnotations(
                title=each.title,
                read_only_hint=not each.writes,
                destructive_hint=each.writes,
                idempotent_hint=each.repeats,
                open_world_hint=False,
            )
            self.add_tool(
                _called(desk, each),
                name=each.name,
                title=each.title,
                description=each.description,
                annotations=hints,
                structured_output=True,
            )
        add_resources(self, language=desk.language)

    async def call_tool(
        self, name: str, arguments: dict[str, Any], context: Context[Any, Any] | None = None
    ) -> CallToolResult | InputRequiredResult:
        """What a tool answers; arguments that do not fit its schema are findings as well."""
        tool = self.by_name.get(name)
        if tool is None:
            return await super().call_tool(name, arguments, context)
        wrong = _too_large(arguments) or _unknown(tool, arguments)
        if wrong:
            return refused(tool, wrong, self.desk.language)
        try:
            return await super().call_tool(name, arguments, context)
        except ToolError as error:
            if not isinstance(error.__cause__, ValidationError):
                raise
            return refused(tool, _unfit(error.__cause__), self.desk.language)


def _called(desk: Desk, tool: Tool) -> Callable[..., Any]:
    """The function of a tool as the server calls it: in a thread, with progress, its failures as findings."""

    async def call(context: Context[Any, Any], **arguments: Any) -> CallToolResult:
        def work() -> CallToolResult:
            with confined(desk.folder.path):
                return answered(desk, tool, arguments)

        return await worked_off(work, context)

    keyword = inspect.Parameter.KEYWORD_ONLY
    parameters = [inspect.Parameter("context", keyword, annotation=Context), *tool.parameters]
    answer = Annotated[CallToolResult, tool.answer]
    call.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [each.replace(kind=keyword) for each in parameters], return_annotation=answer
    )
    call.__annotations__ = {**{each.name: each.annotation for each in parameters}, "return": answer}
    call.__name__ = tool.name
    return call


def answered(desk: Desk, tool: Tool, arguments: Mapping[str, Any]) -> CallToolResult:
    """The answer of a tool, or what hinders it as findings; never raises but for work that is not wanted any more."""
    try:
        return result(tool.work(desk, **arguments))
    except Stopped:
        raise
    except LinkwrightError as error:
        return refused(tool, of_error(error), desk.language)
    except MemoryError:
        message = _(
            "there is not enough memory for this; ask for fewer positions or designs", code="assistants.memory"
        )
        return refused(tool, [_error("", message)], desk.language)
    except Exception as error:  # an error of the program: said, not thrown at who cannot mend it
        traceback.print_exc(file=sys.stderr)
        message = _(
            "this should not have happened ({kind}: {message}); it is an error of the program, not of the model",
            code="assistants.unexpected",
            kind=type(error).__name__,
            message=" ".join(str(error).split())[:300],
        )
        return refused(tool, [_error("", message)], desk.language)


def result(answer: Answer, *, failed: bool = False) -> CallToolResult:
    """An answer as data, the same as text for clients that read text alone, and its pictures.

    ``failed``: the call has no result. A model with errors is the result of checking it.
    """
    data = answer.model_dump(mode="json")
    content: list[ContentBlock] = [TextContent(type="text", text=answer.model_dump_json(exclude_defaults=True))]
    content += [ImageContent(type="image", data=each, mime_type="image/png") for each in answer.pictures]
    return CallToolResult(content=content, structured_content=data, is_error=failed)


def refused(tool: Tool, findings: list[Finding], language: str) -> CallToolResult:
    """The answer of a tool that has no result."""
    listed = entries(findings, language)
    first = next((each.message for each in listed if each.severity == "error"), "")
    summary = in_language(_("no result: {cause}", cause=first), language)
    return result(tool.answer(ok=False, summary=summary, findings=listed), failed=True)


def _too_large(arguments: Mapping[str, Any]) -> list[Finding]:
    """That arguments are larger than any model that a person writes."""
    if len(json.dumps(arguments, ensure_ascii=False).encode()) <= LARGEST:
        return []
    return [_error("", _("the arguments are larger than {most} bytes", code="assistants.large", most=LARGEST))]


def _unknown(tool: Tool, arguments: Mapping[str, Any]) -> list[Finding]:
    """Arguments that a tool does not have, with the nearest ones; the protocol would pass over them in silence."""
    known = [each.name for each in tool.parameters]
    return [
        _error(
            name,
            _('{tool} has no argument "{name}"', code="assistants.argument", tool=tool.name, name=name),
            offered(name, known, _("it has {names}")),
        )
        for name in arguments
        if name not in known
    ]


def _unfit(error: ValidationError) -> list[Finding]:
    """Arguments of a wrong type, or out of range."""
    return [
        _error(
            ".".join(map(str, each["loc"])),
            _("{name}: {cause}", code="assistants.argument", name=".".join(map(str, each["loc"])), cause=each["msg"]),
        )
        for each in error.errors()
    ]


def _error(key: str, message: Message, remedy: str = "") -> Finding:
    return Finding("error", "", key, message, remedy, code_of(message))
