// Draws what was seen as curves: a value by the number of moves.

const [WIDTH, HEIGHT] = [200, 92];
const BOX = { left: 34, right: 56, top: 8, bottom: 16 };
const COLORS = ["#2f5d8a", "#b4432f", "#2f7d4f", "#8a6a1f", "#6b4a86", "#40535e"];
const GAP = 11; // Between the names of curves.

const node = (tag, attributes, text = "") => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
};

// Returns the readings of few curves that have had other values than yes and no, or either side.
export function plotted(task, seen) {
  return Object.keys(task.readings).filter((name) => {
    const { names, components } = task.readings[name];
    const isGraded = seen.some((each) => each[name].some((value) => ![-1, 0, 1].includes(value)));
    return seen.length > 1 && isGraded && names.length * components.length <= COLORS.length;
  });
}

// Moves places apart that are closer than a gap, and returns them in their order.
function apart(places) {
  const order = [...places.keys()].sort((a, b) => places[a] - places[b]);
  const found = [...places];
  order.forEach((place, k) => {
    if (k) found[place] = Math.max(found[place], found[order[k - 1]] + GAP);
  });
  const excess = Math.max(0, found[order.at(-1)] - (HEIGHT - BOX.bottom));
  return found.map((place) => place - excess);
}

// Returns a picture of a reading, whose values are a row for each moment.
export function plot(title, { names, components, unit }, rows, text) {
  const values = rows.flat();
  const [low, high] = [Math.min(0, ...values), Math.max(0, ...values)];
  const across = (step) => BOX.left + (step / Math.max(1, rows.length - 1)) * (WIDTH - BOX.left - BOX.right);
  const up = (value) => HEIGHT - BOX.bottom - ((value - low) / (high - low)) * (HEIGHT - BOX.top - BOX.bottom);
  const made = node("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "plot", role: "img", "aria-label": `${title} by move` });
  const ends = [WIDTH - BOX.right, BOX.left];
  for (const value of new Set([low, 0, high])) {
    made.append(node("line", { x1: ends[0], x2: ends[1], y1: up(value), y2: up(value) }));
    made.append(node("text", { x: BOX.left - 4, y: up(value) + 3, "text-anchor": "end" }, text(value)));
  }
  made.append(node("text", { x: across(0), y: HEIGHT - 4 }, "0"));
  made.append(node("text", { x: across(rows.length - 1), y: HEIGHT - 4, "text-anchor": "end" }, `move ${rows.length - 1}`));
  const curves = names.flatMap((name) => components.map((component) => `${name} ${component}`.trim()));
  const heights = apart(curves.map((_, k) => up(rows.at(-1)[k])));
  curves.forEach((name, k) => {
    const points = rows.map((row, step) => `${across(step)},${up(row[k])}`).join(" ");
    made.append(node("polyline", { points, stroke: COLORS[k], fill: "none" }));
    rows.forEach((row, step) => made.append(node("circle", { cx: across(step), cy: up(row[k]), r: 2, fill: COLORS[k] })));
    if (curves.length > 1) made.append(node("text", { x: ends[0] + 4, y: heights[k] + 3, fill: COLORS[k] }, name));
  });
  return made;
}
