"use strict";

// Keys that work everywhere but in fields; each does what a button does. The help dialog lists them.
const STEP = 0.03;  // of the picture, for the cross of "lock"

function press(id) {
  const button = byId(id);
  if (!button.disabled && button.offsetParent) button.click();
}

function step(frames) {
  if (!playback || hello.mode !== "replay") return;
  if (playback.playing) send({ type: "pause" });
  playback = { ...playback, playing: false, index: playback.index + frames };
  seekTo(playback.index);
}

const KEYS = {
  " ": () => press("play"),
  ArrowLeft: () => step(-1),
  ArrowRight: () => step(1),
  r: () => press("record"),
  c: () => press("calibrate"),
  l: () => press("lock"),
  o: () => press("library-button"),
  a: () => scene.move(-TURN, 0, 1),
  d: () => scene.move(TURN, 0, 1),
  w: () => scene.move(0, -TURN, 1),
  s: () => scene.move(0, TURN, 1),
  "+": () => scene.move(0, 0, NEARER),
  "-": () => scene.move(0, 0, 1 / NEARER),
  f: () => scene.home(),
  "?": () => press("help-button"),
  Escape: () => leave(),
};

const CROSS_KEYS = {
  ArrowLeft: () => moveCross(-STEP, 0),
  ArrowRight: () => moveCross(STEP, 0),
  ArrowUp: () => moveCross(0, -STEP),
  ArrowDown: () => moveCross(0, STEP),
  Enter: () => lockAt(cross.x, cross.y),
};

function leave() {
  if (picking) pick(false);
  else if (!byId("library").hidden && hello.mode !== "idle") library.toggle(false);
  else byId("view-menu").open = false;
}

// Whether the key belongs to what has the focus.
function isTaken(key, target) {
  if (target.matches("input[type=range]")) return key.startsWith("Arrow");
  if (target.matches("select, input[type=text]")) return key !== "Escape";
  return (key === " " || key === "Enter") && target.matches("button, summary, input, a");
}

document.addEventListener("keydown", (event) => {
  if (!scene || event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (isTaken(key, event.target)) return;
  const action = (picking && CROSS_KEYS[key]) || KEYS[key];
  if (!action) return;
  event.preventDefault();
  action();
});
