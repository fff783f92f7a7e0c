/** The picture is drawn when something in it changes, and only then: a page that is only looked at rests. */

import type { Page } from '@playwright/test';
import { expect, frames, open, seek, shown, test } from './page';

/** Counts what the page draws. */
async function watch(page: Page): Promise<void> {
  await page.addInitScript(() => {
    let count = 0;
    const drawing = WebGL2RenderingContext.prototype;
    for (const name of ['drawElements', 'drawArrays'] as const) {
      const draw = drawing[name] as (...given: unknown[]) => void;
      Object.assign(drawing, {
        [name](...given: unknown[]) {
          count++;
          return draw.apply(this, given);
        },
      });
    }
    Object.assign(window, { draws: () => count });
  });
}

/** Draws during some frames after something was done. */
async function draws(page: Page, action: () => Promise<unknown>): Promise<number> {
  const count = (): Promise<number> => page.evaluate('draws()');
  const before = await count();
  await action();
  await frames(page, 8);
  return (await count()) - before;
}

test('drawn when something changes, and only then', async ({ page }) => {
  await watch(page);
  await open(page);
  await seek(page, 0.6);
  const still = (): Promise<void> => Promise.resolve();
  const settled = async (): Promise<void> => {
    await frames(page, 8);
    expect(await draws(page, still)).toBe(0);
  };
  await settled();

  const press = (key: string) => async (): Promise<void> => {
    await page.locator('#picture').focus();
    await page.keyboard.press(key);
  };
  const changes: [string, () => Promise<unknown>][] = [
    ['another moment', () => seek(page, 0.7)],
    ...['t', 'c', 'a', 'q', 'p', 'p', 'ArrowLeft', 'ArrowUp', '+'].map(
      (key): [string, () => Promise<unknown>] => [`key ${key}`, press(key)],
    ),
    ['a cause that is hidden', () => page.locator('#loads input').first().dispatchEvent('click')],
    ['another theme', () => page.locator('#theme').click()],
    ['another size', () => page.setViewportSize({ width: 700, height: 650 })],
    ['the camera turned', () => drag(page)],
    ['a curve', () => page.locator('#curves .u-over').first().hover()],
    ['another run', () => shown(page, () => page.locator('#scene').selectOption('coin'))],
  ];
  for (const [what, change] of changes) {
    expect(await draws(page, change), what).toBeGreaterThan(0);
    // Pressures come from the engine, whenever they do.
    await expect.poll(() => draws(page, still), { message: `after ${what}` }).toBe(0);
  }
  await settled();
});

async function drag(page: Page): Promise<void> {
  const box = await page.locator('#picture').boundingBox();
  const { x, y, height } = box ?? { x: 0, y: 0, height: 0 };
  await page.mouse.move(x + 20, y + 0.8 * height);
  await page.mouse.down();
  await page.mouse.move(x + 60, y + 0.7 * height, { steps: 3 });
  await page.mouse.up();
}

test('a throw that cannot be puts the body back', async ({ page }) => {
  await open(page);
  const before = await page.locator('#picture').screenshot();
  // The engine that would compute it is gone.
  await page.evaluate(() => {
    Worker.prototype.postMessage = () => {
      throw new Error('no engine');
    };
  });
  const box = await page.locator('#picture').boundingBox();
  const { x, y, width, height } = box ?? { x: 0, y: 0, width: 0, height: 0 };
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 0.7 * width, y + 0.3 * height, { steps: 3 });
  await page.mouse.up();
  await expect(page.locator('#trouble')).toContainText('no engine');
  await page.locator('#trouble button').click();
  await page.mouse.move(1, 1);
  await frames(page, 8);
  expect((await page.locator('#picture').screenshot()).equals(before)).toBe(true);
});
