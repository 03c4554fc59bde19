// What stands on the sheet at the position that is shown, whether the text makes a machine or not: places by the names
// of the text, for hits, snaps and what is drawn over the machine.
import type { Load } from "../../drawn_loads";
import type { Picture } from "../../picture";
import type { Session } from "../../session";
import type { Vec } from "../../shapes";

export interface ScenePoint {
  name: string;
  /** Its key among the points of the machine, "" where there is none. */
  key: string;
  at: Vec;
  fixed: boolean;
  links: string[];
}

export class Scene {
  readonly points = new Map<string, ScenePoint>();
  readonly links: Record<string, string[]>;
  readonly loads: Record<string, Load>;
  readonly guided: string[];
  readonly driver: string | null;

  /** `index`: the position of the machine that is shown; without a machine the places are those of the drawing. */
  constructor(picture: Picture | undefined, session: Session | null, index: number) {
    const { points = {}, fixed = [], links = {}, loads = {}, guided = [], driver = null } = picture ?? {};
    [this.links, this.loads, this.guided, this.driver] = [links, loads, guided, driver];
    const keys = new Set(session?.data.points.map(({ key }) => key)), names = new Set([...Object.keys(points), ...Object.values(links).flat()]);
    for (const name of names) {
      const own = Object.keys(links).filter((link) => links[link].includes(name));
      const key = [name, ...own.map((link) => `${link}.${name}`), ...(fixed.includes(name) ? [`frame.${name}`] : [])].find((each) => keys.has(each)) ?? "";
      const at = key && session ? (["x", "y"].map((axis) => session.model.main.row(`p:${key}.${axis}`)[index]) as Vec) : points[name];
      if (at && at.every(Number.isFinite)) this.points.set(name, { name, key, at, fixed: fixed.includes(name), links: own });
    }
  }

  at(name: string): Vec | null {
    return this.points.get(name)?.at ?? null;
  }

  /** The places of a link's points, in its order. */
  corners(link: string): Vec[] {
    return (this.links[link] ?? []).map((name) => this.at(name)).filter((each) => each !== null);
  }

  /** The box of all points, m; null where there are fewer than two. */
  get box(): [number, number, number, number] | null {
    const all = [...this.points.values()].map(({ at }) => at), xs = all.map(([x]) => x), ys = all.map(([, y]) => y);
    return all.length > 1 ? [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)] : null;
  }
}
