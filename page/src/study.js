// The study: its steps are those of `study.json`, and all that a participant does is in the browser's storage at once.
import ButtonPlugin from "@jspsych/plugin-html-button-response";
import ChoicePlugin from "@jspsych/plugin-survey-multi-choice";
import { initJsPsych } from "jspsych";
import { element } from "./main.js";
import { PhysexpPlugin } from "./plugin.js";
import dataset from "./study_data.json";

export { ButtonPlugin, ChoicePlugin, PhysexpPlugin, initJsPsych };

const COLUMNS = dataset.variableMeasured.map(({ name }) => name);

const drawn = () => String(crypto.getRandomValues(new Uint32Array(1))[0]);
const root = () => document.getElementById("study");
const say = (html) => root().replaceChildren(element("div", { className: "text", innerHTML: html }));

// A participant in this browser: who it is, the number of steps that are done, and the episodes.
class Participant {
  constructor(numOrders, query = new URLSearchParams(location.search)) {
    const place = `physexp-study ${location.pathname}`;
    const given = query.get("participant") ?? query.get("PROLIFIC_PID");
    const id = given ?? localStorage.getItem(place) ?? drawn();
    if (!given) localStorage.setItem(place, id);
    this.place = `${place} ${query.get("STUDY_ID") ?? ""} ${id}`;
    this.kept = JSON.parse(localStorage.getItem(this.place)) ?? {
      participant: id,
      study: query.get("STUDY_ID") ?? "",
      session: query.get("SESSION_ID") ?? drawn(),
      order: Number(BigInt(`0${id.replace(/\D/g, "")}`) % BigInt(numOrders)),
      done: 0,
      sent: [],
      episodes: [],
    };
  }

  keep(changes) {
    Object.assign(this.kept, changes);
    localStorage.setItem(this.place, JSON.stringify(this.kept));
  }

  // Keeps an episode, whose step is done from its first action on: a page that is loaded again goes on with the next.
  add(step, episode) {
    const others = this.kept.episodes.filter(({ phase, trial }) => phase !== episode.phase || trial !== episode.trial);
    this.keep({ done: step + 1, episodes: [...others, episode] });
  }

  // Returns the names and the contents of the files.
  get files() {
    const { participant, session, episodes } = this.kept;
    const plain = (id) => id.replace(/[^A-Za-z0-9]/g, "") || "0";
    const name = `participant-${plain(participant)}_session-${plain(session)}`;
    const whole = episodes.filter(({ phase, over }) => phase === "trial" && over);
    const records = whole.map(({ task, seed, episode, actions, times }) => ({ player: participant, task, seed, episode, actions, times }));
    return { [`${name}_data.csv`]: this.table(), [`${name}_records.jsonl`]: records.map((record) => `${JSON.stringify(record)}\n`).join("") };
  }

  // Returns CSV with a row for each action.
  table() {
    const rows = this.kept.episodes.flatMap((episode) =>
      episode.actions.map((action, step) => {
        const each = { step, action, reward: episode.rewards[step], rt_ms: episode.times[step], time_ms: episode.clock[step] };
        const row = { ...this.kept, ...episode, ...each, interrupted: Number(!episode.over) };
        return COLUMNS.map((name) => quoted(row[name]));
      }),
    );
    return [COLUMNS, ...rows].map((row) => `${row.join(",")}\n`).join("");
  }
}

const quoted = (value) => (/[",\n]/.test(value) ? `"${String(value).replaceAll('"', '""')}"` : value);

// Returns the steps, each of which is a timeline of jsPsych.
function steps(study, participant, jsPsych) {
  const text = (html) => ({ type: ButtonPlugin, stimulus: `<div class="text">${html}</div>`, choices: ["Continue"] });
  const agree = ({ response }) => {
    participant.declined = response === 1;
    if (participant.declined) jsPsych.abortExperiment(`<div class="text">${study.declined}</div>`);
  };
  const questions = study.quiz.map(({ prompt, options }) => ({ prompt, options, required: true }));
  let failed = false;
  const judge = ({ response }) => (failed = study.quiz.some(({ answer }, k) => response[`Q${k}`] !== answer));
  const retry = { timeline: [text(study.retry)], conditional_function: () => failed };
  const quiz = { type: ChoicePlugin, questions, on_finish: judge };
  const played = (phase, feedback) => ([task, episode], trial) => ({ type: PhysexpPlugin, task, episode, feedback, data: { phase, trial } });
  const all = [
    { ...text(study.consent), choices: ["I agree", "I do not agree"], on_finish: agree },
    { timeline: [retry, text(study.introduction), quiz], loop_function: () => failed },
    ...study.practice.map(played("practice", true)),
    text(study.begin),
    ...study.orders[participant.kept.order].map(played("trial", study.feedback)),
  ];
  return all.map((step, index) => ({
    timeline: [{ ...step, on_action: (episode) => participant.add(index, { ...episode, ...step.data }) }],
    on_timeline_finish: () => participant.declined || participant.keep({ done: index + 1 }),
  }));
}

// Sends the files that DataPipe does not have yet; returns whether it has all.
async function send({ address, experiment }, participant) {
  for (const [filename, data] of Object.entries(participant.files)) {
    const { sent } = participant.kept;
    if (!experiment || sent.includes(filename)) continue;
    const body = JSON.stringify({ experimentID: experiment, filename, data });
    const headers = { "Content-Type": "application/json" };
    const response = await fetch(address, { method: "POST", headers, body }).catch(() => null); // Without a network.
    if (response?.ok) participant.keep({ sent: [...sent, filename] });
  }
  return Object.keys(participant.files).every((name) => participant.kept.sent.includes(name));
}

async function finish(study, participant) {
  const isSent = await send(study.datapipe, participant);
  say(`${study.debriefing}<p>${isSent ? study.sent : study.kept}</p>`);
  const save = ([name, content]) => {
    const href = URL.createObjectURL(new Blob([content]));
    return element("a", { href, download: name, textContent: `Save ${name}` });
  };
  const links = isSent ? [] : Object.entries(participant.files).map(save);
  const completion = study.completion ? [element("a", { href: study.completion, textContent: "Finish" })] : [];
  root().firstChild.append(...[...links, ...completion].map((link) => element("p", {}, link)));
}

async function run() {
  const study = await (await fetch("study.json")).json();
  const { place } = new Participant(study.orders.length);
  say(study.elsewhere);
  // One tab has the lock; the next one goes on from what it has kept.
  await navigator.locks.request(place, async () => {
    say("Loading ...");
    const participant = new Participant(study.orders.length);
    const jsPsych = initJsPsych({ display_element: "study" });
    const all = steps(study, participant, jsPsych);
    if (participant.kept.done < all.length) {
      await PhysexpPlugin.load([...new Set([...study.practice, ...study.orders[0]].map(([task]) => task))]);
      root().replaceChildren();
      await jsPsych.run(all.slice(participant.kept.done));
    }
    if (!participant.declined) await finish(study, participant);
    await new Promise(() => {}); // Keeps the lock until the tab is closed.
  });
}

if (globalThis.document?.getElementById("study"))
  run().catch((error) => {
    say(`<p>This study cannot be shown: ${error.message}</p>`);
    throw error;
  });
