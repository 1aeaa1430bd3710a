// Which part of space is shown: all that lies between two planes across an axis.

import { about } from "./rows.js";

export const cut = {
  how: "whole",
  axis: 2,
  // Along the axis, in the file's lengths.
  at: about.middle[2],
  thickness: about.spacing,

  // From the middle of the box.
  get between() {
    const at = this.at - about.middle[this.axis];
    switch (this.how) {
      case "slice":
        return [at - 0.5 * this.thickness, at + 0.5 * this.thickness];
      case "below":
        return [-1e30, at];
      case "above":
        return [at, 1e30];
      default:
        return [-1e30, 1e30];
    }
  },
};
