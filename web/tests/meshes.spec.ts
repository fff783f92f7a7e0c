/** One's own meshes: good, mended, and bad. */

import { BOX, SHEET, glb, obj, ply, stl } from './meshes';
import { drop, end, expect, expectPlayable, give, height, open, runs, seek, set, shown, test } from './page';

test('meshes of each format fall', async ({ page }) => {
  await open(page);
  for (const [name, bytes] of [
    ['box.obj', obj(BOX)],
    ['box.stl', stl(BOX)],
    ['box.ply', ply(BOX)],
    ['box.glb', glb(BOX)],
  ] as const) {
    await test.step(name, async () => {
      await shown(page, () => give(page, name, bytes));
      await expect(page.locator('#mesh-told')).toContainText(`${name}: 12 triangles, 6 cm × 3 mm × 4 cm`);
      await expect(page.locator('#trouble')).toBeHidden();
      await seek(page, 0);
      const top = await height(page);
      await seek(page, await end(page));
      expect(await height(page)).toBeLessThan(top - 0.4);
    });
  }
  // Metres are sure in GLB; numbers alone may be of any unit.
  await expect(page.locator('#mesh-unit')).toHaveCount(0);
  await shown(page, () => drop(page, 'box.obj', obj(BOX)));
  await expect(page.locator('#mesh-unit')).toHaveValue('mm');
  await shown(page, () => page.locator('#mesh-unit').selectOption('cm'));
  await expect(page.locator('#mesh-told')).toContainText('60 cm × 3 cm × 40 cm');
});

test('a mesh with a hole is mended, and says so', async ({ page }) => {
  await open(page);
  await shown(page, () =>
    give(page, 'box.obj', obj({ vertices: BOX.vertices, triangles: BOX.triangles.slice(1) })),
  );
  await expect(page.locator('#mesh-told')).toContainText('12 triangles');
  await expect(page.locator('#mesh-told')).toContainText(/filled 1 hole/);
  await expectPlayable(page);
});

test('bad meshes are told in words, and the run before stays', async ({ page }) => {
  await open(page);
  await shown(page, () => give(page, 'box.obj', obj(BOX)));
  const [before, last] = [await runs(page), await end(page)];
  const trouble = page.locator('#trouble p');
  for (const [name, bytes, said] of [
    ['empty.obj', '', /`empty\.obj` is empty/],
    ['letter.obj', 'Dear reader, this is no mesh.\n', /letter\.obj.*there are no triangles/],
    ['short.stl', stl(BOX).subarray(0, 400), /short\.stl.*the file ends at facet 6 of 12/],
    ['nan.obj', obj(BOX).replace('v 60 3 40', 'v NaN 3 40'), /nan\.obj.*`NaN` is not a number/],
    ['thing.fbx', 'Kaydara FBX Binary', /`thing\.fbx` is an FBX scene, which is not read/],
    ['broken.toml', 'body = [', /broken\.toml/],
    ['sheet.obj', obj(SHEET), /sheet\.obj: the surface is open.*needs a thickness/],
  ] as const) {
    await test.step(name, async () => {
      await give(page, name, bytes);
      await expect(trouble).toHaveText(said);
      expect(await runs(page)).toBe(before);
      expect(await end(page)).toBe(last);
      await expectPlayable(page);
    });
  }
  await expect(page.locator('#mesh-told')).toHaveRole('alert');

  await set(page, 'mesh-thickness', '0.5');
  await expect(page.locator('#trouble')).toBeHidden();
  await expect(page.locator('#mesh-told')).toContainText('sheet.obj');
  await expectPlayable(page);
});
