/** What the page shows, and what its controls do. */

import { Vector3 } from 'three';
import { Actor, geometryOf } from './actor';
import { Arrows } from './arrows';
import { BODIES, LOOKS } from './bodies';
import { Charts } from './charts';
import { byId, h, reducedMotion, words } from './dom';
import { Downloads } from './downloads';
import { Engine, Stopped } from './engine';
import { Keys } from './keys';
import { Landings, metres } from './landings';
import { type Linked, ofFragment, toFragment } from './link';
import { LoadsTable } from './loads';
import { type Opened, fetchOpened } from './opened';
import { type Comparison, type MeshTold, Panel } from './panel';
import { Playback } from './playback';
import { coloured, typical } from './pressure';
import { SceneDocument, type Values } from './scene';
import { Swarm } from './swarm';
import { Tabs } from './tabs';
import { Theme } from './theme';
import { type Grabbable, Throw } from './throw';
import { type CheckedMesh, type OpenedRun, type SceneText, curve } from './told';
import { View, gridStep } from './view';

/** Colours of a run and of what it is compared with. */
const FIRST = '#e8710a';
const SECOND = '#3b7dd8';
const SEEDS = 9;
const MANY = 5000;
/** Triangles of a body of many. */
const COARSE = 96;
/** Work that takes longer shows a bar (ms). */
const PATIENCE = 250;

/** Tables of a run that was made before. */
interface Tables {
  trajectory: string;
  bodies?: string | undefined;
}

/** A mesh as its file has it. */
interface MeshFile {
  name: string;
  bytes: Uint8Array;
}

/** Many bodies under way, and the time that their simulation and their drawing take (ms a frame). */
interface Crowd {
  swarm: Swarm;
  simulation: number;
  drawing: number;
  waiting: boolean;
}

/** A run in the picture. */
interface Showing {
  slot: string;
  run: OpenedRun;
  actors: Actor[];
  colour: string;
  name: string;
}

export class App {
  readonly #engine = new Engine();
  readonly #view = new View(byId('view'));
  readonly #playback = new Playback();
  readonly #charts = new Charts(byId('curves'), (time) => (this.#playback.glimpse = time));
  readonly #landings = new Landings(byId('landings'));
  readonly #panel = new Panel(byId('setup'), {
    change: (changes) => void this.#change(changes),
    body: (key) => void this.#chooseBody(key),
    mesh: (file) => void this.#openFile(file),
    meshAgain: (unit, thickness) => void this.#readMesh(this.#meshBytes, unit, thickness),
    compare: (comparison) => void this.#compare(comparison),
    many: (on) => void (on ? this.#startMany() : this.#stopMany()),
  });
  #loadsTable: LoadsTable | undefined;
  #arrows: Arrows | undefined;
  #scenes: SceneText[] = [];
  #scene = new SceneDocument('', {});
  #tables: Tables | undefined;
  #mesh: MeshTold | undefined;
  #meshBytes: MeshFile | undefined;
  #showing: Showing[] = [];
  #comparison: Comparison = { kind: 'none' };
  #swarm: Crowd | undefined;
  #throw: Throw | undefined;
  /** Counts what was asked to be shown: only the last of it is. */
  #asked = 0;
  #pressure = { frame: -1, waiting: false, most: 0 };
  #last = performance.now();
  #written = '';

  async begin(): Promise<void> {
    this.#wire();
    this.#scenes = await this.#engine.call('scenes', []);
    this.#loadsTable = new LoadsTable(byId('loads'), this.#engine.about.causes, () => {});
    this.#arrows = new Arrows(this.#engine.about.causes);
    this.#view.scene.add(this.#arrows);
    byId('version').textContent = `Langevin Rigid ${this.#engine.about.version}`;
    this.#listScenes();
    requestAnimationFrame((now) => this.#frame(now));
    await this.#openFirst();
    addEventListener('hashchange', () => void this.#followLink());
  }

  #wire(): void {
    byId('play').addEventListener('click', () => this.#togglePlay());
    byId('back').addEventListener('click', () => this.#playback.step(-1));
    byId('forth').addEventListener('click', () => this.#playback.step(1));
    byId('again').addEventListener('click', () => this.#again());
    byId<HTMLInputElement>('time').addEventListener('input', ({ target }) => {
      this.#playback.playing = false;
      this.#playback.seek((target as HTMLInputElement).valueAsNumber);
    });
    byId<HTMLSelectElement>('rate').addEventListener('change', ({ target }) => {
      this.#playback.rate = Number((target as HTMLSelectElement).value);
    });
    byId('follow').addEventListener('change', () => this.#frameCamera());
    byId('pressure').addEventListener('change', () => this.#switchPressure());
    byId<HTMLSelectElement>('scene').addEventListener('change', ({ target }) => {
      void this.#openBuiltIn((target as HTMLSelectElement).value);
    });
    byId('work-stop').addEventListener('click', () => {
      this.#engine.stop();
      void this.#reopen();
    });
    byId('trouble')
      .querySelector('button')
      ?.addEventListener('click', () => this.#trouble(undefined));
    byId('share').addEventListener('click', () => void this.#share());
    new Tabs(byId('told'));
    new Theme(byId('theme'), () => {
      this.#view.recolour();
      this.#charts.recolour();
      this.#landings.recolour();
    });
    new Downloads({
      scene: () => this.#scene,
      export: (format) => this.#engine.call('export', ['main', format, 60]),
      png: () => this.#view.png(),
      trouble: (error) => this.#trouble(error),
    });
    new Keys({
      play: () => this.#togglePlay(),
      step: (frames) => this.#playback.step(frames),
      skip: (seconds) => {
        this.#playback.playing = false;
        this.#playback.seek(this.#playback.time + seconds);
      },
      seek: (share) => this.#playback.seek(this.#playback.start + share * this.#length()),
      again: () => this.#again(),
      orbit: (heading, height, distance) => this.#view.orbit(heading, height, distance),
      canvas: this.#view.canvas,
    });
    this.#throw = new Throw(this.#view, {
      target: () => this.#grabbable(),
      grabbed: () => {
        this.#playback.playing = false;
        this.#showing
          .slice(1)
          .forEach(({ actors }) => actors.forEach(({ group }) => (group.visible = false)));
      },
      moved: (position) => this.#showing[0]?.actors[0]?.mesh.position.copy(position),
      released: (position, orientation, velocity) => {
        const { x, y, z, w } = orientation;
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
    const { canvas } = this.#view;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.id = 'picture';
    this.#wireFiles();
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

  #listScenes(): void {
    byId('scene').replaceChildren(
      ...this.#scenes.map(({ name }) => h('option', { value: name }, name.replaceAll('-', ' '))),
    );
  }

  #textOf(name: string): string | undefined {
    return this.#scenes.find((scene) => scene.name === name)?.text;
  }

  // What is opened

  async #openFirst(): Promise<void> {
    const leaf = (): Promise<void> => this.#openBuiltIn('leaf');
    try {
      const linked = await ofFragment(location.hash, (name) => this.#textOf(name));
      if (linked !== undefined) {
        await this.#openLinked(linked);
        return;
      }
      const opened = await fetchOpened();
      await (opened === undefined ? leaf() : this.#openServed(opened));
    } catch (error) {
      await leaf();
      this.#trouble(error);
    }
  }

  async #followLink(): Promise<void> {
    if (location.hash === this.#written) {
      return;
    }
    try {
      const linked = await ofFragment(location.hash, (name) => this.#textOf(name));
      if (linked !== undefined) {
        await this.#openLinked(linked);
      }
    } catch (error) {
      this.#trouble(error);
    }
  }

  async #openLinked({ scene, version }: Linked): Promise<void> {
    await this.#open(scene);
    const { version: own } = this.#engine.about;
    if (version !== undefined && version !== own) {
      this.#trouble(`The link was made by version ${version}, this is ${own}: the run may be another.`);
    }
  }

  async #openServed({ name, toml, files, tables }: Opened): Promise<void> {
    for (const [path, bytes] of files) {
      await this.#engine.putFile(path, bytes);
    }
    await this.#open(SceneDocument.parse(name, toml, files), tables);
  }

  async #openBuiltIn(name: string): Promise<void> {
    const text = this.#textOf(name);
    if (text !== undefined) {
      await this.#open(SceneDocument.parse(name, text));
    }
  }

  /** Opens a scene that has nothing to do with the one before. */
  async #open(scene: SceneDocument, tables?: Tables | undefined): Promise<void> {
    await this.#show(scene, tables, true, undefined);
  }

  async #change(changes: Values): Promise<void> {
    await this.#show(this.#scene.with(changes), undefined, false, this.#mesh);
  }

  async #chooseBody(key: string): Promise<void> {
    const choice = BODIES[key];
    if (choice === undefined) {
      return;
    }
    const text = choice.scene === undefined ? undefined : this.#textOf(choice.scene);
    const body = text === undefined ? choice.values : SceneDocument.parse(key, text).get('body');
    const scene = this.#scene.with({ body, 'run.model': undefined, turbulence: undefined }, key, new Map());
    await this.#show(scene, undefined, true, undefined);
  }

  /**
   * Bakes and drops a scene, and shows it; what was shown before stays if that fails.
   *
   * @throws what went wrong, where nothing was shown before
   */
  async #show(
    scene: SceneDocument,
    tables: Tables | undefined,
    anew: boolean,
    mesh: MeshTold | undefined,
  ): Promise<void> {
    const asked = ++this.#asked;
    this.#stopMany();
    try {
      for (const [path, bytes] of scene.files) {
        await this.#engine.putFile(path, bytes);
      }
      // One that floats would fall for ever.
      const ended =
        scene.get('run.duration') === undefined && tables === undefined
          ? scene.with({ 'run.duration': 10 })
          : scene;
      const run = await this.#working('Baking', (news) =>
        this.#engine.call('open', ['main', ended.name, ended.text(), tables], news),
      );
      if (asked !== this.#asked) {
        return;
      }
      this.#scene = ended;
      this.#mesh = mesh;
      this.#tables = tables;
      this.#trouble(run.bodies.find(({ trouble }) => trouble !== null)?.trouble ?? undefined);
      await this.#stageRun(run, anew);
      void this.#writeLink();
    } catch (error) {
      if (this.#showing.length === 0) {
        throw error;
      }
      if (asked === this.#asked) {
        this.#trouble(error instanceof Stopped ? 'Stopped. The scene before is still here.' : error);
        this.#panel.show(this.#scene, this.#showing[0]?.run.description, this.#mesh);
        this.#chooseScene();
      }
    }
  }

  /** Opens the scene that is shown again, in an engine that was stopped; its run is the same. */
  async #reopen(): Promise<void> {
    const [main] = this.#showing;
    if (main !== undefined) {
      const { name } = this.#scene;
      try {
        await this.#engine.call('open', [main.slot, name, this.#scene.text(), this.#tables]);
      } catch (error) {
        this.#trouble(error instanceof Stopped ? undefined : error);
      }
    }
  }

  /** Puts a run into the picture. */
  async #stageRun(run: OpenedRun, anew: boolean): Promise<void> {
    this.#clear();
    const { description } = run;
    const size = 2 * description.half_extents[0];
    const [low, high] = bounds(run);
    const centre = low.clone().add(high).multiplyScalar(0.5);
    const radius = Math.max(0.5 * high.distanceTo(low), 3 * size);
    this.#view.surround(description.stage, size, centre, radius);
    this.#add('main', run, FIRST, this.#scene.name, undefined);
    this.#playback.times = run.times;
    this.#playback.time = this.#playback.start;
    this.#playback.glimpse = undefined;
    this.#playback.playing = !reducedMotion();
    this.#pressure = { frame: -1, waiting: false, most: 0 };
    this.#loadsTable?.begin(run);
    this.#landings.show(this.#scene);
    this.#panel.comparison = this.#comparison;
    this.#panel.show(this.#scene, description, this.#mesh);
    byId('about').textContent = description.description;
    this.#chooseScene();
    const slider = byId<HTMLInputElement>('time');
    slider.min = String(this.#playback.start);
    slider.max = String(this.#playback.end);
    const alone = run.bodies.length === 1;
    for (const id of ['forces', 'torques', 'pressure']) {
      byId<HTMLInputElement>(id).disabled = run.loads.length === 0;
    }
    this.#view.canvas.setAttribute('aria-label', this.#inWords(run));
    byId('said').textContent = this.#inWords(run);
    if (anew) {
      this.#view.lookFrom(new Vector3(0.35, 0.16, 1));
      byId<HTMLInputElement>('follow').checked = alone;
    }
    this.#frameCamera();
    await this.#compare(this.#comparison);
    document.body.dataset['runs'] = String(Number(document.body.dataset['runs'] ?? 0) + 1);
  }

  #chooseScene(): void {
    const select = byId<HTMLSelectElement>('scene');
    select.querySelector('option[data-own]')?.remove();
    const { name } = this.#scene;
    const text = this.#textOf(name);
    const untouched = text !== undefined && this.#isBuiltIn(name, text);
    if (!untouched) {
      select.prepend(h('option', { value: 'own', data: { own: '' } }, `${name} (changed)`));
    }
    select.value = untouched ? name : 'own';
  }

  #isBuiltIn(name: string, text: string): boolean {
    const built = SceneDocument.parse(name, text);
    const ended = built.get('run.duration') === undefined ? built.with({ 'run.duration': 10 }) : built;
    return ended.text() === this.#scene.text();
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

  /** Adds a run to the picture; `aside` moves it away from the first (m). */
  #add(slot: string, run: OpenedRun, tint: string, name: string, aside: Vector3 | undefined): void {
    const seeds = slot.startsWith('seed');
    const geometries = run.skins.map(geometryOf);
    const compared = this.#comparison.kind === 'model';
    const actors = run.bodies.map((body, place) => {
      const colour = slot === 'main' ? this.#lookOf(run, body.kind, body.number) : tint;
      const label = compared ? { label: name } : {};
      const geometry = geometries[body.kind];
      const actor = new Actor(
        run.bodies.length > 1 && geometry !== undefined ? geometry : (geometry ?? geometryOf(run.skins[0]!)),
        run.poses[place] ?? new Float32Array(7),
        body.from,
        body.scale,
        { colour, opacity: seeds ? 0.35 : 1, ...label },
      );
      if (aside !== undefined) {
        actor.group.position.copy(aside);
      }
      this.#view.scene.add(actor.group);
      return actor;
    });
    this.#showing.push({ slot, run, actors, colour: tint, name });
    this.#charts.show(
      this.#showing.map(({ run, colour, name, slot }) => ({
        run,
        name,
        colour: slot.startsWith('seed') ? `${colour}66` : colour,
      })),
    );
  }

  #lookOf(run: OpenedRun, kind: number, number: number): string {
    const kindName = run.description.kinds[kind] ?? '';
    const text = kind === 0 ? undefined : this.#textOf(kindName);
    const body = text === undefined ? this.#scene.get('body') : SceneDocument.parse('', text).get('body');
    const shape = String((body as Values | undefined)?.['shape'] ?? '');
    const look = LOOKS[shape] ?? '#6f93ad';
    if (run.bodies.length === 1 || shape !== 'leaf') {
      return look;
    }
    return ['#d2691e', '#c1440e', '#e0a030', '#a8761c', '#b5541c'][number % 5] ?? look;
  }

  #clear(): void {
    for (const { slot, actors } of this.#showing) {
      actors.forEach((actor) => actor.dispose());
      if (slot !== 'main') {
        void this.#engine.call('close', [slot]);
      }
    }
    this.#showing = [];
  }

  // Comparisons

  async #compare(comparison: Comparison): Promise<void> {
    const asked = this.#asked;
    this.#comparison = comparison;
    const main = this.#showing.find(({ slot }) => slot === 'main');
    if (main === undefined) {
      return;
    }
    this.#clear();
    this.#add('main', main.run, FIRST, this.#modelName(this.#scene), undefined);
    this.#switchPressure();
    if (comparison.kind === 'none' || main.run.description.world || this.#tables !== undefined) {
      return;
    }
    const scene = this.#scene;
    const others =
      comparison.kind === 'model'
        ? [scene.with({ 'run.model': comparison.model, 'run.integrator': undefined })]
        : Array.from({ length: SEEDS }, (_, number) =>
            scene.with({ 'run.seed': scene.number('run.seed', 0) + number + 1 }),
          );
    const size = 2 * main.run.description.half_extents[0];
    const aside = comparison.kind === 'model' ? new Vector3(1.8 * size, 0, 0) : undefined;
    try {
      for (const [number, other] of others.entries()) {
        const slot = comparison.kind === 'model' ? 'model' : `seed${number}`;
        const run = await this.#working('Comparing', (news) =>
          this.#engine.call('open', [slot, other.name, other.text()], news),
        );
        if (asked !== this.#asked || this.#comparison !== comparison) {
          return;
        }
        this.#add(slot, run, SECOND, this.#modelName(other), aside);
        if (run.times.length > 0 && (run.times[run.times.length - 1] ?? 0) > this.#playback.end) {
          this.#playback.times = run.times;
          byId<HTMLInputElement>('time').max = String(this.#playback.end);
        }
      }
      this.#frameCamera();
    } catch (error) {
      this.#trouble(error instanceof Stopped ? undefined : error);
    }
  }

  #modelName(scene: SceneDocument): string {
    return String(scene.get('run.model') ?? 'separated');
  }

  // Many

  async #startMany(): Promise<void> {
    const asked = ++this.#asked;
    const body = this.#scene.get('body') as Values;
    const coarse = body['shape'] === undefined ? this.#scene : this.#scene.with({ 'body.triangles': COARSE });
    try {
      const { room, shape, poses } = await this.#working('Letting 5,000 go', (news) =>
        this.#engine.call('startMany', [coarse.name, coarse.text(), MANY], news),
      );
      if (asked !== this.#asked) {
        return;
      }
      const look = LOOKS[String(body['shape'])] ?? '#6f93ad';
      const swarm = new Swarm(shape, MANY, look);
      swarm.show(poses);
      this.#view.scene.add(swarm.mesh);
      this.#showing.forEach(({ actors }) => actors.forEach(({ group }) => (group.visible = false)));
      this.#swarm = { swarm, simulation: 0, drawing: 0, waiting: false };
      this.#panel.many = true;
      const [side = 1, height = 1, , x = 0, ground = 0, z = 0] = room;
      const centre = new Vector3(x, ground + 0.5 * height, z);
      const reach = Math.max(side, height);
      const description = this.#showing[0]?.run.description;
      if (description !== undefined) {
        const size = 2 * description.half_extents[0];
        this.#view.surround({ ...description.stage, ground }, size, centre, 0.6 * reach);
      }
      byId<HTMLInputElement>('follow').checked = false;
      this.#view.lookFrom(new Vector3(0.35, 0.1, 1));
      this.#view.lookAt(centre, 0.8 * reach);
      this.#playback.playing = !reducedMotion();
      document.body.dataset['many'] = 'on';
    } catch (error) {
      this.#panel.many = false;
      this.#trouble(error instanceof Stopped ? undefined : error);
    }
  }

  #stopMany(): void {
    this.#panel.many = false;
    delete document.body.dataset['many'];
    if (this.#swarm !== undefined) {
      this.#swarm.swarm.dispose();
      this.#swarm = undefined;
      const main = this.#showing[0];
      if (main !== undefined) {
        this.#showing.forEach(({ actors }) => actors.forEach(({ group }) => (group.visible = true)));
        void this.#stageRun(main.run, true);
      }
    }
  }

  async #advanceMany(many: Crowd): Promise<void> {
    many.waiting = true;
    try {
      const { poses, milliseconds } = await this.#engine.call('advanceMany', [this.#playback.rate / 60]);
      many.simulation += 0.1 * (milliseconds - many.simulation) || milliseconds;
      if (this.#swarm === many) {
        many.swarm.show(poses);
      }
    } catch (error) {
      this.#stopMany();
      this.#trouble(error);
    } finally {
      many.waiting = false;
    }
  }

  // Files

  async #openFile(file: File): Promise<void> {
    try {
      const bytes = new Uint8Array(await file.arrayBuffer());
      if (file.name.toLowerCase().endsWith('.toml')) {
        const text = new TextDecoder().decode(bytes);
        await this.#open(SceneDocument.parse(file.name.replace(/\.toml$/i, ''), text));
        return;
      }
      this.#meshBytes = { name: file.name.replaceAll(/[^\p{L}\p{N}._-]/gu, '-'), bytes };
      await this.#readMesh(this.#meshBytes, undefined, undefined);
    } catch (error) {
      this.#trouble(`${file.name}: ${words(error)}`);
    }
  }

  async #readMesh(
    mesh: MeshFile | undefined,
    unit: string | undefined,
    thickness: number | undefined,
  ): Promise<void> {
    if (mesh === undefined) {
      return;
    }
    const { name, bytes } = mesh;
    try {
      await this.#engine.putFile(name, bytes);
      const checked = await this.#working('Checking the mesh', (news) =>
        this.#engine.call('checkMesh', [name, unit, thickness], news),
      );
      const mended = checked.mended.length > 0;
      const path = mended ? `${name}.mended.obj` : name;
      const content = mended ? await this.#engine.call('getFile', [path]) : bytes;
      const told: MeshTold = {
        name,
        words: meshWords(name, checked),
        unit: checked.unit,
        guessed: checked.unit_guessed || unit !== undefined,
        trouble: false,
        thickness,
      };
      const body = this.#scene.get('body') as Values;
      const density = body['density'] ?? 500;
      const longest = Math.max(...checked.size);
      const ground = this.#scene.number('run.ground', 0);
      const [x, y, z] = this.#scene.vector('release.position');
      const scene = this.#scene.with(
        {
          body: { mesh: path, unit: mended ? 'm' : checked.unit, density },
          // High enough to fall.
          'release.position': [x, Math.max(y, ground + 8 * longest), z],
        },
        name.replace(/\.[^.]*$/, ''),
        new Map([[path, content]]),
      );
      await this.#show(scene, undefined, true, told);
    } catch (error) {
      if (error instanceof Stopped) {
        return;
      }
      const said = words(error);
      this.#mesh = {
        name,
        words: [said.startsWith(name) || said.includes(`\`${name}\``) ? said : `${name}: ${said}`],
        unit,
        guessed: false,
        trouble: true,
        thickness,
      };
      this.#trouble(this.#mesh.words[0]);
      this.#panel.show(this.#scene, this.#showing[0]?.run.description, this.#mesh);
    }
  }

  // The address

  async #writeLink(): Promise<void> {
    const fragment = await toFragment(this.#scene, this.#engine.about.version);
    this.#written = fragment ?? '#';
    history.replaceState(null, '', fragment ?? location.pathname + location.search);
  }

  async #share(): Promise<void> {
    await this.#writeLink();
    if (this.#written === '#') {
      this.#trouble(
        'The mesh is too large for a link. Download the scene and send it with the mesh; others drop both here.',
      );
      return;
    }
    try {
      await navigator.clipboard.writeText(location.href);
      byId('said').textContent = 'The link is copied.';
      const button = byId('share');
      button.textContent = 'Copied ✓';
      setTimeout(() => (button.textContent = 'Copy link'), 1500);
    } catch {
      this.#trouble('The browser did not let the link be copied: copy it from the address bar.');
    }
  }

  // The picture

  #grabbable(): Grabbable | undefined {
    const [main] = this.#showing;
    const actor = main?.actors[0];
    if (main?.run.bodies.length !== 1 || actor === undefined || this.#swarm !== undefined) {
      return undefined;
    }
    return { body: actor.mesh, size: 2 * main.run.description.half_extents[0] };
  }

  #length(): number {
    return this.#playback.end - this.#playback.start;
  }

  #togglePlay(): void {
    if (this.#playback.playing) {
      this.#playback.playing = false;
    } else {
      this.#playback.play();
    }
  }

  #again(): void {
    this.#playback.time = this.#playback.start;
    this.#playback.playing = true;
  }

  /** Near the body where it is followed, else far enough to see the whole way. */
  #frameCamera(): void {
    const [main] = this.#showing;
    if (main === undefined || this.#swarm !== undefined) {
      return;
    }
    const size = 2 * main.run.description.half_extents[0];
    if (this.#follows()) {
      const around = this.#comparison.kind === 'model' ? 13 : 9;
      this.#view.lookAt(this.#bodyNow(main), around * size);
    } else {
      const [low, high] = bounds(main.run);
      const centre = low.clone().add(high).multiplyScalar(0.5);
      const radius = 0.5 * high.distanceTo(low) + size;
      const narrow = Math.min(1, this.#view.camera.aspect);
      this.#view.lookAt(centre, (1.15 * radius) / Math.sin((19 * Math.PI) / 180) / narrow);
    }
  }

  #follows(): boolean {
    return byId<HTMLInputElement>('follow').checked && this.#showing[0]?.run.bodies.length === 1;
  }

  #bodyNow(main: Showing): Vector3 {
    const place = main.actors[0]?.mesh.position.clone() ?? new Vector3();
    const other = this.#showing.find(({ slot }) => slot === 'model')?.actors[0];
    if (other !== undefined) {
      place.add(other.mesh.position).add(other.group.position).multiplyScalar(0.5);
    }
    return place;
  }

  /** A distance from which both of two compared bodies are seen; none where they are. */
  #wideEnough(): number | undefined {
    const other = this.#showing.find(({ slot }) => slot === 'model')?.actors[0];
    const own = this.#showing[0]?.actors[0];
    if (other === undefined || own === undefined) {
      return undefined;
    }
    const there = other.mesh.position.clone().add(other.group.position);
    const wide = 2.2 * own.mesh.position.distanceTo(there);
    const { camera, controls } = this.#view;
    return wide > camera.position.distanceTo(controls.target) ? wide : undefined;
  }

  #frame(now: number): void {
    requestAnimationFrame((next) => this.#frame(next));
    const seconds = Math.min(0.1, Math.max(0, (now - this.#last) / 1000));
    this.#last = now;
    if (this.#swarm !== undefined) {
      this.#frameOfMany(this.#swarm);
      return;
    }
    if (this.#playback.advance(seconds)) {
      byId('said').textContent = this.#showing[0] === undefined ? '' : this.#inWords(this.#showing[0].run);
    }
    if (this.#throw?.holding !== true) {
      this.#place();
    }
    this.#view.draw();
    this.#tell();
  }

  #frameOfMany(many: Crowd): void {
    if (this.#playback.playing && !many.waiting) {
      void this.#advanceMany(many);
    }
    const took = this.#view.draw();
    many.drawing += 0.1 * (took - many.drawing) || took;
    byId('hud').textContent =
      `${MANY.toLocaleString('en')} bodies\nsimulation ${many.simulation.toFixed(1)} ms a frame of 1/60 s\ndrawing    ${many.drawing.toFixed(1)} ms`;
    this.#tellPlaying();
  }

  /** Everything where it is at the moment shown. */
  #place(): void {
    const [trail, copies] = ['trail', 'copies'].map((id) => byId<HTMLInputElement>(id).checked);
    const time = this.#playback.shown;
    for (const { run, actors } of this.#showing) {
      const own = new Playback();
      own.times = run.times;
      const { frame, share } = own.between(Math.min(time, own.end));
      const crowd = actors.length > 1;
      actors.forEach((actor) =>
        actor.place(frame, share, trail === true && !crowd, copies === true && !crowd),
      );
    }
    const [main] = this.#showing;
    if (main === undefined) {
      return;
    }
    if (this.#follows()) {
      this.#view.lookAt(this.#bodyNow(main), this.#wideEnough());
    }
    this.#showLoads(main);
    void this.#showPressure(main);
  }

  #frameOf({ run }: Showing): number {
    const own = new Playback();
    own.times = run.times;
    return own.frame(Math.min(this.#playback.shown, own.end));
  }

  #showLoads(main: Showing): void {
    const { run, actors } = main;
    const width = 6 * this.#engine.about.causes.length;
    const frame = this.#frameOf(main);
    const loads = run.loads.subarray(frame * width, (frame + 1) * width);
    const [forces, torques] = ['forces', 'torques'].map((id) => byId<HTMLInputElement>(id).checked);
    const arrows = this.#arrows;
    if (arrows === undefined || this.#loadsTable === undefined) {
      return;
    }
    arrows.visible = loads.length > 0 && (forces === true || torques === true);
    if (arrows.visible) {
      const { description } = run;
      const gravity = Math.hypot(...description.gravity);
      const size = 2 * description.half_extents[0];
      const weight = description.mass * gravity || 1e-3;
      const place = actors[0]?.mesh.position ?? new Vector3();
      arrows.show(loads, place, weight, 1.4 * size, {
        forces: forces === true,
        torques: torques === true,
        hidden: this.#loadsTable.hidden,
      });
    }
    if (!byId('loads').hidden && loads.length > 0) {
      this.#loadsTable.show(loads);
    }
  }

  #switchPressure(): void {
    const { checked } = byId<HTMLInputElement>('pressure');
    byId('pressure-scale').hidden = !checked;
    this.#pressure = { frame: -1, waiting: false, most: 0 };
    if (!checked) {
      this.#showing[0]?.actors[0]?.paint(undefined);
    }
  }

  async #showPressure(main: Showing): Promise<void> {
    const wanted = byId<HTMLInputElement>('pressure').checked && main.run.loads.length > 0;
    const frame = this.#frameOf(main);
    const pressure = this.#pressure;
    if (!wanted || pressure.waiting || pressure.frame === frame) {
      return;
    }
    pressure.waiting = true;
    try {
      const pressures = await this.#engine.call('pressures', ['main', frame]);
      if (this.#pressure !== pressure || this.#showing[0] !== main) {
        return;
      }
      pressure.frame = frame;
      // While it plays the scale follows slowly, or it would flicker.
      const now = typical(pressures);
      const follows = this.#playback.playing && pressure.most > 0;
      pressure.most = follows ? pressure.most + 0.08 * (now - pressure.most) : now;
      main.actors[0]?.paint(coloured(pressures, pressure.most));
      byId('pressure-low').textContent = pascals(-pressure.most);
      byId('pressure-high').textContent = pascals(pressure.most);
    } catch (error) {
      byId<HTMLInputElement>('pressure').checked = false;
      this.#switchPressure();
      this.#trouble(error instanceof Stopped ? undefined : error);
    } finally {
      pressure.waiting = false;
    }
  }

  #tell(): void {
    const [main] = this.#showing;
    if (main === undefined) {
      return;
    }
    const { description } = main.run;
    const time = this.#playback.shown;
    const frame = this.#frameOf(main);
    byId('clock').textContent = `${time.toFixed(2)} / ${this.#playback.end.toFixed(2)} s`;
    byId<HTMLInputElement>('time').value = String(time);
    byId('time').setAttribute('aria-valuetext', `${time.toFixed(2)} seconds`);
    const size = 2 * description.half_extents[0];
    const lines = [`${time.toFixed(2)} s`];
    const speed = curve(main.run, 'speed')?.[frame];
    if (speed !== undefined) {
      const height = (main.actors[0]?.mesh.position.y ?? 0) - (description.stage.ground ?? 0);
      lines.push(`${speed.toFixed(2)} m/s`, `${metres(height)} up`);
    } else {
      lines.push(`${main.run.bodies.length} bodies`);
    }
    if (description.stage.ground !== null) {
      lines.push(`grid ${metres(gridStep(size))}`);
    }
    byId('hud').textContent = lines.join('   ');
    this.#charts.mark(time);
    this.#tellPlaying();
  }

  #tellPlaying(): void {
    const play = byId('play');
    const words = this.#playback.playing ? 'Pause' : 'Play';
    if (play.getAttribute('aria-label') !== words) {
      play.setAttribute('aria-label', words);
      play.dataset['playing'] = String(this.#playback.playing);
    }
  }

  // Messages

  /** Shows what went wrong; nothing takes the message away. */
  #trouble(error: unknown): void {
    const place = byId('trouble');
    place.hidden = error === undefined;
    const paragraph = place.querySelector('p');
    if (paragraph !== null) {
      paragraph.textContent = error === undefined ? '' : words(error);
    }
  }

  /** Does some work; a bar shows how far it is if it takes long. */
  async #working<T>(
    name: string,
    work: (news: (progress: { stage: string; fraction: number }) => void) => Promise<T>,
  ): Promise<T> {
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
}

/** The box that the bodies of a run pass through. */
function bounds({ poses, bodies, skins, description }: OpenedRun): [Vector3, Vector3] {
  const low = new Vector3().setScalar(Infinity);
  const high = new Vector3().setScalar(-Infinity);
  const point = new Vector3();
  for (const track of poses) {
    for (let at = 0; at < track.length; at += 7) {
      point.fromArray(track, at);
      low.min(point);
      high.max(point);
    }
  }
  if (bodies.length === 0 || skins.length === 0 || !Number.isFinite(low.x)) {
    return [new Vector3(...description.position), new Vector3(...description.position)];
  }
  return [low, high];
}

/** Two digits of a pressure. */
function pascals(pressure: number): string {
  return Math.abs(pressure) < 1e-6 ? '0 Pa' : `${Number(pressure.toPrecision(2))} Pa`.replace('-', '−');
}

function meshWords(name: string, { triangles, size, mended, notices }: CheckedMesh): string[] {
  const sides = size.map(metres).join(' × ');
  return [`${name}: ${triangles.toLocaleString('en')} triangles, ${sides}`, ...mended, ...notices];
}
