// Icons in the colour of the text beside them. They say nothing by themselves: the button that has one has a name, too.
import { type IconName, strokes } from "./signs";

export type { IconName } from "./signs";

export function Icon({ name, size = 20 }: { name: IconName; size?: number }) {
  return (
    <svg class="icon" viewBox="0 0 20 20" width={size} height={size} aria-hidden="true">
      {strokes(name).map(([style, d], k) => <path key={k} class={`i-${style}`} d={d} />)}
    </svg>
  );
}
