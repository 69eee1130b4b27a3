"use strict";

// The stream of the program: opened, and opened again with growing pauses where it was lost.
const PAUSES_S = [1, 2, 4, 8, 15];  // before each attempt; the last one stays
const SILENT_S = 6;                 // without a message: whether the program is there is asked (frames come twice a second)

const pageToken = new URLSearchParams(location.search).get("token");
// An address of this server, with the token.
function withToken(path) {
  if (!pageToken) return path;
  return `${path}${path.includes("?") ? "&" : "?"}token=${encodeURIComponent(pageToken)}`;
}

// The answer of a GET as an object; Error in words where there is none.
async function fetchJson(path) {
  let response;
  try {
    response = await fetch(withToken(path), { signal: AbortSignal.timeout(15000) });
  } catch {
    throw new Error("the program does not answer");
  }
  const answer = await response.json().catch(() => ({}));
  if (!response.ok) throw new Error(answer.error || `the program answers ${response.status}`);
  return answer;
}

class Connection {
  // onText(object), onFrame(buffer), onOpen(again), onLost({ seconds, why }) each second until the next attempt,
  // onSilent(): the program is there, but sends nothing.
  constructor(handlers) {
    this.handlers = handlers;
    this.attempts = 0;
    this.expectsFrames = false;
    this.lastHeard = performance.now();
    setInterval(() => this.watch(), 1000);
    window.addEventListener("online", () => this.tryNow());
    document.addEventListener("visibilitychange", () => { if (!document.hidden) this.tryNow(); });
    this.open();
  }

  isOpen() { return this.socket.readyState === WebSocket.OPEN; }

  // Whether the text was sent.
  send(text) {
    if (this.isOpen()) this.socket.send(text);
    return this.isOpen();
  }

  open() {
    clearTimeout(this.timer);
    this.waiting = false;
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}${withToken("/stream")}`);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.handlers.onOpen(this.attempts > 0);
      this.attempts = 0;
      this.lastHeard = performance.now();
    };
    socket.onmessage = ({ data }) => {
      this.lastHeard = performance.now();
      if (typeof data === "string") this.handlers.onText(JSON.parse(data));
      else this.handlers.onFrame(data);
    };
    socket.onclose = () => { if (socket === this.socket) this.lost(); };
  }

  async lost() {
    const pause = PAUSES_S[Math.min(this.attempts, PAUSES_S.length - 1)];
    ++this.attempts;
    this.waiting = true;
    this.countDown(pause, "The program does not answer.");
    // A browser does not say why a stream was refused.
    const why = await fetchJson("/health").then(() => "", (error) => error.message);
    if (this.waiting && why.includes("token")) {
      this.why = "The program does not let this page in: open the address that it printed.";
    }
  }

  countDown(seconds, why) {
    if (!this.waiting) return;
    this.handlers.onLost({ seconds, why: this.why || why });
    if (seconds <= 0) {
      this.why = "";
      this.open();
      return;
    }
    this.timer = setTimeout(() => this.countDown(seconds - 1, why), 1000);
  }

  tryNow() { if (this.waiting) this.open(); }

  // A connection that died without a word.
  async watch() {
    if (!this.expectsFrames || !this.isOpen() || this.asking) return;
    if (performance.now() - this.lastHeard < 1000 * SILENT_S) return;
    this.asking = true;
    const there = await fetchJson("/health").then(() => true, () => false);
    this.asking = false;
    if (performance.now() - this.lastHeard < 1000 * SILENT_S) return;
    if (there) this.handlers.onSilent();
    else if (this.isOpen()) {
      this.socket.onclose = null;
      this.socket.close();
      this.lost();
    }
  }
}
