// Shows the particles, and says when they are there.

import { about } from "./rows.js";
import { finish, onFrame } from "./stage.js";
import "./axes.js";
import { build } from "./panel.js";

build();

onFrame(() => {
  const page = document.documentElement;
  if (page.dataset.ready) return;
  finish();
  page.dataset.ready = String(about.rows);
  page.dataset.seconds = (performance.now() / 1000).toFixed(2);
});
