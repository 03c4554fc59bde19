// Where in its cycle a machine is as it is drawn.
import type { Session } from "../../session";

// How near a phase is the same.
const SAME = 1e-9;

export function drawnPhase({ data }: Session): number {
  const { steady, count, closed } = data.positions, { input, at } = data.drawing;
  const place = steady && input !== null ? (input - steady.start) / steady.step : Math.max(0, at), whole = closed ? count : count - 1;
  return closed ? (((place / whole) % 1) + 1) % 1 : whole ? Math.min(1, Math.max(0, place / whole)) : 0;
}

export const isDrawn = (session: Session, phase: number) => Math.abs(phase - drawnPhase(session)) < SAME;
