/** What the page says: troubles, news, and how far some work is. */

import { byId, words } from './dom';
import { Stopped } from './engine';
import type { OnProgress } from './rpc';

/** Work that takes longer shows a bar (ms). */
const PATIENCE = 250;

/** Shows what went wrong; undefined takes the message away. Work that a person stopped is no trouble. */
export function trouble(error: unknown): void {
  if (error instanceof Stopped) {
    return;
  }
  const place = byId('trouble');
  place.hidden = error === undefined;
  const paragraph = place.querySelector('p');
  if (paragraph !== null) {
    paragraph.textContent = error === undefined ? '' : words(error);
  }
}

/** Tells those who listen to the page. */
export function say(news: string): void {
  byId('said').textContent = news;
}

/** Does some work; a bar shows how far it is if it takes long. */
export async function working<T>(name: string, work: (news: OnProgress) => Promise<T>): Promise<T> {
  const place = byId('work');
  const bar = byId<HTMLProgressElement>('work-bar');
  byId('work-words').textContent = name;
  bar.removeAttribute('value');
  const shown = setTimeout(() => (place.hidden = false), PATIENCE);
  try {
    return await work(({ stage, fraction }) => {
      byId('work-words').textContent = `${name}: ${stage}`;
      bar.value = fraction;
    });
  } finally {
    clearTimeout(shown);
    place.hidden = true;
  }
}
