// The chosen curves as a table of positions, and as a file for spreadsheets.
import { effect } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { save } from "../../living";
import type { Session } from "../../session";
import { quantity as quantityText, unitFor } from "../../words";
import type { Bench } from "../bench";
import { largest, type Quantity, sentence, values, wordsOf } from "./quantities";

/** Rows of the table at most; digits in the file. */
const ROWS = 73, DIGITS = 10;

/** Numbers of the positions that a table has. */
function positions(count: number): number[] {
  const step = Math.max(1, Math.ceil(count / (ROWS - 1)));
  return Array.from({ length: Math.ceil(count / step) }, (_, k) => k * step);
}

export function CurveTable({ bench, session, shown }: { bench: Bench; session: Session; shown: Quantity[] }) {
  void session.calm.value;
  const host = useRef<HTMLDivElement>(null), words = wordsOf(bench), { model, data } = session, { x, kind } = model.axis, rows = positions(model.n), lists = shown.flatMap((each) => components(session, each));
  useLayoutEffect(() => effect(() => {
    const i = bench.page.index(session), all = [...host.current!.querySelectorAll("tbody tr")], step = rows[1] ?? 1;
    all.forEach((each, k) => (k === Math.floor(i / step) ? each.setAttribute("aria-current", "true") : each.removeAttribute("aria-current")));
  }), [session]);
  return (
    <div class="curve-table" ref={host} tabIndex={0} role="region" aria-label={bench.say("dock.as_table")}>
      <table>
        <thead><tr><th scope="col">{kind === "time" ? bench.say("dock.time") : data.positions.inputs[0]?.name}</th>{lists.map(({ quantity, part }) => <th scope="col" key={quantity.id + part}>{sentence(quantity, words)}{part}</th>)}</tr></thead>
        <tbody>
          {rows.map((i) => (
            <tr key={i}><th scope="row">{quantityText(x[i], kind, kind === "length" ? model.size : Math.abs(x[i]), 5)}</th>{lists.map(({ quantity, part, row, size }) => <td key={quantity.id + part}>{quantityText(row[i], quantity.kind, size, 5)}</td>)}</tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function components(session: Session, quantity: Quantity): { quantity: Quantity; part: string; row: Float64Array; size: number }[] {
  const size = largest(session, quantity), one = (k: number, part: string) => ({ quantity, part, row: values(session, quantity, k), size });
  return quantity.as === "polar" ? [one(0, " x"), one(1, " y")] : [one(0, "")];
}

/** Every position of the chosen curves, with units in the head. */
export function download(bench: Bench, session: Session, shown: Quantity[]): void {
  const words = wordsOf(bench), { model, data } = session, { x, kind } = model.axis, lists = shown.flatMap((each) => components(session, each));
  const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text), named = (name: string, unit: string) => quoted(unit ? `${name} [${unit}]` : name);
  const along = unitFor(kind, kind === "length" ? model.size : 1), units = lists.map(({ quantity, size }) => unitFor(quantity.kind, size));
  const head = [named(kind === "time" ? bench.say("dock.time") : (data.positions.inputs[0]?.name ?? ""), along.symbol), ...lists.map(({ quantity, part }, k) => named(sentence(quantity, words) + part, units[k].symbol))];
  const cell = (value: number, factor: number) => (Number.isFinite(value) ? String(Number((value / factor).toPrecision(DIGITS))) : "");
  const lines = Array.from({ length: model.n }, (_, i) => [cell(x[i], along.factor), ...lists.map(({ row }, k) => cell(row[i], units[k].factor))].join(","));
  const stem = bench.desk.name.value.replace(/\.\w+$/, "") || "machine";
  save(new Blob([`\ufeff${[head.join(","), ...lines].join("\n")}\n`], { type: "text/csv" }), `${stem}.curves.csv`);
}
