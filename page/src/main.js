// The page: chooses a task and an instance, keeps records, and plays those that a link tells.
import load from "@mujoco/mujoco";
import { Player, element } from "./player.js";
import { World, judge } from "./world.js";

export { Player, World, element, judge };

const STORE = "physexp";
const PAUSE = 400; // ms, between the actions of a link.
const LONGEST = 10; // s, that a judgement may take.

const inflated = async (bytes) => {
  if (bytes[0] !== 0x1f) return bytes; // A server that says so has had it inflated.
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};
const fetched = async (path) => {
  const response = await fetch(path);
  if (!response.ok) throw new Error(`${path}: ${response.status} ${response.statusText}`);
  return response;
};
const inline = (id) => document.getElementById(id)?.textContent;

// Returns MuJoCo, whose compressed program is beside the page or in it.
export async function start(program = inline("program")) {
  const bytes = program
    ? Uint8Array.from(atob(program), (letter) => letter.charCodeAt(0))
    : new Uint8Array(await (await fetched("mujoco.wasm.gz")).arrayBuffer());
  return load({ wasmBinary: await inflated(bytes) });
}

const tasks = async () => JSON.parse(inline("tasks") ?? (await (await fetched("tasks.json")).text()));
export const taskOf = async (file) => JSON.parse(inline(file) ?? (await (await fetched(`${file}.json`)).text()));

// Services that the page may be served with take records.
const serviceOf = (name) => document.querySelector(`meta[name=${name}]`)?.content;
const post = (service, record, settings) => fetch(service, { method: "POST", body: JSON.stringify(record), ...settings });

// Returns the mistakes in a record.
async function mistakesIn(record) {
  const settings = { signal: AbortSignal.timeout(1000 * LONGEST) };
  const response = await post(serviceOf("mistakes"), { player: records.player(), ...record }, settings);
  if (!response.ok) throw new Error(await response.text());
  return response.json();
}

const records = {
  all: () => JSON.parse(localStorage.getItem(STORE) ?? "[]"),
  add(record) {
    const kept = { player: records.player(), ...record };
    localStorage.setItem(STORE, JSON.stringify([...records.all(), kept]));
    if (serviceOf("records")) post(serviceOf("records"), kept);
  },
  player() {
    const given = new URLSearchParams(location.search).get("player") ?? localStorage.getItem(`${STORE}-player`);
    const name = given ?? `person-${crypto.getRandomValues(new Uint32Array(1))[0].toString(36)}`;
    localStorage.setItem(`${STORE}-player`, name);
    return name;
  },
  save() {
    const lines = records.all().map((record) => `${JSON.stringify(record)}\n`);
    const href = URL.createObjectURL(new Blob(lines, { type: "application/jsonl" }));
    element("a", { href, download: "records.jsonl" }).click();
    URL.revokeObjectURL(href);
  },
};

class Page {
  constructor(mujoco, known) {
    Object.assign(this, { mujoco, known, root: document.querySelector("main") });
    this.bar = document.querySelector("nav");
  }

  async open(name, episode, actions = null) {
    const names = this.known.map((each) => each.name);
    if (!names.includes(name)) throw new Error(`it has no task ${name}; choose from ${names.join(", ")}`);
    this.player?.close();
    const task = await taskOf(this.known[names.indexOf(name)].file);
    const next = () => this.begin((this.instance + 1) % task.instances.length);
    // A replay that a link tells is nobody's play.
    const onEnd = (record) => {
      if (!this.player.isReplay) records.add(record);
      this.navigate();
    };
    const judge = serviceOf("mistakes") ? mistakesIn : null;
    this.player = new Player(this.root, this.mujoco, task, { onEnd, next, judge });
    const played = records.all().filter((record) => record.task === task.name).length;
    this.begin(episode === undefined ? played % task.instances.length : this.instanceOf(task, episode), Boolean(actions));
    for (const action of actions ?? []) {
      await new Promise((resolve) => setTimeout(resolve, PAUSE));
      await this.player.act(action);
    }
  }

  instanceOf(task, episode) {
    const episodes = task.instances.map((each) => each.episode);
    if (!episodes.includes(episode)) throw new Error(`it has no episode ${episode} of ${task.name}; choose from ${episodes.join(", ")}`);
    return episodes.indexOf(episode);
  }

  begin(instance, isReplay = false) {
    this.instance = instance;
    this.player.begin(instance, isReplay);
    this.navigate();
  }

  get link() {
    const { task, episode, actions } = this.player.record();
    const query = new URLSearchParams({ task, episode, ...(actions.length ? { actions: actions.join(",") } : {}) });
    return `${location.href.split(/[?#]/)[0]}?${query}`.replaceAll("%2C", ",").replaceAll("%2F", "/");
  }

  navigate() {
    const { task } = this.player;
    const options = this.known.map(({ name, question }) => element("option", { value: name, textContent: `${name}: ${question}` }));
    const chosen = element("select", { onchange: () => this.open(chosen.value), title: "task" }, ...options);
    chosen.value = task.name;
    const count = records.all().length;
    this.bar.replaceChildren(
      chosen,
      element("span", { textContent: `instance ${this.instance + 1} of ${task.instances.length}` }),
      element("a", { href: this.link, textContent: this.player.isOver ? "link to this replay" : "link to this instance" }),
      element("button", { textContent: `save ${count} record${count === 1 ? "" : "s"}`, disabled: !count, onclick: records.save }),
    );
  }
}

async function run() {
  const main = document.querySelector("main");
  try {
    const [mujoco, known] = await Promise.all([start(), tasks()]);
    const query = new URLSearchParams(location.search);
    const actions = query.get("actions")?.split(",").map(Number);
    const episode = query.has("episode") ? Number(query.get("episode")) : undefined;
    globalThis.physexp = new Page(mujoco, known);
    document.body.dataset.state = "playing";
    await globalThis.physexp.open(query.get("task") ?? known[0].name, episode, actions);
    document.body.dataset.state = "ready";
  } catch (error) {
    main.textContent = `This page cannot be shown: ${error.message}`;
    document.body.dataset.state = "failed";
    throw error;
  }
}

if (globalThis.document?.querySelector("main")) run();
