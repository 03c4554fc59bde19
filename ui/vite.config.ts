import { defineConfig } from "vite";
import { fingerprint } from "./fingerprint";

// One script and one style sheet, to be put into pages as they are, and the hash of their sources.
export default defineConfig({
  plugins: [
    {
      name: "fingerprint",
      generateBundle() {
        this.emitFile({ type: "asset", fileName: "sources.sha256", source: fingerprint(import.meta.dirname) + "\n" });
      },
    },
  ],
  build: {
    outDir: "../src/linkwright/page/built",
    emptyOutDir: false,
    cssCodeSplit: false,
    modulePreload: false,
    rollupOptions: {
      input: "src/page.tsx",
      output: { format: "iife", entryFileNames: "page.js", assetFileNames: "page.[ext]" },
    },
  },
});
