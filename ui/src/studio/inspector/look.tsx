// The look of a link: the colour of its bars and plates in every drawing.
import { useRef } from "preact/hooks";
import type { Bench } from "../bench";
import { COLOURS, digitsOf } from "../colour";
import { set, tell, unset } from "./change";
import { type Path, type Table, word } from "./entries";
import { Section } from "./fields";

const WAYS: Record<string, number> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

export function Look({ bench, path, link }: { bench: Bench; path: Path; link: Table }) {
  return <Section bench={bench} id="insp.look" title={bench.say("insp.look")}>{() => <Swatches bench={bench} path={path} colour={word(link.colour)} />}</Section>;
}

/** The usual colour of lines, those that have names, and any other; arrow keys go from one to the next. */
function Swatches({ bench, path, colour }: { bench: Bench; path: Path; colour: string }) {
  const { say } = bench, own = !(colour in COLOURS) && digitsOf(colour) !== "", names = ["", ...Object.keys(COLOURS)], row = useRef<HTMLSpanElement>(null);
  const pick = (name: string) => void (name === colour || tell(bench, name ? set(bench, path, name) : unset(bench, path)));
  const title = (name: string) => (name ? say(`insp.colour_${name}`) : say("insp.colour_none"));
  const keys = (event: KeyboardEvent) => {
    const all = [...row.current!.children].map((each) => each.querySelector("input") ?? (each as HTMLElement)), way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    all.at((all.indexOf(event.target as HTMLInputElement) + way) % all.length)!.focus();
  };
  return (
    <div class="look">
      <span class="label">{say("insp.colour")}</span>
      <span class="swatches" role="radiogroup" aria-label={say("insp.colour")} ref={row} onKeyDown={keys}>
        {names.map((name) => (
          <button
            key={name} type="button" class={name && "own"} role="radio" aria-checked={name === colour} aria-label={title(name)} title={title(name)} style={name ? { "--own": COLOURS[name] } : undefined}
            tabIndex={name === (own ? "" : colour) ? 0 : -1} onClick={() => pick(name)}
          ><i class={name ? "" : "usual"} /></button>
        ))}
        <label class={own ? "custom own on" : "custom"} title={say("insp.colour_custom")} style={own ? { "--own": colour } : undefined}>
          <i />
          <input type="color" value={own ? colour : COLOURS.blue} aria-label={own ? say("insp.colour_custom_is", { colour }) : say("insp.colour_custom")} onChange={(event) => pick(event.currentTarget.value)} />
        </label>
      </span>
      <small class="quiet">{own ? colour : title(colour)}</small>
    </div>
  );
}
