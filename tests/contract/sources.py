"""The package's source files and what they import, read once for each worker."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import linkwright

ROOT = Path(linkwright.__file__).parent
MODULES = sorted(path.relative_to(ROOT) for path in ROOT.rglob("*.py") if path != ROOT / "__init__.py")


def imports(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Line and dotted name of everything imported: at the head, inside functions, for type checkers."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"line {node.lineno}: write absolute imports"
            names = (f"{node.module}.{alias.name}" for alias in node.names)
            yield from ((node.lineno, name) for name in names)
        else:
            yield from imports(node)


@cache
def imports_of(module: Path) -> tuple[tuple[int, str], ...]:
    return tuple(imports(ast.parse((ROOT / module).read_text(encoding="utf-8"))))
