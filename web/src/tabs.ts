/** Tabs, by pointer and by arrow keys (WAI-ARIA Authoring Practices). */

export class Tabs {
  readonly #tabs: HTMLElement[];

  constructor(place: HTMLElement) {
    this.#tabs = [...place.querySelectorAll<HTMLElement>('[role=tab]')];
    this.#tabs.forEach((tab, number) => {
      tab.addEventListener('click', () => this.#choose(tab));
      tab.addEventListener('keydown', ({ key }) => {
        const to = { ArrowRight: number + 1, ArrowLeft: number - 1, Home: 0, End: -1 }[key];
        const next = to === undefined ? undefined : this.#tabs.at(to % this.#tabs.length);
        if (next !== undefined) {
          this.#choose(next);
          next.focus();
        }
      });
    });
  }

  #choose(chosen: HTMLElement): void {
    for (const tab of this.#tabs) {
      const on = tab === chosen;
      tab.setAttribute('aria-selected', String(on));
      tab.tabIndex = on ? 0 : -1;
      const panel = document.getElementById(tab.getAttribute('aria-controls') ?? '');
      if (panel !== null) {
        panel.hidden = !on;
      }
    }
  }
}
