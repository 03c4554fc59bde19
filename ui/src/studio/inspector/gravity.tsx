// Gravity: its size and where it pulls.
import type { Bench } from "../bench";
import { set } from "./change";
import { type Table } from "./entries";
import { Quantity } from "./fields";
import { gravityOf } from "./loads_list";

export function GravityFields({ bench, entries }: { bench: Bench; entries: Table }) {
  const { say } = bench, field = gravityOf(entries);
  if (!field) return null;
  const [x, y] = field, size = Math.hypot(x, y), angle = Math.atan2(y, x);
  const write = (far: number, turn: number) => {
    const part = (each: number) => `${Number(each.toPrecision(7)) || 0} m/s²`;
    return set(bench, ["gravity"], [part(tidy(far * Math.cos(turn), far)), part(tidy(far * Math.sin(turn), far))]);
  };
  const take = (work: (value: number) => Promise<string | null>, unit: RegExp) => async (text: string) => {
    const value = Number.parseFloat(text);
    return Number.isFinite(value) && unit.test(text) ? work(value) : say("insp.no_quantity", { text });
  };
  return (
    <>
      <Quantity label={say("insp.size_of")} value={`${Number(size.toPrecision(7))} m/s²`} unit="m/s²" set={take((value) => write(value, angle), /^[-+.\d]+ ?m\/s²$/)} />
      <Quantity label={say("insp.direction")} value={`${Number(((angle * 180) / Math.PI).toPrecision(5))} deg`} unit="deg" set={take((value) => write(size, (value * Math.PI) / 180), /^[-+.\d]+ ?(deg|°)$/)} />
    </>
  );
}

const tidy = (part: number, size: number) => (Math.abs(part) < 1e-9 * size ? 0 : part);
