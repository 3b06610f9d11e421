// A plugin of jsPsych 8: a trial is an episode of a task of the page.
import { ParameterType } from "jspsych";
import { Player, element, judge, start, taskOf } from "./main.js";

const MOST_EXPERIMENTS = 3; // Of a simulated participant.
const REACTION = 400; // ms, likewise.

const loaded = {};
let mujoco;

const placeOf = (task, episode) => task.instances.findIndex((each) => each.episode === episode);

const info = {
  name: "physexp",
  version: "0.1.0",
  parameters: {
    task: { type: ParameterType.STRING, default: undefined }, // The name of its file beside the page, without `.json`.
    episode: { type: ParameterType.INT, default: undefined }, // The number of an episode in that file.
    feedback: { type: ParameterType.BOOL, default: true }, // Tell the answer, and the moves of others.
    on_action: { type: ParameterType.FUNCTION, default: () => {} }, // It gets the data so far after each action.
  },
  data: {
    task: { type: ParameterType.STRING },
    seed: { type: ParameterType.INT },
    episode: { type: ParameterType.INT },
    actions: { type: ParameterType.INT, array: true },
    rewards: { type: ParameterType.INT, array: true },
    times: { type: ParameterType.INT, array: true }, // ms, from the moment in which the page waits to the action.
    clock: { type: ParameterType.INT, array: true }, // ms, from the beginning of the trial to the action.
    hidden: { type: ParameterType.INT }, // How often the page was hidden, as by another tab.
    over: { type: ParameterType.BOOL },
  },
};

class Trial extends Player {
  constructor(root, task, { feedback, on_action, finish }) {
    super(root, mujoco, task, { next: () => finish(this.record()) });
    Object.assign(this, { feedback, on_action, finish, clock: [], hidden: 0, begunAt: performance.now() });
    this.count = () => (this.hidden += document.hidden);
    document.addEventListener("visibilitychange", this.count);
  }

  async act(action) {
    if (this.isBusy || this.isOver) return;
    this.clock.push(Math.round(performance.now() - this.begunAt));
    const shown = super.act(action);
    this.on_action(this.record());
    await shown;
  }

  async end() {
    if (this.feedback) await (this.ended = super.end());
    else this.finish(this.record());
  }

  record() {
    const { judged } = this.world;
    return { ...super.record(), rewards: judged.rewards, clock: [...this.clock], hidden: this.hidden, over: judged.over };
  }

  async close() {
    document.removeEventListener("visibilitychange", this.count);
    super.close();
    await this.ended; // A film after the answer needs the physics.
    this.scene.renderer.forceContextLoss(); // A browser has few contexts.
    for (const part of [this.world.drawn, this.world.data, this.world.model]) part.delete();
  }
}

export class PhysexpPlugin {
  static info = info;

  // Loads the physics and tasks, so that no trial waits for the network.
  static async load(files) {
    mujoco ??= await start();
    await Promise.all(files.map(async (file) => (loaded[file] ??= await taskOf(file))));
  }

  constructor(jsPsych) {
    this.jsPsych = jsPsych;
  }

  async trial(display, trial, onLoad) {
    await PhysexpPlugin.load([trial.task]);
    const root = element("div", { className: "physexp" });
    display.replaceChildren(root);
    return new Promise((resolve) => {
      const finish = (data) => {
        this.player.close();
        this.jsPsych.finishTrial(data);
        resolve();
      };
      this.player = new Trial(root, loaded[trial.task], { ...trial, finish });
      this.player.begin(placeOf(loaded[trial.task], trial.episode));
      onLoad();
    });
  }

  async simulate(trial, mode, options, onLoad) {
    await PhysexpPlugin.load([trial.task]);
    const data = this.jsPsych.pluginAPI.mergeSimulationData(this.simulated(trial), options);
    if (mode === "data-only") {
      onLoad();
      return this.jsPsych.finishTrial(data);
    }
    let finished;
    await new Promise((loaded) => {
      finished = this.trial(this.jsPsych.getDisplayElement(), trial, loaded);
    });
    onLoad();
    for (const [k, action] of data.actions.entries()) {
      await new Promise((resolve) => setTimeout(resolve, data.times[k]));
      await this.player.act(action);
    }
    if (trial.feedback) this.player.next();
    return finished;
  }

  // Returns the data of a participant who experiments a little and guesses.
  simulated({ task: file, episode }) {
    const task = loaded[file];
    const { randomInt } = this.jsPsych.randomization;
    const count = task.interactions.length;
    const experiments = randomInt(0, Math.min(MOST_EXPERIMENTS, task.step_limit - task.num_questions));
    const actions = [
      ...Array.from({ length: experiments }, () => randomInt(0, count - 1)),
      ...Array.from({ length: task.num_questions }, () => randomInt(count, task.actions.length - 1)),
    ];
    const { rewards, over } = judge(task, task.instances[placeOf(task, episode)], actions);
    const times = actions.map(() => REACTION);
    const clock = times.map((time, k) => (k + 1) * time);
    return { task: task.name, seed: task.seed, episode, actions, rewards, times, clock, hidden: 0, over };
  }
}
