// Colours of the page's theme, and canvases as sharp as the screen.

let known = null;

export function colours() {
  if (known) return known;
  const style = getComputedStyle(document.documentElement);
  known = new Proxy({}, { get: (_, name) => style.getPropertyValue(`--${name}`).trim() });
  return known;
}

export function forgetColours() { known = null; }

export function rgb(colour) {
  const number = parseInt(colour.slice(1), 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

// Give a canvas this size in CSS pixels, and a context in them.
export function sharp(canvas, width, height) {
  const scale = Math.min(window.devicePixelRatio || 1, 3);
  const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
  if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
  const context = canvas.getContext("2d");
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}

export function shown(number, digits = 2) {
  if (number === null || number === undefined) return "–";
  if (number !== 0 && (Math.abs(number) >= 1e5 || Math.abs(number) < 1e-3)) return number.toExponential(2);
  return Math.abs(number) < 1 ? Number(number.toPrecision(digits + 1)).toString() : number.toFixed(digits).replace(/\.?0+$/, "");
}
