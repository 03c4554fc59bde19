"""Writes the table of published numbers into the page on validation."""

from pathlib import Path

from linkwright.validation.validate import validate

PAGE = Path(__file__).parent / "en" / "validation.md"
BEGIN, END = "<!-- table -->", "<!-- end of table -->"


def main() -> None:
    text = PAGE.read_text("utf-8")
    head, rest = text.split(BEGIN)
    _, tail = rest.split(END)
    PAGE.write_text(f"{head}{BEGIN}\n\n{validate().markdown()}\n\n{END}{tail}", "utf-8")


if __name__ == "__main__":
    main()
