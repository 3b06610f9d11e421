// Evaluates rules that Python traced. Values are flat arrays: the axis of environments, of length 1, is left out.

// Integers of 64 bits are BigInts, and wrap around.
const wrapped = (x) => (typeof x === "bigint" ? BigInt.asUintN(64, x) : x);

const each = (f) => (...xs) => {
  const size = Math.max(...xs.map((x) => x.length));
  return Array.from({ length: size }, (_, i) => wrapped(f(...xs.map((x) => (x.length === 1 ? x[0] : x[i])))));
};

// Half to even, as NumPy rounds.
const rint = (x) => {
  const nearest = Math.round(x);
  return Math.abs(x % 1) === 0.5 && nearest % 2 !== 0 ? nearest - 1 : nearest;
};

const OPERATIONS = {
  absolute: each(Math.abs),
  add: each((a, b) => a + b),
  any: (x) => [+x.some(Boolean)],
  bitwise_and: each((a, b) => a & b),
  bitwise_or: each((a, b) => a | b),
  bitwise_xor: each((a, b) => a ^ b),
  clip: each((x, low, high) => Math.min(Math.max(x, low), high)),
  concatenate: (...xs) => xs.flat(),
  divide: each((a, b) => a / b),
  equal: each((a, b) => +(a === b)),
  floor: each(Math.floor),
  floor_divide: each((a, b) => Math.floor(a / b)),
  from_uint64: each(Number),
  greater: each((a, b) => +(a > b)),
  greater_equal: each((a, b) => +(a >= b)),
  left_shift: each((a, b) => a << b),
  less: each((a, b) => +(a < b)),
  less_equal: each((a, b) => +(a <= b)),
  max: (x) => [Math.max(...x)],
  maximum: each(Math.max),
  minimum: each(Math.min),
  multiply: each((a, b) => a * b),
  negative: each((x) => -x),
  not_equal: each((a, b) => +(a !== b)),
  right_shift: each((a, b) => a >> b),
  rint: each(rint),
  row: (table, [i]) => table[i],
  sign: each((x) => (x > 0) - (x < 0)),
  slice: (x, [first], [end]) => x.slice(first, end),
  sqrt: each(Math.sqrt),
  subtract: each((a, b) => a - b),
  sum: (x) => [x.reduce((a, b) => a + b, 0)],
  to_uint64: each(BigInt),
  trunc: each(Math.trunc),
  where: each((chosen, a, b) => (chosen ? a : b)),
};

export function evaluate(rule, given) {
  if (typeof rule === "number") return [rule];
  if (typeof rule === "string") return given[rule];
  const [name, ...parts] = rule;
  if (name === "uint64") return parts.map(BigInt);
  if (typeof name !== "string") return rule;
  return OPERATIONS[name](...parts.map((part) => evaluate(part, given)));
}
