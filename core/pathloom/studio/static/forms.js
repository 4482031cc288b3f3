// Forms made of what components declare: a planner's table, as in a config file, edited in place.

const copy = value => structuredClone(value);
const last = name => name.split("/").pop();
const words = name => name.replaceAll("_", " ").replaceAll("-", " ");

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made && name !== "list") made[name] = value; else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

export class PlannerForm {
  #opened = new Set();
  #ids = 0;

  constructor(index, catalogue, parent, onchange) {
    Object.assign(this, { index, kinds: catalogue.components, onchange });
    this.box = element("section", { className: "card planner" });
    this.box.dataset.lane = index;
    parent.append(this.box);
  }

  // Choose a planner by name, or take a whole table.
  use(planner) {
    this.table = typeof planner === "string" ? copy(this.kinds.planner[planner].table ?? { use: planner }) : copy(planner);
    this.render();
  }

  get name() { return last(this.table.use); }
  get about() { return this.#form("planner", this.table.use); }

  say(fault) {
    this.fault.textContent = fault ?? "";
    this.fault.hidden = !fault;
  }

  #form(kind, name) {
    const all = this.kinds[kind] ?? {};
    return all[name] ?? Object.entries(all).find(([full]) => last(full) === last(name))?.[1];
  }

  render() {
    const focused = document.activeElement?.id;
    this.#ids = 0;
    const form = this.about;
    this.fault = element("p", { className: "fault", role: "alert", hidden: true });
    const select = this.#planners();
    const title = element("h2", {}, ["Planner A", "Planner B"][this.index]);
    this.box.replaceChildren(title, select, element("p", { className: "quiet about" }, form?.about ?? ""), this.fault);
    if (form) this.box.append(...this.#groups(form));
    if (focused) document.getElementById(focused)?.focus({ preventScroll: true });
  }

  #planners() {
    const select = element("select", { id: this.#id(), ariaLabel: `Planner ${"AB"[this.index]}` });
    const groups = Map.groupBy ? Map.groupBy(this.#usable(), ([, form]) => form.plugin) : grouped(this.#usable());
    for (const [plugin, planners] of groups) {
      const group = element("optgroup", { label: plugin });
      for (const [name, form] of planners) group.append(new Option(`${last(name)}${form.front ? " · front" : ""}`, name, false, name === this.table.use || last(name) === this.table.use));
      select.append(group);
    }
    select.addEventListener("change", () => { this.use(select.value); this.onchange(); });
    return select;
  }

  #usable() { return Object.entries(this.kinds.planner).filter(([, form]) => form.usable); }

  // Objectives first, then plain values, then operators.
  #groups(form) {
    const plain = form.fields.filter(field => field.form === "value");
    const terms = form.fields.filter(field => field.form === "terms");
    const slots = form.fields.filter(field => field.form.startsWith("slot"));
    const groups = [];
    const values = element("div", { className: "fields" }, ...plain.flatMap(field => this.#field(field, this.table, "")));
    if (plain.length) groups.push(values);
    for (const [title, fields, open] of [["Objectives and weights", terms, true], ["Operators", slots, false]]) {
      if (fields.length) groups.push(this.#group(title, fields.flatMap(field => this.#field(field, this.table, "")), open));
    }
    return groups;
  }

  #group(title, content, open) {
    const key = `group ${title}`;
    if (open && !this.#opened.has(`seen ${key}`)) this.#opened.add(key);
    this.#opened.add(`seen ${key}`);
    return this.#foldable(key, "group", title, content);
  }

  #foldable(key, className, title, content) {
    const details = element("details", { className, open: this.#opened.has(key) });
    details.append(element("summary", {}, title), element("div", { className: "fields" }, ...content));
    details.addEventListener("toggle", () => this.#opened[details.open ? "add" : "delete"](key));
    return details;
  }

  #id() { return `form-${this.index}-${this.#ids++}`; }

  #changed(render = false) {
    this.say("");
    if (render) this.render();
    this.onchange();
  }

  #field(field, table, path) {
    const here = path ? `${path}.${field.name}` : field.name;
    if (field.form === "slot") return [this.#slot(field, table, here)];
    if (field.form === "slots") return [this.#slots(field, table, here)];
    if (field.form === "terms") return [this.#terms(field, table, here)];
    return [this.#value(field, table, here)];
  }

  #row(field, input, ...more) {
    const label = element("label", { htmlFor: input.id, title: field.meaning }, words(field.name));
    return element("div", { className: "field", title: field.meaning }, label, input, ...more);
  }

  // Values

  #value(field, table, here) {
    const { schema } = field, current = table[field.name], id = this.#id();
    let input;
    if (schema.type === "boolean") {
      input = element("input", { id, type: "checkbox", checked: current === true });
      input.addEventListener("change", () => { table[field.name] = input.checked; this.#changed(); });
    } else if (schema.enum) {
      input = element("select", { id }, ...schema.enum.map(value => new Option(value, value, false, value === current)));
      input.addEventListener("change", () => { table[field.name] = schema.enum[input.selectedIndex]; this.#changed(); });
    } else {
      const numeric = schema.type === "integer" || schema.type === "number";
      input = element("input", { id, type: numeric ? "number" : "text", title: field.allowed });
      if (numeric) {
        input.step = schema.type === "integer" ? "1" : "any";
        if (schema.minimum !== undefined) input.min = schema.minimum;
        if (schema.maximum !== undefined && schema.maximum < 2 ** 31 - 1) input.max = schema.maximum;
      }
      input.value = Array.isArray(current) ? (current.some(Array.isArray) ? JSON.stringify(current) : current.join(", ")) : current ?? "";
      input.addEventListener("change", () => {
        const value = read(input.value, schema, field.optional);
        input.classList.toggle("wrong", value === undefined || !input.checkValidity());
        if (value === undefined) { this.say(`${words(field.name)} is ${field.allowed}`); return; }
        table[field.name] = value;
        this.#changed();
      });
    }
    return this.#row(field, input);
  }

  // Slots

  #choice(kind, current, optional, onchoose) {
    const select = element("select", { id: this.#id() });
    if (optional) select.append(new Option("none", "none", false, current === "none"));
    for (const name of Object.keys(this.kinds[kind] ?? {})) {
      const chosen = current?.use !== undefined && (name === current.use || last(name) === current.use);
      select.append(new Option(name, name, false, chosen));
    }
    select.addEventListener("change", () => onchoose(select.value));
    return select;
  }

  #fresh(kind, name, before) {
    if (name === "none") return "none";
    const form = this.#form(kind, name), table = copy(form.table ?? { use: name });
    for (const kept of form.keeps) if (before?.[kept] !== undefined) table[kept] = copy(before[kept]);
    return table;
  }

  #slot(field, table, here) {
    const select = this.#choice(field.kind, table[field.name], field.optional, name => {
      table[field.name] = this.#fresh(field.kind, name, table[field.name]);
      this.#changed(true);
    });
    const box = element("div", { className: "fields" }, this.#row(field, select));
    box.append(...this.#parts(field.kind, table[field.name], here));
    return box;
  }

  // The fields of a component, folded away.
  #parts(kind, table, here) {
    if (!table?.use) return [];
    const fields = (this.#form(kind, table.use)?.fields ?? []).flatMap(field => this.#field(field, table, here));
    return fields.length ? [this.#foldable(here, "part", `${last(table.use)}: settings`, fields)] : [];
  }

  #slots(field, table, here) {
    const list = Array.isArray(table[field.name]) ? table[field.name] : [];
    const members = list.map((member, number) => {
      const select = this.#choice(field.kind, member, false, name => { list[number] = this.#fresh(field.kind, name); this.#changed(true); });
      const away = element("button", { type: "button", title: "Leave it out", ariaLabel: `Leave out ${words(field.name)} ${number + 1}` }, "✕");
      away.addEventListener("click", () => { list.splice(number, 1); this.#changed(true); });
      return element("div", { className: "fields" }, element("div", { className: "member" }, select, away), ...this.#parts(field.kind, member, `${here}.${number}`));
    });
    const add = this.#adding(this.kinds[field.kind], `add to ${words(field.name)} …`, name => {
      table[field.name] = [...list, this.#fresh(field.kind, name)];
      this.#changed(true);
    });
    return this.#foldable(here, "part", `${words(field.name)}: ${list.map(member => last(member.use)).join(", ") || "none"}`, [...members, add]);
  }

  #adding(all, title, onadd) {
    const select = element("select", { id: this.#id(), ariaLabel: title }, new Option(title, ""), ...Object.keys(all ?? {}).map(name => new Option(name, name)));
    select.addEventListener("change", () => onadd(select.value));
    return select;
  }

  // Objectives

  #terms(field, table, here) {
    const terms = typeof table[field.name] === "object" ? table[field.name] : {};
    const rows = Object.entries(terms).flatMap(([label, term]) => {
      const weight = element("input", { id: this.#id(), type: "number", min: "0", step: "any", value: term.weight ?? 1, title: "Weight", ariaLabel: `Weight of ${label}` });
      weight.addEventListener("change", () => {
        weight.classList.toggle("wrong", !weight.checkValidity() || weight.value === "");
        if (weight.value === "") return;
        term.weight = Number(weight.value);
        this.#changed();
      });
      const away = element("button", { type: "button", title: "Leave it out", ariaLabel: `Leave out ${label}` }, "✕");
      away.addEventListener("click", () => {
        delete terms[label];
        if (field.optional && !Object.keys(terms).length) table[field.name] = "none";
        this.#changed(true);
      });
      const name = element("label", { htmlFor: weight.id, title: this.#form("objective", term.use)?.about ?? "" }, label);
      return [element("div", { className: "term" }, name, weight, away), ...this.#parts("objective", term, `${here}.${label}`)];
    });
    const add = this.#adding(this.kinds.objective, "add an objective …", name => {
      let label = last(name);
      while (terms[label]) label += "-again";
      table[field.name] = { ...terms, [label]: { weight: 1, ...this.#fresh("objective", name) } };
      this.#changed(true);
    });
    return element("div", { className: "fields" }, ...rows, add);
  }
}

function grouped(entries) {
  const groups = new Map();
  for (const entry of entries) groups.set(entry[1].plugin, [...(groups.get(entry[1].plugin) ?? []), entry]);
  return groups;
}

// What was typed, as the schema wants it; undefined where that cannot be.
function read(text, schema, optional) {
  const trimmed = text.trim();
  if (trimmed === "" || trimmed === "none") return optional ? "none" : undefined;
  if (schema.type === "array") {
    try { return JSON.parse(trimmed.startsWith("[") ? trimmed : `[${trimmed}]`); } catch { return undefined; }
  }
  const number = Number(trimmed);
  if (!Number.isNaN(number)) return number;
  return schema.anyOf ? trimmed : undefined;
}
