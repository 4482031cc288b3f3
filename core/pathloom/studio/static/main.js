// The page put together: one scene, up to two planners on it, one clock.

import { Bubble } from "./bubble.js";
import { fromBase64, unpack } from "./bits.js";
import { CHARTS, Chart } from "./charts.js";
import { PlannerForm } from "./forms.js";
import { FrontChart } from "./front.js";
import { Lane } from "./lane.js";
import { forgetColours, shown } from "./pen.js";
import { Player } from "./player.js";
import * as save from "./save.js";
import { Scene } from "./scene.js";
import { Live, ask } from "./server.js";
import { contentOf, linkTo } from "./share.js";
import { Stage } from "./stage.js";

const $ = id => document.getElementById(id);
const PLANNERS = ["imga/imga", "agacd/agacd"];
const FIRST_MAP = "blocks-30:25%";

if (location.search) history.replaceState(null, "", location.pathname + location.hash); // the cookie has the token now

const scene = new Scene(), live = new Live();
const lanes = [0, 1].map(index => new Lane(index, live));
const player = new Player(lanes);
const views = lanes.map(view);
const charts = CHARTS.map(what => new Chart(what, $("charts"), number => player.seek(number)));
const fronts = lanes.map(lane => new FrontChart(lane, $("charts"), redraw));
let forms = [], fault = null, looked = 0, dirty = true;

// Views

function view(lane) {
  const figure = document.createElement("figure");
  figure.className = "stage";
  figure.dataset.lane = lane.index;
  figure.innerHTML = `<figcaption><span class="name"></span><span class="status quiet"></span>
    <details class="menu"><summary>Save</summary><div>
      <button type="button" data-save="config">Config (TOML)</button>
      <button type="button" data-save="map">Map</button>
      <button type="button" data-save="path">Path (CSV)</button>
      <button type="button" data-save="result">Result (JSON)</button>
      <button type="button" data-save="picture">Picture (PNG)</button>
    </div></details></figcaption>
    <div class="ground"><canvas></canvas></div><p class="answer quiet"></p>`;
  $("stages").append(figure);
  const find = selector => figure.querySelector(selector);
  const stage = new Stage(find("canvas"), scene, () => ({
    tool: document.querySelector("input[name=tool]:checked").value, brush: Number($("brush").value),
  }));
  stage.onlook = redraw;
  const menu = find(".menu");
  menu.addEventListener("click", event => { if (event.target.dataset.save) { menu.open = false; saveFrom(lane, event.target.dataset.save); } });
  return { lane, figure, stage, menu, bubble: new Bubble(find(".ground")), name: find(".name"), status: find(".status"), answer: find(".answer") };
}

const comparing = () => $("compare").checked;
const inUse = () => comparing() ? views : views.slice(0, 1);
const asked = lane => ({ scene: scene.asked, planner: forms[lane.index].table, seed: Number($("seed").value) || 0 });

function lay() {
  const two = comparing();
  $("view").classList.toggle("two", two);
  views[1].figure.hidden = !two;
  if (forms[1]) forms[1].box.hidden = !two;
  for (const { stage, figure } of inUse()) {
    const width = figure.clientWidth, most = Math.max(300, Math.min(width, window.innerHeight * (two ? 0.6 : 0.66)));
    stage.fit(width, most);
  }
  redraw();
}

function redraw() { dirty = true; }

function draw() {
  requestAnimationFrame(draw);
  if (!dirty) return;
  dirty = false;
  for (const { stage, lane } of inUse()) stage.draw(lane.run === undefined ? null : lane, player.position);
  const used = inUse().map(({ lane }) => lane);
  for (const chart of charts) chart.draw(used, player.position, player.reached);
  fronts.forEach((front, index) => front.draw(index && !comparing() ? -1 : player.position));
  if (!comparing()) fronts[1].figure.hidden = true;
  transport();
  inUse().forEach(words);
}

function transport() {
  const { hasRun, isAtEnd, playing, position, reached: last } = player;
  $("run").textContent = playing ? "Pause" : !hasRun ? "Run" : isAtEnd ? "Run again" : "Go on";
  $("run").disabled = $("step").disabled = forms.length === 0 || !live.isOpen;
  if (isAtEnd) $("step").disabled = true;
  Object.assign($("scrub"), { max: last, value: position, disabled: !hasRun || last === 0 });
  const limits = player.active.map(lane => lane.over ? lane.last : lane.begun?.generations ?? 0);
  const of = Math.max(last, ...limits);
  $("generation").textContent = hasRun ? `generation ${position}${of ? ` of ${of}` : ""}` : "no run yet";
}

function words({ lane, name, status, answer }) {
  const said = text => { if (answer.textContent !== text) answer.textContent = text; };
  name.textContent = forms[lane.index]?.name ?? "";
  const frame = lane.at(player.position);
  status.textContent = lane.compiling ? `compiling kernels, once: ${lane.compiling.done} of ${lane.compiling.all}`
    : lane.isRunning && !frame ? "begins …"
    : frame ? `${frame.individuals} individuals, ${frame.paths.length} different, ${frame.evaluations} evaluations` : "";
  if (lane.fault) return said(["start", "goal"].includes(lane.fault.where) ? "" : lane.fault.message);
  if (!frame) return said("");
  const objectives = Object.entries(frame.values).map(([label, value]) => `${label} ${shown(value, 3)}`).join(", ");
  if (!lane.isAnswerAt(player.position)) return said(frame.best.length ? `Best so far: ${shown(frame.length, 3)} cells long; ${objectives}` : "No path yet.");
  const { result } = lane.answer;
  if (result.status !== "found") return said(`No path: ${result.reason}.`);
  if (lane.answer.front) return said(`${lane.answer.front.values.length} trade-offs, each proven free: choose one by its dot.`);
  const gap = result.gap?.any_angle;
  const against = gap === null || gap === undefined ? "" : gap < 1e-9 ? "; no path is shorter" : `; ${shown(100 * gap, 2)} % longer than the shortest path there is`;
  said(`Answer, proven free: ${shown(result.metrics.length, 3)} cells long, ${result.metrics.turns} turns${against}.`);
}

let told = null;
function tell(text) {
  clearTimeout(told);
  $("note").textContent = text;
  $("note").hidden = !text;
  told = setTimeout(() => { $("note").hidden = true; }, 8000);
}

// Running

function begin() {
  player.reset();
  for (const { lane } of views) lane.reset();
  for (const { lane, bubble } of inUse()) {
    bubble.hide();
    forms[lane.index].say("");
    lane.begin(asked(lane));
  }
}

function forget() {
  if (!player.hasRun) return;
  for (const lane of lanes) lane.reset();
  player.reset();
  redraw();
}

function runOrPause() {
  if ($("run").disabled) return;
  if (player.playing) { player.pause(); return; }
  if (fault) { complain(); return; }
  if (!player.hasRun || player.isAtEnd || player.active.some(lane => lane.fault)) begin();
  player.play();
}

function step() {
  if ($("step").disabled) return;
  if (fault) { complain(); return; }
  const fresh = !player.hasRun;
  if (fresh) begin();
  player.step(fresh ? 0 : player.position + 1);
}

// Show what is wrong with start or goal where the finger last was, or at the end in question.
function complain() {
  for (const { stage, bubble } of inUse()) {
    if (!fault) { bubble.hide(); continue; }
    const at = stage.finger ?? stage.place(scene[fault.where] ?? scene.goal);
    bubble.say(sentence(fault.message), at);
    stage.canvas.setAttribute("aria-description", fault.message);
  }
}

const sentence = text => `${text[0].toUpperCase()}${text.slice(1)}.`;

async function look() {
  const number = ++looked;
  let seen;
  try {
    seen = await ask("/look", scene.asked);
  } catch (error) {
    seen = { fault: { where: error.where, message: error.message }, closed: null };
  }
  if (number !== looked) return;
  scene.closed = seen.closed && unpack(fromBase64(seen.closed), scene.rows * scene.cols);
  fault = seen.fault;
  complain();
  redraw();
}

let waiting = null;
scene.addEventListener("change", ({ detail }) => {
  forget();
  $("undo").disabled = !scene.canUndo;
  Object.assign($("corners"), { value: scene.corners });
  if (document.activeElement !== $("radius")) $("radius").value = scene.radius;
  if (detail.size) { for (const { stage } of views) stage.finger = stage.cursor = null; lay(); }
  for (const { stage } of views) stage.canvas.setAttribute("aria-label",
    `Map of ${scene.rows} rows and ${scene.cols} columns, start ${scene.start.join(", ")}, goal ${scene.goal.join(", ")}`);
  clearTimeout(waiting);
  waiting = setTimeout(look, 60);
  redraw();
});

live.addEventListener("message", ({ data }) => {
  if (data.run === null || data.run === undefined) { if (data.message) tell(data.message); return; }
  lanes[data.lane].hear(data);
});
live.addEventListener("open", () => { $("banner").hidden = true; redraw(); });
live.addEventListener("close", ({ detail }) => {
  player.pause();
  for (const lane of lanes) if (lane.isRunning) lane.fault = { where: "", message: "The connection broke off." };
  $("banner").textContent = detail || "The studio has ended. Start it again with `pathloom studio`, and open the address that it prints.";
  $("banner").hidden = false;
  redraw();
});
for (const lane of lanes) lane.addEventListener("change", () => {
  if (lane.fault) {
    player.pause();
    if (["start", "goal"].includes(lane.fault.where)) { fault = lane.fault; complain(); }
    else if (lane.fault.where === "planner") forms[lane.index].say(lane.fault.message);
  }
  if (lane.answer) $("said").textContent = `${forms[lane.index].name} has ended: ${lane.answer.result.status}`;
  redraw();
});
player.addEventListener("change", () => { transport(); redraw(); });

// Saving and sharing

async function saveFrom(lane, what) {
  const view_ = views[lane.index], answer = lane.answer;
  try {
    if (what === "config") tell(await save.saveConfig(asked(lane)));
    else if (what === "map") tell(await save.saveMap(asked(lane)));
    else if (what === "picture") save.savePicture(view_.stage.canvas);
    else if (!answer) tell("There is no answer yet: let the run come to its end.");
    else if (what === "result") save.saveResult(answer);
    else if (answer.path.length) save.savePath(chosenPath(lane), scene.cols);
    else tell("There is no path to save.");
  } catch (error) { tell(error.message); }
}

function chosenPath(lane) {
  const front = lane.answer.front;
  return (lane.chosen !== null && front?.paths[lane.chosen]) || lane.answer.path;
}

async function share() {
  const planners = inUse().map(({ lane }) => forms[lane.index].table);
  const link = await linkTo({ scene: scene.asked, planners, seed: Number($("seed").value) || 0 });
  history.replaceState(null, "", new URL(link).hash);
  try {
    await navigator.clipboard.writeText(link);
    tell("The link is copied: map, planners and seed are in it.");
  } catch { tell("The address of this page now holds map, planners and seed."); }
}

async function take(fragment) {
  let content;
  try { content = await contentOf(fragment); } catch (error) { tell(error.message); return false; }
  if (!content) return false;
  const { map, start, goal, corners, radius, name } = content.scene;
  Object.assign(scene, {
    corners: ["strict", "no-squeeze", "allow"].includes(corners) ? corners : "strict",
    radius: typeof radius === "number" && radius >= 0 ? radius : 0,
  });
  $("seed").value = content.seed;
  $("compare").checked = content.planners.length > 1;
  content.planners.slice(0, 2).forEach((table, index) => forms[index].use(table));
  scene.take(map, typeof name === "string" ? name : "", { start, goal });
  return true;
}

// Maps

async function takeMap(name) {
  try {
    const found = await ask("/map", { name, corners: scene.corners });
    scene.take(found.map, found.name);
    tell("");
  } catch (error) { tell(error.message); }
}

function mapName() {
  const family = $("map-name").selectedOptions[0]?.dataset.family === "true";
  if (!family) return $("map-name").value;
  const parts = [`${$("map-name").value}-${$("map-size").value || 30}`];
  if ($("map-obstacles").value.trim()) parts.push($("map-obstacles").value.trim());
  if (Number($("map-seed").value)) parts.push(`s${Number($("map-seed").value)}`);
  return parts.join(":");
}

async function openFiles(list) {
  if (!list.length) return;
  try {
    const files = {};
    for (const file of list) files[file.name] = await base64(file);
    const found = await ask("/files", { files });
    scene.take(found.map, "");
    tell(found.note || `Read ${list[0].name}: ${found.map.rows} × ${found.map.cols} cells.`);
  } catch (error) { tell(error.message); }
  $("map-file").value = "";
}

function base64(file) {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result.slice(reader.result.indexOf(",") + 1));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(file);
  });
}

// Theme

const THEMES = ["auto", "light", "dark"];
function wear(theme) {
  if (theme === "auto") delete document.documentElement.dataset.theme; else document.documentElement.dataset.theme = theme;
  $("theme").textContent = `Theme: ${theme}`;
  localStorage.setItem("theme", theme);
  forgetColours();
  redraw();
}
$("theme").addEventListener("click", () => wear(THEMES[(THEMES.indexOf(localStorage.getItem("theme")) + 1) % 3]));
wear(THEMES.includes(localStorage.getItem("theme")) ? localStorage.getItem("theme") : "auto");
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { forgetColours(); redraw(); });

// Controls

$("run").addEventListener("click", runOrPause);
$("step").addEventListener("click", step);
$("scrub").addEventListener("input", () => player.seek(Number($("scrub").value)));
$("speed").addEventListener("change", () => { player.speed = Number($("speed").value); });
$("undo").addEventListener("click", () => scene.undo());
$("clear").addEventListener("click", () => scene.clear());
$("compare").addEventListener("change", () => { forget(); lay(); complain(); });
$("share").addEventListener("click", share);
$("seed").addEventListener("change", forget);
$("corners").addEventListener("change", () => scene.set({ corners: $("corners").value }));
$("radius").addEventListener("change", () => scene.set({ radius: Math.max(0, Number($("radius").value) || 0) }));
$("map-take").addEventListener("click", () => takeMap(mapName()));
$("map-open").addEventListener("click", () => $("map-file").click());
$("map-file").addEventListener("change", () => openFiles([...$("map-file").files]));
$("map-name").addEventListener("change", () => {
  const family = $("map-name").selectedOptions[0].dataset.family === "true";
  $("family-row").hidden = !family;
  $("map-size").disabled = !family;
  takeMap(mapName());
});
document.addEventListener("dragover", event => event.preventDefault());
document.addEventListener("drop", event => { event.preventDefault(); openFiles([...event.dataTransfer.files]); });
document.addEventListener("keydown", event => {
  const typing = event.target.closest("input:not([type=range], [type=checkbox], [type=radio]), select, textarea");
  if (event.key === "Escape") for (const { menu } of views) menu.open = false;
  if ((event.ctrlKey || event.metaKey) && event.key === "z" && !typing) { event.preventDefault(); scene.undo(); return; }
  if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "p") runOrPause();
  else if (event.key === ".") step();
});
document.addEventListener("pointerdown", event => { for (const { menu } of views) if (!menu.contains(event.target)) menu.open = false; });
window.addEventListener("hashchange", () => take(location.hash));
window.addEventListener("resize", lay);
new ResizeObserver(lay).observe($("view"));

// Beginning

async function start() {
  live.open();
  requestAnimationFrame(draw);
  const first = location.hash ? null : takeMap(FIRST_MAP);
  const catalogue = await ask("/catalogue");
  $("waiting").remove();
  forms = lanes.map((_, index) => new PlannerForm(index, catalogue, $("planners"), forget));
  forms.forEach((form, index) => form.use(PLANNERS[index]));
  for (const { name, family, about } of catalogue.maps) {
    const option = new Option(name, name, name === "blocks", name === "blocks");
    option.dataset.family = family;
    option.title = about;
    $("map-name").append(option);
  }
  $("map-obstacles").value = "25%";
  await first;
  if (location.hash && !(await take(location.hash))) await takeMap(FIRST_MAP);
  lay();
  document.documentElement.dataset.ready = "";
}

start().catch(error => { $("banner").textContent = error.message; $("banner").hidden = false; });
