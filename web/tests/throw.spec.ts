/** The body in the hand. */

import { type Page } from '@playwright/test';
import { brightness, end, expect, open, picture, runs, seek, shown, test } from './page';

interface Moment {
  kind: string;
  x: number;
  y: number;
  /** In seconds. */
  time: number;
}

/** Of the leaf (m), of the page's camera (degrees), and how many lengths of the body away it is. */
const LENGTH = 0.08;
const VIEW_ANGLE = 38;
const LENGTHS_AWAY = 9;
/** What is left of the hand's motion is that of its last tenth of a second. */
const MEMORY = 0.1;

/** Notes where the pointer was, and when. */
async function note(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const moments: Moment[] = [];
    Object.assign(window, { moments });
    for (const kind of ['pointerdown', 'pointermove', 'pointerup']) {
      addEventListener(
        kind,
        (event) => {
          const { clientX: x, clientY: y, timeStamp } = event as PointerEvent;
          moments.push({ kind, x, y, time: timeStamp / 1000 });
        },
        { capture: true },
      );
    }
  });
}

/** Velocity of the hand at its release, to the right and up in the picture (m/s). */
async function handVelocity(page: Page): Promise<{ right: number; up: number }> {
  const moments = await page.evaluate(() => (window as unknown as { moments: Moment[] }).moments);
  const down = moments.findLastIndex(({ kind }) => kind === 'pointerdown');
  const held = moments.slice(down, moments.findLastIndex(({ kind }) => kind === 'pointerup') + 1);
  const released = held.at(-1);
  const path = held.slice(0, -1);
  const last = path.at(-1);
  const before = path.find(({ time }) => time >= (released?.time ?? 0) - MEMORY);
  if (released === undefined || last === undefined || before === undefined) {
    throw new Error('the pointer was not let go');
  }
  const tall = await page.locator('#picture').evaluate((canvas) => canvas.clientHeight);
  const metres = (2 * LENGTHS_AWAY * LENGTH * Math.tan((VIEW_ANGLE * Math.PI) / 360)) / tall;
  const duration = released.time - before.time;
  return { right: (metres * (last.x - before.x)) / duration, up: (metres * (before.y - last.y)) / duration };
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

test('dragged with the mouse and let go, the body flies on as the hand moved', async ({ page }) => {
  await note(page);
  await open(page);
  const { x, y } = await centre(page);
  await page.mouse.move(x, y);
  await shown(page, async () => {
    await page.mouse.down();
    for (let step = 1; step <= 12; step++) {
      await page.mouse.move(x + 8 * step, y - 4 * step);
    }
    await page.mouse.up();
  });
  const hand = await handVelocity(page);
  expect(hand.right).toBeGreaterThan(0.1);
  await expectVelocity(page, hand);
  await expect(page.locator('#scene option:checked')).toHaveText('leaf (changed)');
  expect(Number(await page.locator('#height').inputValue())).toBeGreaterThan(3);
  expect(await end(page)).toBeGreaterThan(0.5);
});

test('held still before it is let go, the body is not thrown', async ({ page }) => {
  await note(page);
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
    await note(page);
    await open(page);
    const { x, y } = await centre(page);
    const fingers = await context.newCDPSession(page);
    const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', points: { x: number; y: number }[]) =>
      fingers.send('Input.dispatchTouchEvent', { type, touchPoints: points });
    await shown(page, async () => {
      await touch('touchStart', [{ x, y }]);
      for (let step = 1; step <= 12; step++) {
        await touch('touchMove', [{ x: x - 8 * step, y: y - 2 * step }]);
      }
      await touch('touchEnd', []);
    });
    const hand = await handVelocity(page);
    expect(hand.right).toBeLessThan(-0.1);
    await expectVelocity(page, hand);
  });
});
