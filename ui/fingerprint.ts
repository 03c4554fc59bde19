import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { relative } from "node:path";

/** One hash of everything that the built files are made of; tests/ui/test_built_files.py finds it again. */
export function fingerprint(folder: string): string {
  const hash = createHash("sha256");
  const names = readdirSync(`${folder}/src`, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => `${relative(folder, entry.parentPath)}/${entry.name}`)
    .sort();
  const configurations = readdirSync(folder).filter((name) => /^vite\..*ts$/.test(name)).sort();
  for (const name of [...names, "package-lock.json", ...configurations]) {
    hash.update(name + "\n");
    hash.update(readFileSync(`${folder}/${name}`));
  }
  return hash.digest("hex");
}
