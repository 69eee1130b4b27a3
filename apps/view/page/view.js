"use strict";

const byId = (id) => document.getElementById(id);
const token = new URLSearchParams(location.search).get("token");
const withToken = (path) => token ? `${path}?token=${encodeURIComponent(token)}` : path;
const STAGES = ["segment", "classify", "markers", "prior", "solve", "total"];
const ROOM_COLOR = [150, 158, 170];
const SLOW_MS = 33;
const FIGURES_MS = 150;
const LOST_MS = 2000;   // before the page says what to do about it
const LOST_TEXT = "Nobody is tracked. Stand 2 to 4 m before the camera, the whole body in view.";

let hello = null;
let scene = null;
let socket = null;
let newest = null;      // the frame that is drawn next
let dragging = false;   // the player's knob
let picking = false;    // a person to lock on
let playing = true;
let recording = false;
let unconfirmed = 0;    // frames that came since the last "ready"
let figuresShown = 0;   // when the numbers last changed: faster than eyes read is wasted
let updates = [];
let noticeTimer = 0;
let lostSince = null;   // when the actor was lost [ms]
const bars = new Map();

function say(text, isError) {
  byId("message").textContent = text;
  byId("message").classList.toggle("error", Boolean(isError));
}

// In large letters over the scene, for people who stand before the camera; for some seconds, or until the next one.
function notice(text, kind, seconds) {
  const box = byId("notice");
  clearTimeout(noticeTimer);
  box.hidden = text === "";
  box.textContent = text;
  box.className = kind;
  if (seconds) noticeTimer = setTimeout(() => notice("", ""), 1000 * seconds);
}

function send(message) {
  if (socket && socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
}

function makeBars(parent, names) {
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
  if (hello === null) {
    makeBars(byId("stages"), STAGES);
    makeBars(byId("confidence"), message.joints);
    scene = new Scene(byId("scene"), message.joints, message.part_colors, message.body_stature_m);
    requestAnimationFrame(draw);
  }
  hello = message;
  byId("source").textContent = message.source;
  byId("source").title = message.source;
  byId("player").hidden = message.mode !== "replay";
  for (const name of ["record", "calibrate", "reset", "lock"]) byId(name).disabled = !message.controls.includes(name);
  if (message.mode === "idle") say("No camera and no recording: start `depthmocap live --view` or `replay --view`.");
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
    const color = labels[i] > 0 ? hello.part_colors[labels[i]] : ROOM_COLOR;
    data[k] = color[0] * light;
    data[k + 1] = color[1] * light;
    data[k + 2] = color[2] * light;
  }
  context.putImageData(pixels, 0, 0);
}

function showFigures(frame) {
  const state = byId("state");
  state.textContent = frame.state;
  state.className = `state ${frame.state}`;
  byId("frame").textContent = frame.frame;
  byId("time").textContent = `${frame.time_s.toFixed(2)} s`;
  byId("fps").textContent = `${frame.fps.toFixed(0)} fps`;
  byId("latency").textContent = frame.latency_ms > 0 ? `${frame.latency_ms.toFixed(0)} ms` : "–";
  byId("stature").textContent = frame.joints ? `${frame.stature_m.toFixed(2)} m` : "–";
  for (const stage of STAGES) {
    setBar(`stages.${stage}`, frame.ms[stage] / SLOW_MS, `${frame.ms[stage].toFixed(1)} ms`);
  }
  hello.joints.forEach((name, j) => {
    const c = frame.confidence ? frame.confidence[j] : 0;
    setBar(`confidence.${name}`, c, c.toFixed(2));
  });
  recording = frame.recording;
  byId("record").classList.toggle("on", recording);
  byId("record").textContent = recording ? "Stop recording" : "Record";
}

function showPlayer(playback) {
  if (!playback) return;
  playing = playback.playing;
  byId("play").textContent = playing ? "Pause" : "Play";
  byId("seek").max = Math.max(0, playback.tracked - 1);
  if (!dragging) byId("seek").value = playback.index;
  const more = playback.tracked < playback.total ? ` (tracking, of ${playback.total})` : "";
  byId("place").textContent = `${playback.index + 1} / ${playback.tracked}${more}`;
}

function draw() {
  requestAnimationFrame(draw);
  if (newest) {
    const frame = newest;
    newest = null;
    if (byId("show-cloud").checked) scene.showCloud(frame.image, frame.depth, frame.labels);
    scene.showMarkers(frame.markers);
    scene.showFigure(frame);
    drawPicture(frame);
    for (; unconfirmed > 0; --unconfirmed) socket.send("ready");
    const now = performance.now();
    if (now - figuresShown > FIGURES_MS || frame.state !== byId("state").textContent) {
      figuresShown = now;
      showFigures(frame);
      adviseLost(frame, now);
    }
    showPlayer(frame.playback);
    scene.changed = true;
    updates.push(now);
    updates = updates.filter((t) => now - t < 2000);
    byId("updates").textContent = `${(updates.length / 2).toFixed(0)} fps`;
    window.depthmocap = { frame: frame.frame, updates: (window.depthmocap ? window.depthmocap.updates : 0) + 1 };
  }
  scene.render();
}

function onEvent({ what, text }) {
  say(text, what === "failure");
  if (what === "calibrate") notice(text, "");
  if (what === "calibrated") notice(text, "done", 6);
  if (what === "failure") notice(text, "error", 8);
}

function onText(message) {
  if (message.type === "hello") onHello(message);
  if (message.type === "event") onEvent(message);
  if (message.type === "error") say(message.error, true);
}

// A camera that sees nobody for a while.
function adviseLost(frame, now) {
  if (hello.mode !== "live") return;
  const lost = frame.state === "lost";
  if (lost && lostSince === null) lostSince = now;
  if (lost && now - lostSince > LOST_MS && byId("notice").hidden) notice(LOST_TEXT, "");
  if (lost) return;
  lostSince = null;
  if (byId("notice").textContent === LOST_TEXT) notice("", "");
}

function connect() {
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  socket = new WebSocket(`${scheme}://${location.host}${withToken("/stream")}`);
  socket.binaryType = "arraybuffer";
  socket.onmessage = ({ data }) => {
    if (typeof data === "string") onText(JSON.parse(data));
    else if (hello) {
      newest = parseFrame(data);
      ++unconfirmed;
    }
  };
  socket.onclose = () => {
    unconfirmed = 0;
    newest = null;
    byId("state").textContent = "no connection";
    byId("state").className = "state lost";
    notice("No connection to the program; trying again.", "error", 3);
    setTimeout(connect, 1000);
  };
}

byId("play").onclick = () => send({ type: playing ? "pause" : "play" });
byId("seek").oninput = () => {
  dragging = true;
  send({ type: "seek", frame: Number(byId("seek").value) });
};
byId("seek").onchange = () => { dragging = false; };
byId("speed").onchange = () => send({ type: "speed", value: Number(byId("speed").value) });
byId("record").onclick = () => send({ type: "record", on: recording ? 0 : 1 });
byId("calibrate").onclick = () => send({ type: "calibrate" });
byId("reset").onclick = () => send({ type: "reset" });
function pick(on) {
  picking = on;
  byId("picture").classList.toggle("picking", on);
  byId("lock").classList.toggle("on", on);
  say(on ? "Click the person in the depth picture; Escape: none." : "");
}
byId("lock").onclick = () => pick(!picking);
byId("picture").onclick = (event) => {
  if (!picking) return;
  pick(false);
  const box = byId("picture").getBoundingClientRect();
  send({ type: "lock", x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height });
};
byId("show-cloud").onchange = () => {
  scene.cloudVisible = byId("show-cloud").checked;
  if (scene.cloud) scene.cloud.points.visible = scene.cloudVisible;
};
byId("show-markers").onchange = () => { scene.markers.visible = byId("show-markers").checked; };
byId("show-skeleton").onchange = () => {
  scene.skeletonVisible = byId("show-skeleton").checked;
  scene.skeleton.visible = scene.skeletonVisible;
};
byId("show-surface").onchange = () => scene.setSurfaceVisible(byId("show-surface").checked, withToken("/body.glb"));
byId("home").onclick = () => scene.home();
document.addEventListener("keydown", (event) => {
  if (event.code === "Escape" && picking) pick(false);
  if (event.code !== "Space" || event.target.tagName === "BUTTON") return;
  event.preventDefault();
  byId("play").click();
});
document.addEventListener("change", () => { if (scene) scene.changed = true; });
connect();
