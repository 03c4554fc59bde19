"""The codes of findings and errors, collected from the calls that create them, and their meanings."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TypeGuard

import linkwright

SOURCE = Path(linkwright.__file__).parent
#: Index of the code among the arguments of calls that report a finding.
PLACES = {
    "Saying": 0,
    "Refused": 3,
    "Finding": 5,
    "finding": 3,
    "error": 4,
    "remark": 3,
    "Remark": 4,
    "_remarks": 4,
    "_refuse": 3,
    "add": 3,
    "_wrong": 2,
    "wrong": 2,
    "ExpressionError": 4,
    "note": 2,
}
SHORT = re.compile(r"[a-z]+(?:-[a-z]+)*")

#: What the codes of findings about files mean, in English and Chinese.
MEANINGS: Mapping[str, tuple[str, str]] = {
    "alias": ("a YAML alias without its anchor, or within it", "YAML 别名没有锚点，或在自己的锚点之内"),
    "ambiguous": ("a text with two meanings", "有两种读法的内容"),
    "angles-for-places": ("angles where lengths are asked for", "应给长度而给了角度"),
    "assembly": ("a dyad without assembly word or drawing", "没有装配词也没有装配图说明杆组的装配方式"),
    "at-odds": ("two contradictory numbers", "两个数互相矛盾"),
    "bad-positions": ("invalid number of positions", "不是位置数"),
    "bad-range": ("invalid range of a dimension", "不是尺寸的变化范围"),
    "bad-tolerance": ("invalid tolerance of answers", "不是答案的容差"),
    "blank": ("a blank in the indentation that is not a space", "缩进中有不是空格的空白"),
    "choice": (
        "mutually exclusive keys, or none of several of which one is required",
        "互相排斥的键名，或必选其一而未给",
    ),
    "circle": ("parameters that refer to each other", "参数互相引用"),
    "coincident": ("coincident points or pins", "本应分开的点或销重合"),
    "conflict": ("markers of an unresolved merge conflict", "合并冲突的标记"),
    "control-character": ("a control character", "文本中的控制字符"),
    "corner": ("a corner of a path passed at speed", "轨迹的拐角以一定速度通过"),
    "count": ("wrong number of values", "值的个数不对"),
    "decimal-comma": ("a comma in a number", "数中的小数逗号"),
    "demand": ("invalid constraint of an optimisation", "不是优化的要求"),
    "depth": ("nested too deeply", "嵌套过深"),
    "documents": ("a second YAML document", "第二个 YAML 文档"),
    "doubtful": ("probably unintended", "可能不是本意"),
    "duplicate": ("a duplicate name", "重复的名称"),
    "duplicate-key": ("a duplicate key", "重复的键名"),
    "empty": ("an empty file", "空文件"),
    "encoding": ("not UTF-8", "不是 UTF-8"),
    "expression": ("invalid expression", "不是表达式"),
    "falling-demand": ("a constraint whose lower bound is above its upper bound", "要求的下限大于上限"),
    "geometry": ("dimensions that do not fit the points of a link", "尺寸与构件的点不符"),
    "goal-twice": ("a duplicate objective", "重复的目标"),
    "key": ("a key that is not text", "键名不是文本"),
    "kind": ("a file of another kind", "另一种文件"),
    "load": ("a load that cannot act as described", "不能这样作用的载荷"),
    "many": ("more findings than are listed", "检查结果过多，没有全部列出"),
    "merge": ("a YAML merge key", "YAML 合并键"),
    "misplaced": ("a key in the wrong place", "键名的位置不对"),
    "missing": ("missing section", "缺少需要的一节"),
    "missing-demand": ("missing demand of a synthesis task", "缺少综合任务需要的要求"),
    "missing-key": ("missing key", "缺少需要的键名"),
    "missing-unit": ("a number without its unit", "数没有单位"),
    "name": ("invalid or reserved name", "不能作名称"),
    "near-name": ("two names that are nearly the same", "两个名称几乎相同"),
    "no-file": ("no such file", "没有这个文件"),
    "no-goal": ("no objective", "没有目标"),
    "no-inertia": ("a mass without its moment of inertia", "有质量而没有转动惯量"),
    "no-limit": ("invalid limit of an output", "不是输出的极限"),
    "no-list": ("expected a list", "需要列表"),
    "no-mass-centre": ("a mass without its centre", "有质量而没有质心"),
    "no-motion": ("a load that never acts, since the output does not move so", "输出没有这样的运动，载荷从不作用"),
    "no-number": ("unknown output or metric", "机构没有的量"),
    "no-section": ("unknown section of a report", "报告没有这一节"),
    "no-source": ("unknown source of a citation", "没有文中引用的参考文献"),
    "no-start": ("a quantity without a value at the start", "起始方案没有这个量的值"),
    "no-tolerance": ("a robust optimisation without tolerances", "稳健优化没有给公差"),
    "not-a-file": ("not a readable regular file", "不是可以读完的文件"),
    "not-a-list": ("expected a list", "需要列表"),
    "not-a-mapping": ("expected a mapping", "需要键和值"),
    "not-a-position": ("invalid position", "不是位置"),
    "not-a-text": ("expected text", "需要文本"),
    "not-connected": ("a link without joints", "构件没有与别的构件相连"),
    "not-finite": ("a number that is not finite", "不是有限的数"),
    "nothing-varies": ("an optimisation without variables", "优化没有变量"),
    "old-key": ("a renamed key; the file is still read", "键已改名，文件照常读取"),
    "one-point": ("a link with a single joint", "只有一个运动副的构件"),
    "quantity": ("invalid quantity", "不是物理量"),
    "range": ("a number out of range", "数超出允许的范围"),
    "read-as": ("a value that is read differently from how it looks", "读法与看起来不同"),
    "reference": ("a name of the wrong kind", "名称不适合所在的位置"),
    "singular": ("a group close to a singular position over the entire cycle", "杆组始终接近奇异位置"),
    "size": ("a file that is too large", "文件过大"),
    "source-twice": ("a duplicate name of a source", "两条参考文献同名"),
    "syntax": ("invalid YAML", "不能作为 YAML 读取"),
    "tab": ("a tab in the indentation", "缩进中有制表符"),
    "table": ("a table whose rows do not fit", "数表的行不合要求"),
    "tag": ("unknown YAML tag", "未知的 YAML 标签"),
    "type": ("wrong type: list, mapping or text", "列表、映射、文本用错"),
    "unit": ("values of different dimensions, or a wrong unit", "值的种类不同，或单位不合"),
    "unknown-demand": ("unknown demand of a synthesis task", "综合任务没有这个要求"),
    "unknown-key": ("unknown key", "未知的键名"),
    "unknown-name": ("unknown name", "模型中没有的名称"),
    "unknown-task": ("unknown synthesis task", "没有这个综合任务"),
    "unknown-unit": ("unknown unit", "未知的单位"),
    "unknown-word": ("not one of the allowed words", "不在可选之列的词"),
    "unlikely": ("an implausible number", "不太可能的数"),
    "unused": ("an unused item", "没有用到的内容"),
    "version": ("an unsupported format version", "本版本不能读取的格式"),
    "wrong-dimension": ("wrong dimension", "物理量的种类不对"),
    "wrong-picture": ("missing or unreadable picture", "没有图片，或无法读取"),
}
#: What the areas of the codes of errors are about.
AREAS: Mapping[str, tuple[str, str]] = {
    "verdicts": ("whether a machine starts, its motor and brake", "机器能否起动，电动机与制动"),
    "balance": ("the command balance", "命令 balance"),
    "beam": ("beams", "梁"),
    "cam": ("the command cam", "命令 cam"),
    "cams": ("cams", "凸轮"),
    "cli": ("usage of the command line", "命令行的写法"),
    "compare": ("the command compare", "命令 compare"),
    "course": ("variants of a task and their grading", "题目的变型与批改"),
    "draw": ("the command draw", "命令 draw"),
    "export": ("exports", "导出"),
    "file": ("output files", "写出的文件"),
    "forces": ("queries of joint forces", "对运动副反力的提问"),
    "gallery": ("the command gallery", "命令 gallery"),
    "gears": ("gear pairs", "齿轮副"),
    "given_instead": ("arguments of a wrong type or out of range", "参数的类型或范围不对"),
    "joints": ("joints", "运动副"),
    "laws": ("motion laws", "运动规律"),
    "loads": ("loads over the cycle", "循环中的载荷"),
    "machine": ("the command machine", "命令 machine"),
    "metrics": ("metrics", "设计指标"),
    "mobility": ("mobility", "自由度"),
    "model": ("model files", "模型文件"),
    "motion": ("positions and cycles", "位置与循环"),
    "names": ("unknown names", "不存在的名称"),
    "optimize": ("optimisation", "优化"),
    "part": ("calculations of machine parts", "零件计算"),
    "picture": ("drawings and animations", "图与动画"),
    "range": ("ranges of the input", "输入的范围"),
    "report": ("reports", "报告"),
    "running": ("steady running: motor and flywheel", "稳定运转：电动机与飞轮"),
    "sheet": ("drawing sheets", "图纸"),
    "solve": ("the command solve", "命令 solve"),
    "studio": ("the studio", "工作室"),
    "study": ("studies, sweeps, sensitivities and comparisons", "研究、扫描、灵敏度与比较"),
    "synthesize": ("synthesis", "综合"),
    "tolerance": ("tolerances", "公差"),
    "validate": ("the command validate", "命令 validate"),
    "variants": ("the command variants", "命令 variants"),
    "worked": ("worked solutions", "计算过程"),
}


@cache
def nodes() -> tuple[tuple[str, ast.AST], ...]:
    """Calls, assignments and declarations of the package, each with the path of its module."""
    return tuple(
        (path.relative_to(SOURCE).as_posix(), node)
        for path in sorted(SOURCE.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Call | ast.Assign | ast.ClassDef | ast.arguments)
    )


def called(node: ast.Call) -> str:
    """The name of a function that is called."""
    return getattr(node.func, "id", getattr(node.func, "attr", ""))


def texts(node: ast.AST | None) -> Iterator[str]:
    """The possible texts of an expression: constants, either side of a condition, entries of tuples."""
    match node:
        case ast.Constant(value=str(text)):
            yield text
        case ast.IfExp(body=one, orelse=other):
            yield from (*texts(one), *texts(other))
        case ast.Tuple(elts=each):
            for inner in each:
                yield from texts(inner)


# findings ---------------------------------------------------------------------------------------
@cache
def of_findings() -> frozenset[str]:
    """The codes of findings about files."""
    return frozenset(code for _path, node in nodes() for code in _noted(node) if SHORT.fullmatch(code))


def _noted(node: ast.AST) -> Iterator[str]:
    match node:
        case ast.Call(args=given, keywords=named):
            place = PLACES.get(called(node), 99)
            if given and any(isinstance(each, ast.Starred) for each in given) and place < 99:
                yield from texts(given[-1])
            elif len(given) > place:
                yield from texts(given[place])
            elif called(node) in ("wrong", "_wrong") and len(given) == 2:
                yield from (text.replace("_", "-") for text in texts(given[1]))
            yield from (text for each in named if each.arg == "code" for text in texts(each.value))
        case ast.Assign(targets=[ast.Name(id="_REFUSED")], value=ast.Dict(values=rows)):
            yield from (text for row in rows if isinstance(row, ast.Tuple) for text in texts(row.elts[-1]))
        case ast.Assign(targets=[target], value=value) if "code" in map(_name, ast.walk(target)):
            yield from texts(value)
        case ast.arguments(args=given, kwonlyargs=only):
            defaults = zip(reversed(given), reversed(node.defaults), strict=False)
            for each, value in (*defaults, *zip(only, node.kw_defaults, strict=True)):
                yield from texts(value) if each.arg == "code" else ()


def _name(node: ast.AST) -> str:
    return node.id if isinstance(node, ast.Name) else ""


def of_calculations() -> dict[str, str]:
    """The codes of findings about calculations and motion programs, with their English sentences."""
    found = {}
    for path, node in nodes():
        match node:
            case ast.Call(args=[ast.Constant(value=str(code)), _key, sentence, _remedy]):
                if called(node) == "fault" and isinstance(message := _resolved(sentence, path), ast.Call):
                    found[code] = next(texts(message.args[-1]))
    return found


@cache
def _constants() -> dict[tuple[str, str], ast.expr]:
    """What is assigned to names of capitals, by module and name; of public names by the name alone as well."""
    found: dict[tuple[str, str], ast.expr] = {}
    for path, node in nodes():
        match node:
            case ast.Assign(targets=[ast.Name(id=name)], value=value) if name.isupper():
                found[path, name] = value
                if not name.startswith("_"):
                    found["", name] = value
    return found


def _resolved(node: ast.AST, path: str) -> ast.AST:
    """The message of a constant; other expressions unchanged."""
    name = _name(node)
    return _constants().get((path, name), _constants().get(("", name), node)) if name else node


# errors -----------------------------------------------------------------------------------------
def of_errors() -> dict[str, list[str]]:
    """Codes of errors that are raised literally, by their areas."""
    found: dict[str, set[str]] = {area: set() for area in AREAS}
    for path, node in nodes():
        for key in _codes_within(node.args[0], path) if _raises(node) and node.args else ():
            if key.partition(".")[0] in AREAS:
                found[key.partition(".")[0]].add(key)
    return {area: sorted(each) for area, each in sorted(found.items())}


def _codes_within(node: ast.AST, path: str) -> Iterator[str]:
    for each in ast.walk(node):
        if isinstance(each, ast.Name) and (message := _resolved(each, path)) is not each:
            yield from _codes_within(message, path)
        if isinstance(each, ast.keyword) and each.arg == "code":
            yield from texts(each.value)


def _raises(node: ast.AST) -> TypeGuard[ast.Call]:
    return isinstance(node, ast.Call) and called(node) in classes()


@cache
def classes() -> frozenset[str]:
    """The names of error classes whose code is that of their message."""
    bases = {node.name: [_name(each) for each in node.bases] for _, node in nodes() if isinstance(node, ast.ClassDef)}
    found = {"LinkwrightError"}
    while more := {name for name, own in bases.items() if found.intersection(own)} - found:
        found |= more
    return frozenset(found - {"ModelError", "QuantityError", "ExpressionError"})
