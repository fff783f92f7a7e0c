import { type Plugin, defineConfig } from 'vite';

/** Where the page is built to, and served from for tests. */
const page = process.env['PAGE'] ?? '../crates/langevin-rigid-cli/page';

/** What the page may load; its servers send this. */
const policy = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "style-src 'self' 'unsafe-inline'",
  "img-src 'self' blob: data:",
  "connect-src 'self' blob: data:",
  "worker-src 'self' blob:",
];

/** The same in the page itself, for servers that send nothing. */
const ownPolicy: Plugin = {
  name: 'own-policy',
  apply: 'build',
  transformIndexHtml: () => [
    {
      tag: 'meta',
      attrs: { 'http-equiv': 'Content-Security-Policy', content: policy.join('; ') },
      injectTo: 'head-prepend',
    },
  ],
};

export default defineConfig({
  plugins: [ownPolicy],
  // The page works under any path.
  base: './',
  build: {
    outDir: page,
    emptyOutDir: true,
    target: 'es2023',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    // three is larger than Vite likes.
    chunkSizeWarningLimit: 1000,
  },
  worker: { format: 'es' },
  preview: { headers: { 'Content-Security-Policy': policy.join('; ') } },
});
