/** Run by run.sh, which says in the environment where everything is. */
import { defineConfig } from '@playwright/test';

export default defineConfig({
  testDir: '.',
  outputDir: `${process.env.SPALL_BROWSER_OUT!}/results`,
  globalSetup: './setup.ts',
  workers: 1,
  timeout: 120_000,
  expect: { timeout: 15_000 },
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
