/** Light and dark: as the system has them, or as chosen. */

const CHOICES = ['system', 'light', 'dark'] as const;
const WORDS = { system: 'as the system has them', light: 'light', dark: 'dark' };
const KEPT = 'langevin-rigid-theme';

/** What was chosen before; browsers may refuse to tell. */
function kept(): string | null {
  try {
    return localStorage.getItem(KEPT);
  } catch {
    return null;
  }
}

function keep(choice: string): void {
  try {
    localStorage.setItem(KEPT, choice);
  } catch {
    // It holds for this visit.
  }
}

export class Theme {
  #choice: (typeof CHOICES)[number] = 'system';
  readonly #system = matchMedia('(prefers-color-scheme: dark)');

  constructor(
    readonly button: HTMLElement,
    readonly onChange: () => void,
  ) {
    this.#apply(CHOICES.find((choice) => choice === kept()) ?? 'system');
    button.addEventListener('click', () => {
      const next = CHOICES[(CHOICES.indexOf(this.#choice) + 1) % CHOICES.length] ?? 'system';
      keep(next);
      this.#apply(next);
    });
    this.#system.addEventListener('change', () => this.#apply(this.#choice));
  }

  #apply(choice: (typeof CHOICES)[number]): void {
    this.#choice = choice;
    const { dataset } = document.documentElement;
    if (choice === 'system') {
      delete dataset['theme'];
    } else {
      dataset['theme'] = choice;
    }
    const dark = choice === 'dark' || (choice === 'system' && this.#system.matches);
    dataset['shade'] = dark ? 'dark' : 'light';
    this.button.title = `Colours: ${WORDS[choice]}`;
    this.button.setAttribute('aria-label', `Colours: ${WORDS[choice]}`);
    this.onChange();
  }
}
