// Icons of the dock, 20 by 20.
const PATHS = {
  play: <path class="solid" d="M6.5 4.2v11.6l9.6-5.8z" />,
  pause: <path class="solid" d="M5.5 4.5h3v11h-3zM11.5 4.5h3v11h-3z" />,
  turn: <><path d="M15.6 10a5.6 5.6 0 1 1-2.2-4.5" /><path class="solid" d="M15.6 7.4l-4.3-.6 2.9-3.3z" /></>,
  rock: <><path d="M4 8.2a7.6 7.6 0 0 1 12 0" /><path class="solid" d="M2.9 10.4l.1-4.2 3.2 2.6zM17.1 10.4l-.1-4.2-3.2 2.6z" /><path d="M10 8v7" /><circle cx="10" cy="15.4" r="1.6" /></>,
  loop: <><path d="M4.5 9V8a2.5 2.5 0 0 1 2.5-2.5h7" /><path d="M15.5 11v1a2.5 2.5 0 0 1-2.5 2.5H6" /><path class="solid" d="M13 2.9l3.4 2.6L13 8.1zM7 11.9l-3.4 2.6L7 17.1z" /></>,
  drive: <><circle cx="10" cy="11" r="1.9" /><path d="M11.3 9.6l4.4-4.4" /><path d="M4.2 12.8a6 6 0 0 1 5.3-7.7" /><path class="solid" d="M12.2 5.1L9 7.2V3z" /></>,
  plus: <path d="M10 4.5v11M4.5 10h11" />,
  minus: <path d="M4.5 10h11" />,
  close: <path d="M5.5 5.5l9 9M14.5 5.5l-9 9" />,
  down: <path d="M6 8l4 4 4-4" />,
  find: <><circle cx="8.8" cy="8.8" r="4.6" /><path d="M12.3 12.3l4 4" /></>,
  dots: <><circle class="solid" cx="4.5" cy="10" r="1.4" /><circle class="solid" cx="10" cy="10" r="1.4" /><circle class="solid" cx="15.5" cy="10" r="1.4" /></>,
  check: <path d="M4.5 10.5l3.6 3.6 7.4-8" />,
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name, size = 18 }: { name: IconName; size?: number }) {
  return <svg class="dock-icon" viewBox="0 0 20 20" width={size} height={size} aria-hidden="true">{PATHS[name]}</svg>;
}
