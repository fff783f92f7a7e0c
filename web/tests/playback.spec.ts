/** Moments of a run: slider, keys, speed, and curves. */

import { end, expect, frames, open, seek, test, time } from './page';

test('slider and keys go through the run', async ({ page }) => {
  await open(page);
  const last = await end(page);
  // Between two steps.
  await seek(page, 1.001);
  await expect(page.locator('#clock')).toHaveText(`1.00 / ${last.toFixed(2)} s`);
  await expect(page.locator('#hud')).toContainText('1.00 s');
  await expect(page.locator('#time')).toHaveAttribute('aria-valuetext', '1.00 seconds');

  await page.locator('#picture').focus();
  const press = async (key: string, expected: number): Promise<void> => {
    await page.keyboard.press(key);
    await expect.poll(() => time(page)).toBeCloseTo(expected, 6);
  };
  await press('.', 1.002);
  await press('.', 1.004);
  await press(',', 1.002);
  await press(']', 1.102);
  await press('[', 1.002);
  await press('[', 0.902);
  await press('End', last);
  await press('.', last);
  await press('Home', 0);
  await press(',', 0);
  await page.locator('#forth').click();
  await expect.poll(() => time(page)).toBeCloseTo(0.002, 6);
  await page.locator('#back').click();
  await expect.poll(() => time(page)).toBe(0);

  // The slider's own keys.
  await page.locator('#time').focus();
  await page.keyboard.press('End');
  await expect.poll(() => time(page)).toBeCloseTo(last, 6);
});

test('plays, pauses, and keeps its speed', async ({ page }) => {
  await open(page);
  const play = page.locator('#play');
  await page.locator('#rate').selectOption('0.02');
  await page.locator('#picture').focus();
  const begun = Date.now();
  await page.keyboard.press('Space');
  await expect(play).toHaveAccessibleName('Pause');
  await expect.poll(() => time(page)).toBeGreaterThan(0.01);
  await page.keyboard.press('Space');
  await expect(play).toHaveAccessibleName('Play');
  const paused = await time(page);
  expect(paused).toBeLessThanOrEqual((0.02 * (Date.now() - begun)) / 1000);
  await frames(page, 10);
  expect(await time(page)).toBe(paused);

  await page.locator('#rate').selectOption('4');
  await play.click();
  await expect.poll(() => time(page)).toBeCloseTo(await end(page), 6);
  await expect(play).toHaveAccessibleName('Play');

  // From the end it begins anew.
  await page.locator('#rate').selectOption('0.02');
  await page.locator('#picture').focus();
  await page.keyboard.press('Space');
  await expect.poll(() => time(page)).toBeLessThan(0.5);
  await page.keyboard.press('Space');
  await page.keyboard.press('r');
  await expect(play).toHaveAccessibleName('Pause');
});

test('a curve shows the moment under the pointer', async ({ page }) => {
  await open(page);
  await seek(page, 0.5);
  const clock = page.locator('#clock');
  await expect(clock).toHaveText(/^0\.50 /);
  const speed = page.locator('#curves .chart', { hasText: 'Speed' });
  const still = await speed.locator('.value').innerText();
  const middle = speed.locator('.u-over');
  await middle.hover();
  const half = ((await end(page)) / 2).toFixed(1);
  await expect(clock).toHaveText(new RegExp(`^${half.replace('.', '\\.')}`));
  await expect(speed.locator('.value')).not.toHaveText(still);
  await page.locator('#about, #bar h1').first().hover();
  await expect(clock).toHaveText(/^0\.50 /);
  await expect(speed.locator('.value')).toHaveText(still);
});
