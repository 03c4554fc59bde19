"""What is wrong with questions for learning platforms, by the rules of the platforms' own descriptions.

QTI: "IMS Question & Test Interoperability, Assessment Test, Section and Item Information Model" 2.1 (2012), sections
on items, declarations, text entry, response processing, expressions; "Content Packaging" 1.1.4. Moodle: "Moodle XML
format" and "Embedded Answers (Cloze) question type" of its documentation. PrairieLearn: "Question configuration" and
``pl-number-input`` of its documentation. Nothing here knows how the files are made.
"""

from __future__ import annotations

import base64
import html
import io
import json
import re
import zipfile
from collections.abc import Iterator, Mapping
from html.parser import HTMLParser
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

ITEM, PACKAGE = "http://www.imsglobal.org/xsd/imsqti_v2p1", "http://www.imsglobal.org/xsd/imscp_v1p1"
IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")
NUMBER = re.compile(r"-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
TEMPLATES = {
    f"http://www.imsglobal.org/question/qti_v2p1/rptemplates/{name}"
    for name in ("match_correct", "map_response", "map_response_point")
}
PARTS_OF_ITEM = (
    "responseDeclaration",
    "outcomeDeclaration",
    "templateDeclaration",
    "templateProcessing",
    "stylesheet",
    "itemBody",
    "responseProcessing",
    "modalFeedback",
)
BLOCKS = {"p", "div", "h1", "h2", "h3", "ul", "ol", "dl", "pre", "table", "blockquote", "hr", "address"}
CARDINALITIES = {"single", "multiple", "ordered", "record"}
BASE_TYPES = {
    "identifier",
    "boolean",
    "integer",
    "float",
    "string",
    "point",
    "pair",
    "directedPair",
    "duration",
    "file",
    "uri",
}
NUMERIC = {"integer", "float"}
INSIDE = {"table": {"tbody", "thead", "tfoot", "caption", "col", "colgroup"}, "tbody": {"tr"}, "tr": {"td", "th"}}


# QTI 2.1 ------------------------------------------------------------------------------------------
def package_faults(content: bytes) -> list[str]:
    """Faults of a content package and of its items."""
    package = zipfile.ZipFile(io.BytesIO(content))
    names = set(package.namelist())
    if "imsmanifest.xml" not in names:
        return ["no imsmanifest.xml"]
    root = ElementTree.fromstring(package.read("imsmanifest.xml"))
    faults = _manifest_faults(root, names)
    for each in root.iter(f"{{{PACKAGE}}}resource"):
        href = each.get("href", "")
        if href in names:
            item = ElementTree.fromstring(package.read(href))
            listed = {file.get("href") for file in each}
            faults += [f"{href}: {fault}" for fault in item_faults(item)]
            faults += [
                f"{href}: picture {image.get('src')} is not of the resource"
                for image in item.iter(f"{{{ITEM}}}img")
                if image.get("src") not in listed
            ]
    return faults


def _manifest_faults(root: Element, names: set[str]) -> list[str]:
    faults = []
    if root.tag != f"{{{PACKAGE}}}manifest" or not IDENTIFIER.fullmatch(root.get("identifier", "")):
        faults.append("manifest: root or identifier")
    if [_name(each, PACKAGE) for each in root] != ["metadata", "organizations", "resources"]:
        faults.append("manifest: order of parts")
    told = [root.findtext(f"{{{PACKAGE}}}metadata/{{{PACKAGE}}}{part}") for part in ("schema", "schemaversion")]
    if told != ["QTIv2.1 Package", "1.0.0"]:
        faults.append(f"manifest: schema {told}")
    resources = list(root.iter(f"{{{PACKAGE}}}resource"))
    identifiers = [each.get("identifier", "") for each in resources]
    if len(set(identifiers)) < len(identifiers) or not all(map(IDENTIFIER.fullmatch, identifiers)):
        faults.append("manifest: identifiers of resources")
    listed = {"imsmanifest.xml"}
    for each in resources:
        files = {file.get("href", "") for file in each}
        listed |= files
        if each.get("type") != "imsqti_item_xmlv2p1" or each.get("href") not in files:
            faults.append(f"manifest: resource {each.get('identifier')}")
    return faults + [f"manifest: {name} is listed or packed alone" for name in sorted(listed ^ names)]


def _name(element: Element, space: str) -> str:
    return element.tag.removeprefix(f"{{{space}}}")


class _Item:
    """An item's variables, and the types of its expressions."""

    def __init__(self, root: Element) -> None:
        self.faults: list[str] = []
        self.of: dict[str, dict[str, str]] = {"responseDeclaration": {}, "outcomeDeclaration": {}}
        for kind in self.of:
            for each in root.iterfind(f"{{{ITEM}}}{kind}"):
                self._declare(kind, each)

    def _declare(self, kind: str, each: Element) -> None:
        name, base = each.get("identifier", ""), each.get("baseType", "")
        if not IDENTIFIER.fullmatch(name) or any(name in known for known in self.of.values()):
            self.faults.append(f"identifier {name!r} of {kind}")
        if each.get("cardinality") not in CARDINALITIES or base not in BASE_TYPES:
            self.faults.append(f"{name}: cardinality or baseType")
        self.of[kind][name] = f"{each.get('cardinality')} {base}"
        allowed = (
            {"correctResponse", "mapping", "areaMapping"}
            if kind == "responseDeclaration"
            else {"defaultValue", "matchTable", "interpolationTable"}
        )
        for part in each:
            if _name(part, ITEM) not in allowed:
                self.faults.append(f"{name}: {_name(part, ITEM)} in {kind}")
            values = [value.text or "" for value in part]
            if each.get("cardinality") == "single" and len(values) != 1:
                self.faults.append(f"{name}: {len(values)} values for a single one")
            if base in NUMERIC and not all(map(NUMBER.fullmatch, values)):
                self.faults.append(f"{name}: {values} are no numbers")

    def type_of(self, each: Element) -> str:
        """Cardinality and base type of an expression; a fault where its operands do not fit."""
        operands = [self.type_of(part) for part in each]
        numbers = all(one.startswith("single ") and one[7:] in NUMERIC for one in operands)
        match _name(each, ITEM):
            case "variable":
                return self._known(each, *self.of)
            case "correct":
                return self._known(each, "responseDeclaration")
            case "baseValue":
                if each.get("baseType") in NUMERIC and not NUMBER.fullmatch(each.text or ""):
                    self.faults.append(f"baseValue {each.text!r}")
                return f"single {each.get('baseType')}"
            case "sum" if operands and numbers:
                return "single float" if "single float" in operands else "single integer"
            case "equal" if len(operands) == 2 and numbers:
                self._tolerance(each)
                return "single boolean"
            case name:
                self.faults.append(f"expression {name} with {operands}")
                return "unknown"

    def _known(self, each: Element, *kinds: str) -> str:
        name = each.get("identifier", "")
        found = next((self.of[kind][name] for kind in kinds if name in self.of[kind]), "")
        if not found:
            self.faults.append(f"{_name(each, ITEM)} of the undeclared {name!r}")
        return found

    def _tolerance(self, each: Element) -> None:
        mode, given = each.get("toleranceMode"), each.get("tolerance", "").split()
        if mode not in ("exact", "absolute", "relative") or (mode != "exact" and len(given) not in (1, 2)):
            self.faults.append(f"toleranceMode {mode!r} with tolerance {given}")
        if not all(NUMBER.fullmatch(one) and float(one) >= 0 for one in given):
            self.faults.append(f"tolerance {given}")

    def rules(self, parent: Element) -> None:
        """Response rules within an element; the condition of ``responseIf`` comes first."""
        for each in parent:
            match _name(each, ITEM):
                case "responseCondition":
                    branches = " ".join(_name(part, ITEM) for part in each)
                    if not re.fullmatch(r"responseIf( responseElseIf)*( responseElse)?", branches):
                        self.faults.append(f"responseCondition of {branches!r}")
                    for branch in each:
                        self._branch(branch)
                case "setOutcomeValue" if len(each) == 1:
                    if self._known(each, "outcomeDeclaration") != self.type_of(each[0]):
                        self.faults.append(f"type of the value set for {each.get('identifier')}")
                case name:
                    self.faults.append(f"response rule {name}")

    def _branch(self, branch: Element) -> None:
        parts = list(branch)
        if _name(branch, ITEM) != "responseElse":
            if not parts or self.type_of(parts[0]) != "single boolean":
                self.faults.append("a condition that is no boolean")
            parts = parts[1:]
        rest = Element("rules")
        rest.extend(parts)
        self.rules(rest)


def item_faults(root: Element) -> list[str]:
    """Faults of an assessment item."""
    if root.tag != f"{{{ITEM}}}assessmentItem":
        return [f"root {root.tag}"]
    item = _Item(root)
    rules = {"identifier": r".+", "title": r"(?s:.+)", "adaptive": "true|false", "timeDependent": "true|false"}
    faults = [f"attribute {key}" for key, rule in rules.items() if not re.fullmatch(rule, root.get(key, ""))]
    order = [PARTS_OF_ITEM.index(_name(part, ITEM)) if _name(part, ITEM) in PARTS_OF_ITEM else -1 for part in root]
    if order != sorted(order) or -1 in order or order.count(5) != 1 or order.count(6) > 1:
        faults.append("order of the item's parts")
    asked = [each.get("responseIdentifier", "") for each in root.iter(f"{{{ITEM}}}textEntryInteraction")]
    if sorted(asked) != sorted(item.of["responseDeclaration"]):
        faults.append(f"asked {asked}, declared {sorted(item.of['responseDeclaration'])}")
    faults += [
        f"text entry into a {kind}"
        for kind in item.of["responseDeclaration"].values()
        if kind not in ("single float", "single integer", "single string")
    ]
    for body in root.iterfind(f"{{{ITEM}}}itemBody"):
        faults += _body_faults(body)
    for processing in root.iterfind(f"{{{ITEM}}}responseProcessing"):
        if processing.get("template", next(iter(TEMPLATES))) not in TEMPLATES:
            faults.append(f"template {processing.get('template')}")
        item.rules(processing)
    return faults + item.faults


def _body_faults(body: Element) -> Iterator[str]:
    if (body.text or "").strip() or any((each.tail or "").strip() for each in body):
        yield "text outside a block"
    for each in body:
        if _name(each, ITEM) not in BLOCKS:
            yield f"{_name(each, ITEM)} in the body"
    for each in body.iter():
        name = _name(each, ITEM)
        for part in each:
            inner = _name(part, ITEM)
            if (name in INSIDE and inner not in INSIDE[name]) or (name == "p" and inner in BLOCKS):
                yield f"{inner} in {name}"
        if name == "img" and not (each.get("src") and each.get("alt") is not None):
            yield "img without src or alt"


# Moodle -------------------------------------------------------------------------------------------
ENDED = re.compile(r"\{(\d*):(\w+):((?:[^{}\\]|\\.)*)\}")
ANSWER = re.compile(rf"(=|%(-?\d+(?:\.\d+)?)%)({NUMBER.pattern}):({NUMBER.pattern})(?:#.*)?")


def moodle_faults(content: bytes) -> list[str]:
    """Faults of a question bank of embedded numerical answers."""
    root = ElementTree.fromstring(content)
    if root.tag != "quiz" or [each.tag for each in root] != ["question"] * len(root):
        return ["root or its parts"]
    kinds = [each.get("type") for each in root]
    faults = [] if kinds[:1] == ["category"] and set(kinds[1:]) == {"cloze"} else [f"types {kinds}"]
    place = root[0].findtext("category/text") or ""
    if not re.match(r"\$(course|module|system)\$/", place) or not all(re.split(r"(?<!/)/(?!/)", place)):
        faults.append(f"category {place!r}")
    names = [each.findtext("name/text") or "" for each in root[1:]]
    if not all(names) or len(set(names)) < len(names):
        faults.append(f"names {names}")
    for each in root[1:]:
        faults += _embedded_faults(each)
    return faults


def _embedded_faults(each: Element) -> Iterator[str]:
    text = each.find("questiontext")
    if text is None or text.get("format") not in ("html", "moodle_auto_format", "plain_text", "markdown"):
        yield "questiontext or its format"
        return
    shown = text.findtext("text") or ""
    files = {file.get("name"): file for file in text.iterfind("file")}
    for file in files.values():
        if file.get("encoding") != "base64" or not (file.get("path") or "").startswith("/"):
            yield f"file {file.get('name')}"
        base64.b64decode(file.text or "", validate=True)
    if set(re.findall(r"@@PLUGINFILE@@/([^\"]+)", shown)) != set(files):
        yield f"files {sorted(map(str, files))} are not those shown"
    if not re.fullmatch(r"0(\.\d+)?|1(\.0+)?", each.findtext("penalty") or "0") or (
        each.findtext("hidden") not in (None, "0", "1")
    ):
        yield "penalty or hidden"
    found = ENDED.findall(shown)
    if not found or "{" in ENDED.sub("", shown) or "}" in ENDED.sub("", shown):
        yield "braces"
    for weight, kind, answers in found:
        parts = [ANSWER.fullmatch(html.unescape(one)) for one in re.split(r"(?<!\\)~", answers)]
        if kind not in ("NUMERICAL", "NM") or weight == "0" or None in parts:
            yield f"embedded answer {kind}:{answers}"
            continue
        shares = [100.0 if one[1] == "=" else float(one[2]) for one in parts if one]
        if max(shares) != 100.0 or min(shares) < 0:
            yield f"fractions {shares}"
        if any(float(one[6]) < 0 for one in parts if one):
            yield f"tolerance of {answers}"


# PrairieLearn -------------------------------------------------------------------------------------
INFO = {
    "comment",
    "uuid",
    "type",
    "title",
    "topic",
    "tags",
    "clientFiles",
    "clientTemplates",
    "template",
    "gradingMethod",
    "singleVariant",
    "showCorrectAnswer",
    "partialCredit",
    "options",
    "externalGradingOptions",
    "dependencies",
    "workspaceOptions",
    "sharingSets",
    "sharePublicly",
    "shareSourcePublicly",
}
INPUT = {
    "answers-name",
    "weight",
    "correct-answer",
    "label",
    "suffix",
    "display",
    "comparison",
    "rtol",
    "atol",
    "digits",
    "allow-complex",
    "allow-blank",
    "blank-value",
    "show-help-text",
    "show-placeholder",
    "size",
    "show-correct-answer",
    "allow-fractions",
    "custom-format",
    "placeholder",
    "aria-label",
    "initial-value",
}
ELEMENTS = {"pl-question-panel": set(), "pl-figure": {"file-name"}, "pl-number-input": {"answers-name"}}


class _Page(HTMLParser):
    """Elements of the platform on a question's page, and whether every tag is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.used: list[tuple[str, dict[str, str]]] = []
        self.faults: list[str] = []
        self.feed(text)
        self.close()
        self.faults += [f"{name} is not closed" for name in self.open]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.open.append(tag)
        if tag.startswith("pl-"):
            self.used.append((tag, {key: value or "" for key, value in attrs}))

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"{tag} is closed and was not open")


def question_faults(files: Mapping[str, bytes], answers: set[str], params: set[str]) -> list[str]:
    """Faults of a question's folder, whose server gives these answers and parameters."""
    info = json.loads(files["info.json"])
    faults = [f"key {key}" for key in set(info) - INFO]
    if not {"uuid", "type", "title", "topic"} <= set(info) or info["type"] != "v3":
        faults.append("keys that must be there")
    if not re.fullmatch(r"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", str(info.get("uuid"))):
        faults.append(f"uuid {info.get('uuid')}")
    text = files["question.html"].decode()
    page = _Page(text)
    faults += page.faults
    for tag, given in page.used:
        if tag not in ELEMENTS or not ELEMENTS[tag] <= set(given):
            faults.append(f"{tag} with {sorted(given)}")
        if tag == "pl-number-input":
            faults += [f"attribute {key}" for key in set(given) - INPUT]
            if given.get("comparison", "relabs") not in ("relabs", "sigfig", "decdig"):
                faults.append(f"comparison {given['comparison']}")
            faults += [f"{key} {given[key]}" for key in ("rtol", "atol") if not NUMBER.fullmatch(given.get(key, "0"))]
    names = [given.get("answers-name", "") for tag, given in page.used if tag == "pl-number-input"]
    if len(set(names)) < len(names) or set(names) != answers or not all(map(str.isidentifier, names)):
        faults.append(f"inputs {names}, answers {sorted(answers)}")
    asked = set(re.findall(r"\{\{[#/]?params\.(\w+)\}\}", text))
    return faults + [f"parameter {name}" for name in asked - params]
