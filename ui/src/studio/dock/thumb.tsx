// A linkage as a small picture: bars, plates, pins, ground and guides, its curve over the one that was asked for.
import type { Drawing } from "../desk";
import { hull, line, tenth } from "../../strokes";
import type { Vec } from "../../shapes";

// Size of the picture, its margin, radius of its pins, px.
const WIDE = 200, TALL = 120, EDGE = 16, PIN = 2.6;
/** A curve so many times as large as its linkage does not have to fit. */
const LARGE = 1.8;

interface Props {
  drawing: Drawing;
  curve: Vec[];
  target: Vec[];
}

/** From metres to the picture, so that all places fit. */
function fit(places: Vec[]): (place: Vec) => Vec {
  const xs = places.map(([x]) => x), ys = places.map(([, y]) => y), [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = Math.min((WIDE - 2 * EDGE) / (right - left || 1e-9), (TALL - 2 * EDGE) / (high - low || 1e-9));
  return ([x, y]) => [WIDE / 2 + scale * (x - (left + right) / 2), TALL / 2 - scale * (y - (low + high) / 2)];
}

/** How large a box is around places. */
const reach = (places: Vec[]) => Math.max(...([0, 1] as const).map((axis) => Math.max(...places.map((each) => each[axis])) - Math.min(...places.map((each) => each[axis]))));

export function Thumb({ drawing, curve, target }: Props) {
  const { points, fixed, links, guides } = drawing, own = [...Object.values(points), ...target];
  const place = fit(curve.length && reach(curve) < LARGE * reach(own) ? [...own, ...curve] : own);
  const at = (name: string) => place(points[name]), bodies = Object.entries(links).map(([name, names]) => ({ name, at: names.map(at) }));
  const blocks = guides.map(({ at: block, angle }) => ({ centre: at(block), angle: (-angle * 180) / Math.PI }));
  return (
    <svg class="thumb-picture" viewBox={`0 0 ${WIDE} ${TALL}`} aria-hidden="true">
      {target.length > 1 && <path class="t-target" d={line(target.map(place))} />}
      {curve.length > 1 && <path class="t-curve" d={line(curve.map(place))} />}
      {guides.map(({ on, angle, at: block }, k) => {
        const [x, y] = at(block), [c, s] = [Math.cos(angle), -Math.sin(angle)];
        return <path key={k} class={on === "frame" ? "t-rail" : "t-line"} d={`M${tenth(x - 34 * c)} ${tenth(y - 34 * s)}L${tenth(x + 34 * c)} ${tenth(y + 34 * s)}`} />;
      })}
      {bodies.filter((each) => each.at.length > 2).map((each) => <path key={each.name} class="t-plate" d={line(hull(each.at), true)} />)}
      {bodies.filter((each) => each.at.length === 2).map((each) => <path key={each.name} class={each.name === drawing.driver ? "t-bar t-driven" : "t-bar"} d={line(each.at)} />)}
      {blocks.map(({ centre: [x, y], angle }, k) => <rect key={k} class="t-block" x={-7} y={-4.5} width={14} height={9} transform={`translate(${tenth(x)} ${tenth(y)}) rotate(${tenth(angle)})`} />)}
      {fixed.map((name) => {
        const [x, y] = at(name);
        return <path key={name} class="t-ground" d={`M${tenth(x)} ${tenth(y)}l-4.6 7.4h9.2zM${tenth(x - 7)} ${tenth(y + 7.4)}h14`} />;
      })}
      {Object.keys(points).map((name) => {
        const [x, y] = at(name), single = Object.values(links).filter((each) => each.includes(name)).length < 2 && !fixed.includes(name) && !guides.some((each) => each.at === name);
        return <circle key={name} class={single ? "t-point" : "t-pin"} cx={tenth(x)} cy={tenth(y)} r={single ? 1.8 : PIN} />;
      })}
    </svg>
  );
}
