// A message where the finger is: above it, so that the hand does not cover it, and within the map.

export class Bubble {
  constructor(ground) {
    this.box = document.createElement("p");
    this.box.className = "bubble";
    this.box.setAttribute("role", "alert");
    this.box.hidden = true;
    ground.append(this.box);
    this.ground = ground;
  }

  say(text, [x, y]) {
    this.box.textContent = text;
    this.box.hidden = false;
    const { clientWidth: width, clientHeight: height } = this.ground;
    const { offsetWidth: w, offsetHeight: h } = this.box;
    const above = y - h - 18;
    this.box.style.left = `${Math.min(Math.max(x - w / 2, 4), Math.max(width - w - 4, 4))}px`;
    this.box.style.top = `${above >= 4 ? above : Math.min(y + 22, Math.max(height - h - 4, 4))}px`;
  }

  hide() { this.box.hidden = true; }
}
