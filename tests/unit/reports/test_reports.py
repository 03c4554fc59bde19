"""Reports of every kind of model, in every form; a section that is missing says so, and nothing else is lost."""

import io
import itertools
import re
import zipfile
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.cams.cam import cam_of
from linkwright.core.outputs import Output
from linkwright.equations.latex import latex
from linkwright.errors import LinkwrightError, speaker
from linkwright.files.model_file import json_schema
from linkwright.joints.cam import CamJoint
from linkwright.kinetostatics.forces import reaction_pairs
from linkwright.mechanism.wheels_and_cams import CamShape
from linkwright.pictures.svg import natural_size
from linkwright.reports.document import Figure, Formula, Heading, Paragraph, Table, literal, plain, sentence_with_keys
from linkwright.reports.key_names import MODEL_KEYS
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.numbers import typeset, without_rounding
from linkwright.reports.report import report
from linkwright.reports.section import SECTIONS
from linkwright.reports.sections.reactions import loaded_joints
from linkwright.reports.settings import settings
from linkwright.words import LANGUAGES, _, pgettext, translate
from linkwright.words.message import in_language

typst = pytest.importorskip("typst")
LIGHT = ["task", "structure", "method", "tables", "torque", "limits", "appendix", "references"]
MODELS = ("shaper_quick_return", "triad", "excavator", "truss", "kite")


@pytest.mark.parametrize("name", MODELS)
def test_a_report_of_every_kind_of_machine(name: str) -> None:
    language = LANGUAGES[len(name) % 2]
    found = report(f"gallery:{name}", sections=LIGHT, language=language)
    assert not found.broken
    titles = [plain(b.text) for b in found.document.blocks if isinstance(b, Heading) and b.level == 1]
    assert titles == [translate(SECTIONS[each].title, language) for each in LIGHT]


def test_every_section_has_a_title_and_the_command_knows_all() -> None:
    from linkwright.cli.commands.report import SECTIONS as OFFERED

    assert all(SECTIONS[name].title for name in every(SECTIONS))
    assert list(OFFERED) == sorted(SECTIONS, key=lambda name: SECTIONS[name].rank)


def test_mobility_stands_with_its_numbers_and_both_torques_agree() -> None:
    found = report("gallery:jaw_crusher_sixbar", sections=["structure", "torque"])
    (mobility, *_unused) = [b for b in found.document.blocks if isinstance(b, Formula)]
    assert tuple(map(latex, mobility.sides[1:])) == ("3\\,n - 2\\,p", "3\\cdot 5 - 2\\cdot 7", "1")
    table = next(b for b in found.document.blocks if isinstance(b, Table) and b.label == "torque-both")
    assert len(table.rows) == 24 and all(row[2] == row[3] for row in table.rows)


def test_positions_are_numbered_from_the_limit_position_in_equal_steps_of_the_crank() -> None:
    case = ReportContext(lw.load("gallery:swing_conveyor"), settings({"numbered_from": "rocker max"}), "en")
    numbered = case.numbered
    assert numbered.start is not None and numbered.start.kind == "max"
    inputs = [float(numbered.motion.input[i]) for i in numbered.rows]
    assert inputs[0] == pytest.approx(4.0430566, abs=2e-6)  # 231.650° of the published limit position
    turned = [(b - a) % 6.283185307179586 for a, b in itertools.pairwise(inputs)]
    assert turned == pytest.approx([6.283185307179586 / 24] * 23, abs=1e-9)


def test_an_unknown_element_is_refused_and_the_rest_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    from linkwright.reports.sections import method

    reason = "of an element that is not known"

    def refuse(case: ReportContext, group: object) -> list[tuple[str, str]]:
        raise LinkwrightError(reason)

    monkeypatch.setattr(method, "loops", refuse)
    found = report("gallery:crank_rocker", sections=["task", "method", "limits"])
    assert any(reason in sentence for sentence in found.missing)
    headings = [b.text for b in found.document.blocks if isinstance(b, Heading)]
    assert headings[-1] == _("Limit positions and metrics").translate("en")


def test_an_error_of_the_program_does_not_end_the_report(monkeypatch: pytest.MonkeyPatch) -> None:
    from linkwright.reports.sections import metrics

    def broken(case: ReportContext, rows: object) -> object:
        raise ZeroDivisionError("float division")

    monkeypatch.setattr(metrics, "_quick_return", broken)
    found = report("gallery:crank_rocker", sections=["limits", "structure"])
    assert found.broken and "ZeroDivisionError" in found.missing[0]
    heads = [b.text for b in found.document.blocks if isinstance(b, Heading)]
    assert _("Structure analysis").translate("en") in heads


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["cam_roller", "simple_beam"])
def test_calculations_and_cams_have_reports_beside_machines(name: str) -> None:
    found = report(["gallery:crank_rocker", f"gallery:{name}"], sections=["structure"], language="zh")
    titles = [plain(b.text) for b in found.document.blocks if isinstance(b, Heading) and b.level == 1]
    problem = lw.parts.load(f"gallery:{name}")
    assert titles == [in_language(name, "zh") for name in (lw.load("gallery:crank_rocker").name, problem.name)]
    printed = {
        cell for b in found.document.blocks if isinstance(b, Table) for row in b.rows for cell in map(plain, row)
    }
    chinese = speaker("zh")
    result = problem.solve()
    blocks = (block.table(result.labels) for block in result.blocks(chinese))
    numbers = {plain(typeset(row[1])) for table in blocks for row in table.texts("zh")[1:]}
    assert numbers and numbers <= printed


def test_pdf_html_and_word_hold_the_same_sections() -> None:
    docx = pytest.importorskip("docx")
    sections = ["task", "structure", "method", "drawing"]
    found = report("gallery:crank_rocker", sections=sections)
    assert found.content(".pdf").startswith(b"%PDF")
    page = found.content(".html").decode()
    file = docx.Document(io.BytesIO(found.content(".docx")))
    heads = [p.text.split("  ", 1)[1] for p in file.paragraphs if p.style.name == "Heading 1"]
    assert heads == [SECTIONS[each].title for each in sections]
    assert all(head in page for head in heads)
    assert len(file.tables) == sum(isinstance(b, Table) for b in found.document.blocks)
    formulas = sum(isinstance(b, Formula) for b in found.document.blocks)
    archive = zipfile.ZipFile(io.BytesIO(found.content(".docx"))).read("word/document.xml").decode()
    assert archive.count("<m:oMath ") + archive.count("<m:oMath>") >= formulas > 10


def test_errata_of_the_file_stand_in_the_report() -> None:
    found = report("gallery:swing_conveyor", sections=["errata"])
    (table,) = [b for b in found.document.blocks if isinstance(b, Table)]
    assert any("−0.269782°" in plain(cell) for row in table.rows for cell in row)


GEARED = """
format: 1
name: Geared five-bar
frame: {points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm]}}
links:
  a: {points: [O1, A], length: 60 mm}
  b: {points: [O2, B], length: 70 mm}
  c: {points: [A, C], length: 180 mm, mass: 1 kg, inertia: 0.003 kg·m²}
  d: {points: [B, C], length: 170 mm, mass: 1 kg, inertia: 0.003 kg·m²}
joints:
  mesh: {kind: gear, links: [a, b], radii: [100 mm, 100 mm], phase: 40 deg}
assembly: {C: left}
driver: {turn: a, about: O1, speed: 60 rpm}
gravity: [0, -9.81 m/s²]
"""


def test_gears_appear_with_their_own_formulas_and_no_vector_loop() -> None:
    found = report(lw.loads(GEARED), sections=["structure", "method"])
    assert not found.missing
    sides = [" = ".join(map(latex, b.sides)) for b in found.document.blocks if isinstance(b, Formula)]
    assert sum("overrightarrow" in each for each in sides) == 1  # the dyad's loop alone
    assert any("omega_{2}" in each and "omega_{1}" in each and "overrightarrow" not in each for each in sides)


def test_tables_hold_no_rounding_but_in_residuals() -> None:
    """The shaper's guides carry no couple on pins at their points; its residuals are of the size of rounding."""
    found = report("gallery:shaper_quick_return", sections=["tables", "appendix"]).document.blocks
    tables = [block for block in found if isinstance(block, Table)]
    small = {
        head
        for each in every(tables)
        for head, *cells in zip(each.head, *each.rows, strict=True)
        if any(re.search(r"e-1\d", cell) for cell in cells)
    }
    assert small
    assert all("Δ" in head for head in small), small


def test_results_that_are_nothing_beside_the_largest_of_their_unit_are_zero() -> None:
    force, couple = Output("reaction", "A", "x", "rod"), Output("couple", "guide", on="ram")
    columns = {
        force: np.array([2000.0, 3e-9, -1e-10]),
        couple: np.array([3e-10, np.nan, 0.0]),
        Output("power_residual"): np.array([1e-13, 0.0, 0.0]),
        Output("power"): np.array([500.0, 0.0, 0.0]),
    }
    found = without_rounding(columns)
    assert found[force].tolist() == [2000.0, 3e-9, 0.0]
    assert found[couple][0] == 3e-10  # the largest of its unit
    assert found[Output("power_residual")][0] == 1e-13


@pytest.mark.rotating
def test_what_a_train_does_not_carry_or_does_not_change_is_said_in_one_place() -> None:
    """Two of the three planets are idle and all forces keep their size: no table of one number."""
    found = report("gallery:planetary_two_inputs", sections=["tables", "reactions", "limits"], language="zh")
    peaks, *_unused = [b for b in found.document.blocks if isinstance(b, Table) and b.label == "peaks"]
    told = {plain(row[0]): row[1:] for row in peaks.rows}
    ground = _("{joint} on {link}", joint="O", link=_("frame").translate("zh")).translate("zh")
    assert told[ground] == told["sun_2"] == ("0 N", "")  # 3.6e-13 N by rounding
    assert told["sun_1"][0].startswith("886.8")  # 20 N·m / (24 mm · cos 20°)
    (numbers,) = [b for b in found.document.blocks if isinstance(b, Table) and b.label == "numbers"]
    assert not [row for row in every(numbers.rows) if "10^{-1" in row[3 - 1]]
    constant = _("Constant over the cycle: {values}.", values="|").translate("zh").partition("|")[0]
    said = [b.text for b in found.document.blocks if isinstance(b, Paragraph) and constant in b.text]
    assert any("= 20 N" in each and "= 60 N" in each for each in said)
    heads = [head for b in found.document.blocks if isinstance(b, Table) for head in b.head]
    assert not [head for head in every(heads) if head.startswith("$F_")]
    train = ReportContext(lw.load("gallery:planetary_two_inputs"), settings({}), "en")
    carrying = [("O", "sun"), ("O", "ring"), ("O", "carrier"), *((p, f"planet_{k}") for k, p in enumerate("ABC", 1))]
    assert loaded_joints(train) == [*carrying, ("sun_1", "planet_1"), ("ring_1", "ring")]


def test_residuals_show_two_digits() -> None:
    found = report("gallery:geared_fivebar_double", sections=["appendix"])
    tables = [b for b in found.document.blocks if isinstance(b, Table)]
    cells = [row[k] for b in tables for k, head in enumerate(b.head) if "Δ" in head for row in b.rows]
    assert len(cells) == 48
    assert all(re.fullmatch(r"0|-?\d(\.\d)?e-1\d", plain(cell)) for cell in cells), cells


def test_mobility_of_a_machine_with_gears_racks_and_a_cam_adds_up() -> None:
    found = report("gallery:printing_press", sections=["structure"])
    (mobility, *_unused) = [b for b in found.document.blocks if isinstance(b, Formula)]
    assert tuple(map(latex, mobility.sides[1:])) == ("3\\,n - 2\\,p_{L} - p_{H}", "3\\cdot 12 - 2\\cdot 15 - 5", "1")


def test_positions_over_many_turns_show_the_input_at_many_angles() -> None:
    """Over 24 turns of the sun, 24 positions would all show it at one angle."""
    found = report("gallery:planetary_two_inputs", sections=["tables"])
    table = next(b for b in found.document.blocks if isinstance(b, Table))
    angles = {round(float(row[1]) % 360.0, 1) for row in table.rows}
    assert len(table.rows) == len(angles) == 25
    asked = report("gallery:planetary_two_inputs", sections=["tables"], positions=24)
    assert len(next(b for b in asked.document.blocks if isinstance(b, Table)).rows) == 24


def test_gears_have_their_ratios_and_the_geometry_of_their_teeth() -> None:
    found = report("gallery:planetary_two_inputs", sections=["gears"], language="zh")
    assert not found.missing
    cells = [list(map(plain, row)) for b in found.document.blocks if isinstance(b, Table) for row in b.rows]
    assert ["sun", "24", "48", "45.1052", "52", "43", "3.14159"] in cells  # d, d cos α, d + 2m, d - 2.5m, πm/2
    willis = [tuple(map(latex, b.sides)) for b in found.document.blocks if isinstance(b, Formula)]
    assert (r"\frac{\omega_{2} - \omega_{3}}{\omega_{1} - \omega_{3}}", r"-\frac{1}{3}") in willis


def test_a_section_on_cams_shows_the_machines_own_profile() -> None:
    press = lw.load("gallery:printing_press")
    joint = press.joints["compensating_cam"]
    assert isinstance(joint, CamJoint)
    angles = np.linspace(0.0, 6.28, 200)
    drawn = CamShape.of(joint, press)
    seen = np.abs(drawn.profile(angles) - drawn.centre)
    own = cam_of(press, "compensating_cam").walls[0].contact(angles)
    assert np.abs(own.point) == pytest.approx(seen, abs=1e-12)
    found = report(press, sections=["cams"])
    assert not found.missing
    printed = " ".join(
        plain(cell) for b in found.document.blocks if isinstance(b, Table) for row in b.rows for cell in row
    )
    assert (
        pgettext("cams", "pressure angle, rise").translate("en") in printed
        and _("smallest hollow radius").translate("en") in printed
    )


def test_every_joint_force_has_its_hodograph() -> None:
    crusher = lw.load("gallery:jaw_crusher_sixbar")
    figure = lw.plot(crusher, "hodographs").figure
    drawn = [axes.get_title() for axes in figure.axes if axes.axison]
    wanted = [
        _("{joint}, force on {link}", joint=joint, link=link).translate("en")
        for joint, link in reaction_pairs(crusher)
    ]
    assert drawn == wanted and len(wanted) == 8


def test_a_language_may_have_texts_of_its_own() -> None:
    given = {"title": "Crusher", "zh": {"title": "破碎机", "purpose": "课程设计"}}
    assert settings(given).title == "Crusher" and settings(given, "zh").title == "破碎机"
    with refused("unknown-key", lw.ModelError, key_="titel", offer="title") as caught:
        settings({"zh": {"titel": "x"}})
    assert [each.key for each in caught.value.findings] == ["report.zh.titel"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (r"A price of \$5 and $\unknown{x}$ [[nowhere]] #panic()", r"\unknown"),
        ("typst\n#panic()", "panicked"),
        ("typst\n#let x = ( [ $", "unclosed"),
    ],
)
def test_own_text_that_no_form_can_print_is_shown_as_written_with_the_reason(text: str, told: str) -> None:
    crank = replace(lw.load("gallery:crank_rocker"), report={"text": {"limits": text}})
    found = report(crank, sections=["limits"])
    assert any(told in sentence for sentence in found.missing) and not found.broken
    assert any(
        "panic" in plain(b.text) or "#let" in plain(b.text) for b in found.document.blocks if isinstance(b, Paragraph)
    )
    assert found.content(".pdf").startswith(b"%PDF") and found.content(".docx") and found.content(".html")


def test_a_machine_that_cannot_be_assembled_has_a_report_that_says_so_in_every_section() -> None:
    stretched = lw.loads(lw.dump(lw.load("gallery:crank_rocker"))).with_dimensions({"crank.length": 90.0})
    found = report(stretched)
    assert not found.broken and found.content(".pdf").startswith(b"%PDF")
    told = {sentence.partition(":")[0] for sentence in found.missing}
    assert {SECTIONS[each].title for each in ("drawing", "method", "tables", "curves")} <= told
    assert any(isinstance(b, Formula) and b.label == "mobility" for b in found.document.blocks)


def test_chinese_reports_of_the_gallery_hold_no_english_sentence() -> None:
    whole = ("swing_conveyor", "jaw_crusher_fourbar", "fourbar_lecture", "rack_and_rocker")
    for name in lw.gallery_names():
        sections = ["task", "structure", "errata"] if name in whole else ["task"]
        found = report(f"gallery:{name}", sections=sections, language="zh")
        texts = [plain(b.text) for b in found.document.blocks if isinstance(b, Paragraph | Heading)]
        texts += [
            plain(cell)
            for b in found.document.blocks
            if isinstance(b, Table) and b.label == "errata"
            for row in b.rows
            for cell in row
        ]
        english = [text for text in every(texts) if re.search(r"[a-z]{3,} [a-z]{2,} [a-z]{2,}", text)]
        assert english == []


@pytest.mark.rotating
def test_forces_of_many_joints_stand_in_figures_that_have_room_for_them() -> None:
    model = lw.loads(_chain(9))
    found = report(model, sections=["reactions"]).document.blocks
    figures = [block for block in found if isinstance(block, Figure)]
    # 9 pins of the frame and its crank's, 1 of crank and coupler; 8 pins of three links; the last one: 11 + 24 + 1
    curves, rows = [""] * 3, [""] * 6  # 11, 12, 12, 1; two rows of hodographs: 6, 5, 6, 6, 6, 6, 1
    assert [block.label for block in figures] == ["reactions", *curves, "hodographs", *rows]
    wide, high = natural_size(figures[4].pictures[0][0])
    assert 170.0 * figures[4].pictures[0][1] * high / wide < 115.0  # mm: a page has room for two
    drawn = lw.plot(lw.solve_forces(model, steps=36), "reactions").svg()
    few = lw.plot(lw.solve_forces(model, steps=36), "reactions", of=["O", "G1"]).svg()
    assert natural_size(drawn)[0] == natural_size(few)[0]
    assert natural_size(drawn)[1] > natural_size(few)[1]


def _chain(count: int) -> str:
    """Four-bars that drive one another."""
    places = ", ".join(f"G{i}: [{0.2 * i} m, {0.03 * (-1) ** i} m]" for i in range(1, count + 1))
    links = "".join(
        f"  coupler_{i}: {{points: [P{i - 1}, P{i}], length: 0.21 m, mass: 1 kg}}\n"
        f"  rocker_{i}: {{points: [G{i}, P{i}], length: 0.18 m, mass: 1 kg}}\n"
        for i in range(1, count + 1)
    )
    modes = ", ".join(f"P{i}: left" for i in range(1, count + 1))
    return (
        f"format: 1\nname: chain\nframe: {{points: {{O: [0 m, 0 m], {places}}}}}\n"
        f"links:\n  crank: {{points: [O, P0], length: 0.05 m}}\n{links}"
        f"assembly: {{{modes}}}\ndriver: {{turn: crank, about: O, speed: 60 rpm}}\ngravity: [0, -9.81 m/s²]\n"
    )


PRESS_AND_FEED = """
format: 1
name: Press and feed on one shaft
frame: {points: {O: [0 mm, 0 mm], G: [0 mm, -300 mm], F: [300 mm, 0 mm]}}
links:
  shaft: {points: {O: [0 mm, 0 mm], A: [60 mm, 0 mm], C: [0 mm, 40 mm]}}
  rod: {points: [A, B], length: 260 mm}
  ram: {points: [B]}
  bar: {points: [C, N], length: 240 mm}
  feeder: {points: [N]}
joints:
  press: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: ram, at: B}
  table: {kind: prismatic, guide: frame, through: F, direction: 0 deg, block: feeder, at: N}
assembly: {B: backward, N: forward}
driver: {turn: shaft, about: O, speed: 90 rpm}
"""


@pytest.mark.rotating
@pytest.mark.parametrize("language", LANGUAGES)
def test_a_machine_of_two_outputs_shows_the_motion_of_both(language: str) -> None:
    found = report(lw.loads(PRESS_AND_FEED), sections=["curves"], language=language).document.blocks
    captions = [block.caption for block in found if isinstance(block, Figure)]
    assert [name for caption in captions for name in ("press", "table") if name in caption] == ["press", "table"]
    assert len(captions) == 4  # the angles and the paths
    one = report("gallery:shaper_quick_return", sections=["curves"], language=language).document.blocks
    assert sum(isinstance(block, Figure) for block in one) == 3


def test_lengths_of_joints_and_loads_stand_in_mm_as_those_of_links() -> None:
    text = PRESS_AND_FEED.replace("block: ram, at: B", "block: ram, at: B, offset: 12.5 mm") + (
        "loads:\n  spring: {kind: spring, between: [frame.G, ram.B], stiffness: 2 N/mm, free_length: 0.25 m}\n"
    )
    found = report(lw.loads(text), sections=["task"]).document.blocks
    shown = [cell for block in found if isinstance(block, Table) for row in block.rows for cell in map(plain, row)]
    assert any("12.5 mm" in cell for cell in shown)
    assert any("2000 N/m" in cell and "250 mm" in cell for cell in shown)


def test_what_a_model_gives_stands_in_words_of_the_report() -> None:
    found = report("gallery:printing_press", sections=["task"], language="zh").document.blocks
    shown = [cell for block in found if isinstance(block, Table) for row in block.rows for cell in map(plain, row)]
    given = {
        "turn": "motor",
        "about": "O0",
        "speed": "-15.708 rad/s (-150 rpm)",
        "magnitude": "1500 N",
        "moving": "U.x",
        "cam": "bell_crank",
        "follower": "lower_rack",
        "at": "P",
    }
    for key, value in given.items():
        assert any(f"{MODEL_KEYS[key].translate('zh')}：{value}" in cell for cell in shown), key


def keys_of(shape: Any) -> set[str]:
    """All keys that a part of the schema names."""
    if isinstance(shape, list):
        return set().union(*map(keys_of, shape))
    if not isinstance(shape, dict):
        return set()
    return set(shape.get("properties", ())).union(*map(keys_of, shape.values()))


@pytest.mark.parametrize("section", ["joints", "loads", "driver"])
def test_every_key_of_joints_drivers_and_loads_has_words(section: str) -> None:
    keys = keys_of(json_schema()["properties"][section]) - {"kind"}
    assert len(keys) > 10 and not [key for key in keys if key not in MODEL_KEYS]


LIFTED_OFF = """
format: 1
name: Cam that its follower leaves
frame: {points: {M: [0 mm, -150 mm], C: [0 mm, 0 mm]}}
links:
  pinion: {points: [M], inertia: 0.001 kg·m²}
  cam: {points: [C], inertia: 0.01 kg·m²}
  rod: {points: [P], mass: 2 kg}
joints:
  pair: {kind: gear, links: [pinion, cam], teeth: [20, 40], module: 5 mm}
  way: {kind: prismatic, guide: frame, through: C, direction: 90 deg, block: rod, at: P, friction: 0.1}
  lift: {kind: cam, cam: cam, follower: rod, at: P, touch: roller, base_radius: 40 mm, roller_radius: 10 mm,
    program: [{rise: 30 mm, over: 100 deg, law: cycloidal}, {dwell: 80 deg}, {fall: 30 mm, over: 100 deg},
      {dwell: 80 deg}]}
driver: {turn: pinion, about: M, speed: 600 rpm}
gravity: [0, -9.81 m/s²]
"""


@pytest.mark.rotating
@pytest.mark.parametrize("language", LANGUAGES)
def test_what_solve_notes_stands_in_the_report_too(language: str) -> None:
    forces = lw.solve_forces(lw.solve_motion(lw.loads(LIFTED_OFF), steps=24))
    ((pulls,), (turns,)) = (forces.notes, forces.motion.notes)
    assert (pulls.code, turns.code, turns.values["turns"]) == ("forces.contact_lost_cam", "cycle.turns", 2)
    for section, kind in (("reactions", "forces"), ("tables", "motion")):
        blocks = report(lw.loads(LIFTED_OFF), sections=[section], language=language).document.blocks
        notes = [plain(b.text) for b in blocks if isinstance(b, Paragraph) and b.kind == "note"]
        note = {"forces": pulls, "motion": turns}[kind]
        begin, _unused, _unused2 = note.format(places="|").translate(language).partition("|")
        assert [each.startswith(begin) for each in notes] == [True]
        apart = _(
            "The force in a guide is what presses its parts together; its friction, μ times "
            "that, along the guide, comes on top: {names}",
            names="way",
        ).translate(language)
        texts = [plain(b.text) for b in blocks if isinstance(b, Paragraph)]
        assert (apart in texts) == (section == "reactions")


def test_keys_in_sentences_are_code_and_all_else_is_plain() -> None:
    assert sentence_with_keys("set `fit` to 2*x") == f"set `fit` to 2{literal('*')}x"
