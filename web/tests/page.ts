/** The page under test. A test fails where the page complains, or asks anything of another origin. */

import { readFile } from 'node:fs/promises';
import { type BrowserContext, type Page, test as base, expect } from '@playwright/test';
import { type DecodedPng, decode } from 'fast-png';

export { expect };

/** Of drivers: reading a picture back takes time. */
const HARMLESS = /GPU stall due to ReadPixels/;

function watch(context: BrowserContext, origin: string): string[] {
  const complaints: string[] = [];
  context.on('console', (message) => {
    const grave = message.type() === 'error' || message.type() === 'warning';
    if (grave && !HARMLESS.test(message.text())) {
      complaints.push(`${message.type()}: ${message.text()}`);
    }
  });
  context.on('weberror', (error) => complaints.push(`uncaught: ${error.error().message}`));
  context.on('request', (request) => {
    const { protocol, origin: asked } = new URL(request.url());
    if (protocol !== 'blob:' && protocol !== 'data:' && asked !== origin) {
      complaints.push(`asked another origin: ${request.url()}`);
    }
  });
  return complaints;
}

export const test = base.extend<{ complaints: string[] }>({
  complaints: [
    async ({ context, baseURL }, use) => {
      const complaints = watch(context, new URL(baseURL ?? '').origin);
      await use(complaints);
      expect(complaints).toEqual([]);
    },
    { auto: true },
  ],
});

/** Opens the page and waits for its first run. */
export async function open(page: Page, path = './'): Promise<void> {
  await page.goto(path);
  await page.waitForFunction(() => document.body.dataset['runs'] !== undefined, null, { timeout: 90_000 });
}

/** Runs that were shown. */
export function runs(page: Page): Promise<number> {
  return page.evaluate(() => Number(document.body.dataset['runs']));
}

/** Does what makes another run, and waits until it is shown. */
export async function shown(page: Page, action: () => Promise<unknown>): Promise<void> {
  const before = await runs(page);
  await action();
  await page.waitForFunction((before) => Number(document.body.dataset['runs']) > before, before, {
    timeout: 120_000,
  });
}

/** Types a value into a field of the setup. */
export async function type(page: Page, id: string, value: string): Promise<void> {
  await page.locator(`#${id}`).fill(value);
  await page.locator(`#${id}`).press('Enter');
}

/** Types a value into a field of the setup, and waits for its run. */
export function set(page: Page, id: string, value: string): Promise<void> {
  return shown(page, () => type(page, id, value));
}

/** Chooses from a list, and waits for the run. */
export function choose(page: Page, id: string, value: string): Promise<void> {
  return shown(page, () => page.locator(`#${id}`).selectOption(value));
}

/** What a list has to choose from. */
export function choices(page: Page, id: string): Promise<string[]> {
  return page
    .locator(`#${id} option`)
    .evaluateAll((options) => options.map((option) => (option as HTMLOptionElement).value));
}

/** Waits until so many frames were drawn. */
export function frames(page: Page, count: number): Promise<void> {
  return page.evaluate(async (count) => {
    for (let frame = 0; frame < count; frame++) {
      await new Promise(requestAnimationFrame);
    }
  }, count);
}

/** The moment shown (s). */
export function time(page: Page): Promise<number> {
  return page.locator('#time').evaluate((slider: HTMLInputElement) => slider.valueAsNumber);
}

/** The last moment (s). */
export function end(page: Page): Promise<number> {
  return page.locator('#time').evaluate((slider: HTMLInputElement) => Number(slider.max));
}

/** Goes to a moment (s). */
export async function seek(page: Page, moment: number): Promise<void> {
  await page.locator('#time').evaluate((slider: HTMLInputElement, moment) => {
    slider.value = String(moment);
    slider.dispatchEvent(new Event('input'));
  }, moment);
  await frames(page, 2);
}

/** That the run goes from its release to its end. */
export async function expectPlayable(page: Page): Promise<void> {
  await page.locator('#picture').focus();
  await page.keyboard.press('Home');
  const from = await page.locator('#time').evaluate((slider: HTMLInputElement) => Number(slider.min));
  await expect.poll(() => time(page)).toBeCloseTo(from, 6);
  await page.keyboard.press('End');
  await expect.poll(() => time(page)).toBeCloseTo(await end(page), 6);
  expect(await time(page)).toBeGreaterThan(from);
}

/** Height of the body above the ground as the picture tells it (m). */
export async function height(page: Page): Promise<number> {
  const [, number, unit] = /(-?[\d.]+) (mm|cm|m) up/.exec(await page.locator('#hud').innerText()) ?? [];
  return Number(number) * ({ mm: 1e-3, cm: 1e-2, m: 1 }[unit ?? ''] ?? Number.NaN);
}

/** A file from the download menu. */
export async function download(page: Page, kind: 'glb' | 'csv' | 'png' | 'toml'): Promise<Buffer> {
  const coming = page.waitForEvent('download');
  await page.locator('#downloads summary').click();
  await page.locator(`#downloads [data-file=${kind}]`).click();
  const file = await coming;
  expect(file.suggestedFilename()).toMatch(new RegExp(`\\.${kind}$`));
  return readFile(await file.path());
}

/** Hands a file to the page, as from the file chooser. */
export function give(page: Page, name: string, bytes: Uint8Array | string): Promise<void> {
  const file = { name, mimeType: 'application/octet-stream', buffer: Buffer.from(bytes as Uint8Array) };
  return page.locator('#mesh-file').setInputFiles(file);
}

/** Drops a file onto the picture. */
export async function drop(page: Page, name: string, bytes: Uint8Array | string): Promise<void> {
  const dataTransfer = await page.evaluateHandle(
    ({ name, base64 }) => {
      const transfer = new DataTransfer();
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      transfer.items.add(new File([bytes], name));
      return transfer;
    },
    { name, base64: Buffer.from(bytes as Uint8Array).toString('base64') },
  );
  for (const event of ['dragenter', 'dragover', 'drop']) {
    await page.dispatchEvent('#view', event, { dataTransfer });
  }
}

/** The picture's pixels. */
export async function picture(page: Page): Promise<DecodedPng> {
  await frames(page, 3);
  return decode(await page.locator('#view').screenshot());
}

/** Pixels that pass a test of red, green, and blue: their number and their mean place. */
export function where(
  { width, height, data, channels }: DecodedPng,
  of: (red: number, green: number, blue: number) => boolean,
): { count: number; x: number; y: number } {
  let [count, sumX, sumY] = [0, 0, 0];
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const at = channels * (y * width + x);
      if (of(data[at] ?? 0, data[at + 1] ?? 0, data[at + 2] ?? 0)) {
        count++;
        sumX += x;
        sumY += y;
      }
    }
  }
  return { count, x: sumX / count, y: sumY / count };
}

/** Mean brightness of a picture, from 0 to 255. */
export function brightness({ data, channels }: DecodedPng): number {
  let sum = 0;
  for (let at = 0; at < data.length; at += channels) {
    sum += ((data[at] ?? 0) + (data[at + 1] ?? 0) + (data[at + 2] ?? 0)) / 3;
  }
  return (sum * channels) / data.length;
}

/** Pixels of the lower part, where no words stand, that are not the same in two pictures. */
export function changed(a: DecodedPng, b: DecodedPng): number {
  let count = 0;
  const from = a.channels * a.width * Math.floor(a.height / 5);
  for (let at = from; at < a.data.length; at += a.channels) {
    const apart = [0, 1, 2].map((colour) =>
      Math.abs((a.data[at + colour] ?? 0) - (b.data[at + colour] ?? 0)),
    );
    count += Math.max(...apart) > 8 ? 1 : 0;
  }
  return count;
}
