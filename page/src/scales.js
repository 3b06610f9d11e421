// Marks beside things that move along the floor as readings tell: their place for each value.

const MOST_NUMBERS = 8;
const MOST_MARKS = 200;
const [FAR, NEAR] = [0.012, 0.035]; // m, from a thing to the ends of a mark, towards the viewer.
const HEIGHT = 0.004; // m, above the floor.

// The distance between numbers: 1, 2 or 5 times a power of 10.
function spacing(range) {
  const power = 10 ** Math.floor(Math.log10(range / MOST_NUMBERS));
  const found = power * [1, 2, 5, 10].find((much) => range / (much * power) <= MOST_NUMBERS);
  return range < 2 ? found : Math.max(1, found);
}

const multiples = ([low, high], step) => {
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, k) => (first + k) * step);
};

// Returns the scale of each reading that is one number and moves a thing along x: lines, m, and numbers at places.
export function scales(task, world) {
  const { structure, model } = world;
  return structure.indicators.flatMap(([geom, name, , travel], k) => {
    const { names, components, limits } = task.readings[name];
    const isAlong = travel[0] && !travel[1] && !travel[2] && !task.sizes[k];
    if (!isAlong || !limits || names.length * components.length > 1) return [];
    const [x, y] = structure.start.geom_xpos.slice(3 * geom, 3 * geom + 2);
    const [start] = world.read(name, structure.start.sensordata);
    const front = y - model.geom_size[3 * geom + 1];
    const at = (value, off) => [x + travel[0] * (value - start), front - off, HEIGHT];
    const [[low, high]] = limits;
    const step = spacing(high - low);
    const numbered = multiples(limits[0], step);
    const between = step > 1 && high - low <= MOST_MARKS ? multiples(limits[0], 1) : [];
    const mark = (value, length) => [at(value, FAR), at(value, FAR + length * (NEAR - FAR))];
    return {
      name,
      thing: structure.things[geom],
      lines: [at(low, FAR), at(high, FAR), ...numbered.flatMap((value) => mark(value, 1)), ...between.flatMap((value) => mark(value, 0.5))],
      numbers: numbered.map((value) => ({ value, at: at(value, 2 * NEAR) })),
    };
  });
}
