// Where particles are drawn: one call for all of them, each a round disc of its true size.

import {
  BufferAttribute,
  BufferGeometry,
  BoxGeometry,
  Color,
  DataTexture,
  EdgesGeometry,
  LineBasicMaterial,
  LineSegments,
  MOUSE,
  NearestFilter,
  OrthographicCamera,
  Points,
  Scene,
  ShaderMaterial,
  TOUCH,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "OrbitControls";
import { about, diameter, position } from "./rows.js";
import { cut } from "./cut.js";
import { pace, spread } from "./pace.js";

// More particles than these have no smooth rims: they are small, and it takes time.
const MOST_SMOOTH = 200000;

// The first look in space, as pictures have it: from the front right and above.
const TURN = (-55 * Math.PI) / 180;
const RISE = (25 * Math.PI) / 180;

// So long after the last move all is at rest, milliseconds.
const REST = 200;

const VERTEX = `
attribute float diameter;
attribute float code;
attribute float shown;
uniform sampler2D palette;
uniform float zoom;
uniform vec3 cutAxis;
uniform vec2 cutBetween;
varying vec3 tint;
varying float across;
void main() {
  float along = dot(position, cutAxis);
  bool isOut = shown < 0.5 || along < cutBetween.x || along > cutBetween.y;
  gl_Position = isOut ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  across = max(diameter * zoom, 1.0);
  gl_PointSize = across;
  tint = texture2D(palette, vec2((code + 0.5) / 256.0, 0.5)).rgb;
}`;

// In space a ball in the light of pictures; in the plane a disc with a darker rim.
const FRAGMENT = `
uniform bool isSpace;
uniform bool isSmooth;
varying vec3 tint;
varying float across;
void main() {
  vec2 at = vec2(2.0 * gl_PointCoord.x - 1.0, 1.0 - 2.0 * gl_PointCoord.y);
  float r = length(at);
  float cover = 1.0;
  if (across > 2.5) {
    cover = isSmooth ? clamp(0.5 * (1.0 - r) * across + 0.5, 0.0, 1.0) : step(r, 1.0);
    if (cover <= 0.0) discard;
  }
  vec3 colour = tint;
  if (isSpace) {
    vec3 normal = across > 2.5 ? vec3(at, sqrt(max(0.0, 1.0 - r * r))) : vec3(0.0, 0.0, 1.0);
    float lit = max(0.0, dot(normal, normalize(vec3(-0.45, 0.55, 0.9))));
    colour = mix(tint, vec3(0.063, 0.071, 0.094), 0.62 * (1.0 - lit));
  } else {
    float rim = 0.45 * smoothstep(5.0, 14.0, across);
    colour = mix(tint, vec3(0.1, 0.11, 0.125), rim * smoothstep(1.0 - 5.0 / across, 1.0, r));
  }
  gl_FragColor = vec4(colour, cover);
}`;

const isSpace = about.dimension === 3;
// Sides of the box with the particles at its sides.
const sides = [0, 1, 2].map((k) => about.max[k] - about.min[k] + (k < about.dimension ? about.spacing : 0));
const reach = Math.hypot(...sides);

export const canvas = document.getElementById("stage");
export const camera = new OrthographicCamera();
camera.up.set(0, isSpace ? 0 : 1, isSpace ? 1 : 0);
camera.near = -20 * reach;
camera.far = 20 * reach;

const isSmooth = about.rows <= MOST_SMOOTH;
const renderer = new WebGLRenderer({ canvas, antialias: isSmooth && isSpace, alpha: false, powerPreference: "high-performance" });
const scene = new Scene();
const geometry = new BufferGeometry();

// How each particle is coloured, and whether it is shown.
export const codes = new Uint8Array(about.rows);
export const shown = new Uint8Array(about.rows).fill(1);
export const diameters = Float32Array.from({ length: about.rows }, (_, i) => diameter.number(i));

const ofCodes = new BufferAttribute(codes, 1);
const ofShown = new BufferAttribute(shown, 1);
geometry.setAttribute("position", new BufferAttribute(position, 3));
geometry.setAttribute("diameter", new BufferAttribute(diameters, 1));
geometry.setAttribute("code", ofCodes);
geometry.setAttribute("shown", ofShown);
geometry.setIndex(new BufferAttribute(spread(about.rows), 1));

const colours = new DataTexture(new Uint8Array(4 * 256), 256, 1);
colours.magFilter = NearestFilter;
colours.minFilter = NearestFilter;

const material = new ShaderMaterial({
  vertexShader: VERTEX,
  fragmentShader: FRAGMENT,
  uniforms: {
    palette: { value: colours },
    zoom: { value: 1 },
    cutAxis: { value: new Vector3() },
    cutBetween: { value: [-1, 1] },
    isSpace: { value: isSpace },
    isSmooth: { value: isSmooth },
  },
  transparent: !isSpace,
  depthTest: isSpace,
  depthWrite: isSpace,
  alphaToCoverage: isSmooth && isSpace,
});
const points = new Points(geometry, material);
points.frustumCulled = false;
scene.add(points);

const edges = new LineSegments(
  new EdgesGeometry(new BoxGeometry(...sides)),
  // Behind everything, so that no line crosses a body.
  new LineBasicMaterial({ depthTest: false, depthWrite: false }),
);
edges.renderOrder = -1;
edges.visible = isSpace;
scene.add(edges);

export const controls = new OrbitControls(camera, canvas);
controls.zoomToCursor = true;
controls.zoomSpeed = 1.5;
if (!isSpace) {
  controls.enableRotate = false;
  controls.mouseButtons.LEFT = MOUSE.PAN;
  controls.touches.ONE = TOUCH.PAN;
}

// Pixels of the page per length.
export function zoom() {
  return (canvas.clientHeight * camera.zoom) / (camera.top - camera.bottom);
}

let share = 1;
const watchers = [];

// Has something done after every frame.
export function onFrame(watcher) {
  watchers.push(watcher);
}

function draw() {
  const own = material.uniforms;
  // Where fewer stand for all, each is larger.
  own.zoom.value = zoom() * renderer.getPixelRatio() * share ** (-1 / about.dimension);
  geometry.setDrawRange(0, Math.ceil(share * about.rows));
  own.cutAxis.value.set(...[0, 1, 2].map((k) => (k === cut.axis ? 1 : 0)));
  own.cutBetween.value = cut.between;
  renderer.render(scene, camera);
  for (const watcher of watchers) watcher();
}

let isBegun = false;
let isDue = false;
let isMoving = false;
let atRest;

// Draws before long; nothing is drawn where nothing has changed.
export function redraw() {
  if (isDue) return;
  isDue = true;
  requestAnimationFrame(() => {
    isDue = false;
    isBegun = true;
    const begin = performance.now();
    share = isMoving ? pace.share() : 1;
    draw();
    if (pace.isAsked()) {
      finish();
      pace.took(performance.now() - begin, share);
    }
    if (isMoving) {
      clearTimeout(atRest);
      atRest = setTimeout(settle, REST);
    }
  });
}

function settle() {
  isMoving = false;
  if (share < 1) redraw();
}

// Draws what moves; all of it once it has come to rest.
export function redrawMoving() {
  clearTimeout(atRest);
  isMoving = true;
  redraw();
}

// Waits until what has been asked of the graphics is done.
export function finish() {
  const gl = renderer.getContext();
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
}

export function recolour(palette) {
  colours.image.data.set(palette);
  colours.needsUpdate = true;
  ofCodes.needsUpdate = true;
  redraw();
}

export function reshow() {
  ofShown.needsUpdate = true;
  redraw();
}

// The box around what is shown: its middle, and half its sides.
function box() {
  const [low, high] = [[0, 1, 2].map(() => Infinity), [0, 1, 2].map(() => -Infinity)];
  for (let i = 0; i < about.rows; i += 1) {
    if (shown[i] === 0) continue;
    for (let k = 0; k < about.dimension; k += 1) {
      low[k] = Math.min(low[k], position[3 * i + k] - 0.5 * diameters[i]);
      high[k] = Math.max(high[k], position[3 * i + k] + 0.5 * diameters[i]);
    }
  }
  const isFound = (k) => low[k] <= high[k];
  return {
    middle: [0, 1, 2].map((k) => (isFound(k) ? 0.5 * (low[k] + high[k]) : 0)),
    half: [0, 1, 2].map((k) => 0.5 * (isFound(k) ? high[k] - low[k] : sides[k])),
  };
}

// Looks from a direction at all that is shown.
function look(from) {
  const { middle, half } = box();
  controls.target.fromArray(middle);
  camera.position.copy(from).multiplyScalar(reach).add(controls.target);
  camera.zoom = 1;
  camera.lookAt(controls.target);
  camera.updateMatrixWorld();
  const [right, up] = [new Vector3(), new Vector3()];
  camera.matrixWorld.extractBasis(right, up, new Vector3());
  const along = (axis) => half.reduce((sum, length, k) => sum + length * Math.abs(axis.getComponent(k)), 0);
  seen = [along(right), along(up)];
  resize();
  controls.update();
}

export function reset() {
  look(isSpace
    ? new Vector3(Math.cos(RISE) * Math.cos(TURN), Math.cos(RISE) * Math.sin(TURN), Math.sin(RISE))
    : new Vector3(0, 0, 1));
}

// Looks along an axis, from its far end.
export function lookAlong(axis) {
  // A little off the pole, where up would be anywhere.
  const from = new Vector3(0, axis === 2 ? -1e-4 : 0, 0);
  from.setComponent(axis, axis === 1 ? -1 : 1);
  look(from.normalize());
}

// Half of what is to be seen, across and up.
let seen = [1, 1];

// Fits the drawing into its place, whatever that is.
function resize() {
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setSize(canvas.parentElement.clientWidth, canvas.parentElement.clientHeight, false);
  const aspect = Math.max(1, canvas.clientWidth) / Math.max(1, canvas.clientHeight);
  // Room for the marks below.
  camera.top = 1.16 * Math.max(seen[1], seen[0] / aspect) || 1;
  camera.bottom = -camera.top;
  camera.left = -camera.top * aspect;
  camera.right = camera.top * aspect;
  camera.updateProjectionMatrix();
  // At once: the canvas is empty now.
  if (isBegun) draw();
  else redraw();
}

function repaint() {
  const style = getComputedStyle(document.documentElement);
  renderer.setClearColor(new Color().setStyle(style.getPropertyValue("--paper")), 1);
  edges.material.color.setStyle(style.getPropertyValue("--line"));
  redraw();
}

controls.addEventListener("change", redrawMoving);
new ResizeObserver(resize).observe(canvas.parentElement);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
repaint();
