// Plays one task: its scene, question, price, actions and readings, and after the answer what others did.
import { plot, plotted } from "./plots.js";
import { scales } from "./scales.js";
import { Scene } from "./scene.js";
import { World, judge } from "./world.js";

const MOVING = 450; // ms, from one reading to the next, whatever the frame rate.
const FILM_FRAME = 40; // ms, of a film of what an answer leads to.
const SLOW_FRAME = 80; // ms: slower frames have no shadows.
const KEYS = "1234567890qwertyuiopasdfghjklzxcvbnm";
const MOST_COLUMNS = 12; // Of the table of readings; more are shown on demand.
const BESIDE = 0.02; // m, from a thing to what is written beside it.
const MOST_BOARDS = 6; // Of one reading that are named in the scene.

export const element = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};
const spoken = (name) => name.replaceAll("_", " ");
const titled = (name, { unit }) => (unit ? `${spoken(name)}, ${unit}` : spoken(name));
const number = (value) => String(+value.toFixed(3) || 0);
const worth = (value) => value.toFixed(2).replace("-", "\u2212");
const nextFrame = () => new Promise((resolve) => requestAnimationFrame(resolve));

export class Player {
  // `onEnd` gets the record of each episode, `next` begins another one, `judge` finds the mistakes in a record.
  constructor(root, mujoco, task, { onEnd = () => {}, next = null, judge = null } = {}) {
    Object.assign(this, { root, task, onEnd, next, judge, world: new World(mujoco, task) });
    const part = (name, tag = "section") => (this[name] = element(tag, { className: name }));
    this.canvas = element("canvas");
    root.replaceChildren(
      element("header", {}, element("h1", { textContent: task.question }), part("price", "div")),
      element("div", { className: "stage" }, this.canvas, part("marks", "div")),
      element("aside", {}, part("result"), part("experiments"), part("answers"), part("seen"), this.about()),
    );
    this.result.setAttribute("aria-live", "polite");
    this.scene = new Scene(this.canvas);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.canvas.parentElement);
    this.canvas.onclick = (event) => this.click(event);
    this.onKey = (event) => this.key(event);
    window.addEventListener("keydown", this.onKey);
  }

  about() {
    const summary = element("summary", { textContent: "What is on the table" });
    return element("section", {}, element("details", {}, summary, element("p", { textContent: this.task.description })));
  }

  close() {
    window.removeEventListener("keydown", this.onKey);
    this.observer.disconnect();
    this.scene.renderer.dispose();
  }

  // Begins the instance at a place of the task's list.
  begin(place, isReplay = false) {
    this.isReplay = isReplay;
    const observation = this.world.reset(place);
    this.seenSoFar = [observation];
    this.times = [];
    this.isBusy = false;
    this.scales = scales(this.task, this.world);
    const lines = this.scales.flatMap((scale) => scale.lines);
    this.scene.build(this.world.model, this.world.structure, lines);
    this.pose = this.world.placed(observation);
    this.names();
    this.resize();
    this.result.hidden = true;
    this.experiments.hidden = this.answers.hidden = false;
    this.buttons();
    this.tell();
    this.readyAt = performance.now();
  }

  get isOver() {
    return this.world.judged.over;
  }

  // Takes an action, and returns when all of it has been shown.
  async act(action) {
    if (this.isBusy || this.isOver) return;
    this.isBusy = true;
    this.times.push(Math.round(performance.now() - this.readyAt));
    this.menu?.remove();
    const before = this.seenSoFar.at(-1);
    const after = this.world.step(action);
    this.seenSoFar.push(after);
    this.buttons();
    this.tell();
    await this.move(before, after);
    this.isBusy = false;
    this.readyAt = performance.now();
    if (this.isOver) await this.end();
    else this.buttons();
  }

  // Moves all that shows a reading from one reading to the next, by the clock.
  async move(before, after) {
    const names = Object.keys(after).filter((name) => after[name].some((value, i) => value !== before[name][i]));
    const started = performance.now();
    let [share, frames] = [names.length ? 0 : 1, 0];
    while (share < 1) {
      await nextFrame();
      frames += 1;
      share = Math.min(1, (performance.now() - started) / MOVING);
      const eased = share * share * (3 - 2 * share);
      const mixed = (name) => Array.from(before[name], (value, i) => value + eased * (after[name][i] - value));
      this.pose = this.world.placed({ ...after, ...Object.fromEntries(names.map((name) => [name, mixed(name)])) });
      this.draw();
    }
    if (frames && (performance.now() - started) / frames > SLOW_FRAME) this.scene.dropShadows();
  }

  async end() {
    const { world, task } = this;
    this.scene.reveal(world.instance.tied);
    this.pose = world.truth();
    this.show();
    this.onEnd(this.record());
    const label = world.actions.at(-1) - task.interactions.length;
    for (const qpos of (label >= 0 && task.played_out[world.place]?.[label]) || []) {
      await new Promise((resolve) => setTimeout(resolve, FILM_FRAME));
      if (world.judged.over === false) return;
      this.pose = world.truth(qpos);
      this.draw();
    }
  }

  record() {
    const { task, world, times } = this;
    return { task: task.name, seed: task.seed, episode: world.instance.episode, actions: [...world.actions], times: [...times] };
  }

  // The scene.

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (!this.pose || !clientWidth) return;
    this.scene.resize(clientWidth, clientHeight);
    this.draw();
  }

  draw() {
    this.scene.show(this.pose);
    this.scene.draw();
    for (const { node, thing, above, at } of this.labels) {
      const [x, y] = at ? this.scene.project(at) : this.scene.locate(thing, above);
      Object.assign(node.style, { left: `${100 * x}%`, top: `${100 * y}%` });
      node.hidden = !at && this.scene.isBelow(thing);
    }
  }

  // Writes the names of things that can be acted on, those of boards that show readings, and numbers of scales.
  names() {
    const { task, world, scene } = this;
    const things = [...new Set(task.interactions.map(({ thing }) => thing))];
    const counts = Object.groupBy(world.structure.indicators, ([, name]) => name);
    const boards = world.structure.indicators
      .filter(([geom, name]) => !things.includes(world.structure.things[geom]) && counts[name].length <= MOST_BOARDS)
      .map(([geom, name, column]) => ({
        thing: world.structure.things[geom],
        text: counts[name].length > 1 ? `${spoken(name)} ${column}` : spoken(name),
      }));
    const all = [...things.map((thing) => ({ thing, text: spoken(thing), isName: true })), ...boards];
    const used = new Set();
    this.labels = all
      .filter(({ thing, text }) => scene.find(thing) && !used.has(text) && used.add(text))
      .map(({ thing, text, isName }) => ({ thing, above: isName ? 0 : 1, node: this.mark(text, isName, thing) }));
    const write = (at, className, textContent) => this.labels.push({ at, node: element("span", { className, textContent }) });
    for (const { name, thing, lines, numbers } of this.scales) {
      // Its name is written on a board, but not on a thing that is acted on.
      if (things.includes(thing)) write(lines[0], "number caption", spoken(name));
      for (const { value, at } of numbers) write(at, "number", number(value).replace("-", "\u2212"));
    }
    world.structure.staged.forEach((geom, k) => {
      const [x, y, z] = world.structure.start.geom_xpos.slice(3 * geom, 3 * geom + 3);
      if (task.texts[k]) write([x, y - world.model.geom_size[3 * geom + 1] - BESIDE, z], "number", task.texts[k]);
    });
    this.marks.replaceChildren(...this.labels.map(({ node }) => node));
  }

  mark(text, isName, thing) {
    if (!isName) return element("span", { className: "board", textContent: text });
    return element("button", { className: "name", textContent: text, tabIndex: -1, onclick: (event) => this.choose(thing, event) });
  }

  click(event) {
    const box = this.canvas.getBoundingClientRect();
    this.choose(this.scene.pick((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height), event);
  }

  // Takes the only action on a thing, or shows those that there are.
  choose(thing, event) {
    this.menu?.remove();
    const actions = this.task.interactions.flatMap((each, action) => (each.thing === thing ? [action] : []));
    if (this.isBusy || this.isOver || !actions.length) return;
    if (actions.length === 1) return this.act(actions[0]);
    const box = this.canvas.getBoundingClientRect();
    this.menu = element("div", { className: "menu" }, ...actions.map((action) => this.button(action, this.task.actions[action])));
    const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    Object.assign(this.menu.style, { [x > 0.6 ? "right" : "left"]: `${100 * (x > 0.6 ? 1 - x : x)}%` });
    Object.assign(this.menu.style, { [y > 0.5 ? "bottom" : "top"]: `${100 * (y > 0.5 ? 1 - y : y)}%` });
    this.marks.append(this.menu);
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches?.("select, input")) return;
    const action = KEYS.indexOf(event.key);
    if (event.key === "Escape") this.menu?.remove();
    else if (action >= 0 && action < this.task.actions.length) this.act(action);
    else if (event.key === "Enter" && this.isOver && event.target.tagName !== "BUTTON") this.next?.();
  }

  // The texts beside the scene.

  button(action, text) {
    const key = KEYS[action] ? [element("kbd", { textContent: KEYS[action] })] : [];
    const made = element("button", { title: this.task.actions[action], onclick: () => this.act(action) }, text, ...key);
    made.dataset.action = action;
    made.disabled = this.isBusy || this.isOver;
    return made;
  }

  buttons() {
    const { task } = this;
    const count = task.interactions.length;
    const focused = document.activeElement?.dataset?.action;
    const groups = Object.values(Object.groupBy(task.interactions.keys(), (action) => task.interactions[action].thing));
    const rows = groups.map((actions) => this.row(actions.map((action) => [action, task.actions[action]])));
    const isSingle = groups.every((actions) => actions.length === 1);
    const single = () => [element("div", { className: "row" }, ...rows.flatMap((row) => [...row.children]))];
    this.experiments.replaceChildren(element("h2", { textContent: "Experiment" }), ...(isSingle ? single() : rows));
    const labels = task.labels.map((label, k) => [count + k, label]);
    const asked = `Or answer${task.num_questions > 1 ? ` question ${this.world.judged.answered + 1} of ${task.num_questions}` : ""}`;
    this.answers.replaceChildren(element("h2", { textContent: asked }), this.row(labels, false));
    if (focused !== undefined) this.root.querySelector(`[data-action="${focused}"]`)?.focus({ preventScroll: true });
  }

  // The words that all actions of a row begin with are its heading, and the words that differ are on its buttons.
  row(named, hasHeading = named.length > 1) {
    const words = named.map(([, name]) => name.split(" "));
    const isShared = (place) => words.every((each) => each.length > place + 1 && each[place] === words[0][place]);
    let shared = 0;
    while (hasHeading && isShared(shared)) shared += 1;
    const heading = words[0].slice(0, shared).join(" ");
    const buttons = named.map(([action], k) => this.button(action, words[k].slice(shared).join(" ")));
    return element("div", { className: "row" }, ...(heading ? [element("span", { textContent: heading })] : []), ...buttons);
  }

  tell() {
    const { task, world } = this;
    const now = this.isOver ? world.judged.earned : task.discount ** world.actions.length;
    const left = task.step_limit - world.actions.length;
    const meter = element("i");
    meter.style.setProperty("--worth", Math.max(0, now));
    const caption = this.isOver ? "earned" : `worth now \u00b7 ${left} move${left === 1 ? "" : "s"} left`;
    this.price.replaceChildren(element("b", { textContent: worth(now) }), element("small", { textContent: caption }), meter);
    const table = this.table();
    const isLong = table.querySelectorAll("thead tr:last-child th").length > MOST_COLUMNS;
    const wasOpen = this.seen.querySelector("details")?.open ?? false;
    const summary = element("summary", { textContent: "all numbers" });
    this.seen.replaceChildren(
      element("h2", { textContent: "Seen" }),
      element("div", { className: "plots" }, ...plotted(task, this.seenSoFar).map((name) => this.plot(name))),
      isLong ? element("details", { open: wasOpen }, summary, table) : table,
    );
    this.seen.scrollTop = this.seen.scrollHeight;
  }

  plot(name) {
    const reading = this.task.readings[name];
    const title = titled(name, reading);
    const rows = this.seenSoFar.map((seen) => Array.from(seen[name]));
    return element("figure", { title: reading.meaning }, element("figcaption", { textContent: title }), plot(title, reading, rows, number));
  }

  table() {
    const { task, world, seenSoFar } = this;
    const columns = Object.entries(task.readings).flatMap(([name, reading]) =>
      reading.names.flatMap((curve, s) =>
        reading.components.map((component, c) => ({
          name,
          place: s * reading.components.length + c,
          title: reading.names.length * reading.components.length > 1 ? `${curve} ${component}`.trim() : "",
          limits: reading.limits?.[c],
        })),
      ),
    );
    const heads = Object.entries(task.readings).map(([name, reading]) =>
      element("th", { colSpan: reading.names.length * reading.components.length, title: reading.meaning, textContent: titled(name, reading) }),
    );
    const cell = (seen, { name, place, limits }) => {
      const value = seen[name][place];
      const made = element("td", { textContent: number(value) });
      if (limits) made.style.setProperty("--fill", Math.min(1, Math.abs(value) / Math.max(...limits.map(Math.abs))));
      return made;
    };
    const rewards = world.judged.rewards;
    const done = (t) => {
      if (t === 0) return "at first";
      const action = world.actions[t - 1];
      if (action < task.interactions.length) return task.actions[action];
      return `${task.actions[action]} ${rewards[t - 1] > 0 ? "\u2713" : "\u2717"}`;
    };
    return element(
      "table",
      {},
      element(
        "thead",
        {},
        element("tr", {}, element("th"), ...heads),
        element("tr", {}, element("th"), ...columns.map(({ title }) => element("th", { textContent: title }))),
      ),
      element("tbody", {}, ...seenSoFar.map((seen, t) => element("tr", {}, element("th", { textContent: done(t) }), ...columns.map((column) => cell(seen, column))))),
    );
  }

  show() {
    const { task, world } = this;
    const { instance, actions, judged } = world;
    const count = task.interactions.length;
    const moves = (name, taken) => {
      const found = judge(task, instance, taken);
      const chip = (action, step) => {
        const kind = action < count ? "" : found.rewards[step] > 0 ? "right" : "wrong";
        const mark = { right: " \u2713", wrong: " \u2717" }[kind] ?? "";
        return element("span", { className: kind, textContent: task.actions[action].replace("answer: ", "") + mark });
      };
      return element("tr", {}, element("th", { textContent: name }), element("td", {}, ...taken.map(chip)), element("td", { textContent: worth(found.earned) }));
    };
    const answers = instance.answers.map((answer) => task.labels[answer]).join(", ");
    const rightCount = judged.rewards.filter((reward) => reward > 0).length;
    const isRight = rightCount === task.num_questions;
    const verdict = task.num_questions > 1 ? `${rightCount} of ${task.num_questions} right` : isRight ? "Right" : "Wrong";
    const next = this.next && element("button", { className: "next", textContent: "Next", onclick: () => this.next() });
    const mistakes = element("div", { className: "mistakes" });
    if (this.judge) this.tellMistakes(mistakes);
    const others = Object.entries(instance.others ?? {}).map(([name, taken]) => moves(name, taken));
    this.result.replaceChildren(
      element("h2", { className: isRight ? "right" : "wrong", textContent: `${isRight ? "\u2713" : "\u2717"} ${verdict}: ${answers}` }),
      element("p", { textContent: `${this.isReplay ? "It earns" : "You earn"} ${worth(judged.earned)}.` }),
      element("table", {}, moves(this.isReplay ? "replay" : "you", actions), ...others),
      mistakes,
      ...(next ? [next] : []),
    );
    this.result.hidden = false;
    this.experiments.hidden = this.answers.hidden = true;
    this.reveal();
    next?.focus({ preventScroll: true });
  }

  // Writes the mistakes in the moves, and what each cost, when they are found.
  async tellMistakes(written) {
    const { task } = this;
    written.textContent = "Judging the moves ...";
    try {
      const found = await this.judge(this.record());
      const { actions } = this.world;
      const row = ({ step, kind, meaning, cost }) =>
        element(
          "tr",
          {},
          element("td", { textContent: `${step + 1}. ${task.actions[actions[step]]}` }),
          element("td", {}, element("b", { textContent: kind }), `: ${meaning}`),
          element("td", { textContent: worth(-cost) }),
        );
      written.replaceChildren(
        element("h2", { textContent: found.length ? "Mistakes, and what each cost" : "No mistake: the ideal could do no better" }),
        element("table", {}, ...found.map(row)),
      );
    } catch (error) {
      const why = error.name === "TimeoutError" ? "it takes too long here" : error.message;
      written.textContent = `The moves are not judged: ${why}.`;
    }
  }

  // Writes what was hidden beside the things.
  reveal() {
    const { instance } = this.world;
    const pairs = [...instance.joined.map((pair) => [pair, "glued"]), ...instance.tied.map((pair) => [pair, "band"])];
    const marked = Object.entries(instance.marks).filter(([thing]) => this.scene.find(thing));
    const hidden = marked.map(([thing, text]) => ({ thing, above: 1, node: element("span", { className: "mark", textContent: text }) }));
    this.labels = [...this.labels.filter(({ thing }) => !marked.some(([each]) => each === thing)), ...hidden];
    this.marks.replaceChildren(...this.labels.map(({ node }) => node));
    this.draw();
    for (const [pair, text] of pairs) {
      const [a, b] = pair.map((thing) => this.scene.locate(thing));
      const node = element("span", { className: "mark", textContent: text });
      Object.assign(node.style, { left: `${50 * (a[0] + b[0])}%`, top: `${50 * (a[1] + b[1])}%` });
      this.marks.append(node);
    }
  }
}
