// Map and config in the fragment of an address, which no server ever sees: #studio1.DEFLATED-JSON

import { fromBase64, toBase64 } from "./bits.js";

const MARK = "#studio1.";
const LARGEST = 4_000_000; // characters of a link's content, unpacked

async function through(stream, bytes, most) {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts = [];
  for (let size = 0; ;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) { await reader.cancel(); throw new Error("too large"); }
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

export async function linkTo(content) {
  const bytes = new TextEncoder().encode(JSON.stringify(content));
  const packed = toBase64(await through(new CompressionStream("deflate-raw"), bytes, Infinity));
  return `${location.origin}/${MARK}${packed.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

// What a fragment holds; null where it is none of ours. Throws where it is damaged.
export async function contentOf(fragment) {
  if (!fragment.startsWith(MARK)) return null;
  try {
    const bytes = fromBase64(fragment.slice(MARK.length).replaceAll("-", "+").replaceAll("_", "/"));
    const content = JSON.parse(new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes, LARGEST)));
    const { scene, planners, seed } = content;
    const cell = place => Array.isArray(place) && place.length === 2 && place.every(Number.isInteger);
    const side = length => Number.isInteger(length) && length >= 1 && length <= 1024;
    const whole = scene && side(scene.map.rows) && side(scene.map.cols) && cell(scene.start) && cell(scene.goal)
      && fromBase64(scene.map.bits).length === Math.ceil(scene.map.rows * scene.map.cols / 8);
    if (!whole || !Array.isArray(planners) || !planners.every(table => typeof table?.use === "string") || !Number.isInteger(seed)) throw new Error();
    return content;
  } catch {
    throw new Error("This link is damaged: no map and config can be read from it.");
  }
}
