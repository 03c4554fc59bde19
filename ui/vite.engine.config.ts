import { defineConfig } from "vite";

export default defineConfig({
  build: {
    lib: { entry: "src/engine.ts", formats: ["es"], fileName: () => "engine.mjs" },
    outDir: "../src/linkwright/page/built",
    emptyOutDir: false,
  },
});
