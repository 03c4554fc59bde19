"""Everything that a reader of Chinese sees is Chinese: titles, names that the program gives, findings, refusals."""

import re
from pathlib import Path

import pytest

import linkwright as lw
from linkwright import gallery, words
from linkwright.cli import main
from linkwright.cli.commands.gallery import _heading
from linkwright.plot.diagrams.diagram_by_name import kinds
from linkwright.words.titles import CHINESE

#: Words that stay: identifiers of commands, options, files, units, symbols.
LATIN = re.compile(r"[A-Za-z][A-Za-z']{2,}")


def shown(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    main([*arguments, "--lang", "zh"])
    said = capsys.readouterr()
    return said.out + said.err


def test_every_title_of_the_gallery_is_chinese(capsys: pytest.CaptureFixture[str]) -> None:
    own = {name: lw.load(f"gallery:{name}").name for name in gallery.names()}
    own |= {name: lw.parts.load(f"gallery:{name}").name for name in gallery.calculations()}
    own |= {name: _heading(name)["title"] for name in gallery.tasks()}
    assert set(own.values()) <= set(CHINESE)
    assert all(re.search("[一-鿿]", title) for title in CHINESE.values())
    listed = shown(capsys, "gallery", "list")
    assert all(CHINESE[title] in listed for title in own.values())
    assert CHINESE[own["propped_cantilever"]] in shown(capsys, "beam", "gallery:propped_cantilever")
    main(["beam", "gallery:propped_cantilever"])
    assert own["propped_cantilever"] in capsys.readouterr().out
    assert "铰链式颚式破碎机，六杆" in shown(capsys, "solve", "gallery:jaw_crusher_sixbar", "--steps", "2")
    assert (
        "Hinged jaw crusher"
        in (main(["solve", "gallery:jaw_crusher_sixbar", "--steps", "2"]), capsys.readouterr())[1].out
    )


def test_frame_and_driver_have_their_words(capsys: pytest.CaptureFixture[str]) -> None:
    table = shown(
        capsys, "metrics", "gallery:jaw_crusher_sixbar", "--names", "instant_centre", "peak_input_torque"
    )
    assert "机架" in table and "驱动" in table and not re.search(r"\bframe\b|\bdriver\b", table)
    english = (main(["metrics", "gallery:crank_rocker", "--names", "instant_centre"]), capsys.readouterr())[
        1
    ].out
    assert "frame, crank" in english


def test_the_driver_without_a_name_has_its_word(capsys: pytest.CaptureFixture[str]) -> None:
    """Files with one driver give it no name; names that a file gives stay as they are."""
    said = shown(capsys, "structure", "gallery:jaw_crusher_sixbar")
    assert "铰链式颚式破碎机，六杆" in said and not re.search("driver|Hinged", said)
    several = shown(capsys, "structure", "gallery:excavator")
    assert all(name in several for name in lw.load("gallery:excavator").drivers)


BASE = (gallery.file("crank_rocker")).read_text(encoding="utf-8")
DAMAGES = [
    ("length", "lenght"),
    ("mm", "mn"),
    ("rad/s", ""),
    ("links:", "links: 3\nlinkz:"),
    ("[O1, A]", "[O1]"),
    ("[A, B]", "[A, A]"),
    ("about: O1", "about: O9"),
    ("turn: crank", "turn: crnk"),
    ("turn: crank", "turn: crank, slide: x"),
    ("assembly: {B: left}", "assembly: {B: lft}"),
    ("format: 1", "format: 7"),
    ("frame:", "fram:"),
    ("driver:", "drivr:"),
    ("{", "{{"),
    ("points:", "\tpoints:"),
    (": ", ":"),
]
KNOWN = set(
    re.findall(
        r"\w+",
        "yaml format name frame points links crank rocker coupler length also lengths angle assembly driver drivers "
        "turn slide about speed start joints loads gravity cycle parameters drawing mass inertia centre position "
        "table law relative left right forward backward link duration from turns mm deg rpm rad kind guide block "
        "through direction offset purpose source expected synthesis damaged linkz fram drivr crnk lft lenght linkage "
        "null none mn report optimize optimise",
    )
)


def foreign(text: str, path: Path) -> set[str]:
    """Latin words that are no identifiers of a model, in what is said of a file (its path left out)."""
    return {
        word.lower() for word in LATIN.findall(text.replace(str(path), "").replace(path.name, ""))
    } - KNOWN


@pytest.mark.parametrize("number", range(len(DAMAGES)))
def test_findings_of_damaged_files_hold_no_english(
    number: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    old, new = DAMAGES[number]
    if old not in BASE:
        pytest.skip("the model has no such text")
    path = tmp_path / "damaged.yaml"
    path.write_text(BASE.replace(old, new, 1), encoding="utf-8")
    said = shown(capsys, "check", str(path))
    quoted = {*LATIN.findall(BASE.replace(old, new, 1)), *lw.json_schema()["properties"]}
    assert foreign(said, path) - {word.lower() for word in quoted} == set(), said


@pytest.mark.parametrize(
    "arguments",
    [
        ["solve", "gallery:crank_rocker", "--at", "30"],
        ["solve", "gallery:crank_rocker", "--at", "30 kg"],
        ["solve", "gallery:crank_rocker", "--columns", "xyz"],
        ["solve", "gallery:crank_rocker", "--steps", "0"],
        ["solve", "gallery:nothing_like_it"],
        ["study", "gallery:crank_rocker", "--vary", "crank.lenth=1..2 m:2"],
        ["study", "gallery:crank_rocker", "--vary", "crank.length=1..2 kg:2"],
        ["metrics", "gallery:crank_rocker", "--names", "peak_torque"],
        ["compare", "gallery:crank_rocker", "gallery:kite", "--of", "jaw"],
        ["export", "gallery:crank_rocker", "--output", "a.xyz"],
        ["export", "gallery:crank_rocker", "--output", "a.csv", "--curve", "spline"],
        ["machine", "gallery:crank_rocker", "--fluctuation", "0"],
        ["balance", "gallery:excavator", "--radius", "10mm"],
        ["draw", "gallery:crank_rocker", "--paths", "Q", "--output", "a.svg"],
        ["draw", "gallery:crank_rocker", "--overlay", "limitz", "--output", "a.svg"],
        ["draw", "gallery:crank_rocker", "--output", "a.svg", "--width", "3"],
        ["plot", "gallery:crank_rocker", "--kind", "torqe", "--output", "a.svg"],
        ["plot", "gallery:crank_rocker", "--kind", "reactions", "--output", "a.svg"],
        ["animate", "gallery:crank_rocker", "--output", "a.xyz"],
    ],
)
def test_refusals_hold_no_english(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    said = shown(capsys, *arguments)
    assert re.search("[一-鿿]", said), said
    model = {word.lower() for name in ("crank_rocker", "kite", "excavator") for word in LATIN.findall(
        (gallery.file(name)).read_text(encoding="utf-8"))}  # fmt: skip
    own = {word.lower() for each in arguments for word in LATIN.findall(each)}
    names = {word for name in [*lw.metrics.METRICS, *gallery.names(), *kinds()] for word in name.split("_")}
    known = (
        KNOWN
        | model
        | own
        | names
        | {"linkwright", "help", "gallery", "travel", "point", "flywheel", "faded"}
    )
    left = {
        word.lower() for word in LATIN.findall(re.sub(r"\.\w+|--\w+|\w+_\w+|\w+\.[\w.]+", "", said))
    } - known
    assert left <= {
        "csv",
        "effort",
        "closeness",
        "joint",
        "max",
        "min",
        "rms",
        "output",
        "polyline",
        "spline",
        "degrees",
        "study",
    }, (left, said)


#: Units and symbols of results, roots of names.
SYMBOLS = {"rad", "mm", "min"}


@pytest.mark.parametrize(
    "task",
    [
        ["gallery:function_of_three_pairs"],
        ["slider_crank", "stroke=397.5 mm", "rod_ratio=3.55", "offset_ratio=0.305", "--mass", "2"],
        ["quick_return", "quick_return_ratio=1.5", "frame=300 mm", "stroke=400 mm", "rod=300 mm"],
        ["drag_link", "quick_return_ratio=1.8", "frame=100 mm"],
        ["toggle", "force_ratio=20", "distance=5 mm", "stroke=100 mm"],
        ["straight_line", "length=100 mm"],
        [
            "motion",
            "unit=mm",
            "angle_unit=deg",
            "poses=[[0, 0, 0], [40, 10, 30], [60, 40, 50], [70, 70, 80]]",
        ],
    ],
    ids=lambda task: task[0].removeprefix("gallery:"),
)
def test_synthesis_is_chinese(task: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    said = shown(capsys, "synthesize", *task)
    assert "方案 1：" in said and set(LATIN.findall(said)) <= SYMBOLS, said


def test_names_of_synthesis_have_words() -> None:
    """Counts and values are keys of mappings in the code: each has its word."""
    known = words.catalogue("synthesis_names", "zh")
    root = Path(lw.__file__).parent / "synthesis"
    code = "".join(path.read_text(encoding="utf-8") for path in root.rglob("*.py"))
    with_units = set(re.findall(r'"(\w+) \[(?:rad|m)\]":', code)) - {"lengths", "points"}
    counted = set(re.findall(r'(?:counts=|counts = |"exact_path", [^\n]*|target, )\{"(\w+)": ', code))
    assert len(with_units) > 12 and len(counted) > 5
    assert (with_units | counted) - {"transmission_angle_min", "longest", "extent"} <= set(known)
    assert all(re.search("[一-鿿]", text) for text in known.values())


MISSING = """format: 1
frame: {points: {O1: [0 m, 0 m]}}
links: {crank: {length: 1 m}}
joints: {g: {kind: prismatic, guide: frame}, c: {kind: cam}, w: {kind: weld}, r: {kind: rack}}
loads: {s: {kind: spring}, f: {kind: force}}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""


@pytest.mark.parametrize(
    "text", [MISSING, *(f"format: 1\nkind: {kind}\n" for kind in ("beam", "belt", "vibration", "mounts"))]
)
def test_missing_keys_are_said_in_chinese(
    text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The key with YAML's colon, its quantity or form, and an example; the English description stays English."""
    path = tmp_path / "missing.yaml"
    path.write_text(text, encoding="utf-8")
    said = [line for line in shown(capsys, "check", str(path)).splitlines() if "缺少键" in line]
    assert said
    for line in said:
        key, remedy = re.search("缺少键“(.*?)”；(.*)", line).groups()  # type: ignore[union-attr]
        assert remedy.startswith(f"请补上 {key}: ") and not re.search("[A-Za-z]{2,} [a-z]{2,}", remedy), line
    main(["check", str(path)])
    assert "the key" in capsys.readouterr().out


def test_titles_of_published_cases_are_chinese(capsys: pytest.CaptureFixture[str]) -> None:
    from linkwright.validation.published import from_data

    assert {each.case for each in from_data()} <= set(CHINESE)
    said = shown(capsys, "validate", "--case", "conveyor")
    assert (
        "摆动式输送机，外极限位置：rocker.angle：所印" in said and "反余弦" in said and "conveyor" not in said
    )


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["grade", "no/key.json", "no.csv"], "没有这个文件或文件夹"),
        (["metrics", "gallery:change_point_fourbar", "--steps", "6"], "极限位置            rocker 最小"),
        (
            ["study", "gallery:slider_crank_offset", "--vary", "rod.length=0.01..0.2m:2", "--steps", "4"],
            "无法装配",
        ),
        (["draw", "gallery:crank_rocker", "--output", "d.xyz"], ".svg、.png、.pdf"),
        (["studio", "--no-browser", "--port", "99999"], "端口 99999 不能使用：端口为 0 到 65535"),
        (["optimize", "gallery:crank_rocker"], "带连杆点的曲柄摇杆机构 没有"),
        (["gallery", "shw"], "可选：list、show、copy"),
        (["solve", "gallery:crank_rocker", "--at", "1,5 deg"], "--at：“1,5 deg”用了逗号作小数点"),
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)
def test_results_and_reasons_are_chinese(
    arguments: list[str], part: str, capsys: pytest.CaptureFixture[str]
) -> None:
    said = shown(capsys, *arguments)
    assert part in said and not re.search("[a-z]{3,} [a-z]{2,} [a-z]{2,}", said), said
