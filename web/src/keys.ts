/** Keys. */

import { byId, h } from './dom';

export interface KeyEvents {
  play(): void;
  step(frames: number): void;
  /** By so many seconds of the run. */
  skip(seconds: number): void;
  /** To a share of the run. */
  seek(share: number): void;
  again(): void;
  /** Turns the camera (radians), and its distance by a factor. */
  orbit(heading: number, height: number, distance: number): void;
  canvas: HTMLElement;
}

const TURN = 0.12;

export class Keys {
  constructor(events: KeyEvents) {
    const click = (id: string) => (): void => byId(id).click();
    const keys: Record<string, [string, () => void]> = {
      ' ': ['Play and pause', events.play],
      ',': ['A step back', () => events.step(-1)],
      '.': ['A step on', () => events.step(1)],
      '[': ['A tenth of a second back', () => events.skip(-0.1)],
      ']': ['A tenth of a second on', () => events.skip(0.1)],
      Home: ['To the release', () => events.seek(0)],
      End: ['To the end', () => events.seek(1)],
      r: ['Let go again', events.again],
      f: ['Follow the body', click('follow')],
      t: ['Trail', click('trail')],
      c: ['Copies along the way', click('copies')],
      a: ['Arrows of forces', click('forces')],
      q: ['Rings of torques', click('torques')],
      p: ['Pressure', click('pressure')],
      '?': ['This help', () => help.showModal()],
    };
    const help = byId<HTMLDialogElement>('help-dialog');
    byId('help').addEventListener('click', () => help.showModal());
    addEventListener('keydown', (event) => {
      const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
      const action = keys[key];
      const busy = help.open || event.ctrlKey || event.metaKey || event.altKey || isControl(event);
      if (action !== undefined && !busy) {
        event.preventDefault();
        action[1]();
      }
    });
    events.canvas.addEventListener('keydown', ({ key }) => {
      const moves: Record<string, [number, number, number]> = {
        ArrowLeft: [-TURN, 0, 1],
        ArrowRight: [TURN, 0, 1],
        ArrowUp: [0, TURN, 1],
        ArrowDown: [0, -TURN, 1],
        '+': [0, 0, 0.9],
        '-': [0, 0, 1.1],
      };
      const move = moves[key];
      if (move !== undefined) {
        events.orbit(...move);
      }
    });
    const rows = Object.entries(keys).map(([key, [words]]) => [key === ' ' ? 'Space' : key, words] as const);
    const more = [
      ['← → ↑ ↓', 'Look from elsewhere, with the picture focused'],
      ['+ −', 'Nearer, farther, with the picture focused'],
    ] as const;
    byId('keys').append(
      ...[...rows, ...more].map(([key, words]) =>
        h('tr', {}, h('td', {}, h('kbd', {}, key)), h('td', {}, words)),
      ),
    );
  }
}

/** Whether the key is meant for the control that has the focus. */
function isControl({ key, target }: KeyboardEvent): boolean {
  if (!(target instanceof HTMLElement)) {
    return false;
  }
  if (target instanceof HTMLInputElement && target.type === 'checkbox') {
    return key === ' ';
  }
  if (target.matches('button, summary')) {
    return key === ' ' || key === 'Home' || key === 'End';
  }
  return (
    target.matches('input, select, textarea, [role=tabpanel]') &&
    !(target.matches('[role=tabpanel]') && key === ' ')
  );
}
