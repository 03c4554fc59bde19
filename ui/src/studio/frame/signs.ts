// What the icons are drawn of, on a square of 20: strokes in the styles of frame.css. They follow the drawing's own symbols:
// pins are hollow, bodies filled, the ground is hatched, arrowheads are solid.

export type Style = "line" | "bar" | "thin" | "dash" | "body" | "solid" | "pin";
export type Stroke = readonly [Style, string];

const round = (x: number): string => String(Math.round(x * 100) / 100);
const circle = (x: number, y: number, r: number): string => `M${round(x - r)} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
const pin = (x: number, y: number, r = 2): Stroke => ["pin", circle(x, y, r)];
const dot = (x: number, y: number, r = 1.3): Stroke => ["solid", circle(x, y, r)];

/** The outline of a wheel: trapezoids of a height on a circle. */
function wheel(x: number, y: number, r: number, teeth: number, turn: number, height: number): Stroke {
  const pitch = Math.PI / teeth, flank: [number, number][] = [[-0.6, r], [-0.32, r + height], [0.32, r + height], [0.6, r]];
  const corners = Array.from({ length: teeth }, (_, k) =>
    flank.map(([share, reach]) => {
      const angle = turn + (2 * k + share) * pitch;
      return `${round(x + reach * Math.cos(angle))} ${round(y + reach * Math.sin(angle))}`;
    }),
  );
  return ["body", `M${corners.flat().join("L")}z`];
}

/** A zigzag between two places, straight over `lead` at its ends. */
function zigzag(ax: number, ay: number, bx: number, by: number, turns: number, width: number, lead: number): Stroke {
  const length = Math.hypot(bx - ax, by - ay), [u, v] = [(bx - ax) / length, (by - ay) / length], step = (length - 2 * lead) / turns;
  const at = (along: number, across: number) => `${round(ax + u * along - v * across)} ${round(ay + v * along + u * across)}`;
  const peaks = Array.from({ length: turns }, (_, k) => at(lead + step * (k + 0.5), k % 2 ? -width : width));
  return ["line", `M${[at(0, 0), at(lead, 0), ...peaks, at(length - lead, 0), at(length, 0)].join("L")}`];
}

/** A solid head with its point at a place, in a direction (degrees clockwise from the right). */
function head(x: number, y: number, direction: number, size = 4.6): Stroke {
  const angle = (direction * Math.PI) / 180, at = (along: number, across: number) =>
    `${round(x + along * Math.cos(angle) - across * Math.sin(angle))} ${round(y + along * Math.sin(angle) + across * Math.cos(angle))}`;
  return ["solid", `M${at(0, 0)}L${at(-size, 0.46 * size)}L${at(-size, -0.46 * size)}z`];
}

const GROUND: Stroke[] = [["line", "M3 14.6h14"], ["thin", "M6.2 14.6l-2.1 2.7M10.2 14.6l-2.1 2.7M14.2 14.6l-2.1 2.7"]];
const CHECKED: Stroke[] = [["body", circle(10, 10, 6.6)], ["solid", "M10 10V3.4a6.6 6.6 0 0 1 6.6 6.6zM10 10v6.6A6.6 6.6 0 0 1 3.4 10z"]];
/** Two pins at the ends of the slanting line of springs and their kin. */
const ENDS: Stroke[] = [pin(3.7, 16.3, 1.6), pin(16.3, 3.7, 1.6)];

const TOOLS = {
  move: [["body", "M5.2 2.8l.7 12.9 3.2-2.8 2.2 4.4 2.2-1.1-2.2-4.3 4.2-.6z"]],
  pivot: [["body", "M8.6 6.8L5.2 14.6h9.6L11.4 6.8"], ...GROUND, pin(10, 5.1, 2.3)],
  link: [["bar", "M5 15L15 5"], pin(4.7, 15.3, 2.3), pin(15.3, 4.7, 2.3)],
  plate: [["body", "M3.9 15.4h12.2L11.2 4.2z"], pin(3.9, 15.4, 1.9), pin(16.1, 15.4, 1.9), pin(11.2, 4.2, 1.9)],
  slider: [["body", "M4.8 7.4h10.4v7.2H4.8z"], ...GROUND, ["bar", "M10 11L15.4 3"], pin(10, 11, 1.8)],
  slot: [["body", "M3.6 9.3l8.9-5.5a3.5 3.5 0 0 1 3.7 5.9l-8.9 5.5a3.5 3.5 0 0 1-3.7-5.9z"], ["thin", "M6.2 9.5l6.1-3.8M7.6 11.9l6.1-3.8"], pin(11.4, 8.3, 1.8)],
  weld: [["bar", "M2.6 15.4h14.8M11.2 15.4L6.6 2.8"], ["solid", "M5.6 15.4l3.6-5.5 2 5.5zM11.2 15.4l-1.6-4.4 4.9 4.4z"]],
  gears: [wheel(7.1, 12.2, 4, 9, 0.25, 1.6), wheel(14.8, 5.1, 2.2, 6, 0.1, 1.4), dot(7.1, 12.2, 1.2), dot(14.8, 5.1, 0.8)],
  rack: [["body", "M1.8 17.4v-3.6h1.5l1-2.1h1.9l1 2.1h1.9l1-2.1H12l1 2.1h1.9l1-2.1h1.3l1 2.1v3.6z"], ["body", circle(9.4, 6.3, 4.1)], dot(9.4, 6.3, 1.2)],
  cam: [["body", "M10 8.1c3.8-.3 7 2.2 7 5.3a4.3 4.3 0 0 1-4.6 4.3c-4.5 0-8.6-1.7-8.6-5 0-2.7 2.6-4.4 6.2-4.6z"], dot(12.3, 13, 1.3), ["bar", "M9.2 3.2V1.4"], pin(9.2, 5.4, 2.1)],
  drive: [["line", "M3.9 9.9A6.6 6.6 0 1 1 9.4 17.2"], head(4.3, 12.6, 82), ["bar", "M10.6 10.4l3.7-3.7"], pin(9.8, 11.2, 1.9)],
  force: [["bar", "M16.6 3.4L8 12"], head(4.9, 15.1, 135, 6.4), dot(3.8, 16.2)],
  torque: [["line", "M15.9 13.1A6.6 6.6 0 1 0 4.4 13.5"], head(13.6, 16.8, 128, 5.2), dot(10, 10, 1.4)],
  spring: [zigzag(4.6, 15.4, 15.4, 4.6, 6, 3, 2.4), ...ENDS],
  mass: CHECKED,
  dimension: [["line", "M3 4v12M17 4v12M5.4 10h9.2"], head(3.6, 10, 180, 4), head(16.4, 10, 0, 4)],
  target: [["dash", "M3.5 12.3c-.7-4.9 3.9-8.5 8.1-7.9 4.8.7 6.5 5 3.9 7.6-2.3 2.3-4.5.3-6.9 1.7-2.1 1.3-4.6 2.5-5.1-1.4z"], dot(15, 6.5, 1.8)],
  photo: [["body", "M3.9 4h12.2a1.4 1.4 0 0 1 1.4 1.4v9.2a1.4 1.4 0 0 1-1.4 1.4H3.9a1.4 1.4 0 0 1-1.4-1.4V5.4A1.4 1.4 0 0 1 3.9 4z"], ["line", "M3 14.2l4.4-4.4 3.3 3.2 2.1-1.9 4.2 3.5"], ["line", circle(12.9, 7.5, 1.2)]],
  erase: [["body", "M8.2 16.2l-4.6-4.6a1.4 1.4 0 0 1 0-2L10 3.2a1.4 1.4 0 0 1 2 0L16.8 8a1.4 1.4 0 0 1 0 2l-6.2 6.2z"], ["line", "M6.8 6.4l6.8 6.8M7.6 16.3h9.6"]],
} satisfies Record<string, Stroke[]>;

const SPRINGS = {
  damper: [["line", "M4.8 15.2l3.4-3.4M11.2 8.8l4-4"], ["body", "M10.6 14.2l-4.8-4.8 3.5-3.5M10.6 14.2l3.5-3.5"], ["bar", "M9 6.7l4.3 4.3"], ...ENDS],
  gas_spring: [["bar", "M10.4 9.6l4.4-4.4"], ["body", "M4.9 12.6l4.4-4.4a1 1 0 0 1 1.4 0l1.1 1.1a1 1 0 0 1 0 1.4l-4.4 4.4z"], ["thin", "M7.2 12.8l2.6-2.6"], ...ENDS],
  cylinder: [["bar", "M10.9 9.1l3.9-3.9"], ["body", "M7.4 16.6l-4-4 5.9-5.9 4 4z"], ["line", "M7.6 8.5l3.9 3.9"], pin(16.3, 3.7, 1.6), dot(5.9, 14.1, 1)],
  torsion_spring: [["line", "M2.8 16.6h7.4a6 6 0 1 0-6-6 4.2 4.2 0 0 0 4.2 4.2 2.9 2.9 0 0 0 2.9-2.9"], ["bar", "M11.3 11.6l5.5-8.4"], dot(10.2, 10.6, 1.2)],
} satisfies Record<string, Stroke[]>;

const SIGNS = {
  ...TOOLS,
  ...SPRINGS,
  // Commands.
  play: [["solid", "M6.6 4.3l8.9 5.7-8.9 5.7z"]],
  pause: [["solid", "M5.6 4.6h2.9v10.8H5.6zM11.5 4.6h2.9v10.8h-2.9z"]],
  undo: [["line", "M7.3 4L3.5 7.8l3.8 3.8M3.9 7.8h7.7a4.4 4.4 0 0 1 0 8.8H8"]],
  redo: [["line", "M12.7 4l3.8 3.8-3.8 3.8M16.1 7.8H8.4a4.4 4.4 0 0 0 0 8.8H12"]],
  share: [["line", "M8.7 11.3a3.2 3.2 0 0 0 4.5 0l3-3a3.2 3.2 0 0 0-4.5-4.5l-1 1M11.3 8.7a3.2 3.2 0 0 0-4.5 0l-3 3a3.2 3.2 0 0 0 4.5 4.5l1-1"]],
  export: [["line", "M10 3v9.4M6.2 8.9l3.8 3.8 3.8-3.8M4 16.6h12"]],
  lock: [["body", "M5.8 9h8.4a1.2 1.2 0 0 1 1.2 1.2v5.2a1.2 1.2 0 0 1-1.2 1.2H5.8a1.2 1.2 0 0 1-1.2-1.2v-5.2A1.2 1.2 0 0 1 5.8 9z"], ["line", "M6.8 9V6.6a3.2 3.2 0 0 1 6.4 0V9"]],
  unlock: [["line", "M5.8 9h8.4a1.2 1.2 0 0 1 1.2 1.2v5.2a1.2 1.2 0 0 1-1.2 1.2H5.8a1.2 1.2 0 0 1-1.2-1.2v-5.2A1.2 1.2 0 0 1 5.8 9zM6.8 9V6.2a3.2 3.2 0 0 1 6.2-1"]],
  trash: [["line", "M4 5.6h12M8 5.4V3.6h4v1.8M5.6 5.8l.7 10.6h7.4l.7-10.6M8.6 8.6v5M11.4 8.6v5"]],
  copy: [["line", "M8.2 7h7a1.2 1.2 0 0 1 1.2 1.2v7a1.2 1.2 0 0 1-1.2 1.2h-7A1.2 1.2 0 0 1 7 15.2v-7A1.2 1.2 0 0 1 8.2 7zM4 12.6V4.8a1.2 1.2 0 0 1 1.2-1.2h7.4"]],
  mirror: [["dash", "M10 2.6v14.8"], ["body", "M7.3 5.4v9.2H2.6z"], ["line", "M12.7 5.4v9.2h4.7z"]],
  split: [["bar", "M4 16l4-4M12 8l4-4"], pin(10, 10, 2.1)],
  turn: [["line", "M16.3 10A6.3 6.3 0 1 1 13.4 4.7"], head(16.2, 5.4, 28, 4.8)],
  rock: [["line", "M4.6 7.2a8 8 0 0 1 10.8 0"], head(2.6, 9.2, 135), head(17.4, 9.2, 45), ["bar", "M10 15.4V8.4"], pin(10, 15.6, 1.7)],
  loop: [["line", "M4 9.2V8.4A2.6 2.6 0 0 1 6.6 5.8h7.2M16 10.8v.8a2.6 2.6 0 0 1-2.6 2.6H6.2"], head(16.8, 5.8, 0, 4.4), head(3.2, 14.2, 180, 4.4)],
  sweep: [["line", "M2.8 15.6C5.8 4.8 9 4.8 10.6 9.8s4 5 6.6-4.4"], ["thin", "M2.8 12.6C5.8 2.6 9 3 11 8s3.8 4 6.2-5"]],
  // The room.
  chevron: [["line", "M6.3 8.1l3.7 3.7 3.7-3.7"]],
  plus: [["line", "M10 4.4v11.2M4.4 10h11.2"]],
  minus: [["line", "M4.4 10h11.2"]],
  fit: [["line", "M3.6 7V3.6H7M13 3.6h3.4V7M16.4 13v3.4H13M7 16.4H3.6V13"]],
  close: [["line", "M5.4 5.4l9.2 9.2M14.6 5.4l-9.2 9.2"]],
  menu: [["line", "M3.4 5.6h13.2M3.4 10h13.2M3.4 14.4h13.2"]],
  more: [dot(4.6, 10, 1.4), dot(10, 10, 1.4), dot(15.4, 10, 1.4)],
  grip: [dot(7.4, 5, 1.2), dot(12.6, 5, 1.2), dot(7.4, 10, 1.2), dot(12.6, 10, 1.2), dot(7.4, 15, 1.2), dot(12.6, 15, 1.2)],
  search: [["line", circle(8.8, 8.8, 5)], ["line", "M12.6 12.6l4 4"]],
  magnet: [["body", "M4.4 4h3.4v6.2a2.2 2.2 0 0 0 4.4 0V4h3.4v6.3a5.6 5.6 0 0 1-11.2 0z"], ["line", "M4.4 6.9h3.4M12.2 6.9h3.4"]],
  check: [["line", "M4.4 10.6l3.8 3.8 7.4-8.4"]],
  alert: [["body", "M10 3.2l7.4 13H2.6z"], ["line", "M10 8v4M10 14.1v.2"]],
  info: [["line", circle(10, 10, 7)], ["line", "M10 9.2v4.4M10 6.3v.2"]],
  help: [["line", circle(10, 10, 7)], ["line", "M7.9 8.1a2.1 2.1 0 1 1 3.1 1.8c-.7.4-1 .8-1 1.6M10 14v.2"]],
  sun: [["line", circle(10, 10, 3.4)], ["line", "M10 2v1.6M10 16.4V18M2 10h1.6M16.4 10H18M4.3 4.3l1.2 1.2M14.5 14.5l1.2 1.2M15.7 4.3l-1.2 1.2M5.5 14.5l-1.2 1.2"]],
  moon: [["body", "M16.4 12.2A7 7 0 0 1 7.8 3.6a7 7 0 1 0 8.6 8.6z"]],
  contrast: [["line", circle(10, 10, 6.6)], ["solid", "M10 3.4a6.6 6.6 0 0 1 0 13.2z"]],
  rail: [["line", "M4.4 4h11.2A1.4 1.4 0 0 1 17 5.4v9.2a1.4 1.4 0 0 1-1.4 1.4H4.4A1.4 1.4 0 0 1 3 14.6V5.4A1.4 1.4 0 0 1 4.4 4zM8 4v12"]],
  sheet: [["body", "M4.2 3.4h11.6v13.2H4.2z"], ["thin", "M4.2 7.8h11.6M4.2 12.2h11.6M8.1 3.4v13.2M11.9 3.4v13.2"]],
  file: [["body", "M5 2.8h6.4L15 6.4v10.8H5z"], ["line", "M11.2 3v3.6h3.6"]],
  folder: [["body", "M2.8 5.2h4.8l1.6 1.9h8v8.7H2.8z"]],
  gallery: [["body", "M3.2 3.4h5.6v5.6H3.2zM11.2 3.4h5.6v5.6h-5.6zM3.2 11.2h5.6v5.6H3.2zM11.2 11.2h5.6v5.6h-5.6z"]],
  clock: [["line", circle(10, 10, 6.8)], ["line", "M10 6v4.2l2.9 1.8"]],
  pencil: [["body", "M3.4 16.6l.9-3.9L13.4 3.6l3 3-9.1 9.1z"], ["line", "M11.5 5.5l3 3"]],
  keyboard: [["body", "M2.2 5.2h15.6v9.6H2.2z"], ["thin", "M5 8h.6M8.2 8h.6M11.4 8h.6M14.6 8h.6M5 12h1M14.4 12h.6M7.6 12h5"]],
  settings: [["line", "M3 6h7.4M14.6 6H17M3 14h2.4M9.6 14H17"], pin(12.5, 6, 2), pin(7.5, 14, 2)],
  eye: [["line", "M2 10c2.2-3.6 4.9-5.2 8-5.2s5.8 1.6 8 5.2c-2.2 3.6-4.9 5.2-8 5.2S4.2 13.6 2 10z"], ["line", circle(10, 10, 2.4)]],
  eye_off: [["line", "M2 10c2.2-3.6 4.9-5.2 8-5.2s5.8 1.6 8 5.2c-2.2 3.6-4.9 5.2-8 5.2S4.2 13.6 2 10zM3.6 16.4L16.4 3.6"]],
  // What can be selected or measured, beside what the tools draw.
  joint: [["bar", "M3 16.4l5.6-5M11.4 8.8L17 3.6"], pin(10, 10, 2.8)],
  point: [["bar", "M3 15.4L17 4.6"], dot(10, 10, 2.4)],
  guide: [["dash", "M2.6 10h14.8"], ["body", "M6.4 6.6h7.2v6.8H6.4z"], pin(10, 10, 1.6)],
  path: [["line", "M3.4 13.4C3 7.6 6.6 4.2 11 4.6c4.4.4 6.6 4 4.8 6.4-2 2.6-4.8.4-7.2 2-2 1.4-4.8 3-5.2.4z"], dot(15.9, 7.6, 1.9)],
  angle: [["line", "M4 15.6h12.6M4 15.6L13.4 4.6M11.4 15.6a7.4 7.4 0 0 0-2.6-5.6"]],
  gravity: [["bar", "M10 3v9.6"], head(10, 16.8, 90, 6), ["thin", "M4.6 5.4v5M15.4 5.4v5"]],
  curves: [["line", "M3.4 3.4v13.2h13.2"], ["line", "M5.6 13c2-7.4 4-7.4 5.6-3.4s3 2.8 5-3.6"]],
  table: [["line", "M3 4.4h14v11.2H3zM3 8.2h14M3 11.9h14M8.4 4.4v11.2"]],
  compare: [["body", "M3 4.4h5.6v11.2H3z"], ["dash", "M11.4 4.4H17v11.2h-5.6z"]],
  optimise: [["line", "M3 14.8c2.2 0 2.6-9.4 5-9.4s2.2 6.2 4.2 6.2 2-3 4.8-3"], ["thin", "M3 17.2h14"], dot(12.2, 11.6, 1.7)],
  synthesis: [["dash", "M4 14.4c0-6.4 3.6-9.6 12-9.6"], dot(4, 14.4, 1.7), dot(7.6, 7.3, 1.7), dot(16, 4.8, 1.7)],
  file_text: [["body", "M5 2.8h6.4L15 6.4v10.8H5z"], ["thin", "M7.4 9.2h5.2M7.4 11.6h5.2M7.4 14h3.4"]],
} satisfies Record<string, Stroke[]>;

export type IconName = keyof typeof SIGNS;
export const strokes = (name: IconName): readonly Stroke[] => SIGNS[name] as Stroke[];
