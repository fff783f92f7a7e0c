/** Where the page or a scene cannot work, it says so. */

import { end, expect, expectPlayable, open, runs, set, test, type } from './page';

test('without WebGL 2 the page says so plainly', async ({ page }) => {
  await page.addInitScript(() => {
    const own = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: []) {
      return kind === 'webgl2' ? null : own.call(this, kind, ...rest);
    } as typeof own;
  });
  await page.goto('./');
  await expect(page.getByRole('alert')).toHaveText(/^This page draws with WebGL 2.*another browser/);
});

test('an engine that does not load is told of', async ({ page, complaints }) => {
  await page.route(/\.wasm$/, (route) => route.fulfill({ status: 404 }));
  await page.goto('./');
  await expect(page.getByRole('alert')).toHaveText(/^The page could not start: /);
  // The browser tells of the missing file; the page tells nothing more.
  expect(complaints.splice(0)).toEqual([expect.stringContaining('404')]);
});

test('a wrong value is told in words, and the run before stays', async ({ page }) => {
  await open(page);
  const [count, last] = [await runs(page), await end(page)];
  const trouble = page.locator('#trouble');
  await type(page, 'body-density', '-5');
  await expect(trouble).toHaveRole('alert');
  await expect(trouble).toContainText('`density` (kg/m^3) must be between 0 and 1e9, and is -5');
  expect(await runs(page)).toBe(count);
  expect(await end(page)).toBe(last);
  await expectPlayable(page);
  // Shown is the value that the run has.
  await expect(page.locator('#body-density')).toHaveValue('400');

  await page.locator('#body-density').fill('');
  await page.locator('#body-density').press('Enter');
  await expect(page.locator('#body-density')).toHaveAttribute('aria-invalid', 'true');
  expect(await runs(page)).toBe(count);

  await set(page, 'body-density', '500');
  await expect(trouble).toBeHidden();
});
