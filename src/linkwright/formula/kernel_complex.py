"""How kernels write complex numbers: ``LANES`` of them at once, as a pair of vectors."""

from __future__ import annotations

from typing import Any

from linkwright.formula.late_import import ir


class ComplexWriter:
    """How a writer of kernels writes complex numbers."""

    b: Any
    vector: Any
    lanes: int
    flags: tuple[str, ...]
    _as: Any

    def _is_pair(self, value: Any) -> bool:
        return isinstance(value.type, ir.LiteralStructType)

    def _parts(self, value: Any) -> tuple[Any, Any]:
        """Real and imaginary part; the latter None for what is real."""
        if self._is_pair(value):
            return self.b.extract_value(value, 0), self.b.extract_value(value, 1)
        return self._as(value, self.vector), None

    def _pair(self, real: Any, imaginary: Any) -> Any:
        empty = ir.Constant(ir.LiteralStructType([self.vector, self.vector]), ir.Undefined)
        return self.b.insert_value(self.b.insert_value(empty, real, 0), imaginary, 1)

    def _complex_operation(self, name: str, left: Any, right: Any) -> Any:
        (a, b), (c, d) = self._parts(left), self._parts(right)
        if name == "Mult":
            if b is None or d is None:
                pair, factor = ((c, d), a) if b is None else ((a, b), c)
                return self._pair(self._fmul(pair[0], factor), self._fmul(pair[1], factor))
            real = self._fsub(self._fmul(a, c), self._fmul(b, d))
            return self._pair(real, self._fadd(self._fmul(a, d), self._fmul(b, c)))
        if name == "Sub":
            c, d = self._negative(c), None if d is None else self._negative(d)
        elif name != "Add":
            raise TypeError(name)
        return self._pair(self._fadd(a, c), b if d is None else d if b is None else self._fadd(b, d))

    def _negative(self, value: Any) -> Any:
        if self._is_pair(value):
            a, b = self._parts(value)
            return self._pair(self._negative(a), self._negative(b))
        return self.b.fneg(value, flags=self.flags)

    def _fadd(self, a: Any, b: Any) -> Any:
        return self.b.fadd(a, b, flags=self.flags)

    def _fsub(self, a: Any, b: Any) -> Any:
        return self.b.fsub(a, b, flags=self.flags)

    def _fmul(self, a: Any, b: Any) -> Any:
        return self.b.fmul(a, b, flags=self.flags)

    def _entry(self, address: Any, entry: Any, half: int) -> Any:
        index_type = entry.type
        place = self.b.mul(entry, ir.Constant(index_type, 2 * self.lanes))
        place = self.b.add(place, ir.Constant(index_type, half * self.lanes))
        return self.b.gep(address.value, [place], source_etype=address.entry)

    def _call_fetch(self, address: Any, entry: Any) -> Any:
        halves = (self.b.load(self._entry(address, entry, k), align=8, typ=self.vector) for k in (0, 1))
        return self._pair(*halves)

    def _call_put(self, address: Any, entry: Any, value: Any) -> None:
        for k, part in enumerate(self._parts(value)):
            self.b.store(part, self._entry(address, entry, k), align=8)

    def _call_square(self, value: Any) -> Any:
        a, b = self._parts(value)
        return self._fadd(self._fmul(a, a), self._fmul(b, b))

    def _call_inverse(self, value: Any) -> Any:
        one = ir.Constant(self.vector, [1.0] * self.lanes)
        size = self.b.fdiv(one, self._call_square(value), flags=self.flags)
        a, b = self._parts(value)
        return self._pair(self._fmul(a, size), self._negative(self._fmul(b, size)))

    def _call_choose(self, test: Any, yes: Any, no: Any) -> Any:
        (a, b), (c, d) = self._parts(yes), self._parts(no)
        return self._pair(self.b.select(test, a, c), self.b.select(test, b, d))
