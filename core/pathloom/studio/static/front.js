// A front: trade-offs between two objectives at a time, each to be clicked for its path.

import { extent } from "./charts.js";
import { colours, sharp, shown } from "./pen.js";

const LEFT = 52, RIGHT = 14, TOP = 12, BOTTOM = 34;

export class FrontChart {
  constructor(lane, parent, onchoose) {
    Object.assign(this, { lane, onchoose, axes: [0, 1], position: 0 });
    this.figure = document.createElement("figure");
    this.figure.className = "chart front";
    this.figure.hidden = true;
    const caption = document.createElement("figcaption");
    const title = document.createElement("strong");
    title.textContent = "Trade-offs: each is a path";
    this.choices = document.createElement("span");
    caption.append(title, this.choices);
    this.canvas = document.createElement("canvas");
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "slider");
    this.canvas.setAttribute("aria-label", "Trade-off; left and right choose");
    this.words = document.createElement("p");
    this.words.className = "quiet";
    this.words.setAttribute("role", "status");
    this.figure.append(caption, this.canvas, this.words);
    parent.append(this.figure);
    this.canvas.addEventListener("pointerdown", event => this.#click(event));
    this.canvas.addEventListener("keydown", event => this.#key(event));
  }

  get front() { return this.lane.frontAt(this.position); }

  draw(position) {
    this.position = position;
    const { front } = this;
    this.figure.hidden = !front || !front.values.length;
    if (this.figure.hidden) return;
    this.#offer(this.lane.begun.objectives);
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight, it = colours();
    const context = sharp(this.canvas, width, height);
    const [h, v] = this.axes, ranges = this.axes.map(axis => extent(front.values.map(values => values[axis])));
    this.places = front.values.map(values => [
      LEFT + (width - LEFT - RIGHT) * (values[h] - ranges[0][0]) / (ranges[0][1] - ranges[0][0]),
      TOP + (height - TOP - BOTTOM) * (1 - (values[v] - ranges[1][0]) / (ranges[1][1] - ranges[1][0])),
    ]);
    this.#axes(context, width, height, ranges, it);
    const chosen = this.lane.chosen ?? front.knee;
    this.places.forEach(([x, y], number) => {
      if (number === chosen) return;
      context.fillStyle = it.crowd;
      context.globalAlpha = 0.85;
      context.beginPath();
      context.arc(x, y, 5, 0, 2 * Math.PI);
      context.fill();
    });
    context.globalAlpha = 1;
    const at = this.places[chosen];
    if (at) {
      context.fillStyle = it.path;
      context.strokeStyle = it.ink;
      context.lineWidth = 2;
      context.beginPath();
      context.arc(...at, 8, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
    const named = this.lane.begun.objectives.map((label, k) => `${label} ${shown(Math.abs(front.values[chosen]?.[k]), 3)}`);
    const which = this.lane.chosen === null ? "knee" : `${chosen + 1} of ${front.values.length}`;
    const said = `${which}: ${named.join(", ")}`;
    if (this.words.textContent !== said) this.words.textContent = said;
    this.canvas.setAttribute("aria-valuenow", String(chosen + 1));
    this.canvas.setAttribute("aria-valuemin", "1");
    this.canvas.setAttribute("aria-valuemax", String(front.values.length));
    this.canvas.setAttribute("aria-valuetext", said);
  }

  #offer(labels) {
    if (String(labels) === this.offered) return;
    this.offered = String(labels);
    this.axes = [0, Math.min(1, labels.length - 1)];
    this.choices.replaceChildren(...["across", "up"].map((word, k) => {
      const label = document.createElement("label"), select = document.createElement("select");
      select.append(...labels.map((name, number) => new Option(name, number, number === this.axes[k], number === this.axes[k])));
      select.addEventListener("change", () => { this.axes[k] = Number(select.value); this.onchoose(); });
      label.append(word, select);
      return label;
    }));
  }

  #axes(context, width, height, ranges, it) {
    const [h, v] = this.axes, labels = this.lane.begun.objectives;
    context.strokeStyle = it.faint;
    context.lineWidth = 1;
    context.strokeRect(LEFT + 0.5, TOP + 0.5, width - LEFT - RIGHT - 1, height - TOP - BOTTOM - 1);
    context.fillStyle = it.quiet;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "right";
    for (const share of [0, 1]) context.fillText(shown(ranges[1][share]), LEFT - 6, share ? TOP + 8 : height - BOTTOM);
    context.textAlign = "left";
    context.fillText(shown(ranges[0][0]), LEFT, height - BOTTOM + 14);
    context.textAlign = "right";
    context.fillText(shown(ranges[0][1]), width - RIGHT, height - BOTTOM + 14);
    context.textAlign = "center";
    context.fillText(labels[h], (LEFT + width - RIGHT) / 2, height - 6);
    context.save();
    context.translate(12, (TOP + height - BOTTOM) / 2);
    context.rotate(-Math.PI / 2);
    context.fillText(labels[v], 0, 0);
    context.restore();
  }

  #click(event) {
    const box = this.canvas.getBoundingClientRect();
    const far = this.places.map(([x, y]) => Math.hypot(x - event.clientX + box.left, y - event.clientY + box.top));
    const nearest = far.indexOf(Math.min(...far));
    if (far[nearest] < 40) this.#choose(nearest);
  }

  #key(event) {
    const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const order = this.places.map((_, k) => k).sort((a, b) => this.places[a][0] - this.places[b][0] || a - b);
    const at = order.indexOf(this.lane.chosen ?? this.front.knee);
    this.#choose(order[Math.min(Math.max(at + step, 0), order.length - 1)]);
  }

  #choose(number) {
    this.lane.chosen = number;
    this.onchoose();
  }
}
