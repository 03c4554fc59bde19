"""XML elements with their lines; document types and entities are refused."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from linkwright.importers.layout import Remarks
from linkwright.words import _


@dataclass
class Element:
    """An element: its tag, attributes and children, and its line in the file."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list)

    def get(self, name: str, default: str = "") -> str:
        """An attribute."""
        return self.attributes.get(name, default)

    def all(self, *tags: str) -> Iterator[Element]:
        """The children of these tags."""
        return (each for each in self.children if each.tag in tags)

    def first(self, tag: str) -> Element | None:
        """The first child of a tag."""
        return next(self.all(tag), None)

    def below(self) -> Iterator[Element]:
        """All that it holds, level by level."""
        pending = deque(self.children)
        while pending:
            element = pending.popleft()
            yield element
            pending.extend(element.children)


def parse_xml(text: str, remarks: Remarks) -> Element | None:
    """The root of a text; None, with an error among the remarks, where it is not well-formed."""
    parser, open_elements, roots = expat.ParserCreate(), list[Element](), list[Element]()

    def begin(tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, parser.CurrentLineNumber)
        (open_elements[-1].children if open_elements else roots).append(element)
        open_elements.append(element)

    def end(_tag: str) -> None:
        open_elements.pop()

    def refuse(*_unused: object) -> None:
        raise _DocumentType

    parser.StartElementHandler, parser.EndElementHandler = begin, end
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(text, True)
    except _DocumentType:
        message = _("the file declares a document type, which may hide what it holds")
        remarks.remark("error", message, _("remove <!DOCTYPE …>"), "import.document_type")
        return None
    except expat.ExpatError as error:
        message = _("this is no well-formed XML ({reason})", reason=expat.ErrorString(error.code))
        remedy = _("write it again with its program, or mend it here")
        remarks.remark("error", message, remedy, "import.xml", line=error.lineno, column=error.offset + 1)
        return None
    return roots[0]


class Lines:
    """Lines of elements by their tags and names; of those without a name 0."""

    def __init__(self, root: Element) -> None:
        self.found: dict[tuple[str, str], int] = {}
        pending = [root]
        while pending:
            element = pending.pop()
            if element.get("name"):
                self.found.setdefault((element.tag, element.get("name")), element.line)
            pending += element.children

    def of(self, name: str, *tags: str) -> int:
        """The line of the first element of these tags that has a name."""
        return next((self.found[tag, name] for tag in tags if (tag, name) in self.found), 0)


class _DocumentType(Exception):
    """A document type declaration."""
