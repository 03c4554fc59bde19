"""Parts of Typst files: formulas, the head of the text, the cover, and the style of web pages."""

from __future__ import annotations

from linkwright.equations.latex import ACCENTS, BRACES
from linkwright.equations.notation import Accent, Atom, Bracket, Fraction, Limits, Matrix, Node, Root, Row, Script

_ACCENTS = {
    "dot": "dot",
    "ddot": "dot.double",
    "dddot": "dot.triple",
    "vec": "arrow",
    "overrightarrow": "arrow",
    "bar": "macron",
    "hat": "hat",
    "widehat": "hat",
    "tilde": "tilde",
    "widetilde": "tilde",
}
_SPACES = {",": "thin", ":": "med", ";": "thick", " ": "med", "quad": "quad", "qquad": "wide"}
_STYLES = {"bold": "bold(upright({}))", "slanted bold": "bold({})", "script": "cal({})", "double": "bb({})"}
_ALIGN = {"<": "left", "^": "center", ">": "right"}
_ESCAPED = '\\"'
assert _ACCENTS.keys() == ACCENTS.keys()


def typst(node: Node) -> str:
    """A formula between dollar signs of Typst."""
    match node:
        case Atom():
            return _sign(node)
        case Row(items):
            return " ".join(typst(each) for each in items)
        case Fraction(above, below):
            return f"frac({typst(above)}, {typst(below)})"
        case Root(inside, None):
            return f"sqrt({typst(inside)})"
        case Root(inside, degree) if degree is not None:
            return f"root({typst(degree)}, {typst(inside)})"
        case Script(base, below, above):
            found = '""' if base == Row() else f"lr({typst(base)})" if isinstance(base, Row) else typst(base)
            return found + _scripts(below, above)
        case Limits(Accent(mark, inside), below, None) if mark == "underbrace" and below is not None:
            return f"underbrace({typst(inside)}, {typst(below)})"
        case Limits(Accent(mark, inside), None, above) if mark == "overbrace" and above is not None:
            return f"overbrace({typst(inside)}, {typst(above)})"
        case Limits(base, below, above):
            return f"limits({typst(base)})" + _scripts(below, above)
        case Accent("overline", inside):
            return f"#lw-overline($ {typst(inside)} $)"
        case Accent(mark, inside):
            return f"{mark}({typst(inside)})" if mark in BRACES else f"accent({typst(inside)}, {_ACCENTS[mark]})"
        case Bracket(inside, "(", ")"):
            return f"lr(({typst(inside)}))"
        case Bracket(inside, left, right):
            return f"lr({_delimiter(left)} {typst(inside)} {_delimiter(right)})"
        case Matrix():
            return _matrix(node)
    raise AssertionError(node)


def _scripts(below: Node | None, above: Node | None) -> str:
    under = f"_({typst(below)})" if below is not None else ""
    return under + (f"^({typst(above)})" if above is not None else "")


def _sign(atom: Atom) -> str:
    kind, text = atom.kind, atom.text
    if kind in ("letter", "number"):
        return text
    if kind == "space":
        return _SPACES[text]
    if kind in ("open", "close"):
        return _delimiter(text)
    if kind == "sign":
        return f"\\{text}" if text in "/;,:!" else text
    style = _STYLES.get(kind, "upright({})")
    if len(text) == 1 and text.isascii():
        return style.format(text) if text.isalnum() else f"\\{text}"
    return quoted(text) if kind == "upright" else style.format(quoted(text))


def _delimiter(text: str) -> str:
    return text if text in ("", "|", "‖", "[", "]") else f"\\{text}"


def _matrix(matrix: Matrix) -> str:
    """Cells row by row; equations below each other share one column that is aligned at its marks."""
    if matrix.align == "=":
        rows = "; ".join(" & ".join(_cell(cell) for cell in row) for row in matrix.rows)
        return f"mat(delim: #none, row-gap: #0.6em, {rows})"
    sides = ", ".join(quoted(each) if each else "none" for each in (matrix.left, matrix.right))
    rows = "; ".join(", ".join(_cell(cell) for cell in row) for row in matrix.rows)
    return f"mat(delim: #({sides}), align: #{_ALIGN[matrix.align]}, {rows})"


def _cell(cell: Row) -> str:
    return typst(cell) if cell.items else '""'


def quoted(text: str) -> str:
    """A text as a string of Typst."""
    return '"' + "".join(f"\\{c}" if c in _ESCAPED else c for c in text).replace("\n", " ") + '"'


HEAD = """\
#set document(title: {title}, author: ())
#set page(paper: "a4", margin: (x: 20mm, top: 24mm, bottom: 22mm), numbering: "1", header: context {{
  if here().page() > 1 {{ text(8.5pt, fill: luma(90))[#{running}; #h(1fr) Linkwright] }} }})
#set text(font: {fonts}, size: 10.5pt, lang: {language})
#set par(justify: true, leading: 0.62em, spacing: 0.95em)
#set heading(numbering: none)
#show heading: set block(above: 1.3em, below: 0.7em)
#show heading.where(level: 1): set text(15pt)
#show heading.where(level: 2): set text(12.5pt)
#show heading.where(level: 3): set text(11pt)
#show math.equation: set text(font: {mathematics})
#show math.equation.where(block: true): set block(above: 0.55em, below: 0.55em)
#show math.equation.where(block: true): set align(left)
#show figure: set block(above: 1.1em, below: 1.1em)
#show figure.where(kind: table): set figure.caption(position: top)
#show figure.where(kind: raw): set figure.caption(position: top)
#show figure.where(kind: raw): set block(breakable: true)
#show figure.caption: set text(9.5pt)
#show figure.caption.where(kind: table): set block(sticky: true)
#show figure.caption.where(kind: raw): set block(sticky: true)
#show raw: set text(font: {monospaced})
#show raw.where(block: true): set text(8.3pt)
#show raw.where(block: true): set par(justify: false)
#set table(
  stroke: (x, y) => (top: if y == 0 {{ 0.9pt }} else if y == 1 {{ 0.6pt }} else {{ 0pt }}),
  inset: (x: 4.5pt, y: 3pt))
#let lw-is-html = sys.inputs.form == "html"
#let lw-thin = not lw-is-html and {thin}
#let lw-bold(body) = if not lw-thin {{ body }} else {{
  show regex("[\\u{{2e80}}-\\u{{9fff}}\\u{{f900}}-\\u{{faff}}\\u{{ff00}}-\\u{{ffef}}]+"): set text(stroke: 0.024em)
  body }}
#show strong: lw-bold
#show heading: lw-bold
#let lw-title(body) = if lw-is-html {{ html.elem("h1", attrs: (class: "title"))[#body] }} else {{
  align(center, {{ set par(justify: false); text(19pt, weight: "bold", lw-bold(body)) }}) }}
#let lw-under(body) = if lw-is-html {{ html.elem("p", attrs: (class: "under"))[#body] }} else {{
  align(center, {{ set par(justify: false); body }}) }}
#let lw-table(columns, align, kind, head, ..cells) = {{
  set text(8.8pt)
  set par(justify: false)
  if lw-is-html {{ html.elem("div", attrs: (class: kind))[#table(
    columns: columns.len(), table.header(..head), ..cells)] }} else {{
    table(columns: columns, align: align, table.header(..head), ..cells, table.hline(stroke: 0.9pt)) }}
}}
#let lw-row(body, number) = block(width: 100%, above: 0.6em, below: 0.6em, breakable: false,
  grid(columns: (1fr, auto), column-gutter: 6pt, align: (left + horizon, right + horizon),
    pad(left: 1.2em, body), number))
#let lw-html(body, number) = html.elem("div", attrs: (class: "formula"))[
  #html.elem("div")[#body] #html.elem("span")[#number]]
#let lw-formula(body, number) = {{
  if lw-is-html {{ lw-html(body, number) }} else {{ lw-row(body, number) }}
}}
#let lw-wide(body, number) = {{
  if lw-is-html {{ lw-html(body, number) }} else {{
    lw-row(layout(room => {{
      let wide = measure(body).width
      if wide > room.width {{
        scale(100% * (room.width / wide), origin: left, reflow: true, body)
      }} else {{ body }}
    }}), number)
  }}
}}
#let lw-picture(svg, share, high) = {{
  if lw-is-html {{ image(bytes(svg), format: "svg", width: share * 100%) }} else {{
    image(bytes(svg), format: "svg", width: share * 170mm, height: high * 1mm)
  }}
}}
#let lw-pictures(..images) = {{
  if lw-is-html {{ html.elem("div", attrs: (class: "pictures"))[#images.pos().join()] }} else {{
    align(center, images.pos().map(each => box(each)).join(h(1fr, weak: true)))
  }}
}}
#let lw-need = if not lw-is-html {{
  block(height: 7em, breakable: false, above: 0pt, below: 0pt)
  v(-7em)
}}
#let lw-code(text, lang) = {{
  if lw-is-html {{ raw(text, block: true, lang: lang) }} else {{
    let body = raw(text.replace(regex("\\S{{90}}"), it => it.text + str.from-unicode(8203)), block: true, lang: lang)
    block(width: 100%, inset: 6pt, fill: luma(246), stroke: (left: 2pt + luma(190)), align(left, body)) }}
}}
#let lw-overline(body) = if lw-is-html {{ math.accent(body, math.macron) }} else {{ math.overline(body) }}
#let lw-url(url, body) = if lw-is-html {{ link(url, body) }} else {{ text(fill: rgb("#0b57a4"), link(url, body)) }}
#let lw-dots(words) = {{
  if lw-is-html {{ html.elem("em", attrs: (class: "dots"))[#words] }} else {{
    for each in words.clusters() {{ box({{ each; place(bottom + center, dy: 0.42em, text(0.55em)[●]) }}) }} }}
}}
#let lw-rule = if lw-is-html {{ html.elem("hr") }} else {{ line(length: 100%, stroke: 0.5pt) }}
#let lw-quote(body) = if lw-is-html {{ html.elem("blockquote")[#body] }} else {{
  block(width: 100%, inset: (left: 1.2em, y: 3pt), stroke: (left: 2pt + luma(190)), body) }}
#let lw-small(body) = if lw-is-html {{ html.elem("p", attrs: (class: "small"))[#body] }} else {{
  par(text(8.8pt, body)) }}
#let lw-source(number, body) = if lw-is-html {{ html.elem("p", attrs: (class: "entry"))[#number #body] }} else {{
  grid(columns: (2.2em, 1fr), number, body) }}
#let lw-note(body) = {{
  if lw-is-html {{ html.elem("p", attrs: (class: "note"))[#body] }} else {{
    block(width: 100%, inset: 7pt, fill: luma(244), stroke: (left: 2pt + rgb("#c8501e")), body) }}
}}
"""
COVER = """\
#let lw-cover(kind, title, above, rows, below, logo) = {
  if lw-is-html {
    html.elem("div", attrs: (class: "cover"))[
      #if logo != none { html.elem("div")[#logo] }
      #html.elem("div", attrs: (class: "above"))[#above.join(linebreak())]
      #html.elem("p", attrs: (class: "kind"))[#kind]
      #html.elem("h1", attrs: (class: "title"))[#title]
      #table(columns: 2, ..rows.flatten())
      #html.elem("p")[#below]
    ]
  } else {
    page(numbering: none, header: none)[
      #set par(justify: false)
      #set align(center)
      #v(0.6fr)
      #if logo != none { logo; v(0.3fr) }
      #for each in above { text(16pt, each); linebreak() }
      #v(1fr)
      #text(28pt, weight: "bold", tracking: 0.12em, lw-bold(kind))
      #v(0.5fr)
      #text(19pt, weight: "bold", lw-bold(title))
      #v(1.2fr)
      #set text(13pt)
      #box(width: 78%, grid(columns: (auto, 1fr), column-gutter: 1em, row-gutter: 1.1em,
        ..rows.map(((name, value)) => (
          align(left + bottom, name),
          block(width: 100%, stroke: (bottom: 0.6pt), inset: (bottom: 4pt), outset: 0pt, align(center, value))
        )).flatten()))
      #v(1fr)
      #below
      #v(0.4fr)
    ]
    counter(page).update(1)
  }
}
"""
#: What a web page has in addition to its own style.
STYLE = """\
<style>body{font:16px/1.55 "Noto Serif","Libertinus Serif","DejaVu Serif","Noto Serif CJK SC","Songti SC",serif;\
max-width:52rem;margin:2rem auto;padding:0 1rem;color:#1c2733;background:#fff}table{border-collapse:collapse;\
font-size:.84rem;margin:.4rem auto}th,td{padding:.2rem .55rem;text-align:left}th{border-top:2px solid;\
border-bottom:1px solid}.title,.under{text-align:center}tbody tr:last-child td{border-bottom:2px solid}\
figure{margin:1.4rem 0;text-align:center;overflow-x:auto}figure img{max-width:100%;height:auto;display:inline-block\
!important}figcaption{font-size:.9rem;margin:.4rem}\
pre{font-size:.82rem;line-height:1.4;text-align:left;overflow-x:auto;padding:.6rem .8rem;color:#1c2733;\
background:#f4f4f4;border-left:3px solid #bbb}.pictures{display:flex;flex-wrap:wrap;\
justify-content:space-evenly;gap:.6rem}a{color:#0b57a4}.formula{display:flex;justify-content:space-between;align-items:\
center;margin:.2rem 0 .2rem 1.2rem;padding:.15rem 0;overflow:auto hidden}\
.small{font-size:.85rem}.entry{padding-left:2.2em;text-indent:-2.2em;margin:.3rem 0}.dots{font-style:normal;\
text-emphasis:filled dot;text-emphasis-position:under right;-webkit-text-emphasis:filled dot;\
-webkit-text-emphasis-position:under}.cover img{display:block!important;margin:0 auto}\
.cover{text-align:center;min-height:min(90vh,60rem);display:flex;flex-direction:column;\
justify-content:space-evenly;break-after:page}.cover table{font-size:1.05rem}.cover th,.cover td{border:0!important;\
padding:.35rem .8rem}.cover td:last-child{border-bottom:1px solid!important;min-width:14rem;text-align:center}\
.cover .kind{font-size:2.1rem;font-weight:700;letter-spacing:.08em}.cover .above{font-size:1.3rem}\
blockquote{border-left:3px solid #bbb;margin-left:0;padding-left:1rem}\
.note{background:#f4f4f4;border-left:3px solid #c8501e;\
padding:.5rem .8rem}nav ol{padding-left:1.2rem}nav a{color:inherit;text-decoration:none}nav a:hover{text-decoration:\
underline}@media print{figure{break-inside:avoid}}body>div:not(.formula,.note){margin:1em 0}\
@media screen and (prefers-color-scheme:dark){body{color:#dfe5ec;background:#15191e}figure img{background:#fff}\
.note{background:#242a32}a{color:#8cc4ff}}\
@media screen and (max-width:40rem){table:has(th:nth-child(5)){min-width:34rem}\
table:has(th:nth-child(8)){min-width:46rem}}</style>"""
