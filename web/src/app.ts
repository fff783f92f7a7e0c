/** Opens scenes, and puts their runs into the picture. */

import { Vector3 } from 'three';
import { Address } from './address';
import { BODIES, LOOKS } from './bodies';
import { bodySize } from './camera';
import { Crowd } from './crowd';
import { byId, h, reducedMotion, words } from './dom';
import { Downloads } from './downloads';
import { type MeshFile, type Reading, meshFile, unusable, withMesh } from './dropped';
import { Engine, Stopped } from './engine';
import { Keys } from './keys';
import { Landings } from './landings';
import { type Linked, ofFragment } from './link';
import { say, trouble, working } from './messages';
import { type Opened, fetchOpened } from './opened';
import { type Comparison, type MeshTold, Panel } from './panel';
import { type Appearance, Picture } from './picture';
import { Playback } from './playback';
import { Pressure } from './pressure';
import { SceneDocument, type Values } from './scene';
import { Tabs } from './tabs';
import { Theme } from './theme';
import { Throw } from './throw';
import type { OpenedRun, SceneText } from './told';
import { Transport } from './transport';
import { View } from './view';

/** Colours of a run and of what it is compared with. */
const FIRST = '#e8710a';
const SECOND = '#3b7dd8';
const SEEDS = 9;
/** Duration of a run whose scene gives none (s): one that floats would fall for ever. */
const DURATION = 10;
const LEAVES = ['#d2691e', '#c1440e', '#e0a030', '#a8761c', '#b5541c'];
const PLAIN = '#6f93ad';

type Tables = NonNullable<Opened['tables']>;

/** How a scene comes into the picture. */
interface Way {
  /** Of a run that was made before. */
  tables?: Tables | undefined;
  /** Whether it has nothing to do with the one before, so that the camera begins anew. */
  anew: boolean;
  /** What is told of its mesh. */
  mesh?: MeshTold | undefined;
}

export class App {
  readonly #engine: Engine;
  readonly #playback = new Playback();
  readonly #transport = new Transport(this.#playback);
  readonly #landings = new Landings(byId('landings'));
  readonly #panel = new Panel(byId('setup'), {
    change: (changes) => void this.#change(changes),
    body: (key) => void this.#chooseBody(key),
    mesh: (file) => void this.#openFile(file),
    meshAgain: (unit, thickness) => void this.#readMesh({ unit, thickness }),
    compare: (comparison) => void this.#compareAnew(comparison),
    many: (on) => void (on ? this.#startMany() : this.#stopMany()),
  });
  readonly #address = new Address(
    () => this.#scene,
    () => this.#engine.about.version,
  );
  readonly #picture: Picture;
  readonly #crowd: Crowd;
  readonly #throw: Throw;
  readonly #scenes: SceneText[];
  #scene = new SceneDocument('', {});
  #tables: Tables | undefined;
  #mesh: MeshTold | undefined;
  #meshFile: MeshFile | undefined;
  #comparison: Comparison = { kind: 'none' };
  /** Counts what was asked to be shown: only the last of it is. */
  #asked = 0;
  #last = performance.now();

  /** Starts the engine, and opens what the address or the command names. */
  static async begin(): Promise<void> {
    const view = new View(byId('view'));
    const engine = new Engine();
    const scenes = await engine.call('scenes', []);
    await new App(view, engine, scenes).#openFirst();
  }

  private constructor(view: View, engine: Engine, scenes: SceneText[]) {
    this.#engine = engine;
    this.#scenes = scenes;
    const pressure = new Pressure(
      (frame) => engine.call('pressures', ['main', frame]),
      () => view.changed(),
      trouble,
    );
    this.#picture = new Picture(view, this.#playback, pressure, engine.about.causes);
    this.#crowd = new Crowd(engine, this.#picture, this.#playback);
    this.#throw = this.#throwing(view);
    this.#wire(view);
    this.#wireFiles();
    requestAnimationFrame((now) => this.#frame(now));
  }

  #wire(view: View): void {
    byId('version').textContent = `Langevin Rigid ${this.#engine.about.version}`;
    const select = byId<HTMLSelectElement>('scene');
    select.replaceChildren(
      ...this.#scenes.map(({ name }) => h('option', { value: name }, name.replaceAll('-', ' '))),
    );
    select.addEventListener('change', () => void this.#openBuiltIn(select.value));
    byId('work-stop').addEventListener('click', () => {
      this.#engine.stop();
      void this.#reopen();
    });
    byId('trouble')
      .querySelector('button')
      ?.addEventListener('click', () => trouble(undefined));
    addEventListener('hashchange', () => void this.#followLink());
    new Tabs(byId('told'));
    new Theme(byId('theme'), () => {
      this.#picture.recolour();
      this.#landings.recolour();
    });
    new Downloads({
      scene: () => this.#scene,
      export: (format) => this.#engine.call('export', ['main', format, 60]),
      png: () => view.png(),
      trouble,
    });
    new Keys({
      play: () => this.#transport.toggle(),
      step: (frames) => this.#playback.step(frames),
      skip: (seconds) => this.#transport.seek(this.#playback.time + seconds),
      seek: (share) => this.#transport.seekShare(share),
      again: () => this.#transport.again(),
      orbit: (heading, height, distance) => view.orbit(heading, height, distance),
      canvas: view.canvas,
    });
    view.canvas.tabIndex = 0;
    view.canvas.id = 'picture';
    view.canvas.setAttribute('role', 'img');
  }

  #throwing(view: View): Throw {
    return new Throw(view, {
      target: () => {
        const { main } = this.#picture;
        const actor = main?.actors[0];
        const alone = main?.run.bodies.length === 1 && !this.#crowd.on;
        return alone && actor !== undefined ? { body: actor.mesh, size: bodySize(main.run) } : undefined;
      },
      grabbed: () => {
        this.#playback.playing = false;
        this.#picture.visible(false, 1);
      },
      moved: (position) => {
        this.#picture.main?.actors[0]?.mesh.position.copy(position);
        view.changed();
      },
      released: (position, { x, y, z, w }, velocity) => {
        view.changed();
        void this.#change({
          'release.position': position.toArray(),
          'release.velocity': velocity.toArray(),
          'release.orientation': [x, y, z, w],
          'release.angular_velocity': undefined,
          'release.tilt': undefined,
          'release.tilt_axis': undefined,
          'release.carried': undefined,
          'release.frame': undefined,
        });
      },
    });
  }

  #wireFiles(): void {
    const hint = byId('drop');
    addEventListener('dragover', (event) => {
      event.preventDefault();
      hint.hidden = false;
    });
    addEventListener('dragleave', (event) => {
      hint.hidden = event.relatedTarget === null;
    });
    addEventListener('drop', (event) => {
      event.preventDefault();
      hint.hidden = true;
      const file = event.dataTransfer?.files[0];
      if (file !== undefined) {
        void this.#openFile(file);
      }
    });
  }

  #frame(now: number): void {
    requestAnimationFrame((next) => this.#frame(next));
    const seconds = Math.min(0.1, Math.max(0, (now - this.#last) / 1000));
    this.#last = now;
    if (this.#crowd.on) {
      this.#crowd.frame().catch((error: unknown) => {
        this.#stopMany();
        trouble(error);
      });
    } else {
      const { main } = this.#picture;
      if (this.#playback.advance(seconds) && main !== undefined) {
        say(this.#inWords(main.run));
      }
      if (!this.#picture.current) {
        if (!this.#throw.holding) {
          this.#picture.place();
        }
        this.#picture.view.draw();
        this.#picture.tell();
      }
    }
    this.#transport.tell();
  }

  // What is opened

  #textOf(name: string): string | undefined {
    return this.#scenes.find((scene) => scene.name === name)?.text;
  }

  async #openFirst(): Promise<void> {
    try {
      const linked = await this.#linked();
      const opened = linked === undefined ? await fetchOpened() : undefined;
      if (linked !== undefined) {
        await this.#openLinked(linked);
      } else if (opened !== undefined) {
        const { name, toml, files, tables } = opened;
        await this.#show(SceneDocument.parse(name, toml, files), { tables, anew: true });
      }
    } catch (error) {
      trouble(error);
    }
    if (this.#picture.main === undefined) {
      // What could not be opened is told beside it.
      const { textContent } = byId('trouble').querySelector('p') ?? byId('trouble');
      await this.#openBuiltIn('leaf');
      if (textContent !== '') {
        trouble(textContent);
      }
    }
  }

  #linked(): Promise<Linked | undefined> {
    return ofFragment(location.hash, (name) => this.#textOf(name));
  }

  async #followLink(): Promise<void> {
    if (!this.#address.isForeign) {
      return;
    }
    try {
      const linked = await this.#linked();
      if (linked !== undefined) {
        await this.#openLinked(linked);
      }
    } catch (error) {
      trouble(error);
    }
  }

  async #openLinked({ scene, version }: Linked): Promise<void> {
    await this.#show(scene, { anew: true });
    const { version: own } = this.#engine.about;
    if (version !== undefined && version !== own) {
      trouble(`The link was made by version ${version}, this is ${own}: the run may be another.`);
    }
  }

  async #openBuiltIn(name: string): Promise<void> {
    const text = this.#textOf(name);
    if (text !== undefined) {
      await this.#show(SceneDocument.parse(name, text), { anew: true });
    }
  }

  async #change(changes: Values): Promise<void> {
    await this.#show(this.#scene.with(changes), { anew: false, mesh: this.#mesh });
  }

  async #chooseBody(key: string): Promise<void> {
    const choice = BODIES[key];
    if (choice === undefined) {
      return;
    }
    const text = choice.scene === undefined ? undefined : this.#textOf(choice.scene);
    const body = text === undefined ? choice.values : SceneDocument.parse(key, text).get('body');
    const scene = this.#scene.with({ body, 'run.model': undefined, turbulence: undefined }, key, new Map());
    await this.#show(scene, { anew: true });
  }

  async #openFile(file: File): Promise<void> {
    try {
      if (file.name.toLowerCase().endsWith('.toml')) {
        const name = file.name.replace(/\.toml$/i, '');
        await this.#show(SceneDocument.parse(name, await file.text()), { anew: true });
      } else {
        this.#meshFile = await meshFile(file);
        await this.#readMesh({});
      }
    } catch (error) {
      trouble(`${file.name}: ${words(error)}`);
    }
  }

  async #readMesh(reading: Reading): Promise<void> {
    const file = this.#meshFile;
    if (file === undefined) {
      return;
    }
    try {
      const { scene, told } = await withMesh(this.#engine, this.#scene, file, reading);
      await this.#show(scene, { anew: true, mesh: told });
    } catch (error) {
      if (!(error instanceof Stopped)) {
        this.#mesh = unusable(file.name, error, reading);
        trouble(this.#mesh.words[0]);
        this.#panel.show(this.#scene, this.#picture.main?.run.description, this.#mesh);
      }
    }
  }

  /**
   * Bakes and drops a scene, and shows it; what was shown before stays if that fails.
   *
   * @throws what went wrong, where nothing was shown before
   */
  async #show(given: SceneDocument, { tables, anew, mesh }: Way): Promise<void> {
    const asked = ++this.#asked;
    this.#stopMany();
    const endless = given.get('run.duration') === undefined && tables === undefined;
    const scene = endless ? given.with({ 'run.duration': DURATION }) : given;
    try {
      for (const [path, bytes] of scene.files) {
        await this.#engine.putFile(path, bytes);
      }
      const run = await working('Baking', (news) =>
        this.#engine.call('open', ['main', scene.name, scene.text(), tables], news),
      );
      if (asked !== this.#asked) {
        return;
      }
      this.#scene = scene;
      this.#mesh = mesh;
      this.#tables = tables;
      trouble(run.bodies.find((body) => body.trouble !== null)?.trouble ?? undefined);
      await this.#stageRun(run, anew);
      void this.#address.write();
    } catch (error) {
      if (this.#picture.main === undefined) {
        throw error;
      }
      if (asked === this.#asked) {
        trouble(error instanceof Stopped ? 'Stopped. The scene before is still here.' : told(error, anew));
        this.#panel.show(this.#scene, this.#picture.main.run.description, this.#mesh);
        this.#picture.visible(true);
        this.#chooseScene();
      }
    }
  }

  /** Opens the scene that is shown again, in an engine that was stopped; its run is the same. */
  async #reopen(): Promise<void> {
    if (this.#picture.main !== undefined) {
      const { name } = this.#scene;
      await this.#engine.call('open', ['main', name, this.#scene.text(), this.#tables]).catch(trouble);
    }
  }

  /** Puts a run into the picture. */
  async #stageRun(run: OpenedRun, anew: boolean): Promise<void> {
    const { description } = run;
    this.#picture.begin(run);
    this.#transport.frames(run.times);
    this.#playback.begin(!reducedMotion());
    this.#landings.show(this.#scene);
    this.#panel.comparison = this.#comparison;
    this.#panel.show(this.#scene, description, this.#mesh);
    byId('about').textContent = description.description;
    this.#chooseScene();
    this.#picture.view.canvas.setAttribute('aria-label', this.#inWords(run));
    say(this.#inWords(run));
    if (anew) {
      this.#picture.camera.begin(run);
    }
    this.#showMain(run);
    this.#picture.place();
    this.#picture.camera.frame(this.#picture.showing);
    await this.#compare(this.#comparison);
    const { dataset } = document.body;
    dataset['runs'] = String(Number(dataset['runs'] ?? 0) + 1);
  }

  /** The choice of scenes names what is shown. */
  #chooseScene(): void {
    const select = byId<HTMLSelectElement>('scene');
    select.querySelector('option[data-own]')?.remove();
    const { name } = this.#scene;
    const text = this.#textOf(name);
    const builtIn = text === undefined ? undefined : SceneDocument.parse(name, text);
    const duration = builtIn?.get('run.duration') ?? DURATION;
    const same = builtIn?.with({ 'run.duration': duration }).text() === this.#scene.text();
    const untouched = same && this.#tables === undefined;
    if (!untouched) {
      const what = this.#tables !== undefined ? ' (recorded)' : builtIn !== undefined ? ' (changed)' : '';
      select.prepend(h('option', { value: 'own', data: { own: '' } }, `${name}${what}`));
    }
    select.value = untouched ? name : 'own';
  }

  #inWords(run: OpenedRun): string {
    const { name } = this.#scene;
    const [first] = run.bodies;
    const time = `${this.#playback.end.toFixed(2)} s`;
    if (run.bodies.length > 1) {
      return `${name}: ${run.bodies.length} bodies over ${time}.`;
    }
    const ends: Record<string, string> = {
      ground: 'it reached the ground',
      time: 'the time was up',
      rest: 'it came to rest',
      recorded: 'the recording ends',
      diverged: 'a step failed',
    };
    return `${name}: ${ends[first?.ending ?? ''] ?? 'it ended'} after ${time}.`;
  }

  /** The run of the scene alone. */
  #showMain(run: OpenedRun): void {
    for (const slot of this.#picture.clear().filter((slot) => slot !== 'main')) {
      void this.#engine.call('close', [slot]).catch(trouble);
    }
    this.#picture.add(run, {
      slot: 'main',
      colour: FIRST,
      name: modelName(this.#scene),
      look: (kind, number) => this.#lookOf(run, kind, number),
      opacity: 1,
      labelled: this.#comparison.kind === 'model' && !run.description.world,
    });
  }

  #lookOf(run: OpenedRun, kind: number, number: number): string {
    const text = kind === 0 ? undefined : this.#textOf(run.description.kinds[kind] ?? '');
    const body = text === undefined ? this.#scene.get('body') : SceneDocument.parse('', text).get('body');
    const shape = String((body as Values | undefined)?.['shape'] ?? '');
    const many = run.bodies.length > 1 && shape === 'leaf';
    return (many ? LEAVES[number % LEAVES.length] : LOOKS[shape]) ?? PLAIN;
  }

  // What it is compared with

  /** Another comparison is seen from the release on. */
  async #compareAnew(comparison: Comparison): Promise<void> {
    await this.#compare(comparison);
    this.#playback.begin(!reducedMotion());
  }

  async #compare(comparison: Comparison): Promise<void> {
    const asked = this.#asked;
    this.#comparison = comparison;
    const run = this.#picture.main?.run;
    if (run === undefined) {
      return;
    }
    this.#showMain(run);
    if (run.description.world || this.#tables !== undefined) {
      return;
    }
    try {
      for (const [slot, scene] of this.#others(comparison)) {
        const other = await working('Comparing', (news) =>
          this.#engine.call('open', [slot, scene.name, scene.text()], news),
        );
        if (asked !== this.#asked || this.#comparison !== comparison) {
          return;
        }
        this.#picture.add(other, this.#appearance(slot, scene, other));
        if ((other.times[other.times.length - 1] ?? 0) > this.#playback.end) {
          this.#transport.frames(other.times);
        }
      }
      this.#picture.place();
      this.#picture.camera.frame(this.#picture.showing);
    } catch (error) {
      trouble(error);
    }
  }

  #others(comparison: Comparison): [string, SceneDocument][] {
    switch (comparison.kind) {
      case 'none':
        return [];
      case 'model':
        return [['model', this.#scene.with({ 'run.model': comparison.model, 'run.integrator': undefined })]];
      case 'seeds': {
        const first = this.#scene.number('run.seed', 0) + 1;
        return Array.from({ length: SEEDS }, (_, number) => [
          `seed${number}`,
          this.#scene.with({ 'run.seed': first + number }),
        ]);
      }
    }
  }

  #appearance(slot: string, scene: SceneDocument, run: OpenedRun): Appearance {
    const model = slot === 'model';
    return {
      slot,
      colour: SECOND,
      name: modelName(scene),
      look: () => SECOND,
      opacity: model ? 1 : 0.35,
      labelled: model,
      ...(model ? { aside: new Vector3(1.8 * bodySize(run), 0, 0) } : {}),
    };
  }

  async #startMany(): Promise<void> {
    const asked = ++this.#asked;
    try {
      await this.#crowd.start(this.#scene, () => asked === this.#asked);
      this.#playback.playing = !reducedMotion();
      this.#panel.many = this.#crowd.on;
    } catch (error) {
      this.#panel.many = false;
      trouble(error);
    }
  }

  #stopMany(): void {
    this.#panel.many = false;
    const run = this.#picture.main?.run;
    if (this.#crowd.stop() && run !== undefined) {
      void this.#stageRun(run, true);
    }
  }
}

function modelName(scene: SceneDocument): string {
  return String(scene.get('run.model') ?? 'separated');
}

/** What an error says; of a value from a control without its place in a file that nobody wrote. */
function told(error: unknown, written: boolean): string {
  const said = words(error);
  const [, what, line] = /^[^\n]*?:\d+:\d+: (.*)\n +\d+ \| (.*)\n/.exec(said) ?? [];
  return written || what === undefined ? said : `${what} (${line})`;
}
