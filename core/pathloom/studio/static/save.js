// Taking things out of the page: config, map, path, result, picture.

import { ask } from "./server.js";

function download(name, content, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export async function saveConfig(asked) {
  const saved = await ask("/config", asked);
  download("studio.toml", saved.toml, "application/toml");
  return saved.map_file ? `studio.toml reads ${saved.map_file}, which is to lie beside it: save the map as well.` : "";
}

export async function saveMap(asked) {
  const saved = await ask("/config", asked);
  if (!saved.map_file) return `The map has a name, ${asked.scene.name}: the config does without a file.`;
  download(saved.map_file, saved.map, "text/plain");
  return "";
}

export function savePath(path, cols) {
  const lines = path.map(id => `${Math.floor(id / cols)},${id % cols}`);
  download("path.csv", ["row,col", ...lines, ""].join("\n"), "text/csv");
}

export function saveResult(answer) {
  download("result.json", `${JSON.stringify(answer.result)}\n`, "application/json");
}

export function savePicture(canvas) {
  canvas.toBlob(blob => download("studio.png", blob), "image/png");
}
