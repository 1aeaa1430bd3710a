// Over the particles: which way the axes go, how long a length is, and a ring around the particle that is looked at.

import { Vector3 } from "three";
import { about, position, short } from "./rows.js";
import { camera, canvas, diameters, onFrame, zoom } from "./stage.js";
import { picked } from "./pick.js";

const marks = document.getElementById("marks");

// Of the axes and of the length's bar, pixels.
const ARM = 34;
const LONGEST = 160;

function add(kind, attributes, text) {
  const mark = document.createElementNS("http://www.w3.org/2000/svg", kind);
  for (const [name, value] of Object.entries(attributes)) mark.setAttribute(name, value);
  if (text !== undefined) mark.textContent = text;
  marks.append(mark);
}

function line(x1, y1, x2, y2) {
  add("line", { x1, y1, x2, y2 });
}

// The largest of 1, 2 or 5 times a power of ten that is no more.
function roundBelow(length) {
  const unit = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].map((step) => step * unit).find((round) => round <= length * (1 + 1e-9)) ?? unit;
}

onFrame(() => {
  marks.replaceChildren();
  const [right, up, back] = [new Vector3(), new Vector3(), new Vector3()];
  camera.matrixWorld.extractBasis(right, up, back);
  const bottom = canvas.clientHeight - 56;
  const middle = [52, bottom];
  for (const [k, name] of ["x", "y", "z"].slice(0, about.dimension).entries()) {
    const way = [right.getComponent(k), -up.getComponent(k)];
    // An axis that is looked along has no length.
    if (Math.hypot(...way) < 0.05) continue;
    line(...middle, middle[0] + ARM * way[0], middle[1] + ARM * way[1]);
    const [x, y] = way.map((part, j) => middle[j] + (ARM + 11) * part);
    add("text", { x, y: y + 4, "text-anchor": "middle" }, name);
  }
  const length = roundBelow(LONGEST / zoom());
  const [left, y] = [120, canvas.clientHeight - 44];
  const end = left + length * zoom();
  line(left, y, end, y);
  line(left, y - 5, left, y + 5);
  line(end, y - 5, end, y + 5);
  add("text", { x: 0.5 * (left + end), y: y + 20, "text-anchor": "middle" }, short(length));
  if (picked.row >= 0) {
    const place = new Vector3().fromArray(position, 3 * picked.row).sub(camera.position);
    add("circle", {
      cx: 0.5 * canvas.clientWidth + place.dot(right) * zoom(),
      cy: 0.5 * canvas.clientHeight - place.dot(up) * zoom(),
      r: Math.max(6, 0.5 * diameters[picked.row] * zoom() + 2),
    });
  }
});
