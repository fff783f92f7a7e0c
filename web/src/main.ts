/** The page. */

import { App } from './app';
import { byId, words } from './dom';

function hasWebGL2(): boolean {
  return document.createElement('canvas').getContext('webgl2') !== null;
}

/** Says plainly that the page cannot work here. */
function plainly(message: string): void {
  const main = document.querySelector('main');
  const said = Object.assign(document.createElement('p'), { className: 'plain', textContent: message });
  said.setAttribute('role', 'alert');
  main?.replaceChildren(said);
  main?.style.setProperty('display', 'block');
}

if (!hasWebGL2()) {
  plainly(
    'This page draws with WebGL 2, and the browser does not offer it. Turn on hardware acceleration in its settings, update it, or try another browser. The command `langevin-rigid simulate` makes pictures and films without one.',
  );
} else if (typeof WebAssembly === 'undefined') {
  plainly('This page computes with WebAssembly, and the browser does not offer it. Try another browser.');
} else {
  try {
    await App.begin();
  } catch (error) {
    plainly(`The page could not start: ${words(error)}`);
    byId('said').textContent = words(error);
  }
}
