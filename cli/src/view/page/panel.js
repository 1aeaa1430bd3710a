// Beside the particles: what they are coloured by, which of them are shown, and the row of the one that is looked at.

import { about, columns, grouped, short } from "./rows.js";
import { colourOfNone, colourOfWord, encode, gradient, palette, range } from "./colours.js";
import { codes, lookAlong, recolour, redrawMoving, reset, reshow, shown } from "./stage.js";
import { cut } from "./cut.js";
import { watchPointer } from "./pick.js";

// Lists of more words than these are of no use.
const MOST_WORDS = 500;

// Of the legend's numbers; they are exact until they are changed.
const DIGITS = 5;

const by = (id) => document.getElementById(id);

// Of a column without a name; the fluid has no body.
const named = (word) => (word === "" ? "(none)" : word);

function make(kind, parts = {}, ...children) {
  const element = Object.assign(document.createElement(kind), parts);
  element.append(...children);
  return element;
}

let column = columns.find(({ name }) => name === about.colour) ?? columns[0];
let ends = range(column);

function colour() {
  const missing = encode(column, ends, codes);
  recolour(palette(column));
  by("scale").hidden = column.words !== null;
  by("bar").style.background = gradient(column);
  by("low").value = short(ends[0], DIGITS);
  by("high").value = short(ends[1], DIGITS);
  by("between").textContent = short(0.5 * (ends[0] + ends[1]), DIGITS);
  by("none").hidden = missing === 0;
  by("none").firstElementChild.style.background = colourOfNone;
  for (const swatch of document.querySelectorAll("#lists i")) {
    swatch.hidden = swatch.dataset.column !== column.name;
  }
}

function colours() {
  by("column").append(...columns.map(({ name }) => make("option", {}, name)));
  by("column").value = column.name;
  by("column").addEventListener("change", () => {
    column = columns[by("column").selectedIndex];
    ends = range(column);
    colour();
  });
  for (const [k, id] of ["low", "high"].entries()) {
    by(id).addEventListener("change", () => {
      const number = Number(by(id).value);
      const all = range(column);
      // Emptied, it is as at first.
      const end = by(id).value.trim() === "" || !Number.isFinite(number) ? all[k] : number;
      ends = k === 0 ? [end, ends[1]] : [ends[0], end];
      if (ends[0] > ends[1]) ends = all;
      colour();
    });
  }
  colour();
}

// The words of each column that are not shown.
const left = new Map();

function show() {
  const lists = [...left].filter(([, words]) => words.size > 0);
  const isHidden = lists.map(([{ words }, hidden]) => words.map((_, word) => hidden.has(word)));
  let count = 0;
  for (let i = 0; i < about.rows; i += 1) {
    shown[i] = lists.some(([own], k) => isHidden[k][own.number(i)]) ? 0 : 1;
    count += shown[i];
  }
  by("count").textContent = count === about.rows
    ? `${grouped(about.rows)} particles`
    : `${grouped(count)} of ${grouped(about.rows)} particles`;
  reshow();
}

function list(own) {
  const counts = new Array(own.words.length).fill(0);
  for (let i = 0; i < about.rows; i += 1) counts[own.number(i)] += 1;
  const hidden = new Set();
  left.set(own, hidden);
  const entries = own.words.flatMap((word, place) => {
    if (counts[place] === 0) return [];
    // In space a body is what one wants to see first, and the fluid is around it.
    const isFluid = about.dimension === 3 && own.name === "side" && word === "fluid" && counts[own.words.indexOf("solid")] > 0;
    if (isFluid) hidden.add(place);
    const box = make("input", { type: "checkbox", checked: !isFluid });
    box.addEventListener("change", () => {
      if (box.checked) hidden.delete(place);
      else hidden.add(place);
      show();
    });
    const swatch = make("i");
    swatch.style.background = colourOfWord(own, place);
    swatch.dataset.column = own.name;
    const count = make("small", {}, grouped(counts[place]));
    return [make("label", {}, box, swatch, make("span", {}, named(word)), count)];
  });
  by("lists").append(make("fieldset", {}, make("legend", {}, own.name), make("div", {}, ...entries)));
}

function cuts() {
  by("cut").hidden = about.dimension !== 3;
  by("axis").value = "xyz"[cut.axis];
  const write = () => {
    const [low, high] = [about.min[cut.axis], about.max[cut.axis]];
    by("where").hidden = cut.how === "whole";
    by("thick").hidden = cut.how !== "slice";
    by("at").value = short(cut.at);
    by("slide").value = high > low ? (cut.at - low) / (high - low) : 0.5;
    by("thickness").value = short(cut.thickness);
    redrawMoving();
  };
  by("how").addEventListener("change", () => {
    cut.how = by("how").value;
    write();
  });
  by("axis").addEventListener("change", () => {
    cut.axis = by("axis").selectedIndex;
    cut.at = about.middle[cut.axis];
    write();
  });
  by("slide").addEventListener("input", () => {
    const [low, high] = [about.min[cut.axis], about.max[cut.axis]];
    cut.at = low + Number(by("slide").value) * (high - low);
    write();
  });
  for (const [id, isWrong] of [["at", () => false], ["thickness", (number) => number <= 0]]) {
    by(id).addEventListener("change", () => {
      const number = Number(by(id).value);
      if (by(id).value.trim() !== "" && Number.isFinite(number) && !isWrong(number)) cut[id] = number;
      write();
    });
  }
  write();
}

function tell(row) {
  const table = document.querySelector("#particle table");
  by("hint").hidden = row >= 0;
  table.replaceChildren(...(row < 0 ? [] : columns).map((own) => make(
    "tr",
    {},
    make("th", {}, own.name),
    make("td", {}, own.words ? named(own.text(row)) : own.text(row)),
  )));
}

export function build() {
  document.querySelector("h1").textContent = about.name;
  by("hint").textContent = "Point at a particle for its row; click to keep it.";
  colours();
  for (const own of columns) {
    if (own.words && own.words.length <= MOST_WORDS) list(own);
  }
  colour();
  show();
  reset();
  cuts();
  by("reset").addEventListener("click", reset);
  by("along").hidden = about.dimension !== 3;
  for (const button of by("along").children) {
    button.addEventListener("click", () => lookAlong(Number(button.dataset.axis)));
  }
  document.addEventListener("keydown", (event) => {
    if (event.key === "r" && event.target.tagName !== "INPUT") reset();
  });
  watchPointer(tell);
}
