/** The address bar, which holds the scene that is shown. */

import { byId } from './dom';
import { toFragment } from './link';
import { say, trouble } from './messages';
import type { SceneDocument } from './scene';

export class Address {
  #written = '';

  constructor(
    readonly scene: () => SceneDocument,
    readonly version: () => string,
  ) {
    byId('share').addEventListener('click', () => void this.#share());
  }

  /** Whether the address is another than was written. */
  get isForeign(): boolean {
    return location.hash !== this.#written;
  }

  /** Writes the scene; whether there is room for it. */
  async write(): Promise<boolean> {
    const fragment = await toFragment(this.scene(), this.version());
    this.#written = fragment ?? '';
    history.replaceState(null, '', fragment ?? location.pathname + location.search);
    return fragment !== undefined;
  }

  async #share(): Promise<void> {
    if (!(await this.write())) {
      trouble(
        'The mesh is too large for a link. Download the scene and send it with the mesh; others drop both here.',
      );
      return;
    }
    try {
      await navigator.clipboard.writeText(location.href);
      say('The link is copied.');
      const button = byId('share');
      button.textContent = 'Copied ✓';
      setTimeout(() => (button.textContent = 'Copy link'), 1500);
    } catch {
      trouble('The browser did not let the link be copied: copy it from the address bar.');
    }
  }
}
