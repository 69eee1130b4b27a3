"use strict";

const byId = (id) => document.getElementById(id);
const STAGES = ["segment", "classify", "markers", "prior", "solve", "total"];
const ROOM_COLOR = [150, 158, 170];
const SLOW_MS = 33;
const FIGURES_MS = 150;
const LOST_MS = 2000;   // before the page says what to do about it
const LOST_TEXT = "Nobody is tracked. Stand 2 to 4 m before the camera, the whole body in view.";
const AWAY = "camera away";
const COMMANDS = ["record", "calibrate", "reset", "lock"];

let hello = null;
let scene = null;
let newest = null;      // the frame that is drawn next
let playback = null;    // of the newest frame
let dragging = false;   // the player's knob
let picking = false;    // a person to lock on
let recording = false;
let unconfirmed = 0;    // frames that came since the last "ready"
let figuresShown = 0;   // when the numbers last changed: faster than eyes read is wasted
let updates = [];
let noticeTimer = 0;
let lostSince = null;   // when everybody was lost [ms]
const bars = new Map();
const cross = { x: 0.5, y: 0.5 };  // in the depth picture, for the keyboard

function say(text, isError) {
  byId("message").textContent = text;
  byId("message").classList.toggle("error", Boolean(isError));
}

// In large letters over the scene, for people who stand before the camera; for some seconds, or until the next one.
function notice(text, kind, seconds) {
  clearTimeout(noticeTimer);
  byId("notice").hidden = text === "";
  byId("notice").className = kind;
  byId("notice-text").textContent = text;
  byId("try-now").hidden = kind !== "error away";
  if (seconds) noticeTimer = setTimeout(() => notice("", ""), 1000 * seconds);
}

function setState(text, kind) {
  byId("state").textContent = text;
  byId("state").className = `state ${kind || text}`;
}

function send(message) {
  return connection.send(JSON.stringify(message));
}

function makeBars(parent, names) {
  parent.replaceChildren();
  for (const name of names) {
    const row = document.createElement("div");
    row.className = "bar";
    const label = document.createElement("span");
    label.textContent = name.replace("_", " ");
    const track = document.createElement("div");
    track.className = "track";
    const fill = document.createElement("div");
    fill.className = "fill";
    track.appendChild(fill);
    const value = document.createElement("span");
    row.append(label, track, value);
    parent.appendChild(row);
    bars.set(`${parent.id}.${name}`, { fill, value });
  }
}

function setBar(name, share, text) {
  const bar = bars.get(name);
  bar.fill.style.width = `${Math.round(100 * Math.min(1, Math.max(0, share)))}%`;
  bar.value.textContent = text;
}

function onHello(message) {
  const first = hello === null;
  hello = message;
  if (first) {
    makeBars(byId("stages"), STAGES);
    makeBars(byId("confidence"), message.joints);
    scene = new Scene(byId("scene"));
    requestAnimationFrame(draw);
  }
  newest = null;
  playback = null;
  hello.labelColors = labelColors(hello);
  scene.begin(hello);
  people.begin(hello);
  library.begin(hello);
  connection.expectsFrames = hello.mode !== "idle";
  byId("source").textContent = message.source;
  byId("source").title = message.source;
  byId("player").hidden = message.mode !== "replay";
  byId("commands").hidden = !COMMANDS.some((name) => message.controls.includes(name));
  byId("calibrating").hidden = true;
  for (const name of COMMANDS) byId(name).disabled = !message.controls.includes(name);
  if (hello.mode === "idle") setState("ready", "tracking");
  else setState("waiting for pictures", "waiting");
}

// JSON, then the depth picture, then the labels (docs/reference/stream.md).
function parseFrame(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const frame = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const pixels = frame.image.width * frame.image.height;
  frame.depth = new Uint16Array(buffer, 4 + length, pixels);
  frame.labels = new Uint8Array(buffer, 4 + length + 2 * pixels, pixels);
  return frame;
}

function drawPicture({ image, depth, labels }) {
  const canvas = byId("picture");
  if (canvas.width !== image.width || canvas.height !== image.height) {
    canvas.width = image.width;
    canvas.height = image.height;
  }
  const context = canvas.getContext("2d");
  const pixels = context.createImageData(image.width, image.height);
  const { data } = pixels;
  for (let i = 0, k = 0; i < depth.length; ++i, k += 4) {
    data[k + 3] = 255;
    if (depth[i] === 0) continue;
    const light = Math.max(0.15, 1.1 - depth[i] / 5500);
    const color = (labels[i] > 0 && hello.labelColors[labels[i]]) || ROOM_COLOR;
    data[k] = color[0] * light;
    data[k + 1] = color[1] * light;
    data[k + 2] = color[2] * light;
  }
  context.putImageData(pixels, 0, 0);
}

function showFigures(frame) {
  const person = people.of(frame);
  setState(people.stateOf(frame));
  byId("frame").textContent = frame.frame;
  byId("time").textContent = `${frame.time_s.toFixed(2)} s`;
  byId("fps").textContent = `${frame.fps.toFixed(0)} fps`;
  byId("latency").textContent = frame.latency_ms > 0 ? `${frame.latency_ms.toFixed(0)} ms` : "–";
  byId("stature").textContent = person.joints ? `${person.stature_m.toFixed(2)} m` : "–";
  for (const stage of STAGES) {
    setBar(`stages.${stage}`, frame.ms[stage] / SLOW_MS, `${frame.ms[stage].toFixed(1)} ms`);
  }
  byId("confidence-title").textContent = hello.people > 1 ? `Confidence, person ${people.chosen}` : "Confidence";
  hello.joints.forEach((name, j) => {
    const c = person.confidence ? person.confidence[j] : 0;
    setBar(`confidence.${name}`, c, c.toFixed(2));
  });
  if (frame.people) people.show(frame);
  recording = frame.recording;
  byId("record").classList.toggle("on", recording);
  byId("record").textContent = recording ? "Stop recording" : "Record";
}

function showPlayer() {
  if (!playback) return;
  byId("play").textContent = playback.playing ? "Pause" : "Play";
  byId("seek").max = Math.max(0, playback.tracked - 1);
  if (!dragging) byId("seek").value = playback.index;
  const more = playback.tracked < playback.total ? ` of ${playback.total}` : "";
  byId("place").textContent = `${playback.index + 1} / ${playback.tracked}${more}`;
}

function draw() {
  requestAnimationFrame(draw);
  if (newest) {
    const frame = newest;
    newest = null;
    playback = frame.playback;
    scene.showFrame(frame, people.chosen);
    drawPicture(frame);
    for (; unconfirmed > 0; --unconfirmed) connection.send("ready");
    const now = performance.now();
    if (now - figuresShown > FIGURES_MS || people.stateOf(frame) !== byId("state").textContent) {
      figuresShown = now;
      showFigures(frame);
      adviseLost(frame, now);
    }
    showPlayer();
    updates.push(now);
    updates = updates.filter((t) => now - t < 2000);
    byId("updates").textContent = `${(updates.length / 2).toFixed(0)} fps`;
    window.depthmocap = { frame: frame.frame, updates: (window.depthmocap ? window.depthmocap.updates : 0) + 1 };
  }
  scene.render();
}

function onEvent({ what, text }) {
  const calibrates = what === "calibrate";
  say(calibrates ? "" : text, what === "failure");
  if (calibrates) notice("", "");
  if (calibrates) byId("calibrating-text").textContent = text;
  if (calibrates || what === "calibrated" || what === "failure") byId("calibrating").hidden = !calibrates;
  if (what === "calibrated") notice(text, "done", 6);
  if (what === "failure") notice(text, "error", 8);
  if (what === "camera_lost") onCameraLost(text);
  if (what === "camera_back") notice(text, "done", 4);
  if (what === "record") library.load();
}

function onCameraLost(text) {
  newest = null;
  setState(AWAY, "lost");
  notice(text, "error");
}

function onText(message) {
  if (message.type === "hello") onHello(message);
  if (message.type === "event") onEvent(message);
  if (message.type === "error") say(message.error, true);
  if (message.type === "job") library.onJob(message);
}

// A camera that sees nobody for a while.
function adviseLost(frame, now) {
  if (hello.mode !== "live") return;
  const lost = people.stateOf(frame) === "lost";
  if (lost && lostSince === null) lostSince = now;
  const silent = byId("notice").hidden && byId("calibrating").hidden;
  if (lost && now - lostSince > LOST_MS && silent) notice(LOST_TEXT, "");
  if (lost) return;
  lostSince = null;
  if (byId("notice-text").textContent === LOST_TEXT) notice("", "");
}

function onLost({ seconds, why }) {
  unconfirmed = 0;
  newest = null;
  connection.expectsFrames = false;
  setState("no connection", "lost");
  byId("calibrating").hidden = true;
  notice(`${why} ${seconds > 0 ? `Trying again in ${seconds} s.` : "Trying again."}`, "error away");
}

function onOpen(again) {
  unconfirmed = 0;
  notice(again ? "Connected again." : "", "done", 3);
}

function pick(on) {
  picking = on;
  byId("picture-box").classList.toggle("picking", on);
  byId("lock").classList.toggle("on", on);
  byId("cross").hidden = true;
  say(on ? "Click the person in the depth picture, or go there with the arrows and Enter; Escape: none." : "");
  if (!on) return;
  byId("picture").tabIndex = 0;
  byId("picture").focus();
  byId("picture").scrollIntoView({ block: "nearest" });
}

function moveCross(dx, dy) {
  cross.x = Math.min(1, Math.max(0, cross.x + dx));
  cross.y = Math.min(1, Math.max(0, cross.y + dy));
  byId("cross").hidden = false;
  byId("cross").style.left = `${100 * cross.x}%`;
  byId("cross").style.top = `${100 * cross.y}%`;
}

function lockAt(x, y) {
  pick(false);
  byId("picture").removeAttribute("tabindex");
  byId("lock").focus();
  send({ type: "lock", x, y });
}

function seekTo(index) {
  send({ type: "seek", frame: Math.min(Math.max(0, index), Number(byId("seek").max)) });
}

const people = new People(byId("people"));
const library = new Library(send, say);
const connection = new Connection({
  onText,
  onFrame: (data) => {
    if (!hello) return;
    newest = parseFrame(data);
    ++unconfirmed;
  },
  onOpen,
  onLost,
  onSilent: () => { if (byId("state").textContent !== AWAY) setState("no pictures", "coasting"); },
});

byId("try-now").onclick = () => connection.tryNow();
byId("play").onclick = () => send({ type: playback && playback.playing ? "pause" : "play" });
byId("seek").oninput = () => {
  dragging = true;
  seekTo(Number(byId("seek").value));
};
byId("seek").onchange = () => { dragging = false; };
byId("speed").onchange = () => send({ type: "speed", value: Number(byId("speed").value) });
byId("record").onclick = () => send({ type: "record", on: recording ? 0 : 1 });
byId("calibrate").onclick = () => send({ type: "calibrate" });
byId("reset").onclick = () => send({ type: "reset" });
byId("lock").onclick = () => pick(!picking);
byId("picture").onclick = (event) => {
  if (!picking) return;
  const box = byId("picture").getBoundingClientRect();
  lockAt((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
};
for (const what of ["cloud", "markers", "skeleton", "surface"]) {
  byId(`show-${what}`).onchange = () => scene.setShown(what, byId(`show-${what}`).checked);
}
byId("follow").onchange = () => { scene.follow = byId("follow").checked; };
byId("home").onclick = () => scene.home();
byId("help-button").onclick = () => byId("help").showModal();
