/** The controls: each shows a value of the scene and makes another scene of it. */

import { BODIES, FLUIDS, MODELS } from './bodies';
import { h } from './dom';
import type { SceneDocument, Values } from './scene';
import type { Description, Quat } from './told';

/** What else is compared with the run. */
export type Comparison = { kind: 'none' } | { kind: 'model'; model: string } | { kind: 'seeds' };

export interface PanelEvents {
  /** The scene is to be another. */
  change(changes: Values): void;
  /** Another body, by its key in `BODIES`. */
  body(key: string): void;
  /** A mesh from a file. */
  mesh(file: File): void;
  /** The same mesh, read in another way. */
  meshAgain(unit: string | undefined, thickness: number | undefined): void;
  compare(comparison: Comparison): void;
  many(on: boolean): void;
}

/** What is known of the mesh of the scene. */
export interface MeshTold {
  name: string;
  words: string[];
  unit: string | undefined;
  guessed: boolean;
  trouble: boolean;
  /** Whether it is a sheet, which has the thickness that it is given. */
  sheet: boolean;
  thickness: number | undefined;
}

const UNITS = ['m', 'cm', 'mm', 'in', 'ft'];
/** Dimensions of shapes, with their words; lengths, shown in millimetres. */
const DIMENSIONS: Record<string, string> = {
  length: 'Length',
  width: 'Width',
  thickness: 'Thickness',
  radius: 'Radius',
  height: 'Height',
  diameter: 'Diameter',
  inner_diameter: 'Hole',
  hole: 'Hole',
  side: 'Side',
};
const TRIPLES: Record<string, string> = { size: 'Sides', semi_axes: 'Half-axes' };

/** A number that reads well and back. */
function short(value: number): string {
  return String(Number(value.toPrecision(6)));
}

export class Panel {
  readonly #place: HTMLElement;
  readonly #events: PanelEvents;
  #comparison: Comparison = { kind: 'none' };
  #many = false;

  constructor(place: HTMLElement, events: PanelEvents) {
    this.#place = place;
    this.#events = events;
  }

  /** Shows a scene; the focus stays where it was. */
  show(scene: SceneDocument, description: Description | undefined, mesh: MeshTold | undefined): void {
    const focused = this.#place.contains(document.activeElement) ? document.activeElement?.id : undefined;
    this.#place.replaceChildren(
      this.#body(scene, description, mesh),
      this.#fluid(scene, description),
      this.#release(scene, description),
      this.#wind(scene),
      this.#run(scene),
      this.#compare(scene, description),
    );
    if (focused !== undefined && focused !== '') {
      document.getElementById(focused)?.focus({ preventScroll: true });
    }
  }

  set many(on: boolean) {
    this.#many = on;
    const box = document.getElementById('many');
    if (box instanceof HTMLInputElement) {
      box.checked = on;
    }
  }

  set comparison(comparison: Comparison) {
    this.#comparison = comparison;
  }

  #set(path: string, value: unknown): void {
    this.#events.change({ [path]: value });
  }

  /** Another dimension: the characteristic sizes that belonged to the old one go. */
  #resize(path: string, value: unknown): void {
    this.#events.change({
      [path]: value,
      'body.characteristic_thickness': undefined,
      'body.characteristic_length': undefined,
    });
  }

  #body(scene: SceneDocument, description: Description | undefined, mesh: MeshTold | undefined): HTMLElement {
    const body = scene.get('body') as Values;
    const file = h('input', {
      type: 'file',
      id: 'mesh-file',
      className: 'hidden',
      accept: '.obj,.stl,.ply,.glb,.gltf,.toml',
      tabIndex: -1,
    });
    file.addEventListener('change', () => {
      const [chosen] = file.files ?? [];
      if (chosen !== undefined) {
        this.#events.mesh(chosen);
      }
      file.value = '';
    });
    file.setAttribute('aria-label', 'Mesh file');
    const open = h('button', { type: 'button', id: 'mesh-open', className: 'wide' }, 'Your own mesh …');
    open.addEventListener('click', () => file.click());

    const parts: (HTMLElement | undefined)[] = [
      this.#choice('body', 'Body', bodyKey(scene), this.#bodyChoices(scene), (key) => this.#events.body(key)),
      ...Object.entries(DIMENSIONS)
        .filter(([key]) => typeof body[key] === 'number' || typeof body[key] === 'bigint')
        .map(([key, words]) =>
          this.#number(`body-${key}`, words, 'mm', 1000 * Number(body[key]), { min: 0 }, (value) =>
            this.#resize(`body.${key}`, value / 1000),
          ),
        ),
      ...Object.entries(TRIPLES)
        .filter(([key]) => Array.isArray(body[key]))
        .map(([key, words]) => this.#dimensions(`body-${key}`, `body.${key}`, words, body[key] as number[])),
      this.#massOrDensity(body),
      h('div', { className: 'field' }, open, file),
      mesh === undefined ? undefined : this.#mesh(mesh),
      description === undefined ? undefined : this.#facts(description),
    ];
    return h('fieldset', {}, h('legend', {}, 'Body'), ...parts.filter((part) => part !== undefined));
  }

  #bodyChoices(scene: SceneDocument): [string, string][] {
    const built = Object.entries(BODIES).map(([key, { words }]): [string, string] => [key, words]);
    return bodyKey(scene) === 'own' ? [['own', 'That of the scene'], ...built] : built;
  }

  #dimensions(id: string, path: string, words: string, values: number[]): HTMLElement {
    const change = (axis: number, value: number): void =>
      this.#resize(
        path,
        values.map((old, place) => (place === axis ? value / 1000 : Number(old))),
      );
    return this.#several(
      id,
      words,
      'mm',
      values.map((x) => 1000 * Number(x)),
      { min: 0 },
      change,
    );
  }

  #massOrDensity(body: Values): HTMLElement | undefined {
    if (body['mass'] !== undefined) {
      return this.#number('body-mass', 'Mass', 'g', 1000 * Number(body['mass']), { min: 0 }, (value) =>
        this.#set('body.mass', value / 1000),
      );
    }
    return body['density'] === undefined
      ? undefined
      : this.#number('body-density', 'Density', 'kg/m³', Number(body['density']), { min: 0 }, (value) =>
          this.#set('body.density', value),
        );
  }

  #mesh(mesh: MeshTold): HTMLElement {
    const parts: HTMLElement[] = [
      h(
        'ul',
        { className: mesh.trouble ? 'notices trouble' : 'notices hint' },
        ...mesh.words.map((words) => h('li', {}, words)),
      ),
    ];
    if (mesh.guessed && mesh.unit !== undefined) {
      const units = UNITS.map((unit): [string, string] => [unit, unit]);
      parts.push(
        this.#choice('mesh-unit', 'Drawn in', mesh.unit, units, (unit) =>
          this.#events.meshAgain(unit, mesh.thickness),
        ),
      );
    }
    if (mesh.sheet) {
      parts.push(
        this.#number(
          'mesh-thickness',
          'Thickness of a sheet',
          'mm',
          1000 * (mesh.thickness ?? 0),
          { min: 0 },
          (value) => this.#events.meshAgain(mesh.unit, value > 0 ? value / 1000 : undefined),
        ),
      );
    }
    const group = h('div', { id: 'mesh-told' }, ...parts);
    if (mesh.trouble) {
      group.setAttribute('role', 'alert');
    }
    return group;
  }

  #facts(told: Description): HTMLElement {
    const grams = (kilograms: number): string => `${Number((1000 * kilograms).toPrecision(3))} g`;
    const facts = [
      `${grams(told.mass)}; moves with up to ${grams(Math.max(...told.added_mass.slice(0, 3)))} of fluid`,
      `U₀ ${Number(told.falling_speed.toPrecision(3))} m/s, Re ${Math.round(told.falling_reynolds)}`,
    ];
    return h(
      'div',
      {},
      h('p', { className: 'hint', id: 'facts' }, facts.join('; ')),
      told.notices.length === 0
        ? undefined
        : h('ul', { className: 'notices hint' }, ...told.notices.map((notice) => h('li', {}, notice))),
    );
  }

  #fluid(scene: SceneDocument, description: Description | undefined): HTMLElement {
    const fluid = scene.get('fluid') as Values;
    const key = fluidKey(fluid, description);
    const choices = Object.entries(FLUIDS).map(([key, { words }]): [string, string] => [key, words]);
    const own = key === 'own';
    const choose = (key: string): void => {
      const velocity = fluid['velocity'];
      // An own one begins with the numbers of the one before, a little denser: it is not the preset any more.
      const values = FLUIDS[key]?.values ?? {
        density: 1.001 * (description?.fluid_density ?? 1000),
        viscosity: description?.fluid_viscosity ?? 1e-6,
      };
      this.#set('fluid', velocity === undefined ? values : { ...values, velocity });
    };
    return h(
      'fieldset',
      {},
      h('legend', {}, 'Fluid'),
      this.#choice('fluid', 'Fluid', key, [...choices, ['own', 'Own …']], choose),
      ...(own
        ? [
            this.#number('fluid-density', 'Density', 'kg/m³', Number(fluid['density']), { min: 0 }, (value) =>
              this.#set('fluid.density', value),
            ),
            this.#number(
              'fluid-viscosity',
              'Viscosity',
              'mm²/s',
              1e6 * Number(fluid['viscosity']),
              { min: 0 },
              (value) => this.#set('fluid.viscosity', value / 1e6),
            ),
          ]
        : []),
    );
  }

  #release(scene: SceneDocument, description: Description | undefined): HTMLElement {
    const position = scene.vector('release.position');
    const ground = scene.number('run.ground', 0);
    const orientation = scene.get('release.orientation');
    const tilt =
      orientation === undefined
        ? scene.number('release.tilt', 0)
        : tiltOf(description?.orientation ?? [0, 0, 0, 1]);
    const velocity = scene.vector('release.velocity');
    const spin = scene.vector('release.angular_velocity').map((x) => x / (2 * Math.PI));
    const component = (path: string, values: number[], factor: number) => (axis: number, value: number) =>
      this.#set(
        path,
        values.map((old, place) => factor * (place === axis ? value : old)),
      );
    return h(
      'fieldset',
      {},
      h('legend', {}, 'Release'),
      this.#number('height', 'Height', 'm', position[1] - ground, { step: 0.1 }, (value) =>
        this.#set('release.position', [position[0], ground + value, position[2]]),
      ),
      this.#number('tilt', 'Tilt', '°', tilt, { step: 5, min: -180, max: 180 }, (value) =>
        this.#events.change({ 'release.orientation': undefined, 'release.tilt': value }),
      ),
      this.#several(
        'speed',
        'Speed',
        'm/s',
        velocity,
        { step: 0.1 },
        component('release.velocity', velocity, 1),
      ),
      this.#several(
        'spin',
        'Spin',
        'turns/s',
        spin,
        { step: 0.5 },
        component('release.angular_velocity', spin, 2 * Math.PI),
      ),
      h('p', { className: 'hint' }, 'Or drag the body in the picture and let it go.'),
    );
  }

  #wind(scene: SceneDocument): HTMLElement {
    const stream = scene.vector('fluid.velocity');
    const winds = (scene.get('wind') ?? []) as Values[];
    const place = winds.findIndex((wind) => wind['field'] === 'gusts');
    const gusts = winds[place];
    const others = winds.filter((_, number) => number !== place).map((wind) => String(wind['field']));
    const change = (values: Values): void => {
      const next = { field: 'gusts', rms: 0.3, length: 1, ...gusts, ...values };
      const rest = winds.filter((_, number) => number !== place);
      const all = Number(next.rms) > 0 ? [...rest, next] : rest;
      this.#set('wind', all.length > 0 ? all : undefined);
    };
    return h(
      'fieldset',
      {},
      h('legend', {}, 'Wind'),
      this.#number('wind', 'Steady, to the right', 'm/s', stream[0], { step: 0.1 }, (value) =>
        this.#set('fluid.velocity', [value, stream[1], stream[2]]),
      ),
      this.#number('gusts', 'Gusts, rms', 'm/s', Number(gusts?.['rms'] ?? 0), { step: 0.1, min: 0 }, (rms) =>
        change({ rms }),
      ),
      ...(gusts === undefined
        ? []
        : [
            this.#number(
              'gust-length',
              'Size of gusts',
              'm',
              Number(gusts['length'] ?? 1),
              { step: 0.1, min: 0 },
              (length) => change({ length }),
            ),
          ]),
      ...(others.length > 0
        ? [h('p', { className: 'hint' }, `The scene also has: ${others.join(', ')}.`)]
        : []),
    );
  }

  #run(scene: SceneDocument): HTMLElement {
    const models = Object.entries(MODELS);
    const seed = scene.get('run.seed');
    return h(
      'fieldset',
      {},
      h('legend', {}, 'Motion'),
      this.#choice('model', 'Model', String(scene.get('run.model') ?? 'separated'), models, (model) =>
        this.#events.change({ 'run.model': model, 'run.integrator': undefined }),
      ),
      this.#number('seed', 'Seed', '', Number(seed ?? 0), { step: 1, min: 0 }, (value) =>
        this.#set('run.seed', Math.round(value)),
      ),
      this.#number(
        'duration',
        'Longest run',
        's',
        scene.number('run.duration', 10),
        { step: 1, min: 0 },
        (value) => this.#set('run.duration', value),
      ),
    );
  }

  #compare(scene: SceneDocument, description: Description | undefined): HTMLElement {
    const current = String(scene.get('run.model') ?? 'separated');
    const choices: [string, string][] = [
      ['none', 'nothing'],
      ['seeds', 'nine other seeds'],
      ...Object.entries(MODELS)
        .filter(([model]) => model !== current)
        .map(([model, words]): [string, string] => [model, words]),
    ];
    const { kind } = this.#comparison;
    const value = this.#comparison.kind === 'model' ? this.#comparison.model : kind;
    const select = this.#choice('compare', 'With', value, choices, (key) => {
      this.#comparison = key === 'none' || key === 'seeds' ? { kind: key } : { kind: 'model', model: key };
      this.#events.compare(this.#comparison);
    });
    const many = h('input', { type: 'checkbox', id: 'many', checked: this.#many });
    many.addEventListener('change', () => this.#events.many(many.checked));
    const world = description?.world === true;
    many.disabled = world;
    for (const control of select.querySelectorAll('select')) {
      control.disabled = world;
    }
    return h(
      'fieldset',
      {},
      h('legend', {}, 'Compare'),
      select,
      h('label', { className: 'check' }, many, '5,000 at once'),
    );
  }

  #choice(
    id: string,
    words: string,
    value: string,
    choices: [string, string][],
    change: (value: string) => void,
  ): HTMLElement {
    const select = h('select', { id }, ...choices.map(([value, words]) => h('option', { value }, words)));
    select.value = value;
    select.addEventListener('change', () => change(select.value));
    return h('label', { className: 'field' }, h('span', {}, words), select);
  }

  #number(
    id: string,
    words: string,
    unit: string,
    value: number,
    limits: { min?: number; max?: number; step?: number },
    change: (value: number) => void,
  ): HTMLElement {
    return h(
      'label',
      { className: 'field' },
      h('span', {}, words, ...(unit === '' ? [] : [' ', h('small', {}, unit)])),
      input(id, value, limits, change),
    );
  }

  #several(
    id: string,
    words: string,
    unit: string,
    values: number[],
    limits: { min?: number; step?: number },
    change: (axis: number, value: number) => void,
  ): HTMLElement {
    const boxes = values.map((value, axis) => {
      const name = 'xyz'[axis] ?? '';
      const box = input(`${id}-${name}`, value, limits, (value) => change(axis, value));
      box.setAttribute('aria-label', `${words}, ${name}, ${unit}`);
      box.title = name;
      return box;
    });
    return h(
      'div',
      { className: 'field' },
      h('span', {}, words, ' ', h('small', {}, unit)),
      h('div', { className: 'three' }, ...boxes),
    );
  }
}

function input(
  id: string,
  value: number,
  { min, max, step }: { min?: number; max?: number; step?: number },
  change: (value: number) => void,
): HTMLInputElement {
  const box = h('input', { type: 'number', id, value: short(value), step: 'any' });
  box.min = min === undefined ? '' : String(min);
  box.max = max === undefined ? '' : String(max);
  if (step !== undefined) {
    // The arrows take these steps; what is typed may be any number.
    box.addEventListener('keydown', (event) => {
      const up = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0;
      if (up !== 0) {
        event.preventDefault();
        const next = Number((box.valueAsNumber + up * step).toPrecision(10));
        box.value = String(Math.min(max ?? next, Math.max(min ?? next, next)));
        box.dispatchEvent(new Event('change'));
      }
    });
  }
  box.addEventListener('change', () => {
    const wrong = Number.isNaN(box.valueAsNumber);
    box.setAttribute('aria-invalid', String(wrong));
    if (!wrong) {
      change(box.valueAsNumber);
    }
  });
  return box;
}

/** Which of `BODIES` the body of a scene is: the one that names the scene, where several have its shape. */
function bodyKey(scene: SceneDocument): string {
  const body = scene.get('body') as Values;
  const same = (values: Values): boolean =>
    values['shape'] === body['shape'] &&
    Object.keys(body).every((key) => key in values || key.startsWith('characteristic'));
  const found = Object.entries(BODIES)
    .filter(([, { values }]) => values !== undefined && same(values))
    .map(([key]) => key);
  const byScene: Record<string, string> = {
    samara: 'seed',
    'paper-airplane': 'airplane',
    feather: 'feather',
  };
  return byScene[String(body['shape'])] ?? found.find((key) => key === scene.name) ?? found[0] ?? 'own';
}

function fluidKey(fluid: Values, description: Description | undefined): string {
  const same = ([, { values }]: [string, { values: Values }]): boolean =>
    Object.entries(values).every(([key, value]) => fluid[key] === value);
  return Object.entries(FLUIDS).find(same)?.[0] ?? description?.fluid ?? 'own';
}

function tiltOf([x, , z]: Quat): number {
  return (Math.acos(Math.min(1, Math.max(-1, 1 - 2 * (x * x + z * z)))) * 180) / Math.PI;
}
