/** Runs beside each other, many landings, and many bodies. */

import { choose, download, end, expect, expectPlayable, frames, open, runs, test, time } from './page';

test('a run is compared with another model, and with other seeds', async ({ page }) => {
  await open(page);
  const curves = page.locator('#curves');
  await expect(curves).toHaveAttribute('data-runs', '1');
  await expect(page.locator('.label')).toHaveCount(0);
  await page.locator('#compare').selectOption('consistent');
  await expect(curves).toHaveAttribute('data-runs', '2');
  await expect(page.locator('.label')).toHaveText(['separated', 'consistent']);
  await expectPlayable(page);

  // It goes with the run.
  await choose(page, 'body', 'disc');
  await expect(page.locator('#compare')).toHaveValue('consistent');
  await expect(curves).toHaveAttribute('data-runs', '2');

  await page.locator('#compare').selectOption('seeds');
  await expect(curves).toHaveAttribute('data-runs', '10');
  await expectPlayable(page);

  await page.locator('#compare').selectOption('none');
  await expect(curves).toHaveAttribute('data-runs', '1');
  await expect(page.locator('.label')).toHaveCount(0);
  await expectPlayable(page);
});

test.describe('with motion', () => {
  test.use({ contextOptions: { reducedMotion: 'no-preference' } });

  test('landings add up while the run plays', async ({ page }) => {
    await open(page);
    await page.locator('#rate').selectOption('0.02');
    await page.locator('#tab-landings').click();
    const button = page.locator('#landings button');
    const told = page.locator('#landings p');
    const count = async (): Promise<number> =>
      Number(/(\d+) of (\d+) landed/.exec(await told.innerText())?.[2] ?? 0);
    await expect(button).toHaveText('Drop many');
    await button.click();
    await expect(button).toHaveText('Stop');
    await expect.poll(count).toBeGreaterThan(0);
    const [before, first] = [await time(page), await count()];
    await expect.poll(count).toBeGreaterThan(first);
    await expect.poll(() => time(page)).not.toBe(before);
    await expect(told).toHaveText(
      /^\d+ of \d+ landed; half within [\d.]+ c?m of the point below the release\.$/,
    );
    await button.click();
    await expect(button).toHaveText('Go on');
    const stopped = await count();
    await frames(page, 20);
    expect(await count()).toBe(stopped);
    await button.click();
    await expect.poll(count).toBeGreaterThan(stopped);

    // Another scene has other landings.
    await choose(page, 'body', 'card');
    await expect(button).toHaveText('Drop many');
    expect(await count()).toBe(0);
  });
});

test('five thousand fall at once, and give the run back', async ({ page }) => {
  await page.setViewportSize({ width: 720, height: 480 });
  await open(page);
  const [before, last] = [await runs(page), await end(page)];
  await page.locator('#many').check();
  await expect(page.locator('body')).toHaveAttribute('data-many', 'on', { timeout: 120_000 });
  await expect(page.locator('#hud')).toHaveText(
    /^5,000 bodies\s+simulation [\d.]+ ms .*drawing +[\d.]+ ms$/s,
  );
  const released = await download(page, 'png');
  await page.locator('#picture').focus();
  await page.keyboard.press('Space');
  await expect(page.locator('#hud')).toHaveText(/simulation (?!0\.0 )[\d.]+ ms/, { timeout: 60_000 });
  await frames(page, 3);
  await page.keyboard.press('Space');
  await frames(page, 2);
  expect((await download(page, 'png')).equals(released)).toBe(false);

  await page.locator('#many').uncheck();
  await expect(page.locator('body')).not.toHaveAttribute('data-many');
  await expect.poll(() => runs(page)).toBe(before + 1);
  expect(await end(page)).toBe(last);
  await expectPlayable(page);
  await expect(page.locator('#hud')).toContainText('m/s');
});
