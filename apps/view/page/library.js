"use strict";

// The list of recordings: to replay, and to have as files; and what to do where there is no camera. The server tracks
// one recording at a time, the job.
const PLACES = { command: "of this run", folder: "", bundled: "comes with the program" };
const CAMERAS_MS = 4000;      // between two looks at what is plugged in
const BETWEEN_FILES_MS = 400; // browsers drop downloads that begin at the same moment

function element(name, text, className) {
  const made = document.createElement(name);
  if (text) made.textContent = text;
  if (className) made.className = className;
  return made;
}

function sizeText(bytes) {
  return bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

function describe(recording) {
  const { duration_s: seconds, frames, width, height, bytes, modified_s: modified } = recording;
  const date = new Date(1000 * modified).toLocaleString([], { dateStyle: "medium", timeStyle: "short" });
  const place = PLACES[recording.id.split("/")[0]];
  const length = seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
  return `${length}, ${frames} frames of ${width}×${height}, ${sizeText(bytes)}, ${place || date}`;
}

// A line of the list of cameras, with what to type.
function row(text, command, className) {
  const item = element("li", text, className);
  if (command) item.append(element("code", command));
  return item;
}

class Library {
  // send(message) of the stream, say(text, isError).
  constructor(send, say) {
    this.send = send;
    this.say = say;
    this.box = document.getElementById("library");
    this.button = document.getElementById("library-button");
    this.job = { state: "none", recording: "", files: [] };
    this.rows = new Map();  // by id
    this.button.onclick = () => this.toggle(this.box.hidden);
    document.getElementById("library-close").onclick = () => this.toggle(false);
    document.getElementById("job-stop").onclick = () => this.stop();
    document.getElementById("close").onclick = () => this.stop();
    setInterval(() => this.lookForCameras(), CAMERAS_MS);
  }

  begin(hello) {
    const wasIdle = this.hello && this.hello.mode === "idle";
    this.hello = hello;
    const idle = hello.mode === "idle";
    this.offered = hello.controls.includes("open");
    this.button.hidden = idle || !this.offered;
    document.getElementById("library-close").hidden = idle;
    document.getElementById("close").hidden = !hello.opened;
    document.getElementById("cameras").hidden = !idle;
    if (!hello.opened) document.getElementById("library-people").value = hello.people;
    if (idle) this.lookForCameras();
    if (idle) this.toggle(true, false);
    else if (wasIdle && !this.wanted) this.toggle(false);
    if (this.offered) this.load();
  }

  toggle(open, focus = true) {
    this.box.hidden = !open;
    this.button.setAttribute("aria-expanded", String(open));
    if (open) this.load();
    if (!focus) return;
    if (open) this.box.focus();
    else if (this.button.offsetParent) this.button.focus();
  }

  async load() {
    const text = document.getElementById("library-text");
    try {
      const { recordings, formats, job } = await fetchJson("/recordings");
      this.formats = formats;
      this.list(recordings);
      this.onJob(job);
      text.textContent = recordings.length > 0 ? "" : "There is none yet: record one with a camera.";
      text.className = "";
    } catch (error) {
      text.textContent = `The list cannot be had: ${error.message}.`;
      text.className = "error";
    }
  }

  list(recordings) {
    const list = document.getElementById("recordings");
    const opened = new Set([...this.rows].filter(([, row]) => row.export.open).map(([id]) => id));
    const focus = document.activeElement && document.activeElement.dataset.key;
    this.rows.clear();
    list.replaceChildren(...recordings.map((recording) => this.row(recording, opened.has(recording.id))));
    if (focus) [...list.querySelectorAll("[data-key]")].find((e) => e.dataset.key === focus)?.focus();
  }

  row(recording, isOpen) {
    const item = element("li");
    const about = element("div", "", "about");
    about.append(element("strong", recording.name), element("span", recording.problem || describe(recording),
      recording.problem ? "error" : "soft"));
    item.append(about);
    const replay = element("button", "Replay");
    replay.setAttribute("aria-label", `Replay ${recording.name}`);
    replay.dataset.key = `replay ${recording.id}`;
    replay.disabled = recording.problem !== "";
    replay.onclick = () => this.open(recording.id, null);
    const files = element("details", "", "export");
    const summary = element("summary", "Export");
    summary.setAttribute("aria-label", `Export ${recording.name}`);
    summary.dataset.key = `export ${recording.id}`;
    const buttons = element("div", "", "formats");
    files.append(summary, buttons);
    files.open = isOpen;
    if (!recording.problem) item.append(replay, files);
    this.rows.set(recording.id, { replay, export: files, buttons });
    this.fill(recording.id);
    return item;
  }

  // The export buttons of a recording: a file each where it is tracked, else a format each.
  fill(id) {
    const row = this.rows.get(id);
    if (!row) return;
    const tracked = this.job.state === "done" && this.job.recording === id;
    row.buttons.replaceChildren(...this.formats.flatMap((format) => {
      const files = tracked ? this.job.files.filter((file) => file.format === format.name) : [];
      if (files.length < 2) return [this.exportButton(id, format, files, format.title)];
      return files.map((file) => this.exportButton(id, format, [file], `${format.title}: ${file.name}`));
    }));
  }

  exportButton(id, format, files, title) {
    const button = element("button", files.length > 0 ? `${title}, ${sizeText(files[0].bytes)}` : title);
    button.dataset.key = `${format.name} ${title} ${id}`;
    button.onclick = () => (files.length > 0 ? this.download(files) : this.open(id, format.name));
    return button;
  }

  // `format`: downloaded once the recording is tracked.
  open(id, format) {
    if (this.job.state === "tracking") {
      this.wanted = this.job.recording === id ? format : this.wanted;
      this.tell(this.job.recording === id ? "It is being tracked; the file follows." :
        `${this.job.name} is being tracked: wait until it is done, or stop it.`, this.job.recording !== id);
      return;
    }
    this.wanted = format;
    if (format) this.tell("Tracking; the file follows.");
    const people = Number(document.getElementById("library-people").value);
    if (!this.send({ type: "open", recording: id, people })) {
      this.tell("There is no connection to the program.", true);
    } else if (!format) this.toggle(false);
  }

  stop() {
    this.wanted = null;
    this.send({ type: "close" });
  }

  tell(text, isError) {
    const line = document.getElementById("library-text");
    line.textContent = text;
    line.className = isError ? "error" : "";
    this.say(text, isError);
  }

  onJob(job) {
    const before = this.job;
    this.job = job;
    const tracking = job.state === "tracking";
    document.getElementById("job").hidden = !tracking;
    document.getElementById("job-progress").value = job.total > 0 ? job.done / job.total : 0;
    const share = job.total > 0 ? `, ${Math.round(100 * job.done / job.total)} %` : "";
    document.getElementById("job-text").textContent = tracking ? `Tracking ${job.name}${share}` : "";
    if (before.state === job.state && before.recording === job.recording) return;
    for (const id of new Set([before.recording, job.recording])) this.fill(id);
    if (job.state === "failed") this.tell(`${job.name}: ${job.problem}`, true);
    if (job.state === "done") {
      const wanted = job.files.filter((file) => file.format === this.wanted);
      this.tell(this.wanted ? `${job.name} is tracked.` : `${job.name} is tracked; Recordings, Export has its files.`);
      if (this.wanted) this.download(wanted);
    }
    if (!tracking && job.state !== "none") this.wanted = null;
  }

  download(files) {
    files.forEach((file, i) => setTimeout(() => this.save(file), BETWEEN_FILES_MS * i));
  }

  save(file) {
    const link = element("a");
    link.href = withToken(`/export?file=${file.name}`);
    link.download = file.name;
    document.body.appendChild(link);
    link.click();
    link.remove();
    this.tell(`Saving ${file.name}, ${sizeText(file.bytes)}.`);
  }

  async lookForCameras() {
    if (!this.hello || this.hello.mode !== "idle" || document.hidden) return;
    const text = document.getElementById("cameras-text");
    try {
      const { plugged, ready, waits } = await fetchJson("/cameras");
      this.showCameras(plugged, ready, waits, text);
    } catch (error) {
      text.textContent = `What is plugged in is not known: ${error.message}.`;
    }
  }

  showCameras(plugged, ready, waits, text) {
    const rows = [];
    for (const camera of ready) {
      rows.push(row(`${camera.name} is ready. Type: `, `depthmocap live --source ${camera.source} --view`));
    }
    for (const camera of plugged) {
      rows.push(row(`${camera.name} is plugged in. To use it: ${camera.use}`));
      for (const mend of camera.mends) rows.push(row(`To mend: ${mend}`, "", "error"));
    }
    document.getElementById("cameras-list").replaceChildren(...rows);
    const plug = "Plug in a depth camera: Kinect, Xtion, Astra, RealSense, Orbbec or another. ";
    if (waits) text.textContent = `${plug}This page goes on by itself as soon as a camera can be opened.`;
    else text.replaceChildren(`${plug}Then end this program with Ctrl-C and type `, element("code", "depthmocap live --view"));
  }
}
