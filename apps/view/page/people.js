"use strict";

// The legend of several people, and the figures of the one that was chosen in it.
class People {
  constructor(list) {
    this.list = list;
    this.chosen = 1;
    this.buttons = new Map();  // by person
  }

  begin(hello) {
    this.hello = hello;
    this.chosen = 1;
    this.buttons.clear();
    this.list.replaceChildren();
    this.list.hidden = hello.people === 1;
    if (hello.people === 1) return;
    for (let number = 1; number <= hello.people; ++number) this.add(number);
  }

  add(number) {
    const button = document.createElement("button");
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = cssColor(this.hello.person_colors[number - 1]);
    const name = document.createElement("span");
    name.textContent = `Person ${number}`;
    const state = document.createElement("span");
    state.className = "soft";
    button.append(swatch, name, state);
    button.onclick = () => this.choose(number);
    const item = document.createElement("li");
    item.appendChild(button);
    this.list.appendChild(item);
    this.buttons.set(number, { button, state });
    button.setAttribute("aria-pressed", String(number === this.chosen));
  }

  choose(number) {
    this.chosen = number;
    for (const [other, { button }] of this.buttons) button.setAttribute("aria-pressed", String(other === number));
  }

  // The chosen person in a frame; of those who are there, or somebody without a pose.
  of(frame) {
    if (!frame.people) return frame;
    return frame.people.find((person) => person.person === this.chosen) || { person: this.chosen, state: "lost" };
  }

  show(frame) {
    for (const [number, { state }] of this.buttons) {
      const person = frame.people.find((other) => other.person === number);
      const mean = person && person.confidence.reduce((sum, c) => sum + c, 0) / person.confidence.length;
      state.textContent = person ? `${person.state}, confidence ${mean.toFixed(2)}` : "not there";
    }
  }

  // The state of all together.
  stateOf(frame) {
    if (!frame.people || frame.people.length === 0) return frame.people ? "lost" : frame.state;
    return frame.people.some((person) => person.state === "tracking") ? "tracking" : frame.people[0].state;
  }
}
