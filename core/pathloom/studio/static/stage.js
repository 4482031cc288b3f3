// A stage: the map on a canvas, with population, best path and answer; drawn on by pointer and keyboard.

import { colours, rgb, sharp } from "./pen.js";

const VEIL = 0.2; // how much one path of the population covers
const LINED = 14; // pixels of a cell from which cells are separated by lines

export class Stage {
  cursor = null; // the cell that the keyboard is at
  finger = null; // where on the canvas somebody last pressed

  constructor(canvas, scene, pen) {
    Object.assign(this, { canvas, scene, pen });
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.addEventListener("pointerdown", event => this.#press(event));
    canvas.addEventListener("pointermove", event => this.#move(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => this.#lift());
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("keydown", event => this.#key(event));
    canvas.addEventListener("focus", () => {
      if (canvas.matches(":focus-visible")) this.cursor ??= [...scene.start];
      this.onlook?.();
    });
    canvas.addEventListener("blur", () => { this.cursor = null; this.onlook?.(); });
  }

  fit(width, height) {
    const { rows, cols } = this.scene;
    let cell = Math.min(width / cols, height / rows);
    if (cell > 3) cell = Math.floor(cell);
    this.cell = cell;
    this.width = Math.max(1, cell * cols);
    this.height = Math.max(1, cell * rows);
    Object.assign(this.canvas.style, { width: `${this.width}px`, height: `${this.height}px` });
  }

  // The middle of a cell on the canvas.
  place([row, col]) { return [(col + 0.5) * this.cell, (row + 0.5) * this.cell]; }

  draw(lane, position) {
    const context = sharp(this.canvas, this.width, this.height);
    this.#map(context);
    const frame = lane?.at(position);
    if (frame) this.#run(context, lane, frame, position);
    this.#ends(context);
    if (this.cursor) this.#cursor(context);
  }

  #map(context) {
    const { rows, cols, cells, closed } = this.scene, it = colours();
    const image = new ImageData(cols, rows);
    const tones = [rgb(it.free), rgb(it.closed), rgb(it.wall)];
    for (let i = 0; i < cells.length; i++) {
      const tone = tones[cells[i] ? 2 : closed?.[i] ? 1 : 0];
      image.data.set(tone, 4 * i);
      image.data[4 * i + 3] = 255;
    }
    this.small ??= document.createElement("canvas");
    Object.assign(this.small, { width: cols, height: rows });
    this.small.getContext("2d").putImageData(image, 0, 0);
    context.imageSmoothingEnabled = this.cell < 1;
    context.drawImage(this.small, 0, 0, this.width, this.height);
    if (this.cell < LINED) {
      context.strokeStyle = it.faint;
      context.strokeRect(0.5, 0.5, this.width - 1, this.height - 1);
      return;
    }
    context.strokeStyle = it.faint;
    context.lineWidth = 1;
    context.beginPath();
    for (let c = 0; c <= cols; c++) { const x = Math.min(c * this.cell + 0.5, this.width - 0.5); context.moveTo(x, 0); context.lineTo(x, this.height); }
    for (let r = 0; r <= rows; r++) { const y = Math.min(r * this.cell + 0.5, this.height - 0.5); context.moveTo(0, y); context.lineTo(this.width, y); }
    context.stroke();
  }

  #run(context, lane, frame, position) {
    const it = colours(), thick = this.cell >= 12 ? 4 : 3;
    const over = lane.isAnswerAt(position), front = lane.frontAt(position);
    context.lineJoin = context.lineCap = "round";
    context.globalAlpha = over ? VEIL / 2 : VEIL;
    context.strokeStyle = it.crowd;
    context.lineWidth = thick * 0.6;
    for (const path of frame.paths) this.#line(context, path);
    if (front) {
      context.globalAlpha = 0.6;
      context.lineWidth = thick * 0.5;
      for (const path of front.paths) this.#line(context, path);
    }
    context.globalAlpha = 1;
    const path = (front && front.paths[lane.chosen ?? front.knee]) || (over && lane.answer.path.length ? lane.answer.path : frame.best);
    const settled = over && lane.answer.path.length > 0;
    const curve = over && !front && lane.answer.curve.length ? lane.answer.curve : null;
    if (curve) {
      context.globalAlpha = 0.5;
      this.#bold(context, path, it.crowd, thick * 0.6, it);
      context.globalAlpha = 1;
      this.#bold(context, curve, it.path, thick, it, ([row, col]) => this.place([row, col]), false);
    } else this.#bold(context, path, settled || front ? it.path : it.best, thick, it);
  }

  #bold(context, path, colour, thick, it, place = id => this.#of(id), nodes = true) {
    if (path.length < 2) return;
    for (const [width, stroke] of [[thick + 3, it.ground], [thick, colour]]) {
      context.strokeStyle = stroke;
      context.lineWidth = width;
      this.#line(context, path, place);
    }
    if (!nodes || this.cell < 8 || path.length > 80) return;
    context.fillStyle = colour;
    for (const id of path) {
      const [x, y] = place(id);
      context.beginPath();
      context.arc(x, y, thick * 0.95, 0, 2 * Math.PI);
      context.fill();
    }
  }

  #of(id) { return this.place([Math.floor(id / this.scene.cols), id % this.scene.cols]); }

  #line(context, path, place = id => this.#of(id)) {
    context.beginPath();
    for (let k = 0; k < path.length; k++) {
      const [x, y] = place(path[k]);
      if (k) context.lineTo(x, y); else context.moveTo(x, y);
    }
    context.stroke();
  }

  get radius() { return Math.max(9, Math.min(13, this.cell * 0.48)); }

  #disc(end) {
    const [x, y] = this.place(this.scene[end]), r = this.radius;
    const within = (at, length) => Math.min(Math.max(at, r + 1), Math.max(length - r - 1, r + 1));
    return [within(x, this.width), within(y, this.height), r];
  }

  #ends(context) {
    const it = colours();
    for (const [end, letter] of [["start", "S"], ["goal", "G"]]) {
      const [x, y, r] = this.#disc(end);
      context.fillStyle = it[end];
      context.strokeStyle = it.ground;
      context.lineWidth = 2;
      context.beginPath();
      context.arc(x, y, r, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
      context.fillStyle = "#fff";
      context.font = `600 ${Math.round(r * 1.15)}px system-ui, sans-serif`;
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.fillText(letter, x, y + 0.5);
    }
  }

  #cursor(context) {
    const [x, y] = this.place(this.cursor), half = Math.max(this.cell, 8) / 2;
    context.strokeStyle = colours().ink;
    context.lineWidth = 2;
    context.setLineDash([4, 3]);
    context.strokeRect(x - half, y - half, 2 * half, 2 * half);
    context.setLineDash([]);
  }

  // Drawing

  #cellAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const clamp = (value, most) => Math.min(Math.max(Math.floor(value / this.cell), 0), most - 1);
    this.finger = [event.clientX - box.left, event.clientY - box.top];
    return [clamp(this.finger[1], this.scene.rows), clamp(this.finger[0], this.scene.cols)];
  }

  #press(event) {
    if (event.button > 2 || !event.isPrimary) return;
    const cell = this.#cellAt(event), [x, y] = this.finger;
    this.canvas.setPointerCapture(event.pointerId);
    const near = event.pointerType === "touch" ? 10 : 3;
    this.held = ["goal", "start"].find(end => { const [ex, ey, r] = this.#disc(end); return Math.hypot(ex - x, ey - y) <= r + near; });
    if (this.held) return;
    const { tool, brush } = this.pen();
    this.wall = tool === "draw" && event.button === 0;
    this.scene.remember();
    this.at = cell;
    this.scene.stroke(cell, cell, this.wall, brush);
  }

  #move(event) {
    if (!this.held && !this.at) return;
    const cell = this.#cellAt(event);
    if (this.held) this.scene.put(this.held, cell);
    else if (String(cell) !== String(this.at)) {
      this.scene.stroke(this.at, cell, this.wall, this.pen().brush);
      this.at = cell;
    }
  }

  #lift() { this.held = this.at = null; }

  #key(event) {
    const step = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key];
    const { scene } = this;
    this.cursor ??= [...scene.start];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (step) {
      const far = event.shiftKey ? 5 : 1;
      this.cursor = [0, 1].map(k => Math.min(Math.max(this.cursor[k] + far * step[k], 0), [scene.rows, scene.cols][k] - 1));
      this.onlook?.();
    } else if (event.key === " " || event.key === "Enter") {
      scene.remember();
      scene.stroke(this.cursor, this.cursor, !scene.isWall(this.cursor), this.pen().brush);
    } else if (event.key === "s" || event.key === "g") scene.put(event.key === "s" ? "start" : "goal", [...this.cursor]);
    else return;
    this.finger = this.place(this.cursor);
    event.preventDefault();
    event.stopPropagation();
  }
}
