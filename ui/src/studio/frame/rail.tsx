// The rail of tools at the left.
import { type Bench, TOOLS } from "../bench";

export function Rail({ bench }: { bench: Bench }) {
  return (
    <div class="rail" role="toolbar" aria-orientation="vertical" aria-label={bench.say("tools")}>
      {TOOLS.map((name) => <button key={name} aria-pressed={name === bench.tool.value} onClick={() => (bench.tool.value = name)}>{name}</button>)}
    </div>
  );
}
