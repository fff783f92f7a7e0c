/** Files to take along. */

import { byId, h } from './dom';
import type { SceneDocument } from './scene';

export interface DownloadEvents {
  scene(): SceneDocument;
  export(format: string): Promise<Uint8Array>;
  png(): Promise<Blob>;
  trouble(error: unknown): void;
}

export class Downloads {
  readonly #events: DownloadEvents;

  constructor(events: DownloadEvents) {
    this.#events = events;
    const menu = byId<HTMLDetailsElement>('downloads');
    for (const button of menu.querySelectorAll('button')) {
      button.addEventListener('click', () => {
        menu.open = false;
        menu.querySelector('summary')?.focus();
        void this.#download(button.dataset['file'] ?? '');
      });
    }
    menu.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') {
        menu.open = false;
        menu.querySelector('summary')?.focus();
      }
    });
    addEventListener('click', ({ target }) => {
      if (!menu.contains(target as Node)) {
        menu.open = false;
      }
    });
  }

  async #download(kind: string): Promise<void> {
    try {
      save(`${this.#events.scene().name}.${kind}`, await this.#made(kind));
    } catch (error) {
      this.#events.trouble(error);
    }
  }

  async #made(kind: string): Promise<Blob> {
    switch (kind) {
      case 'png':
        return this.#events.png();
      case 'toml':
        return new Blob([this.#events.scene().text()], { type: 'application/toml' });
      default:
        return new Blob([(await this.#events.export(kind)) as BlobPart]);
    }
  }
}

function save(name: string, blob: Blob): void {
  const href = URL.createObjectURL(blob);
  const link = h('a', { href, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(href), 10_000);
}
