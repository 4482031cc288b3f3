// One run as the page knows it: every generation so far, asked for one by one, in bounded memory.

const MOST_NODES = 3_000_000; // of the populations that are kept: some 12 MB
let runs = 0;

export class Lane extends EventTarget {
  constructor(index, live) {
    super();
    this.index = index;
    this.live = live;
    this.reset();
  }

  reset() {
    if (this.run !== undefined && !this.over) this.live.send({ type: "stop", lane: this.index });
    Object.assign(this, {
      run: undefined, begun: null, frames: [], answer: null, fault: null, compiling: null, chosen: null,
    });
    this.awaited = 0; // generations that are asked for and have not come yet
    this.nodes = 0;
    this.every = 1; // only every so many-th generation still has its population
  }

  begin(asked) {
    this.reset();
    this.run = ++runs;
    this.live.send({ type: "begin", lane: this.index, run: this.run, asked });
  }

  get over() { return this.answer !== null || this.fault !== null; }
  get isRunning() { return this.run !== undefined && !this.over; }
  get last() { return this.frames.length - 1; }

  // Ask for generations until there is one with this number.
  reach(number) {
    const missing = Math.min(number - this.last - this.awaited, 64);
    if (!this.isRunning || missing < 1) return;
    this.awaited += missing;
    this.live.send({ type: "more", lane: this.index, run: this.run, generations: missing });
  }

  hear(message) {
    if (message.run !== this.run) return;
    if (message.type === "begun") this.begun = message;
    else if (message.type === "compiling") this.compiling = message;
    else if (message.type === "generation") this.#keep(message);
    else if (message.type === "ended") this.answer = message;
    else if (message.type === "refused") this.fault = message;
    this.dispatchEvent(new Event("change"));
  }

  #keep(message) {
    this.awaited = Math.max(0, this.awaited - 1);
    this.compiling = null;
    message.paths = message.paths.map(path => Int32Array.from(path));
    this.frames.push(message);
    this.nodes += count(message);
    while (this.nodes > MOST_NODES && this.every < 1024) {
      this.every *= 2;
      this.frames.forEach((frame, number) => {
        if (number % this.every === 0 || number === this.last) return;
        this.nodes -= count(frame);
        frame.paths = [];
      });
    }
  }

  // What stands at a generation: its frame, with the nearest population that is kept.
  at(number) {
    const frame = this.frames[Math.min(number, this.last)];
    if (!frame || frame.paths.length || this.every === 1) return frame;
    const nearest = this.frames[Math.floor(Math.min(number, this.last) / this.every) * this.every];
    return { ...frame, paths: nearest.paths };
  }

  // Whether the answer is to be shown in place of the best path.
  isAnswerAt(number) { return this.answer !== null && number >= this.last; }

  frontAt(number) {
    return (this.isAnswerAt(number) && this.answer.front) || this.at(number)?.front || null;
  }
}

function count(frame) {
  return frame.paths.reduce((sum, path) => sum + path.length, 0);
}
