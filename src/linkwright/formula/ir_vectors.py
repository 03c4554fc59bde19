"""Vectors of one width as LLVM intermediate representation: their types, constants, and how memory gives them."""

from __future__ import annotations


class Lanes:
    """Types of vectors of so many lanes, and instructions for them."""

    def __init__(self, width: int) -> None:
        self.width = width
        self.vector, self.integers = f"<{width} x double>", f"<{width} x i64>"
        self.mask, self.pointers = f"<{width} x i1>", f"<{width} x ptr>"
        self.all_true = self.same("i1", "true")

    def same(self, kind: str, value: object) -> str:
        """The same constant in all lanes."""
        return f"<{', '.join([f'{kind} {value}'] * self.width)}>"

    def numbers(self) -> str:
        """0, 1, 2, … as a constant vector."""
        return f"<{', '.join(f'i64 {lane}' for lane in range(self.width))}>"

    def spread(self, scalar: str, name: str, kind: str) -> list[str]:
        """Instructions that put a scalar into all lanes of ``name``."""
        vector = f"<{self.width} x {kind}>"
        lanes = f"<{self.width} x i32> zeroinitializer"
        return [
            f"{name}.0 = insertelement {vector} poison, {kind} {scalar}, i32 0",
            f"{name} = shufflevector {vector} {name}.0, {vector} poison, {lanes}",
        ]

    def gather(self, name: str, base: str, offset: str) -> list[str]:
        """The numbers at ``base`` + ``offset``, lane by lane."""
        return [
            f"{name}.at = getelementptr double, ptr {base}, {self.integers} {offset}",
            f"{name} = call {self.vector} @llvm.masked.gather.{self._suffix}({self.pointers} {name}.at, i32 8, "
            f"{self.mask} {self.all_true}, {self.vector} zeroinitializer)",
        ]

    @property
    def _suffix(self) -> str:
        return f"v{self.width}f64.v{self.width}p0"
