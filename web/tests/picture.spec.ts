/** The pixels. */

import { brightness, changed, choose, expect, frames, open, picture, seek, test, where } from './page';

/** Colours of an autumn leaf, in light and in shade; neither sky nor ground has them. */
const ofLeaf = (red: number, green: number, blue: number): boolean =>
  red > 60 && red > 1.5 * green && red > 2 * blue;

test('the body is in the picture, and elsewhere later', async ({ page }) => {
  await open(page);
  await page.locator('#trail').uncheck();
  await seek(page, 0.3);
  // From above more of it is seen.
  const flat = where(await picture(page), ofLeaf);
  await page.locator('#picture').focus();
  for (let press = 0; press < 6; press++) {
    await page.keyboard.press('ArrowUp');
  }
  const near = where(await picture(page), ofLeaf);
  expect(near.count).toBeGreaterThan(1.5 * flat.count);
  expect(near.count).toBeGreaterThan(100);

  await page.locator('#follow').uncheck();
  const early = where(await picture(page), ofLeaf);
  await seek(page, 1.6);
  const late = where(await picture(page), ofLeaf);
  expect(early.count).toBeGreaterThan(2);
  expect(late.count).toBeGreaterThan(2);
  expect(early.count).toBeLessThan(near.count);
  expect(late.y).toBeGreaterThan(early.y + 40);

  // Its way is drawn in its colour.
  await page.locator('#trail').check();
  expect(where(await picture(page), ofLeaf).count).toBeGreaterThan(2 * late.count);
});

test('arrows, copies, and pressure have colours of their own', async ({ page }) => {
  await open(page);
  await seek(page, 0.6);
  await page.locator('#forces').check();
  const green = where(await picture(page), (red, green, blue) => green > 1.5 * red && green > 1.3 * blue);
  expect(green.count).toBeGreaterThan(50);
  await page.locator('#forces').uncheck();
  const plain = await picture(page);
  await page.locator('#copies').check();
  expect(changed(await picture(page), plain)).toBeGreaterThan(50);
  await page.locator('#copies').uncheck();
  expect(changed(await picture(page), plain)).toBe(0);
  await page.locator('#pressure').check();
  await expect(page.locator('#pressure-high')).toHaveText(/^[1-9][\d.]* Pa$/);
  expect(changed(await picture(page), plain)).toBeGreaterThan(50);
});

test('the dark theme is dark, and the choice is kept', async ({ page }) => {
  await open(page);
  const light = await picture(page);
  const theme = page.locator('#theme');
  await expect(theme).toHaveAccessibleName('Colours: as the system has them');
  await theme.click();
  await expect(theme).toHaveAccessibleName('Colours: light');
  await theme.click();
  await expect(theme).toHaveAccessibleName('Colours: dark');
  await frames(page, 2);
  const dark = await picture(page);
  expect(brightness(light)).toBeGreaterThan(170);
  expect(brightness(dark)).toBeLessThan(90);
  const colours = await page.evaluate(() => {
    const { color, backgroundColor } = getComputedStyle(document.body);
    return [color, backgroundColor].map((colour) => Number(/\d+/.exec(colour)?.[0]));
  });
  expect(colours[0]).toBeGreaterThan(200);
  expect(colours[1]).toBeLessThan(50);

  await page.reload();
  await expect(theme).toHaveAccessibleName('Colours: dark');
});

test('a small window and a large one are filled', async ({ page }) => {
  await open(page);
  for (const [width, height] of [
    [390, 844],
    [1300, 500],
  ] as const) {
    await page.setViewportSize({ width, height });
    const view = page.locator('#view');
    await expect
      .poll(async () => {
        const [frame, canvas] = [await view.boundingBox(), await page.locator('#picture').boundingBox()];
        return Math.max(
          Math.abs((frame?.width ?? 0) - (canvas?.width ?? 0)),
          Math.abs((frame?.height ?? 0) - (canvas?.height ?? 0)),
        );
      })
      .toBeLessThan(1.5);
  }
  await choose(page, 'body', 'coin');
  await seek(page, 0.1);
  const copper = where(await picture(page), (red, green, blue) => red > 1.2 * green && green > 1.2 * blue);
  expect(copper.count).toBeGreaterThan(50);
});
