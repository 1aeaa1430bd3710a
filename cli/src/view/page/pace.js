// How many particles are drawn while they move, so that slow graphics keep up: a part of them, evenly spread.

// A frame should take no longer, milliseconds.
const FRAME = 40;

// No fewer than this part.
const LEAST = 0.01;

let whole = 0;

export const pace = {
  // Whether frames are slow enough to be watched: waiting for one takes time.
  isAsked: () => whole === 0 || whole > 0.5 * FRAME,
  // A frame of this share of the particles has taken so long.
  took: (milliseconds, share) => { whole = milliseconds / share; },
  share: () => Math.min(1, Math.max(LEAST, FRAME / Math.max(whole, 1))),
};

function divisor(a, b) {
  return b === 0 ? a : divisor(b, a % b);
}

// All rows in such an order that any first part of them is spread over all: steps of the golden section around a ring.
export function spread(count) {
  let step = Math.max(1, Math.round(count * 0.6180339887));
  while (divisor(count, step) !== 1) step += 1;
  return Uint32Array.from({ length: count }, (_, i) => (i * step) % count);
}
