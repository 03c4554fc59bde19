import { defineConfig } from "vite";

export default defineConfig({
  build: {
    outDir: "../src/linkwright/page/built",
    emptyOutDir: false,
    cssCodeSplit: false,
    modulePreload: false,
    rollupOptions: {
      input: "src/studio/studio.tsx",
      output: { format: "iife", entryFileNames: "studio.js", assetFileNames: "studio.[ext]" },
    },
  },
});
