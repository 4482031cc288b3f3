// Small line charts over generations. Of two planners the first is drawn solid, the second dashed.

import { colours, sharp, shown } from "./pen.js";

const LEFT = 52, RIGHT = 8, TOP = 8, BOTTOM = 18;

// What is drawn: `lines` gives, for a lane's frames, pairs of [colour, values]; `bands` a low and a high line.
export const CHARTS = [
  { title: "Length of the best path", key: [], unit: "cells", own: true, lines: frames => [["lane", frames.map(f => f.length)]] },
  { title: "Fitness", key: [["best", "best"], ["quiet", "mean"]], scaled: true,
    lines: frames => [["quiet", frames.map(f => f.mean)], ["best", frames.map(f => f.fitness)]] },
  { title: "Operator probabilities", key: [["path", "crossover"], ["mean", "mutation"]], range: [0, 1],
    lines: frames => [["path", frames.map(f => f.rates.crossover?.[1])], ["mean", frames.map(f => f.rates.mutation?.[1])]],
    bands: frames => [["path", frames.map(f => f.rates.crossover)], ["mean", frames.map(f => f.rates.mutation)]] },
  { title: "Diversity", key: [], unit: "share of distinct individuals", own: true, range: [0, 1], lines: frames => [["lane", frames.map(f => f.diversity)]] },
];

export class Chart {
  constructor(what, parent, onseek) {
    this.what = what;
    this.figure = document.createElement("figure");
    this.figure.className = "chart";
    this.caption = document.createElement("figcaption");
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.figure.append(this.caption, this.canvas);
    parent.append(this.figure);
    const seek = event => {
      if (event.type === "pointermove" && !event.buttons) return;
      const box = this.canvas.getBoundingClientRect();
      const share = (event.clientX - box.left - LEFT) / (box.width - LEFT - RIGHT);
      if (this.most) onseek(Math.round(Math.min(Math.max(share, 0), 1) * this.most));
    };
    this.canvas.addEventListener("pointerdown", seek);
    this.canvas.addEventListener("pointermove", seek);
  }

  draw(lanes, position, reached) {
    const { what } = this, it = colours();
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width) return;
    const context = sharp(this.canvas, width, height);
    const used = lanes.filter(lane => lane.frames.length);
    const most = used.map(lane => lane.over ? lane.last : lane.begun?.generations ?? 0);
    this.most = Math.max(1, ...(reached * 4 < Math.max(...most) ? [reached * 2] : most), reached); // room to grow, not all of it at once
    const seen = lane => lane.frames.slice(0, reached + 1);
    const lines = used.flatMap(lane => what.lines(seen(lane)).map(([colour, values]) => ({ lane, colour: this.#colour(colour, lane), values })));
    const optimum = what.own && !what.range ? used.map(lane => lane.isAnswerAt(reached) && lane.answer.result.optimum?.any_angle).find(Boolean) : undefined;
    this.#caption(lanes, used, position, optimum);
    const relative = what.scaled && used.length > 1;
    const range = what.range ?? extent([...lines.flatMap(line => line.values), optimum]);
    const x = k => LEFT + (width - LEFT - RIGHT) * k / this.most;
    const y = (value, [low, high]) => TOP + (height - TOP - BOTTOM) * (1 - (value - low) / (high - low || 1));
    this.#axes(context, width, height, relative || !used.length ? null : range, y, it);
    for (const lane of used) {
      for (const [colour, triples] of what.bands?.(seen(lane)) ?? []) this.#band(context, triples, x, v => y(v, range), it[colour]);
    }
    if (optimum !== undefined) {
      context.strokeStyle = it.optimum;
      context.lineWidth = 1.5;
      context.setLineDash([2, 3]);
      this.#path(context, [[x(0), y(optimum, range)], [x(this.most), y(optimum, range)]]);
      context.setLineDash([]);
    }
    for (const { lane, colour, values } of lines) {
      const own = relative ? extent(lines.filter(line => line.lane === lane).flatMap(line => line.values)) : range;
      context.strokeStyle = colour;
      context.lineWidth = 2;
      context.setLineDash(lane.index ? [6, 4] : []);
      this.#path(context, values.map((value, k) => value === null || value === undefined ? null : [x(k), y(value, own)]));
      context.setLineDash([]);
    }
    if (used.length) {
      context.strokeStyle = it.ink;
      context.globalAlpha = 0.35;
      context.lineWidth = 1;
      this.#path(context, [[x(Math.min(position, this.most)), TOP], [x(Math.min(position, this.most)), height - BOTTOM]]);
      context.globalAlpha = 1;
    }
  }

  #colour(name, lane) { return colours()[name === "lane" ? (lane.index ? "mean" : "path") : name]; }

  #caption(lanes, used, position, optimum) {
    const { what } = this;
    const values = used.map(lane => what.own ? what.lines([lane.at(position)])[0][1][0] : undefined);
    const now = what.own ? values.map(value => shown(value, what.range ? 2 : 3)).join(" · ") : "";
    const text = `${what.title}|${now}|${optimum}|${used.length}`;
    if (text === this.said) return;
    this.said = text;
    const title = document.createElement("strong");
    title.textContent = what.title;
    const rest = document.createElement("span");
    rest.className = "quiet";
    rest.append(now);
    const keys = [...what.key, ...(optimum === undefined ? [] : [["optimum", "shortest there is"]])];
    for (const [colour, word] of keys) {
      const key = document.createElement("span");
      key.className = `key${colour === "optimum" ? " dashed" : ""}`;
      const line = document.createElement("i");
      line.style.borderTopColor = `var(--${colour})`;
      key.append(line, word);
      rest.append(key);
    }
    this.caption.replaceChildren(title, rest);
    this.canvas.setAttribute("aria-label", `${what.title} over generations${now ? `: ${now} ${what.unit}` : ""}`);
  }

  #axes(context, width, height, range, y, it) {
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = it.quiet;
    context.strokeStyle = it.faint;
    context.lineWidth = 1;
    context.textBaseline = "middle";
    context.textAlign = "right";
    for (const share of [0, 0.5, 1]) {
      const at = Math.round(TOP + (height - TOP - BOTTOM) * (1 - share)) + 0.5;
      this.#path(context, [[LEFT, at], [width - RIGHT, at]]);
      if (range) context.fillText(shown(range[0] + share * (range[1] - range[0])), LEFT - 6, at);
    }
    if (!range && this.most > 1) for (const [k, word] of ["each on", "its own", "scale"].entries()) context.fillText(word, LEFT - 6, TOP + 24 + 14 * k);
    context.textBaseline = "alphabetic";
    context.textAlign = "left";
    context.fillText("0", LEFT, height - 4);
    context.textAlign = "right";
    context.fillText(range || this.most > 1 ? `generation ${this.most}` : "generations", width - RIGHT, height - 4);
  }

  #band(context, triples, x, y, colour) {
    const there = triples.map((triple, k) => [k, triple]).filter(([, triple]) => triple);
    if (there.length < 2) return;
    context.fillStyle = colour;
    context.globalAlpha = 0.14;
    context.beginPath();
    for (const [k, [low]] of there) context.lineTo(x(k), y(low));
    for (const [k, [, , high]] of there.reverse()) context.lineTo(x(k), y(high));
    context.fill();
    context.globalAlpha = 1;
  }

  #path(context, points) {
    context.beginPath();
    let pen = false;
    for (const point of points) {
      if (!point) { pen = false; continue; }
      if (pen) context.lineTo(...point); else context.moveTo(...point);
      pen = true;
    }
    if (points.length === 1 && points[0]) context.lineTo(points[0][0] + 3, points[0][1]);
    context.stroke();
  }
}

export function extent(values) {
  const known = values.filter(value => typeof value === "number");
  if (!known.length) return [0, 1];
  const low = Math.min(...known), high = Math.max(...known);
  const room = (high - low || Math.abs(high) || 1) * 0.06;
  return [low - room, high + room];
}
