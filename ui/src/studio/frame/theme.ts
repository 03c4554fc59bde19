// Light or dark: as chosen, else as the system has it; paper is always light.
import { effect } from "@preact/signals";
import { repaint } from "../../palette";
import type { Bench } from "../bench";

export function followTheme(bench: Bench): () => void {
  const dark = matchMedia("(prefers-color-scheme: dark)"), print = matchMedia("print");
  const follow = () => {
    const theme = print.matches ? "light" : bench.settings.value.theme || (dark.matches ? "dark" : "light");
    if (document.documentElement.dataset.theme === theme) return;
    document.documentElement.dataset.theme = theme;
    repaint();
  };
  for (const each of [dark, print]) each.addEventListener("change", follow);
  const end = effect(follow);
  return () => {
    end();
    for (const each of [dark, print]) each.removeEventListener("change", follow);
  };
}
