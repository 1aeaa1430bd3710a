// Which particle is under the pointer.

import { Vector3 } from "three";
import { about, position } from "./rows.js";
import { cut } from "./cut.js";
import { camera, canvas, controls, diameters, redraw, shown, zoom } from "./stage.js";

// Small ones are hit from this far, pixels.
const NEAR = 4;

// The row of the foremost particle at a place of the canvas, pixels from its left and top; -1 where there is none.
function pick(x, y) {
  const [right, up, back] = [new Vector3(), new Vector3(), new Vector3()];
  camera.matrixWorld.extractBasis(right, up, back);
  const perPixel = 1 / zoom();
  const u = camera.position.dot(right) + (x - 0.5 * canvas.clientWidth) * perPixel;
  const v = camera.position.dot(up) + (0.5 * canvas.clientHeight - y) * perPixel;
  const [low, high] = cut.between;
  let found = -1;
  let foremost = -Infinity;
  for (let i = 0; i < about.rows; i += 1) {
    if (shown[i] === 0) continue;
    const [a, b, c] = [position[3 * i], position[3 * i + 1], position[3 * i + 2]];
    const along = position[3 * i + cut.axis];
    if (along < low || along > high) continue;
    const du = a * right.x + b * right.y + c * right.z - u;
    const dv = a * up.x + b * up.y + c * up.z - v;
    const reach = Math.max(0.5 * diameters[i], NEAR * perPixel);
    const away = du * du + dv * dv;
    if (away > reach * reach) continue;
    // In the plane the nearest, in space the foremost.
    const depth = about.dimension === 2 ? -away : a * back.x + b * back.y + c * back.z;
    if (depth > foremost) {
      foremost = depth;
      found = i;
    }
  }
  return found;
}

// The row that is looked at, and whether it stays when the pointer moves on.
export const picked = { row: -1, isHeld: false };

// Tells `tell` whenever another particle is looked at.
export function watchPointer(tell) {
  let waiting = null;
  let isDragged = false;
  let begin = null;
  const set = (row) => {
    if (row === picked.row) return;
    picked.row = row;
    tell(row);
    redraw();
  };
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  controls.addEventListener("start", () => { isDragged = true; });
  controls.addEventListener("end", () => { isDragged = false; });
  canvas.addEventListener("pointermove", (event) => {
    if (picked.isHeld || isDragged || event.pointerType === "touch") return;
    if (waiting === null) requestAnimationFrame(() => {
      const place = waiting;
      waiting = null;
      if (!picked.isHeld && !isDragged) set(pick(...place));
    });
    waiting = at(event);
  });
  canvas.addEventListener("pointerleave", () => {
    if (!picked.isHeld) set(-1);
  });
  canvas.addEventListener("pointerdown", (event) => { begin = at(event); });
  canvas.addEventListener("pointerup", (event) => {
    const end = at(event);
    if (begin === null || Math.hypot(end[0] - begin[0], end[1] - begin[1]) > NEAR) return;
    const row = pick(...end);
    picked.isHeld = row >= 0 && !(picked.isHeld && row === picked.row);
    set(row);
    redraw();
  });
}
