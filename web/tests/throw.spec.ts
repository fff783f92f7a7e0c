/** The body in the hand. */

import { type Page } from '@playwright/test';
import { brightness, end, expect, open, picture, runs, seek, shown, test } from './page';

/** Length of the leaf (m), the angle that the page's camera sees (degrees), and its distance in lengths. */
const LENGTH = 0.08;
const VIEW_ANGLE = 38;
const LENGTHS_AWAY = 9;

/** A hand moves by so many pixels in each of twelve hundredths of a second. */
const STEPS = 12;
const STEP = 0.01;

/** Metres a second of a pixel in each step. */
async function metresPerSecond(page: Page): Promise<number> {
  const tall = await page.locator('#picture').evaluate((canvas) => canvas.clientHeight);
  return (2 * LENGTHS_AWAY * LENGTH * Math.tan((VIEW_ANGLE * Math.PI) / 360)) / tall / STEP;
}

/** That the body was let go with the velocity of the hand, as the camera sees it from (0.35, 0.16, 1). */
async function expectVelocity(page: Page, { right, up }: { right: number; up: number }): Promise<void> {
  const speed = await Promise.all(
    ['x', 'y', 'z'].map(async (axis) => Number(await page.locator(`#speed-${axis}`).inputValue())),
  );
  const [x, y, z] = [0.35, 0.16, 1].map((part) => part / Math.hypot(0.35, 0.16, 1)) as [
    number,
    number,
    number,
  ];
  const level = Math.hypot(x, z);
  const rightward = [z / level, 0, -x / level];
  const upward = [(-y * x) / level, level, (-y * z) / level];
  const close = 0.02 * Math.hypot(right, up) + 0.005;
  [0, 1, 2].forEach((axis) => {
    const expected = right * (rightward[axis] ?? 0) + up * (upward[axis] ?? 0);
    expect(Math.abs((speed[axis] ?? Number.NaN) - expected)).toBeLessThan(close);
  });
}

async function centre(page: Page): Promise<{ x: number; y: number }> {
  const { x, y, width, height } = (await page.locator('#picture').boundingBox()) ?? {
    x: 0,
    y: 0,
    width: 0,
    height: 0,
  };
  return { x: x + width / 2, y: y + height / 2 };
}

test('dragged with the mouse and let go, the body flies on as the hand moved', async ({ page, context }) => {
  await open(page);
  const { x, y } = await centre(page);
  await page.mouse.move(x, y);
  // With times of its own: the hand is as fast as it is, however slow the machine.
  const hand = await context.newCDPSession(page);
  const begun = Date.now() / 1000;
  const mouse = (type: 'mousePressed' | 'mouseMoved' | 'mouseReleased', step: number) =>
    hand.send('Input.dispatchMouseEvent', {
      type,
      x: x + 8 * step,
      y: y - 4 * step,
      button: 'left',
      buttons: type === 'mouseReleased' ? 0 : 1,
      clickCount: type === 'mouseMoved' ? 0 : 1,
      timestamp: begun + STEP * step,
    });
  await shown(page, async () => {
    await mouse('mousePressed', 0);
    for (let step = 1; step <= STEPS; step++) {
      await mouse('mouseMoved', step);
    }
    await mouse('mouseReleased', STEPS);
  });
  const unit = await metresPerSecond(page);
  await expectVelocity(page, { right: 8 * unit, up: 4 * unit });
  await expect(page.locator('#scene option:checked')).toHaveText('leaf (changed)');
  expect(Number(await page.locator('#height').inputValue())).toBeGreaterThan(3);
  expect(await end(page)).toBeGreaterThan(0.5);
});

test('held still before it is let go, the body is not thrown', async ({ page }) => {
  await open(page);
  const { x, y } = await centre(page);
  await page.mouse.move(x, y);
  await shown(page, async () => {
    await page.mouse.down();
    await page.mouse.move(x + 60, y, { steps: 5 });
    const moved = await page.evaluate(() => performance.now());
    await page.waitForFunction((moved) => performance.now() > moved + 300, moved);
    await page.mouse.up();
  });
  for (const axis of ['x', 'y', 'z']) {
    await expect(page.locator(`#speed-${axis}`)).toHaveValue('0');
  }
});

test('dragged beside the body, the picture turns and nothing is thrown', async ({ page }) => {
  await open(page);
  await seek(page, 1);
  const { width = 0, height = 0, x = 0, y = 0 } = (await page.locator('#picture').boundingBox()) ?? {};
  const before = await picture(page);
  const count = await runs(page);
  await page.mouse.move(x + 0.1 * width, y + 0.8 * height);
  await page.mouse.down();
  await page.mouse.move(x + 0.1 * width, y + 0.3 * height, { steps: 5 });
  await page.mouse.up();
  const after = await picture(page);
  expect(Math.abs(brightness(after) - brightness(before))).toBeGreaterThan(0.5);
  expect(await runs(page)).toBe(count);
});

test.describe('with a finger', () => {
  test.use({ hasTouch: true });

  test('the body is thrown too', async ({ page, context }) => {
    await open(page);
    const { x, y } = await centre(page);
    const hand = await context.newCDPSession(page);
    const begun = Date.now() / 1000;
    const finger = (type: 'touchStart' | 'touchMove' | 'touchEnd', step: number) =>
      hand.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: type === 'touchEnd' ? [] : [{ x: x - 8 * step, y: y - 2 * step }],
        timestamp: begun + STEP * step,
      });
    await shown(page, async () => {
      await finger('touchStart', 0);
      for (let step = 1; step <= STEPS; step++) {
        await finger('touchMove', step);
      }
      await finger('touchEnd', STEPS);
    });
    const unit = await metresPerSecond(page);
    await expectVelocity(page, { right: -8 * unit, up: 2 * unit });
  });
});
