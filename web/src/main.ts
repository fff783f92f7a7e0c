import { Engine } from './engine';

function element(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (found === null) {
    throw new Error(`the page has no #${id}`);
  }
  return found;
}

const status = element('status');
try {
  const engine = await Engine.start();
  const names = await engine.sceneNames();
  element('scenes').append(
    ...names.map((name) => {
      const item = document.createElement('li');
      item.textContent = name;
      return item;
    }),
  );
  status.textContent = `${names.length} scenes`;
} catch (error) {
  status.textContent = `The engine did not start: ${error instanceof Error ? error.message : String(error)}`;
}
