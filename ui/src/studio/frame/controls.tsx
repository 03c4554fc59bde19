// Small controls that all regions may use.
import { Icon } from "./icons";
import type { IconName } from "./signs";

interface SquareProps {
  icon: IconName;
  name: string;
  keys?: string;
  act: (event: MouseEvent) => void;
  disabled?: boolean;
  pressed?: boolean;
  size?: number;
}

/** A button that is an icon; its name is shown where the pointer rests. */
export function Square({ icon, name, keys, act, disabled, pressed, size = 18 }: SquareProps) {
  return <button class="square" aria-label={name} aria-pressed={pressed} data-tip={name} data-keys={keys} disabled={disabled} onClick={act}><Icon name={icon} size={size} /></button>;
}
