// What stands on the sheet at the position that is shown, whether the text makes a machine or not: places by the names
// of the text, for hits, snaps and what is drawn over the machine.
import type { Load, Picture } from "../picture";
import type { Session } from "../../session";
import type { Vec } from "../../shapes";
import type { Entry } from "../outline";
import { placeOf } from "./sketch_pairs";

export interface ScenePoint {
  name: string;
  /** Its key among the points of the machine, "" where there is none. */
  key: string;
  at: Vec;
  fixed: boolean;
  links: string[];
}

/** An entry of `joints:` with the point at which it is drawn. */
export interface ScenePair {
  name: string;
  kind: string;
  at: Vec | null;
  /** The point that it is at, "": none. */
  point: string;
}

/** Key of a point that has been hung, while others are hung on it. */
const HUNG = "hung";

export class Scene {
  readonly points = new Map<string, ScenePoint>();
  readonly links: Record<string, string[]>;
  readonly loads: Record<string, Load>;
  readonly guided: string[];
  readonly driver: string | null;
  readonly pairs: ScenePair[];
  /** What is driven, with the point at which its arrow is drawn. */
  readonly drives: { name: string; at: Vec | null }[];
  /** Points through which guides on the frame go. */
  readonly throughs: Set<string>;
  /** Points that a link has elsewhere than the others that share them: ends that do not meet. */
  apart: Record<string, Record<string, Vec>> = {};

  /** `place`: that of the machine among its positions which is shown; without a machine places are those of the drawing. */
  constructor(picture: Picture | undefined, session: Session | null, place: number, joints?: Entry, lifted: Record<string, Vec> | null = null) {
    const { points = {}, fixed = [], links = {}, loads = {}, guided = [], driver = null } = picture ?? {};
    [this.links, this.loads, this.guided, this.driver] = [links, loads, guided, driver];
    const keys = new Set(session?.data.points.map(({ key }) => key)), names = new Set([...Object.keys(points), ...Object.values(links).flat()]);
    const { main, solver } = session?.model ?? {}, between = Number.isInteger(place) ? null : solver?.whole(place);
    const value = (row: string) => (between ? between.row(row)[0] : main!.row(row)[Math.round(place) % main!.n]);
    for (const name of names) {
      const own = Object.keys(links).filter((link) => links[link].includes(name));
      const key = [name, ...own.map((link) => `${link}.${name}`), ...(fixed.includes(name) ? [`frame.${name}`] : [])].find((each) => keys.has(each)) ?? "";
      const at = lifted?.[name] ?? (key && session ? (["x", "y"].map((axis) => value(`p:${key}.${axis}`)) as Vec) : points[name]);
      if (at && at.every(Number.isFinite)) this.points.set(name, { name, key, at, fixed: fixed.includes(name), links: own });
    }
    this.hang(picture?.loose ?? [], points);
    this.throughs = new Set(Object.values(picture?.guides ?? {}).flatMap(({ guide, through }) => (guide === "frame" ? [through] : [])));
    this.drives = Object.entries(picture?.drives ?? {}).map(([drive, { about }]) => ({ name: drive, at: about ? this.at(about) : null }));
    this.pairs = Object.entries(typeof joints === "object" && !Array.isArray(joints) ? joints : {}).flatMap(([pair, entry]) => {
      if (typeof entry !== "object" || Array.isArray(entry)) return [];
      const { kind, at } = entry;
      return [{ name: pair, kind: typeof kind === "string" ? kind : "", at: placeOf(this, entry), point: typeof at === "string" ? at : "" }];
    });
  }

  /** Links that the machine has not yet go along with the joints that they hang on, as they are drawn. */
  private hang(loose: string[], drawn: Record<string, Vec>): void {
    for (let left = loose, count = -1; left.length !== count; ) {
      count = left.length;
      left = left.filter((link) => {
        const points = this.links[link] ?? [], joint = points.find((name) => this.points.get(name)?.key && drawn[name]);
        if (!joint) return true;
        const [x, y] = this.at(joint)!, shift: Vec = [x - drawn[joint][0], y - drawn[joint][1]];
        for (const name of points) {
          const point = this.points.get(name);
          if (point && !point.key && !point.fixed) Object.assign(point, { at: [point.at[0] + shift[0], point.at[1] + shift[1]], key: HUNG });
        }
        return false;
      });
    }
    for (const point of this.points.values()) if (point.key === HUNG) point.key = "";
  }

  at(name: string): Vec | null {
    return this.points.get(name)?.at ?? null;
  }

  /** The places of a link's points, in its order. */
  corners(link: string): Vec[] {
    return (this.links[link] ?? []).map((name) => this.apart[link]?.[name] ?? this.at(name)).filter((each) => each !== null);
  }

  /** The box of all points, m; null where there are fewer than two. */
  get box(): [number, number, number, number] | null {
    const all = [...this.points.values()].map(({ at }) => at), xs = all.map(([x]) => x), ys = all.map(([, y]) => y);
    return all.length > 1 ? [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)] : null;
  }
}
