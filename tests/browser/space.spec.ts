import { statSync } from 'node:fs';
import { expect } from '@playwright/test';
import type { Locator, Page } from '@playwright/test';
import { compare, download, file, open, picture, still, test } from './pages';

const view = (page: Page): Locator => page.locator('figure.space');
const setSlider = (slider: Locator, value: number): Promise<void> =>
  slider.evaluate((element, to) => {
    (element as HTMLInputElement).value = String(to);
    element.dispatchEvent(new Event('input'));
  }, value);

test('time, cut, threshold and broken links change the picture', async ({ page }) => {
  await open(page, 'scene-20000.html');
  const figure = view(page);
  await expect(figure.locator('.summary')).toContainText('20,000 elements and a mesh of 169 nodes in 20 frames');
  const last = await still(page, figure);
  await setSlider(figure.getByLabel('Frame'), 0);
  await expect(figure).toHaveAttribute('data-frame', '0');
  await expect(figure.locator('.status')).toContainText('t = 0 ms: 20,000 of 20,000 elements shown, damage up to 0, 0 links broken');
  const first = await still(page, figure);
  expect((await compare(page, last, first)).different).toBeGreaterThan(500);

  await setSlider(figure.getByLabel('Frame'), 19);
  await expect(figure.locator('.status')).toContainText('damage up to 1');
  await figure.getByLabel('Finite element mesh').uncheck();
  await figure.getByLabel('Impactor').uncheck();
  const whole = await still(page, figure);
  await figure.getByLabel('Plane').selectOption('across y');
  await expect(figure).toHaveAttribute('data-shown', /^(9|10)\d{3}$/);
  const cut = await still(page, figure);
  const counts = await compare(page, whole, cut);
  expect(counts.other).toBeLessThan(0.85 * counts.one);
  await figure.getByRole('button', { name: 'Flip' }).click();
  await expect(figure.getByRole('button', { name: 'Flip' })).toHaveAttribute('aria-pressed', 'true');
  await picture(page, 'view-cut', figure.locator('.stage'));
  await figure.getByLabel('Plane').selectOption('none');

  await setSlider(figure.getByLabel('Hide below'), 127);
  await expect(figure.locator('.status')).toContainText(/: [1-9],?\d{2,} of 20,000 elements shown/);
  expect((await compare(page, whole, await still(page, figure))).different).toBeGreaterThan(5000);
  await setSlider(figure.getByLabel('Hide below'), 0);

  await figure.getByLabel('Broken links only').check();
  await expect(figure).toHaveAttribute('data-shown', '0');
  const links = await compare(page, whole, await still(page, figure));
  expect(links.other).toBeGreaterThan(200);
  expect(links.other).toBeLessThan(0.5 * links.one);
  await setSlider(figure.getByLabel('Frame'), 0);
  await expect(figure.locator('.status')).toContainText('0 links broken');
});

test('keys turn, zoom, step and read', async ({ page }) => {
  await open(page, 'scene-20000.html');
  const figure = view(page);
  const stage = figure.locator('.stage');
  await expect(stage).toHaveAttribute('aria-label', /20,000 of 20,000 elements shown.*arrows turn/s);
  await stage.focus();
  const one = await still(page, figure);
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowUp');
  const two = await still(page, figure);
  expect((await compare(page, one, two)).different).toBeGreaterThan(5000);
  await page.keyboard.press('z');
  const above = await still(page, figure);
  await page.keyboard.press('+');
  await page.keyboard.press('+');
  const nearer = await compare(page, above, await still(page, figure));
  expect(nearer.other).toBeGreaterThan(1.1 * nearer.one);
  await page.keyboard.press(',');
  await expect(figure).toHaveAttribute('data-frame', '18');
  await page.keyboard.press('0');
  await figure.getByLabel('Impactor').uncheck();
  await stage.focus();
  await page.keyboard.press('Enter');
  await expect(figure.locator('.reading')).toContainText(/element \d+ {2}· {2}at \([−\d.]+, [−\d.]+, [−\d.]+\) mm {2}· {2}damage [\d.]+ {2}· {2}speed/);
});

test('pointing reads an element, playing goes through the frames, PNG saves', async ({ page }) => {
  await open(page, 'scene-20000.html');
  const figure = view(page);
  await still(page, figure);
  const box = (await figure.locator('canvas').boundingBox())!;
  await page.mouse.move(box.x + 0.42 * box.width, box.y + 0.55 * box.height);
  await expect(figure.locator('.reading')).toContainText(/element \d+/);
  await page.mouse.move(box.x + 4, box.y + 4);
  await expect(figure.locator('.reading')).toHaveText('');
  await figure.getByRole('button', { name: 'Play' }).click();
  await expect(figure).not.toHaveAttribute('data-frame', '19');
  await expect(figure).toHaveAttribute('data-frame', '19', { timeout: 60_000 });
  const png = await download(page, figure.getByRole('button', { name: 'PNG' }));
  expect(png.name).toBe('slab-in-space-20.png');
  expect(png.bytes.readUInt32BE(16)).toBeGreaterThan(600);
  expect(png.bytes.length).toBeGreaterThan(20_000);
});

for (const elements of [20000, 120808])
  test(`${elements} elements turn`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: elements > 20000 ? 'dark' : 'light' });
    await open(page, `scene-${elements}.html`);
    const figure = view(page);
    const times = await figure.evaluate((element) => {
      const { measure } = element as unknown as { measure: (turns: number, fraction: number) => number };
      return [1, 0.25, 0.1].map((fraction) => `${measure(4, fraction).toFixed(0)} ms with ${100 * fraction} %`);
    });
    console.log(`${elements} elements: ${statSync(file(`scene-${elements}.html`)).size} bytes; a picture, computed without a graphics card: ${times.join(', ')}`);
    // Dragged for a while, it finds a level of detail that keeps up with the hand.
    const box = (await figure.locator('canvas').boundingBox())!;
    await page.mouse.move(box.x + 300, box.y + 200);
    await page.mouse.down();
    const drawn: number[] = [];
    for (let k = 0; k < 24; ++k) {
      await page.mouse.move(box.x + 300 + 6 * k, box.y + 200 + k);
      drawn.push(Number(await figure.getAttribute('data-detail')));
    }
    await page.mouse.up();
    // A fast machine may draw 20,000 whole even so.
    if (elements > 20000) expect(Math.min(...drawn)).toBeLessThan(1);
    await expect(figure).toHaveAttribute('data-detail', '1.000');
    await picture(page, `view-${elements}`, figure);
  });

test('without WebGL 2 the page says so', async ({ page }) => {
  await page.addInitScript(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  await open(page, 'scene-20000.html');
  await expect(view(page).locator('.absent')).toContainText('needs WebGL 2');
  await expect(view(page).locator('.summary')).toContainText('20,000 elements');
});

for (const [name, least] of [['calibration', 1], ['impact', 1]] as const)
  test(`the report of a real ${name} turns`, async ({ page }) => {
    await open(page, `${name}/report.html`);
    const figures = view(page);
    expect(await figures.count()).toBeGreaterThanOrEqual(least);
    const figure = figures.first();
    await figure.scrollIntoViewIfNeeded();
    const last = await still(page, figure);
    await figure.getByLabel('Plane').selectOption('across x');
    const cut = await compare(page, last, await still(page, figure));
    expect(cut.different).toBeGreaterThan(1000);
    await picture(page, `view-${name}`, figure);
    await figure.getByLabel('Plane').selectOption('none');
    await setSlider(figure.getByLabel('Frame'), 0);
    await expect(figure).toHaveAttribute('data-frame', '0');
    await expect(figure.locator('.status')).toContainText(', 0 links broken');
    expect((await compare(page, last, await still(page, figure))).different).toBeGreaterThan(20);
  });
