// The path problem as it is drawn: cells, start, goal, corner policy, radius. Tells of every change.

import { fromBase64, pack, toBase64, unpack } from "./bits.js";

const UNDOS = 20;

export class Scene extends EventTarget {
  rows = 20;
  cols = 20;
  cells = new Uint8Array(400);
  closed = null; // cells that the radius closes, from the server
  start = [19, 0];
  goal = [0, 19];
  corners = "strict";
  radius = 0;
  name = "";
  #past = [];

  // Replace the map. Ends that do not fit go to the corners, bottom left and top right, or near them.
  take(map, name = "", ends = {}) {
    this.rows = map.rows;
    this.cols = map.cols;
    this.cells = unpack(fromBase64(map.bits), map.rows * map.cols);
    this.name = name;
    this.closed = null;
    this.#past = [];
    this.start = ends.start ?? this.nearestFree([this.rows - 1, 0]);
    this.goal = ends.goal ?? this.nearestFree([0, this.cols - 1]);
    this.changed({ size: true });
  }

  inside([row, col]) { return row >= 0 && row < this.rows && col >= 0 && col < this.cols; }
  isWall([row, col]) { return this.cells[row * this.cols + col] === 1; }

  nearestFree([row, col]) {
    let best = [row, col], least = Infinity;
    for (let i = 0; i < this.cells.length; i++) {
      if (this.cells[i]) continue;
      const r = Math.floor(i / this.cols), c = i % this.cols, far = (r - row) ** 2 + (c - col) ** 2;
      if (far < least) [best, least] = [[r, c], far];
    }
    return best;
  }

  remember() {
    this.#past.push(this.cells.slice());
    if (this.#past.length > UNDOS) this.#past.shift();
  }

  get canUndo() { return this.#past.length > 0; }

  undo() {
    const before = this.#past.pop();
    if (before) { this.cells = before; this.changed(); }
  }

  clear() {
    this.remember();
    this.cells = new Uint8Array(this.cells.length);
    this.changed();
  }

  // Draw or erase all cells on the way between two, with a square brush. Start and goal stay free.
  stroke(from, to, wall, brush) {
    const steps = Math.max(Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1]), 1), reach = (brush - 1) / 2;
    for (let k = 0; k <= steps; k++) {
      const row = Math.round(from[0] + (to[0] - from[0]) * k / steps);
      const col = Math.round(from[1] + (to[1] - from[1]) * k / steps);
      for (let r = row - reach; r <= row + reach; r++)
        for (let c = col - reach; c <= col + reach; c++)
          if (this.inside([r, c]) && !(wall && this.isEnd([r, c]))) this.cells[r * this.cols + c] = wall ? 1 : 0;
    }
    this.changed();
  }

  isEnd([row, col]) {
    return [this.start, this.goal].some(([r, c]) => r === row && c === col);
  }

  put(end, cell) {
    if (!this.inside(cell) || String(this[end]) === String(cell)) return;
    this[end] = cell;
    this.changed();
  }

  set(settings) {
    Object.assign(this, settings);
    this.changed();
  }

  changed(detail = {}) { this.dispatchEvent(new CustomEvent("change", { detail })); }

  get map() { return { rows: this.rows, cols: this.cols, bits: toBase64(pack(this.cells)) }; }

  // As the server takes it.
  get asked() {
    const { map, start, goal, corners, radius, name } = this;
    return { map, start, goal, corners, radius, name };
  }
}
