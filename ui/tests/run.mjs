// Bundles the tests for Node, which takes no TypeScript, and runs them: npm run unit [-- FILTER].
import { spawnSync } from "node:child_process";
import { readdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { build } from "vite";

const here = import.meta.dirname, made = join(here, "../node_modules/.tests"), filter = process.argv[2] ?? "";
const names = readdirSync(here).filter((name) => name.endsWith(".test.ts") && name.includes(filter));
if (!names.length) throw new Error(`no tests named ${filter}`);
rmSync(made, { recursive: true, force: true });
await build({
  configFile: false, logLevel: "warn", root: join(here, ".."),
  build: {
    ssr: true, target: "node20", outDir: made, minify: false, sourcemap: "inline",
    rollupOptions: { input: names.map((name) => join(here, name)), output: { entryFileNames: "[name].mjs" } },
  },
});
const files = names.map((name) => join(made, name.replace(".ts", ".mjs")));
process.exit(spawnSync(process.execPath, ["--enable-source-maps", "--test", ...files], { stdio: "inherit" }).status ?? 1);
