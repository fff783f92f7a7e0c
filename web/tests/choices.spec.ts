/** Every body, scene, fluid, and model. */

import { choices, choose, end, expect, expectPlayable, height, open, seek, set, test } from './page';

test('each body falls', async ({ page }) => {
  await open(page);
  const bodies = await choices(page, 'body');
  expect(bodies).toHaveLength(13);
  // The leaf is there: last, it is chosen anew.
  for (const body of bodies.reverse()) {
    await test.step(body, async () => {
      await choose(page, 'body', body);
      await expect(page.locator('#body')).toHaveValue(body);
      await expect(page.locator('#trouble')).toBeHidden();
      await expect(page.locator('#facts')).toHaveText(
        / g; moves with up to .* g of fluid; U₀ .* m\/s, Re \d+/,
      );
      await seek(page, 0);
      const top = await height(page);
      await seek(page, await end(page));
      expect(await height(page)).toBeLessThan(top - 0.5);
    });
  }
});

test('each built-in scene opens and plays', async ({ page }) => {
  // Each of them is baked.
  test.slow();
  await open(page);
  const scenes = await choices(page, 'scene');
  expect(scenes.length).toBeGreaterThanOrEqual(23);
  const others = scenes.filter((scene) => scene !== 'leaf');
  for (const scene of [...others, 'leaf']) {
    await test.step(scene, async () => {
      await choose(page, 'scene', scene);
      await expect(page.locator('#scene')).toHaveValue(scene);
      await expect(page.locator('#about')).not.toBeEmpty();
      await expect(page.locator('#trouble')).toBeHidden();
      await expectPlayable(page);
    });
  }
});

test('fluids, wind, and models', async ({ page }) => {
  await open(page);
  const airborne = await end(page);
  await set(page, 'body-density', '1500');
  await set(page, 'height', '0.5');
  await choose(page, 'fluid', 'water');
  await expectPlayable(page);
  expect(await end(page)).toBeGreaterThan(airborne);
  await choose(page, 'fluid', 'honey');
  await expectPlayable(page);
  await choose(page, 'fluid', 'own');
  await expect(page.locator('#fluid')).toHaveValue('own');
  await expect(page.locator('#fluid-density')).toHaveValue(/^142\d/);
  await set(page, 'fluid-density', '800');
  await set(page, 'fluid-viscosity', '2');
  await expectPlayable(page);

  await choose(page, 'scene', 'leaf');
  await expect(page.locator('#gust-length')).toHaveCount(0);
  await set(page, 'gusts', '0.5');
  await set(page, 'gust-length', '0.5');
  await set(page, 'wind', '1');
  await expectPlayable(page);
  await set(page, 'gusts', '0');
  await expect(page.locator('#gust-length')).toHaveCount(0);

  const models = await choices(page, 'model');
  expect(models).toHaveLength(4);
  for (const model of models.reverse()) {
    await choose(page, 'model', model);
    await expect(page.locator('#model')).toHaveValue(model);
    // As they are printed, the equations diverge at such steps.
    const said = page.locator('#trouble p');
    await (model === 'published'
      ? expect(said).toHaveText(/^the state diverged at t = /)
      : expect(said).toHaveText(''));
    await expectPlayable(page);
  }
});
