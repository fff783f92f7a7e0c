/** What the command that serves the page was asked to open. */

export interface Opened {
  name: string;
  toml: string;
  files: Map<string, Uint8Array>;
  tables: { trajectory: string; bodies?: string | undefined } | undefined;
}

interface Told {
  name: string;
  toml: string;
  files: string[];
  tables: { trajectory?: string; bodies?: string };
}

async function fetched(path: string): Promise<Response> {
  const response = await fetch(path);
  if (!response.ok) {
    throw new Error(`${path}: the server answered ${response.status}`);
  }
  return response;
}

/** None where nothing was asked for, or where no command serves the page. */
export async function fetchOpened(): Promise<Opened | undefined> {
  const response = await fetch('opened.json').catch(() => undefined);
  const isJson = response?.headers.get('content-type')?.includes('json') === true;
  if (response?.ok !== true || !isJson) {
    return undefined;
  }
  const told = (await response.json()) as Told | null;
  if (told === null) {
    return undefined;
  }
  const files = new Map<string, Uint8Array>();
  for (const name of told.files) {
    const answer = await fetched(`opened/files/${encodeURIComponent(name)}`);
    files.set(name, new Uint8Array(await answer.arrayBuffer()));
  }
  const table = async (name: string | undefined): Promise<string | undefined> =>
    name === undefined ? undefined : (await fetched(`opened/${name}`)).text();
  const trajectory = await table(told.tables.trajectory);
  const tables =
    trajectory === undefined ? undefined : { trajectory, bodies: await table(told.tables.bodies) };
  return { name: told.name, toml: told.toml, files, tables };
}
