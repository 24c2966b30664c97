import { statSync } from 'node:fs';
import { expect } from '@playwright/test';
import { download, file, open, picture, test } from './pages';

test('curves show values with units where the pointer is', async ({ page }) => {
  await open(page, 'charts.html');
  const chart = page.locator('figure.chart').first();
  const points = chart.locator('.scatterlayer .trace .points path');
  // The sixth mark of "seed 1", at x = 0.44: 3 sin(2.8 x) is there 2.83.
  await chart.locator('.legend button').nth(0).click();
  await chart.locator('.legend button').nth(1).click();
  await chart.locator('.legend button').nth(3).click();
  const place = (await points.nth(4).boundingBox())!;
  await page.mouse.move(place.x + place.width / 2, place.y + place.height / 2);
  const words = chart.locator('.hoverlayer text').last();
  await expect(words).toContainText('seed 1 <b>&');
  const [, x, y] = /axial strain\s+([\d.]+) ‰.*stress\s+([\d.]+) MPa/s.exec((await words.textContent())!) ?? [];
  expect(Number(y)).toBeCloseTo(3 * Math.sin(2.8 * Number(x)), 3);
});

test('curves zoom and reset by key, pointer and button', async ({ page }) => {
  await open(page, 'charts.html');
  const chart = page.locator('figure.chart').first();
  const ticks = async (): Promise<string[]> => chart.locator('.xtick text').allTextContents();
  const all = await ticks();
  await chart.locator('.canvas').focus();
  for (let k = 0; k < 6; ++k) await page.keyboard.press('+');
  await expect.poll(ticks).not.toEqual(all);
  const near = await ticks();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  await expect.poll(ticks).not.toEqual(near);
  await page.keyboard.press('0');
  await expect.poll(ticks).toEqual(all);
  const box = (await chart.locator('.nsewdrag').boundingBox())!;
  await page.mouse.move(box.x + 100, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 300, box.y + 200, { steps: 4 });
  await page.mouse.up();
  await expect.poll(ticks).not.toEqual(all);
  await page.mouse.dblclick(box.x + 200, box.y + 100);
  await expect.poll(ticks).toEqual(all);
  await chart.locator('.canvas').focus();
  await page.keyboard.press('Shift+ArrowRight');
  await expect(chart.locator('[role=status]')).toContainText('axial strain 0 ‰');
});

test('the legend hides and shows, and curves carry marks beside colours', async ({ page }) => {
  await open(page, 'charts.html');
  const chart = page.locator('figure.chart').first();
  const lines = chart.locator('.scatterlayer .trace .lines path');
  const before = await lines.count();
  const entry = chart.locator('.legend button').nth(3);
  await entry.click();
  await expect(entry).toHaveAttribute('aria-pressed', 'false');
  await expect.poll(() => lines.count()).toBeLessThan(before);
  await entry.press('Enter');
  await expect.poll(() => lines.count()).toBe(before);
  const shapes = await chart.locator('.scatterlayer .trace .points path:first-child').evaluateAll((all) => all.map((path) => path.getAttribute('d')));
  expect(new Set(shapes).size).toBe(3);
});

test('SVG, PNG and CSV hold what is shown', async ({ page }) => {
  await open(page, 'charts.html');
  const chart = page.locator('figure.chart').first();
  const csv = await download(page, chart.getByRole('button', { name: 'CSV' }));
  expect(csv.name).toBe('several-curves.csv');
  const rows = csv.bytes.toString().trim().split('\n');
  expect(rows[0]).toBe('series,axial strain[‰],stress[MPa],upper');
  expect(rows).toHaveLength(1 + 4 * 101);
  const [name, x, y] = rows.find((row) => row.startsWith('seed 2,0.5,'))!.split(',');
  expect([name, Number(x)]).toEqual(['seed 2', 0.5]);
  expect(Number(y)).toBeCloseTo(3 * Math.sin(1.6), 5);
  const svg = await download(page, chart.getByRole('button', { name: 'SVG' }));
  const drawn = svg.bytes.toString();
  expect(svg.name).toBe('several-curves.svg');
  for (const words of ['Several curves', 'axial strain [‰]', 'stress [MPa]', 'laboratory, mean', 'seed 1 &#60;b&#62;&amp;'])
    expect(drawn.includes(words), words).toBe(true);
  expect(drawn.match(/class="js-line"/g)!.length).toBeGreaterThanOrEqual(4);
  const png = await download(page, chart.getByRole('button', { name: 'PNG' }));
  expect(png.bytes.subarray(1, 4).toString()).toBe('PNG');
  expect(png.bytes.readUInt32BE(16)).toBe(2 * 860);
});

test('dark and light follow the reader', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'dark' });
  await open(page, 'charts.html');
  const back = (): Promise<string> => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const title = (): Promise<string> => page.locator('.xtitle').first().evaluate((element) => getComputedStyle(element).fill);
  const [dark, darkTitle] = [await back(), await title()];
  await page.getByRole('button', { name: 'Light' }).press('Enter');
  await expect.poll(back).not.toBe(dark);
  await expect.poll(title).not.toBe(darkTitle);
  await page.getByRole('button', { name: 'Dark' }).click();
  await expect.poll(back).toBe(dark);
});

test('without scripts, and on paper, the curves are there', async ({ browser, page }) => {
  await open(page, 'charts.html');
  await expect(page.locator('svg.plot').first()).toBeHidden();
  await page.emulateMedia({ media: 'print' });
  await expect(page.locator('svg.plot').first()).toBeVisible();
  const plain = await (await browser.newContext({ javaScriptEnabled: false })).newPage();
  await plain.goto(page.url());
  await expect(plain.locator('svg.plot').first()).toBeVisible();
  await expect(plain.locator('svg.plot .line').first()).toBeVisible();
});

test('the report of a calibration has curves, targets in words, and is small', async ({ page }) => {
  await open(page, 'calibration/report.html');
  const bytes = statSync(file('calibration/report.html')).size;
  console.log(`calibration's report: ${bytes} bytes`);
  expect(bytes).toBeLessThan(5e6);
  const rows = page.locator('table.targets tbody tr');
  expect(await rows.count()).toBeGreaterThanOrEqual(3);
  for (const words of await rows.locator('td:last-child').allInnerTexts()) expect(words).toMatch(/✓ met|✗ not met/);
  const charts = page.locator('figure.chart');
  expect(await charts.count()).toBeGreaterThan(2);
  for (let k = 0; k < (await charts.count()); ++k) {
    await expect(charts.nth(k).locator('.scatterlayer .trace').first()).toBeAttached();
    await expect(charts.nth(k).locator('.xtitle')).toBeAttached();
    await expect(charts.nth(k).locator('.ytitle')).toBeAttached();
  }
  await expect(page.locator('footer')).toContainText('spall calibrate case.toml');
  await picture(page, 'report-calibration');
});
