// Episodes of a task that Python exported, in MuJoCo's WebAssembly build.
import { evaluate } from "./rules.js";

// Returns the rewards, whether the episode is over, and what was earned, after some actions in an instance.
export function judge(task, instance, actions) {
  let [answered, earned, over] = [0, 0, false];
  const rewards = actions.map((action, step) => {
    const label = action - task.interactions.length;
    const right = label === instance.answers[answered];
    if (label >= 0) answered += 1;
    const left = task.num_questions - answered;
    over = left === 0 || step + 1 >= task.step_limit;
    const reward = (label < 0 ? 0 : right ? 1 : -1) - (over ? left : 0);
    earned += reward * task.discount ** step;
    return reward;
  });
  return { rewards, over, earned, answered };
}

export class World {
  constructor(mujoco, task) {
    Object.assign(this, { mujoco, task, compiled: null });
  }

  // Compiles a structure, and frees the one before: JavaScript does not collect the memory of MuJoCo.
  compile(name) {
    if (this.compiled !== name) {
      for (const part of [this.drawn, this.data, this.model]) part?.delete();
      this.model = this.mujoco.MjModel.from_xml_string(this.task.structures[name].xml);
      this.data = new this.mujoco.MjData(this.model);
      this.drawn = new this.mujoco.MjData(this.model);
      this.compiled = name;
    }
  }

  reset(place) {
    const instance = this.task.instances[place];
    const structure = this.task.structures[instance.structure];
    Object.assign(this, { place, instance, structure });
    this.compile(instance.structure);
    for (const [field, addresses, values] of instance.fields) {
      const array = this.model[field];
      addresses.forEach((address, i) => (array[address] = values[i]));
    }
    this.start = instance.start ?? structure.start;
    this.mujoco.mj_resetData(this.model, this.data);
    this.data.qpos.set(this.start.qpos);
    this.touched = structure.held.map(() => false);
    this.actions = [];
    this.judged = judge(this.task, instance, []);
    this.measured = this.start.sensordata.slice();
    return (this.observation = this.look());
  }

  step(action) {
    const isAnswer = action >= this.task.interactions.length;
    this.actions.push(action);
    if (!isAnswer) this.interact(action);
    this.judged = judge(this.task, this.instance, this.actions);
    if (!isAnswer || !this.judged.over) this.observation = this.look();
    return this.observation;
  }

  interact(action) {
    const { mujoco, model, data, task, instance } = this;
    const given = { actions: [action], qpos: Array.from(data.qpos), ctrl: Array.from(data.ctrl), controls: task.controls };
    const strength = instance.strength;
    evaluate(task.drive, given).forEach((value, i) => {
      data.ctrl[i] = value * (strength.length === 1 ? strength[0] : strength[i]);
    });
    for (let k = 0; k < instance.substeps; k++) mujoco.mj_step(model, data);
    mujoco.mj_fwdPosition(model, data);
    mujoco.mj_sensorPos(model, data);
    this.measured = Array.from(data.sensordata);
    this.structure.held.forEach((held, k) => {
      const moved = (address) => Math.abs(data.qpos[address] - this.start.qpos[address]) > task.tolerance;
      if (held.qpos.some(moved)) this.touched[k] = true;
      if (!this.touched[k]) for (const i of held.sensordata) this.measured[i] = this.start.sensordata[i];
    });
  }

  // Returns the readings, Float32Arrays by name.
  look() {
    const { task, instance, structure, actions } = this;
    const asked = Math.min(this.judged.answered, task.num_questions - 1);
    structure.told.forEach((address, i) => (this.measured[address] = instance.told[asked][actions.length][i]));
    const noise = instance.noise?.[actions.length] ?? {};
    return Object.fromEntries(
      Object.keys(task.readings).map((name) => {
        const values = Float32Array.from(this.read(name, this.measured));
        noise[name]?.forEach((value, i) => (values[i] += value));
        return [name, values];
      }),
    );
  }

  read(name, sensordata) {
    const sensors = this.structure.addresses[name].map((address) => sensordata[address]);
    const { measure } = this.task.readings[name];
    return measure ? evaluate(measure, { sensors }) : sensors;
  }

  // Returns where readings place things, and nothing that they do not tell: what is drawn before the answer.
  placed(readings) {
    const { mujoco, model, drawn, structure, task } = this;
    drawn.qpos.set(model.qpos0);
    for (const [address, name, column] of structure.joints) drawn.qpos[address] = readings[name][column];
    mujoco.mj_kinematics(model, drawn);
    const pose = poses(drawn);
    const start = structure.start;
    const moved = (name, column) => readings[name][column] - this.read(name, start.sensordata)[column];
    for (const [geom, name, columns] of structure.displaced)
      columns.forEach((column, i) => (pose.positions[3 * geom + i] = start.geom_xpos[3 * geom + i] + moved(name, column)));
    structure.indicators.forEach(([geom, name, column, travel], k) => {
      travel.forEach((much, i) => {
        pose.positions[3 * geom + i] = start.geom_xpos[3 * geom + i] + much * moved(name, column);
      });
      if (task.sizes[k]) pose.sizes[geom] = evaluate(task.sizes[k], { value: [readings[name][column]] });
    });
    structure.staged.forEach((geom, k) => {
      const [rise, lean] = task.moves[k];
      if (rise) pose.positions[3 * geom + 2] += evaluate(rise, readings)[0];
      if (lean) pose.rotations.splice(9 * geom, 9, ...leaned(pose.rotations.slice(9 * geom, 9 * geom + 9), evaluate(lean, readings)[0]));
    });
    return pose;
  }

  // Returns where things are; readings place the indicators that no joint moves.
  truth(qpos = null) {
    const { mujoco, model, data, drawn, structure } = this;
    const shown = this.placed(this.observation);
    if (qpos) drawn.qpos.set(qpos);
    else drawn.qpos.set(data.qpos);
    mujoco.mj_kinematics(model, drawn);
    const pose = { ...poses(drawn), sizes: shown.sizes };
    const keep = (field, geom, width) => {
      for (let i = width * geom; i < width * (geom + 1); i++) pose[field][i] = shown[field][i];
    };
    for (const [geom] of structure.indicators) if (!this.isSimulated(geom)) keep("positions", geom, 3);
    for (const geom of structure.staged) {
      keep("positions", geom, 3);
      keep("rotations", geom, 9);
    }
    return pose;
  }

  isSimulated(geom) {
    return this.model.body_weldid[this.model.geom_bodyid[geom]] !== 0;
  }
}

// Returns a rotation that is followed by one about the y axis, rad.
const leaned = (m, angle) => {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const row = (a, b, k) => [0, 1, 2].map((column) => a * m[column] + b * m[6 + column] + k * m[3 + column]);
  return [...row(c, s, 0), ...row(0, 0, 1), ...row(-s, c, 0)];
};

// Views into MuJoCo's memory must be copied.
const poses = (data) => ({ positions: Array.from(data.geom_xpos), rotations: Array.from(data.geom_xmat), sizes: {} });
