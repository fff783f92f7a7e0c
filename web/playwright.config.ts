import { existsSync } from 'node:fs';
import { defineConfig } from '@playwright/test';

const browser = '/usr/bin/chromium';
const served = 'http://localhost:4173/';

export default defineConfig({
  testDir: 'tests',
  forbidOnly: true,
  // A busy machine may starve a browser once.
  retries: 1,
  reporter: 'line',
  fullyParallel: true,
  workers: 2,
  // Drawing in software takes its time.
  timeout: 180_000,
  expect: { timeout: 30_000 },
  use: {
    baseURL: process.env['TEST_URL'] ?? served,
    viewport: { width: 800, height: 600 },
    // Nothing moves by itself, but where a test lets it.
    contextOptions: { reducedMotion: 'reduce' },
    launchOptions: {
      // The distribution's browser, or else Playwright's own.
      ...(existsSync(browser) ? { executablePath: browser } : {}),
      args: [
        '--no-sandbox',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
        '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader',
      ],
    },
  },
  // The built page, unless TEST_URL names one that is served.
  ...(process.env['TEST_URL'] === undefined
    ? { webServer: { command: 'npx vite preview --host localhost --port 4173 --strictPort', url: served } }
    : {}),
});
