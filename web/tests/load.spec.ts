/** What the page shows first, to all who come. */

import AxeBuilder from '@axe-core/playwright';
import { end, expect, frames, open, test, time } from './page';

test('nothing moves by itself for those who want it so', async ({ page }) => {
  await open(page);
  await frames(page, 20);
  expect(await time(page)).toBe(0);
  await expect(page.locator('#play')).toHaveAccessibleName('Play');
});

test.describe('with motion', () => {
  test.use({ contextOptions: { reducedMotion: 'no-preference' } });

  test('opens on the leaf, which falls by itself to the ground', async ({ page }) => {
    await open(page);
    await expect(page).toHaveTitle(/Langevin Rigid/);
    await expect(page.locator('meta[name=description]')).toHaveAttribute('content', /fall/);
    await expect(page.locator('html')).toHaveAttribute('lang', 'en');
    await expect(page.locator('#scene')).toHaveValue('leaf');
    await expect(page.locator('#about')).toHaveText('An autumn leaf falling from a branch');
    await expect.poll(() => time(page)).toBeGreaterThan(0.2);
    await expect.poll(() => time(page)).toBeCloseTo(await end(page), 6);
    await expect(page.locator('#play')).toHaveAccessibleName('Play');
    await expect(page.locator('#said')).toHaveText(/^leaf: it reached the ground after \d\.\d\d s\.$/);
    await expect(page.locator('#trouble')).toBeHidden();
  });
});

for (const colorScheme of ['light', 'dark'] as const) {
  test.describe(colorScheme, () => {
    test.use({ colorScheme });

    for (const [width, height] of [
      [1200, 700],
      [390, 844],
    ] as const) {
      test(`is accessible and fits, ${width} pixels wide`, async ({ page }) => {
        await page.setViewportSize({ width, height });
        await open(page);
        const scan = async (): Promise<void> => {
          const { violations } = await new AxeBuilder({ page }).analyze();
          const told = violations.map(
            ({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join('\n')}`,
          );
          expect(told).toEqual([]);
          expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
        };
        for (const tab of ['curves', 'loads', 'landings']) {
          await page.locator(`#tab-${tab}`).click();
          await expect(page.locator(`#${tab}`)).toBeVisible();
          await scan();
        }
        await page.locator('#downloads summary').click();
        await scan();
        await page.keyboard.press('Escape');
        await page.locator('#help').click();
        await expect(page.locator('#help-title')).toBeInViewport();
        await scan();
      });
    }
  });
}
