/** Run by run.sh, which says in the environment where everything is. */
import { defineConfig } from '@playwright/test';

export default defineConfig({
  testDir: '.',
  outputDir: `${process.env.SPALL_BROWSER_OUT!}/results`,
  globalSetup: './setup.ts',
  workers: 1,
  // Without a graphics card, on a machine with other work, a picture of 120,808 elements takes seconds.
  timeout: 240_000,
  expect: { timeout: 30_000 },
  reporter: 'list',
  use: {
    viewport: { width: 1100, height: 1000 },
    launchOptions: {
      executablePath: process.env.SPALL_CHROMIUM!,
      // As root there is no sandbox; without a graphics card WebGL is computed.
      args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    },
  },
});
