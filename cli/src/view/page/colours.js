// What colour a particle has: a place in a row of 256, of which the first is for what is not a number.

import { about } from "./rows.js";

const { none, words, sequential, diverging } = about.colours;

function channels(colour) {
  return [0, 2, 4].map((k) => parseInt(colour.slice(k, k + 2), 16));
}

// The colours of a column's steps.
function steps(column) {
  if (column.words) return words;
  return column.diverging ? diverging : sequential;
}

// All 256 as bytes: red, green, blue, opaque.
export function palette(column) {
  const all = new Uint8Array(4 * 256);
  const own = steps(column);
  for (let k = 0; k < 256; k += 1) {
    const colour = k === 0 ? none : own[(k - 1) % own.length];
    all.set([...channels(colour), 255], 4 * k);
  }
  return all;
}

// From where to where a column is coloured, unless somebody says otherwise.
export function range(column) {
  return column.diverging ?? column.range ?? [0, 1];
}

// The place of a word's colour; what has no name, as the fluid has no body's, is grey.
function placeOfWord(column, word) {
  return column.words[word] === "" ? 0 : 1 + (word % words.length);
}

export function colourOfWord(column, word) {
  const place = placeOfWord(column, word);
  return `#${place === 0 ? none : words[place - 1]}`;
}

export const colourOfNone = `#${none}`;

// Every row's place, written into `codes`; gives how many rows are not a number.
export function encode(column, [low, high], codes) {
  let missing = 0;
  if (column.words) {
    const places = column.words.map((_, word) => placeOfWord(column, word));
    for (let i = 0; i < codes.length; i += 1) codes[i] = places[column.number(i)];
    return missing;
  }
  const last = steps(column).length - 1;
  const factor = high > low ? last / (high - low) : 0;
  for (let i = 0; i < codes.length; i += 1) {
    const number = column.number(i);
    if (Number.isNaN(number)) {
      codes[i] = 0;
      missing += 1;
    } else {
      const step = factor === 0 ? last / 2 : (number - low) * factor;
      codes[i] = 1 + Math.round(Math.min(last, Math.max(0, step)));
    }
  }
  return missing;
}

// The bar of a legend, as CSS has it.
export function gradient(column) {
  const own = steps(column).filter((_, k) => k % 2 === 0);
  return `linear-gradient(to right, ${own.map((colour) => `#${colour}`).join(", ")})`;
}
