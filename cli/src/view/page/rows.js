// The particles, as the page holds them.

export const about = JSON.parse(document.getElementById("about").textContent);

const ARRAYS = {
  u8: Uint8Array,
  u16: Uint16Array,
  u32: Uint32Array,
  f32: Float32Array,
  f64: Float64Array,
};

// The bytes of an element; little-endian, as is every machine that has a browser.
function array(id, store) {
  const letters = document.getElementById(id).textContent;
  let bytes;
  if (Uint8Array.fromBase64) {
    bytes = Uint8Array.fromBase64(letters);
  } else {
    const raw = atob(letters);
    bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i += 1) bytes[i] = raw.charCodeAt(i);
  }
  return new ARRAYS[store](bytes.buffer);
}

// A column; its rows are decoded when they are first asked for.
class Column {
  constructor(told, id) {
    this.name = told.name;
    this.words = told.words ?? null;
    this.range = told.range;
    this.diverging = told.diverging ?? null;
    // What is not a number is null there.
    this.table = told.table?.map((number) => number ?? NaN);
    this.store = told.store;
    this.id = id;
  }

  get rows() {
    this.decoded ??= this.store === "none" ? null : array(this.id, this.store);
    return this.decoded;
  }

  // The number of a row; of words, the place among them.
  number(i) {
    const rows = this.rows;
    const entry = rows === null ? 0 : rows[i];
    return this.table ? this.table[entry] : entry;
  }

  text(i) {
    const number = this.number(i);
    return this.words ? this.words[number] : short(number, this.store === "f32" ? 7 : 12);
  }
}

// Relative to the middle of the box: x, y, z of every row.
export const position = (() => {
  const stored = array("position", "f32");
  if (about.dimension === 3) return stored;
  const all = new Float32Array(3 * about.rows);
  for (let i = 0; i < about.rows; i += 1) {
    all[3 * i] = stored[2 * i];
    all[3 * i + 1] = stored[2 * i + 1];
  }
  return all;
})();

export const diameter = new Column(about.diameter, "diameter");

const coordinates = ["x", "y", "z"].slice(0, about.dimension).map((name, k) => ({
  name,
  words: null,
  range: [about.min[k], about.max[k]],
  diverging: null,
  number: (i) => about.middle[k] + position[3 * i + k],
  text: (i) => {
    // As many digits as are known.
    const finest = (about.max[k] - about.min[k]) * 1e-7;
    const number = about.middle[k] + position[3 * i + k];
    const places = finest > 0 ? Math.min(20, Math.max(0, -Math.floor(Math.log10(finest)) - 1)) : 6;
    return String(Number(number.toFixed(places)));
  },
}));

export const columns = [
  ...coordinates,
  ...about.columns.map((told, number) => new Column(told, `column-${number}`)),
];

// A number in so many digits.
export function short(number, digits = 6) {
  if (!Number.isFinite(number)) return String(number);
  const rounded = Number(number.toPrecision(digits));
  const size = Math.abs(rounded);
  return size > 0 && (size < 1e-3 || size >= 1e9) ? rounded.toExponential() : String(rounded);
}

// A whole number with its thousands set apart.
export function grouped(number) {
  return String(number).replace(/\B(?=(\d{3})+$)/g, ",");
}
