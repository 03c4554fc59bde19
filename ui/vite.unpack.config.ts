import { defineConfig } from "vite";

export default defineConfig({
  build: {
    outDir: "../src/linkwright/page/built",
    emptyOutDir: false,
    modulePreload: false,
    rollupOptions: { input: "src/unpack.ts", output: { format: "iife", entryFileNames: "unpack.js" } },
  },
});
