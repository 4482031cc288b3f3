// Speaking to the server: questions by HTTP, runs over one socket that is opened again when it breaks.

const AGAIN = 2000;

export class Refusal extends Error {
  constructor({ where, message }) {
    super(message);
    this.where = where;
  }
}

export async function ask(path, question) {
  const asked = question && { method: "POST", body: JSON.stringify(question), headers: { "Content-Type": "application/json" } };
  let answer;
  try {
    answer = await fetch(path, asked);
  } catch {
    throw new Refusal({ where: "", message: "the studio does not answer" });
  }
  if (answer.status === 403) throw new Refusal({ where: "", message: await answer.text() });
  const said = await answer.json();
  if (!answer.ok) throw new Refusal(said);
  return said;
}

export class Live extends EventTarget {
  #socket = null;

  open() {
    const socket = new WebSocket(`ws://${location.host}/live`);
    this.#socket = socket;
    socket.onopen = () => this.dispatchEvent(new Event("open"));
    socket.onmessage = event => this.dispatchEvent(new MessageEvent("message", { data: JSON.parse(event.data) }));
    socket.onclose = event => {
      this.dispatchEvent(new CustomEvent("close", { detail: event.reason }));
      setTimeout(() => this.open(), AGAIN);
    };
  }

  get isOpen() { return this.#socket?.readyState === WebSocket.OPEN; }

  send(message) {
    if (this.isOpen) this.#socket.send(JSON.stringify(message));
  }
}
