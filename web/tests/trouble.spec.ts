/** Where the page or a scene cannot work, it says so. */

import { download, end, expect, expectPlayable, set, open, runs, test, type } from './page';

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

test('work that takes long can be stopped, and the run before stays', async ({ page }) => {
  await open(page);
  const [count, last, table] = [await runs(page), await end(page), await download(page, 'csv')];
  await page.locator('#scene').selectOption('leaves');
  await page.locator('#work-stop').click();
  await expect(page.locator('#trouble p')).toHaveText('Stopped. The scene before is still here.');
  expect(await runs(page)).toBe(count);
  expect(await end(page)).toBe(last);
  await expectPlayable(page);
  // All that can be done with it still can.
  await expect(page.locator('#scene')).toHaveValue('leaf');
  await page.locator('#pressure').check();
  await expect(page.locator('#pressure-high')).toHaveText(/Pa$/);
  expect((await download(page, 'csv')).equals(table)).toBe(true);
  await set(page, 'tilt', '20');
  await expect(page.locator('#trouble')).toBeHidden();
});
