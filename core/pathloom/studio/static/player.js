// Time on the page: which generation is looked at, and how fast both runs go on. Paused, nothing is computed.

export class Player extends EventTarget {
  playing = false;
  position = 0;
  reached = 0; // the farthest generation that was looked at: there is no more to see before its time
  speed = 15;
  #wanted = null; // a step that waits for its generation
  #due = 0;
  #before = null;

  constructor(lanes) {
    super();
    this.lanes = lanes;
    const beat = now => { this.#tick(now); requestAnimationFrame(beat); };
    requestAnimationFrame(beat);
  }

  // Both lanes, or the one that is used.
  get active() { return this.lanes.filter(lane => lane.run !== undefined); }
  get hasRun() { return this.active.length > 0; }
  get #last() { return Math.max(0, ...this.active.map(lane => lane.last)); }
  get isOver() { return this.hasRun && this.active.every(lane => lane.over) && this.reached >= this.#last; }
  get isAtEnd() { return this.isOver && this.position >= this.#last; }

  play() { this.playing = true; this.#before = null; this.#due = 0; this.#changed(); }
  pause() { this.playing = false; this.#changed(); }

  // Go to a generation as soon as it is there.
  step(number) {
    this.playing = false;
    this.active.forEach(lane => lane.reach(number));
    this.#wanted = number;
    this.#changed();
  }

  seek(number) {
    this.playing = false;
    this.#wanted = null;
    this.position = Math.min(Math.max(0, number), this.reached);
    this.#changed();
  }

  reset() {
    this.playing = false;
    this.position = this.reached = 0;
    this.#wanted = null;
    this.#changed();
  }

  #tick(now) {
    if (this.#wanted !== null && this.#isThere(this.#wanted)) {
      this.#go(Math.min(this.#wanted, this.#last));
      this.#wanted = null;
      this.active.forEach(lane => lane.reach(this.position + 1)); // to learn of an end
      this.#changed();
    }
    if (!this.playing) return;
    const ahead = this.speed === Infinity ? 12 : 3;
    this.active.forEach(lane => lane.reach(this.position + ahead));
    this.#due += this.#before === null ? 1 : this.speed === Infinity ? ahead : (now - this.#before) * this.speed / 1000;
    this.#before = now;
    let moved = false;
    while (this.#due >= 1 && this.#isThere(this.position + 1) && this.position < this.#last) {
      this.#go(this.position + 1);
      this.#due -= 1;
      moved = true;
    }
    this.#due = Math.min(this.#due, 1);
    if (this.isAtEnd) this.pause();
    else if (moved) this.#changed();
  }

  #go(number) {
    this.position = number;
    this.reached = Math.max(this.reached, number);
  }

  #isThere(number) { return this.active.every(lane => lane.over || lane.last >= number); }
  #changed() { this.dispatchEvent(new Event("change")); }
}
