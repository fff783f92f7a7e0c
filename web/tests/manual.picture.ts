/** `npm run picture`: the picture of the manual. */

import { test } from '@playwright/test';

test('the picture of the manual', async ({ page }) => {
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.goto('./');
  await page.locator('body[data-runs]').waitFor();
  for (const id of ['pressure', 'forces', 'copies']) {
    await page.check(`#${id}`);
  }
  await page.focus('#picture');
  for (let nearer = 0; nearer < 4; nearer++) {
    await page.keyboard.press('+');
  }
  await page.locator('#time').fill('1.26');
  await page.locator('#pressure-high:not(:empty)').waitFor();
  await page.screenshot({ path: '../docs/images/viewer.png' });
});
