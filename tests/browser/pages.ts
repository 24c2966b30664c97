/** Opens pages from disk, and watches that they say and load nothing that they should not. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { test as base, expect } from '@playwright/test';
import type { Locator, Page } from '@playwright/test';

export const OUT = process.env.SPALL_BROWSER_OUT!;
export const SOURCE = process.env.SPALL_SOURCE!;
export const file = (name: string): string => join(OUT, name);

/** Fails a test whose page wrote to the console, threw, or asked the network for anything. */
export const test = base.extend<{ watched: undefined }>({
  watched: [
    async ({ page }, use) => {
      const said: string[] = [];
      page.on('console', (message) => {
        if (['error', 'warning'].includes(message.type())) said.push(`${message.type()}: ${message.text()}`);
      });
      page.on('pageerror', (error) => said.push(`thrown: ${error.message}`));
      page.on('request', (request) => {
        if (!/^(file|blob|data):/.test(request.url())) said.push(`request: ${request.url()}`);
      });
      await use(undefined);
      expect(said).toEqual([]);
    },
    { auto: true },
  ],
});

export async function open(page: Page, name: string): Promise<void> {
  await page.goto(pathToFileURL(file(name)).href);
  await page.waitForFunction(() => [...document.querySelectorAll<HTMLElement>('figure.chart, figure.space')].every((figure) => figure.dataset.ready));
}

export async function picture(page: Page, name: string, what?: Locator): Promise<void> {
  const path = file(`pictures/${name}.png`);
  await (what ? what.screenshot({ path }) : page.screenshot({ path }));
}

/** What a button hands the reader. */
export async function download(page: Page, button: Locator): Promise<{ name: string; bytes: Buffer }> {
  const [handed] = await Promise.all([page.waitForEvent('download'), button.click()]);
  return { name: handed.suggestedFilename(), bytes: readFileSync(await handed.path()) };
}

/** The view's picture with every element, without what lies over it. */
export async function still(page: Page, figure: Locator): Promise<Buffer> {
  await expect(figure).toHaveAttribute('data-detail', '1.000');
  // Nothing drawn any more: two pictures that agree.
  let last = await figure.locator('canvas').screenshot({ style: '.overlay { visibility: hidden }' });
  for (let k = 0; k < 20; ++k) {
    await page.waitForTimeout(250);
    const next = await figure.locator('canvas').screenshot({ style: '.overlay { visibility: hidden }' });
    if (next.equals(last) && (await figure.getAttribute('data-detail')) === '1.000') return next;
    last = next;
  }
  throw new Error('the view does not come to rest');
}

/** Pixels that are not the background (what a place near the corner shows), and pixels in which two pictures differ. */
export async function compare(page: Page, one: Buffer, other: Buffer): Promise<{ one: number; other: number; different: number }> {
  return page.evaluate(async (pictures) => {
    const near = { x: 20, y: 20 };
    const pixels = async (text: string): Promise<{ all: Uint32Array; back: number }> => {
      const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const paper = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
      paper.drawImage(image, 0, 0);
      const all = new Uint32Array(paper.getImageData(0, 0, image.width, image.height).data.buffer);
      return { all, back: all[near.y * image.width + near.x]! };
    };
    const [a, b] = [await pixels(pictures[0]!), await pixels(pictures[1]!)];
    const drawn = ({ all, back }: { all: Uint32Array; back: number }): number => all.reduce((count, pixel) => count + (pixel === back ? 0 : 1), 0);
    return { one: drawn(a), other: drawn(b), different: a.all.reduce((count, pixel, k) => count + (pixel === b.all[k] ? 0 : 1), 0) };
  }, [one.toString('base64'), other.toString('base64')]);
}
