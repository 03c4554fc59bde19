"""The codes of findings and errors: which there are, by the calls that give them, and what those of findings mean."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TypeGuard

import linkwright

SOURCE = Path(linkwright.__file__).parent
#: Where the code stands among the arguments of calls that note a finding.
PLACES = {"Saying": 0,
    "Finding": 5, "finding": 3, "error": 4, "remark": 3, "Remark": 4, "_remarks": 4, "_refuse": 3,
    "add": 3, "_wrong": 2, "wrong": 2, "say": 3, "ExpressionError": 4, "note": 2,
}  # fmt: skip
SHORT = re.compile(r"[a-z]+(?:-[a-z]+)*")

#: What the codes of findings about files mean, in English and Chinese.
MEANINGS: Mapping[str, tuple[str, str]] = {
    "alias": ("a YAML alias without its anchor, or within it", "YAML 别名没有锚点，或在自己的锚点之内"),
    "ambiguous": ("a text with two meanings", "有两种读法的内容"),
    "angles-for-places": ("angles where lengths are asked for", "应给长度而给了角度"),
    "assembly": (
        "neither a word nor a drawing says how a dyad is assembled",
        "没有装配词也没有装配图说明杆组的装配方式",
    ),
    "at-odds": ("two numbers that contradict each other", "两个数互相矛盾"),
    "bad-positions": ("no number of positions", "不是位置数"),
    "bad-range": ("no range to vary a dimension in", "不是尺寸的变化范围"),
    "bad-tolerance": ("no tolerance of answers", "不是答案的容差"),
    "blank": ("a blank in the indentation that is no space", "缩进中有不是空格的空白"),
    "choice": (
        "keys that exclude each other, or none of those of which one is needed",
        "互相排斥的键名，或必选其一而未给",
    ),
    "circle": ("parameters that need each other", "参数互相引用"),
    "coincident": ("points or pins in one place that must be apart", "本应分开的点或销重合"),
    "conflict": ("the marks of a merge that was not finished", "合并冲突的标记"),
    "control-character": ("a character that no text has", "文本中的控制字符"),
    "count": ("another number of values than needed", "值的个数不对"),
    "decimal-comma": ("a comma in a number", "数中的小数逗号"),
    "demand": ("no demand of an optimisation", "不是优化的要求"),
    "depth": ("nested too deeply", "嵌套过深"),
    "documents": ("a second YAML document", "第二个 YAML 文档"),
    "doubtful": ("probably not what is meant", "可能不是本意"),
    "duplicate": ("a name that is given twice", "重复的名称"),
    "duplicate-key": ("a key that is given twice", "重复的键名"),
    "empty": ("an empty file", "空文件"),
    "encoding": ("not UTF-8", "不是 UTF-8"),
    "expression": ("no expression", "不是表达式"),
    "falling-demand": ("a demand whose first bound is above its second", "要求的下限大于上限"),
    "geometry": ("sizes that do not fit the points of a link", "尺寸与构件的点不符"),
    "goal-twice": ("an objective that is given twice", "重复的目标"),
    "key": ("a key that is no text", "键名不是文本"),
    "kind": ("a file of another kind", "另一种文件"),
    "load": ("a load that cannot act as described", "不能这样作用的载荷"),
    "many": ("more findings than are listed", "检查结果过多，没有全部列出"),
    "merge": ("a YAML merge key", "YAML 合并键"),
    "misplaced": ("a key in the wrong place", "键名的位置不对"),
    "missing": ("a section that is needed", "缺少需要的一节"),
    "missing-demand": ("a demand that a task of synthesis needs", "缺少综合任务需要的要求"),
    "missing-key": ("a key that is needed", "缺少需要的键名"),
    "missing-unit": ("a number without its unit", "数没有单位"),
    "name": ("no name, or one that is reserved", "不能作名称"),
    "near-name": ("two names that are nearly the same", "两个名称几乎相同"),
    "no-file": ("no such file", "没有这个文件"),
    "no-goal": ("nothing to minimise or maximise", "没有目标"),
    "no-inertia": ("a mass without its moment of inertia", "有质量而没有转动惯量"),
    "no-limit": ("no limit of an output", "不是输出的极限"),
    "no-list": ("a list is needed", "需要列表"),
    "no-mass-centre": ("a mass without its centre", "有质量而没有质心"),
    "no-motion": (
        "a load that never acts, since the output does not move so",
        "输出没有这样的运动，载荷从不作用",
    ),
    "no-number": ("a number that the machine does not have", "机构没有的量"),
    "no-section": ("no section of a report", "报告没有这一节"),
    "no-source": ("no source that texts could cite", "没有文中引用的参考文献"),
    "no-start": ("a number that the machine has no value of at the start", "起始方案没有这个量的值"),
    "no-tolerance": ("a robust optimisation without tolerances", "稳健优化没有给公差"),
    "not-a-file": ("no file that can be read to its end", "不是可以读完的文件"),
    "not-a-list": ("a list is needed", "需要列表"),
    "not-a-mapping": ("keys with values are needed", "需要键和值"),
    "not-a-position": ("no position", "不是位置"),
    "not-a-text": ("a text is needed", "需要文本"),
    "not-connected": ("a link that nothing connects", "构件没有与别的构件相连"),
    "not-finite": ("a number that is not finite", "不是有限的数"),
    "nothing-varies": ("an optimisation without variables", "优化没有变量"),
    "old-key": (
        "a key that has another name now; the file is read all the same",
        "键已改名，文件照常读取",
    ),
    "one-point": ("a link with a single joint", "只有一个运动副的构件"),
    "quantity": ("no quantity", "不是物理量"),
    "range": ("a number outside of what is allowed", "数超出允许的范围"),
    "read-as": ("a text that is read otherwise than it looks", "读法与看起来不同"),
    "reference": ("a name that does not fit where it stands", "名称不适合所在的位置"),
    "singular": ("a group that is close to a singular position all the time", "杆组始终接近奇异位置"),
    "size": ("a file that is too large", "文件过大"),
    "source-twice": ("a name that two sources have", "两条参考文献同名"),
    "syntax": ("not readable as YAML", "不能作为 YAML 读取"),
    "tab": ("a tab in the indentation", "缩进中有制表符"),
    "table": ("a table whose rows do not fit", "数表的行不合要求"),
    "tag": ("a YAML tag that is not known", "未知的 YAML 标签"),
    "type": ("a list, mapping or text in the place of another", "列表、映射、文本用错"),
    "unit": ("values of different kinds, or a unit that does not fit", "值的种类不同，或单位不合"),
    "unknown-demand": ("a demand that a task of synthesis does not have", "综合任务没有这个要求"),
    "unknown-key": ("a key that is not known", "未知的键名"),
    "unknown-name": ("a name that is not in the model", "模型中没有的名称"),
    "unknown-task": ("no task of synthesis", "没有这个综合任务"),
    "unknown-unit": ("a unit that is not known", "未知的单位"),
    "unknown-word": ("a word that is not among those to choose from", "不在可选之列的词"),
    "unlikely": ("a number that is probably not meant", "不太可能的数"),
    "unused": ("what nothing refers to", "没有用到的内容"),
    "version": ("a format that this version does not read", "本版本不能读取的格式"),
    "wrong-dimension": ("a quantity of another kind than needed", "物理量的种类不对"),
    "wrong-picture": ("no picture, or one that cannot be read", "没有图片，或无法读取"),
}
#: What the areas of the codes of errors are about.
AREAS: Mapping[str, tuple[str, str]] = {
    "balance": ("the command balance", "命令 balance"),
    "beam": ("beams", "梁"),
    "cam": ("the command cam", "命令 cam"),
    "cams": ("cams", "凸轮"),
    "cli": ("the words of a command line", "命令行的写法"),
    "compare": ("the command compare", "命令 compare"),
    "course": ("variants of a task and their grading", "题目的变型与批改"),
    "draw": ("the command draw", "命令 draw"),
    "export": ("exports", "导出"),
    "file": ("files that are written", "写出的文件"),
    "forces": ("questions to joint forces", "对运动副反力的提问"),
    "gallery": ("the command gallery", "命令 gallery"),
    "gears": ("gear pairs", "齿轮副"),
    "given_instead": ("arguments of another type or range", "参数的类型或范围不对"),
    "joints": ("joints", "运动副"),
    "laws": ("motion laws", "运动规律"),
    "loads": ("loads over the cycle", "循环中的载荷"),
    "machine": ("the command machine", "命令 machine"),
    "metrics": ("design numbers", "设计指标"),
    "mobility": ("mobility", "自由度"),
    "model": ("model files", "模型文件"),
    "motion": ("positions and cycles", "位置与循环"),
    "names": ("names that do not exist", "不存在的名称"),
    "optimize": ("optimisation", "优化"),
    "part": ("calculations of machine parts", "零件计算"),
    "picture": ("drawings and animations", "图与动画"),
    "range": ("ranges of the input", "输入的范围"),
    "report": ("reports", "报告"),
    "running": ("steady running: motor and flywheel", "稳定运转：电动机与飞轮"),
    "sheet": ("drawing sheets", "图纸"),
    "solve": ("the command solve", "命令 solve"),
    "studio": ("the studio", "编辑器"),
    "study": ("studies, sweeps, sensitivities and comparisons", "研究、扫描、灵敏度与比较"),
    "synthesize": ("synthesis", "综合"),
    "tolerance": ("tolerances", "公差"),
    "validate": ("the command validate", "命令 validate"),
    "variants": ("the command variants", "命令 variants"),
    "worked": ("worked solutions", "计算过程"),
}


@cache
def nodes() -> tuple[tuple[str, ast.AST], ...]:
    """What calls, assigns or declares in the modules of the package, each with the path of its module."""
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
    """The texts that an expression may be: constants, either side of a condition, entries of tuples."""
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
    """The message that a constant stands for; other expressions as they are."""
    name = _name(node)
    return _constants().get((path, name), _constants().get(("", name), node)) if name else node


# errors -----------------------------------------------------------------------------------------
def of_errors() -> dict[str, list[str]]:
    """Codes of errors that are raised as they stand here, by their areas."""
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
    """The names of the classes of errors that a user can do something about, and whose code is their sentence's."""
    bases = {
        node.name: [_name(each) for each in node.bases]
        for _, node in nodes()
        if isinstance(node, ast.ClassDef)
    }
    found = {"LinkwrightError"}
    while more := {name for name, own in bases.items() if found.intersection(own)} - found:
        found |= more
    return frozenset(found - {"ModelError", "QuantityError", "ExpressionError"})
