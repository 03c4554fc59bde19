import { defineConfig } from "vite";

// The certificate of groups without closed form, for pages that need it.
export default defineConfig({
  build: {
    outDir: "../src/linkwright/page/built",
    emptyOutDir: false,
    modulePreload: false,
    rollupOptions: { input: "src/proof.ts", output: { format: "iife", entryFileNames: "proof.js" } },
  },
});
