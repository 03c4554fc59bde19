// A field in which one of several is chosen, with the arrow of all such fields.
import type { JSX } from "preact";
import { Icon } from "../frame/icons";

export function Select(attributes: JSX.IntrinsicElements["select"]) {
  return (
    <span class="select">
      <select {...attributes} />
      <Icon name="chevron" size={14} />
    </span>
  );
}
