/** The page without a pointer. */

import { type Page } from '@playwright/test';
import { choose, end, expect, open, seek, shown, test, time } from './page';

/** Goes on by Tab until a control has the focus; each on the way must show that it has it. */
async function tabTo(page: Page, id: string): Promise<void> {
  for (let presses = 0; presses < 80; presses++) {
    await page.keyboard.press('Tab');
    const focused = await page.evaluate(() => {
      const control = document.activeElement ?? document.body;
      const { outlineStyle, outlineWidth } = getComputedStyle(control);
      const ring = outlineStyle !== 'none' && Number.parseFloat(outlineWidth) >= 2;
      return { id: control.id, tag: control.outerHTML.slice(0, 80), ring };
    });
    expect(focused.ring, `no ring around ${focused.tag}`).toBe(true);
    if (focused.id === id) {
      return;
    }
  }
  throw new Error(`Tab does not reach #${id}`);
}

test('all of it can be done with the keyboard', async ({ page }) => {
  await open(page);
  await page.keyboard.press('Tab');
  await expect(page.locator('.skip')).toBeFocused();
  await expect(page.locator('.skip')).toBeInViewport();
  await page.keyboard.press('Enter');
  await expect(page.locator('#setup')).toBeFocused();

  await tabTo(page, 'body');
  await shown(page, async () => {
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
  });
  await expect(page.locator('#body')).toHaveValue('sheet');
  // The setup is new, the focus is where it was.
  await expect(page.locator('#body')).toBeFocused();

  await tabTo(page, 'tilt');
  const tilt = Number(await page.locator('#tilt').inputValue());
  await shown(page, () => page.keyboard.press('ArrowUp'));
  await expect(page.locator('#tilt')).toHaveValue(String(tilt + 5));
  await expect(page.locator('#tilt')).toBeFocused();

  await tabTo(page, 'tab-curves');
  await page.keyboard.press('ArrowRight');
  await expect(page.locator('#tab-loads')).toBeFocused();
  await expect(page.locator('#loads')).toBeVisible();
  await expect(page.locator('#curves')).toBeHidden();
  await page.keyboard.press('End');
  await expect(page.locator('#landings')).toBeVisible();
  await page.keyboard.press('ArrowRight');
  await expect(page.locator('#curves')).toBeVisible();

  await page.locator('.skip').focus();
  await tabTo(page, 'share');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Tab');
  const coming = page.waitForEvent('download');
  await page.keyboard.press('Enter');
  expect((await coming).suggestedFilename()).toBe('sheet.csv');
  await expect(page.locator('#downloads')).not.toHaveAttribute('open');
  await expect(page.locator('#downloads summary')).toBeFocused();

  await tabTo(page, 'help');
  await page.keyboard.press('Enter');
  await expect(page.locator('#help-dialog')).toBeVisible();
  await expect(page.locator('#help-title')).toBeInViewport();
  await page.keyboard.press('Escape');
  await expect(page.locator('#help-dialog')).toBeHidden();
  await expect(page.locator('#help')).toBeFocused();
  await page.keyboard.press('?');
  await expect(page.locator('#help-dialog')).toBeVisible();
  await page.keyboard.press('Escape');

  await tabTo(page, 'play');
  await page.keyboard.press('Space');
  await expect(page.locator('#play')).toHaveAccessibleName('Pause');
  await expect.poll(() => time(page)).toBeGreaterThan(0);
  await tabTo(page, 'follow');
  await page.keyboard.press('Space');
  await expect(page.locator('#follow')).not.toBeChecked();
  await expect.poll(() => time(page)).toBeCloseTo(await end(page), 6);
});

test('letters switch what the picture shows', async ({ page }) => {
  await open(page);
  await seek(page, 1);
  await page.locator('#picture').focus();
  for (const [key, id] of [
    ['f', 'follow'],
    ['t', 'trail'],
    ['c', 'copies'],
    ['a', 'forces'],
    ['q', 'torques'],
    ['p', 'pressure'],
  ] as const) {
    const before = await page.locator(`#${id}`).isChecked();
    await page.keyboard.press(key);
    await expect(page.locator(`#${id}`)).toBeChecked({ checked: !before });
  }
  await expect(page.locator('#pressure-high')).toHaveText(/^[1-9][\d.]* Pa$/);
  await page.locator('#tab-loads').click();
  await expect(page.locator('#loads tbody tr:visible').first()).toContainText('Weight');
});

test('all controls have names', async ({ page }) => {
  await open(page);
  // With the fields that some scenes have and others lack.
  await choose(page, 'fluid', 'own');
  const controls = page.locator(
    'button, select, input, summary, a, #picture, #landings canvas, [role=tab], [role=tabpanel]',
  );
  for (const control of await controls.all()) {
    if (await control.isVisible()) {
      await expect(control).toHaveAccessibleName(/\S/);
    }
  }
});
