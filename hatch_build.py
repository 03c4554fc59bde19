"""Compiles the translations while the package is built or installed."""

from pathlib import Path
from typing import Any

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from hatchling.builders.hooks.plugin.interface import BuildHookInterface


def compile_translations(source: Path) -> None:
    """Writes the compiled catalogue next to every one that is newer."""
    for path in source.glob("linkwright/locale/*/LC_MESSAGES/linkwright.po"):
        compiled = path.with_suffix(".mo")
        if not compiled.exists() or compiled.stat().st_mtime < path.stat().st_mtime:
            with path.open("rb") as text, compiled.open("wb") as binary:
                write_mo(binary, read_po(text))


class CompiledTranslations(BuildHookInterface[Any]):
    """The step of the build."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compiles before the files are collected."""
        compile_translations(Path(self.root) / "src")
