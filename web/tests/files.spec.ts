/** What leaves the page, and comes back: links and files. */

import { deflateRawSync } from 'node:zlib';
import { decode } from 'fast-png';
import { BOX, stl } from './meshes';
import { choose, download, drop, end, expect, expectPlayable, give, open, set, shown, test } from './page';

test('a link opens the same fall to the last bit', async ({ page, context }) => {
  await open(page);
  await choose(page, 'body', 'disc');
  await set(page, 'body-radius', '25');
  await set(page, 'tilt', '17');
  await set(page, 'spin-y', '1.5');
  await set(page, 'gusts', '0.2');
  await set(page, 'seed', '42');
  const unthrown = page.url();
  const { x = 0, y = 0, width = 0, height = 0 } = (await page.locator('#picture').boundingBox()) ?? {};
  await page.mouse.move(x + width / 2, y + height / 2);
  await shown(page, async () => {
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 50, y + height / 2 - 30, { steps: 8 });
    await page.mouse.up();
  });
  const table = await download(page, 'csv');
  await expect(page).not.toHaveURL(unthrown);

  const other = await context.newPage();
  await open(other, page.url());
  expect((await download(other, 'csv')).equals(table)).toBe(true);
  await expect(other.locator('#seed')).toHaveValue('42');
  await expect(other.locator('#scene option:checked')).toHaveText('disc');
  expect((await download(page, 'csv')).equals(table)).toBe(true);
  // And again from there.
  expect(other.url()).toBe(page.url());
});

test('a link holds a mesh too', async ({ page, context }) => {
  await open(page);
  await shown(page, () => give(page, 'box.stl', stl(BOX)));
  await expect(page).toHaveURL(/#.*file=/);
  const table = await download(page, 'csv');
  const other = await context.newPage();
  await open(other, page.url());
  expect((await download(other, 'csv')).equals(table)).toBe(true);
});

test('a link may be of a built-in scene, of another, or damaged', async ({ page }) => {
  await open(page, './#coin');
  await expect(page.locator('#scene')).toHaveValue('coin');

  await shown(page, () => page.evaluate(() => void (location.hash = '#fan')));
  await expect(page.locator('#scene')).toHaveValue('fan');

  await expect(page).toHaveURL(/scene=/);
  const whole = page.url();
  const trouble = page.locator('#trouble p');
  await page.goto('about:blank');
  await open(page, whole.slice(0, -40));
  await expect(trouble).toHaveText('the link is damaged: a part of it is missing or was changed');
  await expect(page.locator('#scene')).toHaveValue('leaf');
  await expectPlayable(page);

  await page.goto('about:blank');
  await open(page, whole.replace(/version=[^&]*/, 'version=0.0.1'));
  await expect(trouble).toHaveText(/^The link was made by version 0\.0\.1, this is /);
  await expect(page.locator('#scene')).toHaveValue('fan');

  await page.goto('about:blank');
  const wrong = deflateRawSync('[body]\nshape = "cube"\n').toString('base64url');
  await open(page, `./#name=cube&scene=${wrong}`);
  await expect(trouble).toContainText('cube');
  await expect(page.locator('#scene')).toHaveValue('leaf');

  await page.goto('about:blank');
  await open(page, './#no-such-scene');
  await expect(trouble).toHaveText('the link names no scene: there is none called “no-such-scene”');
  await expect(page.locator('#scene')).toHaveValue('leaf');
  await page.locator('#trouble button').click();
  await expect(page.locator('#trouble')).toBeHidden();
});

test('animation, table, picture, and scene are files', async ({ page }) => {
  await open(page);
  await set(page, 'tilt', '25');

  const glb = await download(page, 'glb');
  expect(glb.toString('latin1', 0, 4)).toBe('glTF');
  expect(glb.readUInt32LE(4)).toBe(2);
  expect(glb.readUInt32LE(8)).toBe(glb.length);
  expect(glb.toString('latin1', 16, 20)).toBe('JSON');
  const told = JSON.parse(glb.toString('utf8', 20, 20 + glb.readUInt32LE(12))) as {
    animations: { channels: unknown[] }[];
    meshes: unknown[];
  };
  expect(told.animations).toHaveLength(1);
  expect(told.animations[0]?.channels.length).toBeGreaterThanOrEqual(2);
  expect(told.meshes).toHaveLength(1);

  const csv = await download(page, 'csv');
  const lines = csv.toString('utf8').trimEnd().split('\n');
  expect(lines[0]).toBe('body,t,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz');
  const rows = lines.slice(1).map((line) => line.split(',').map(Number));
  expect(rows.length).toBeGreaterThan(100);
  expect(rows.every((row) => row.length === 15 && row.every(Number.isFinite))).toBe(true);
  expect(rows[0]?.slice(0, 5)).toEqual([0, 0, 0, 3, 0]);
  expect(rows.at(-1)?.[1]).toBeCloseTo(await end(page), 6);

  const png = decode(await download(page, 'png'));
  const size = await page
    .locator('#picture')
    .evaluate((canvas: HTMLCanvasElement) => [canvas.width, canvas.height]);
  expect([png.width, png.height]).toEqual(size);
  expect(new Set(png.data).size).toBeGreaterThan(30);

  const toml = await download(page, 'toml');
  expect(toml.toString('utf8')).toContain('tilt = 25');
  await choose(page, 'scene', 'coin');
  await shown(page, () => drop(page, 'leaf.toml', toml));
  await expect(page.locator('#tilt')).toHaveValue('25');
  expect((await download(page, 'csv')).equals(csv)).toBe(true);
});
