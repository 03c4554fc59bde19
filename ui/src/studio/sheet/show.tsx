// What is shown over the machine, chosen at the lower right; at the lower left how long its arrows are.
import type { Bench, ShownName } from "../bench";
import { SHOWN } from "../bench";
import type { Board } from "./sheet";
import type { Layers } from "./layers";

/** Signs of quantities; the others are words. */
const SIGNS: Partial<Record<ShownName, string>> = { velocities: "v", accelerations: "a", forces: "F", transmission: "μ" };
const ORDER: ShownName[] = ["velocities", "accelerations", "forces", "loads", "transmission", "paths", "limits", "centres", "names", "dimensions", "reach", "outlines", "grid"];

/** Whether the drawing or its machine has what could be shown. */
function has(bench: Bench, name: ShownName): boolean {
  const { picture } = bench.desk.solved.value, data = bench.session.value?.data;
  const moves = data !== undefined && data.positions.count > 1, masses = Object.keys(picture?.masses ?? {}).length > 0;
  switch (name) {
    case "velocities": case "accelerations": return moves;
    case "forces": return data?.signals.some(({ id }) => id.startsWith("r:")) ?? false;
    case "loads": return Object.keys(picture?.loads ?? {}).length > 0 || (masses && Boolean(picture?.gravity));
    case "transmission": return data?.signals.some(({ id }) => id.startsWith("m:")) ?? false;
    case "paths": return moves && data.points.some(({ fixed }) => !fixed);
    case "limits": return data?.numbers.some(({ kind }) => kind === "range") ?? false;
    case "centres": return masses;
    case "names": case "grid": return true;
    case "dimensions": return Object.keys(picture?.links ?? {}).length > 0;
    case "outlines": return data !== undefined;
    case "reach": return bench.gap.value !== null;
  }
}

export function ShowBar({ bench }: { bench: Bench }) {
  const shown = ORDER.filter((name) => SHOWN.includes(name) && has(bench, name));
  return (
    <div class="show" role="group" aria-label={bench.say("show")}>
      {shown.map((name) => {
        const label = bench.say(`show.${name}`), sign = SIGNS[name];
        return (
          <button key={name} class={name} aria-pressed={bench.shows(name)} aria-label={label} data-tip={sign && label} onClick={() => bench.show(name, !bench.shows(name))}>
            {sign ? <i>{sign}</i> : label}
          </button>
        );
      })}
    </div>
  );
}

/** Arrows of round values at their length. */
export function Scales({ board, layers }: { board: Board; layers: Layers }) {
  const scales = layers.scales.value, { bench } = board;
  if (!scales.length) return null;
  return (
    <ul class="scales" aria-label={bench.say("scale")}>
      {scales.map(({ kind, text, long }) => (
        <li key={kind} class={kind}>
          <i style={{ width: `${long}px` }} />
          {kind === "length" ? text : bench.say(`scale.${kind}`, { value: text })}
        </li>
      ))}
    </ul>
  );
}
