// The question, as the address has it: what is shared, bookmarked and gone back to.

const TEXTS = {
  view: "check",
  robot: "",
  stairs: "",
  surface: "",
  flippers: "best",
  direction: "up",
  facing: "",
  tab: "side",
};
const NUMBERS = [
  "mu_low",
  "mu_high",
  "front",
  "rear",
  "speed",
  "acceleration",
  "yaw",
  "risk",
  "flipper_tolerance",
  "payload_mass",
  "payload_behind",
  "payload_height",
  "u.com_from_front",
  "u.com_height",
  "u.angle",
];
const TURN = /^s\.(lower|upper)_turn$/;
const TURNS = ["none", "quarter", "half", "unknown"];

function empty() {
  return { ...TEXTS, numbers: {}, robotFigures: {}, stairsFigures: {} };
}

export const state = empty();
const listeners = new Set();

export function subscribe(listener) {
  listeners.add(listener);
}

export function addressOf(from = state) {
  const query = new URLSearchParams();
  for (const [name, usual] of Object.entries(TEXTS)) {
    if (name !== "view" && from[name] !== usual) query.set(name, from[name]);
  }
  for (const [name, value] of Object.entries(from.numbers)) query.set(name, String(value));
  for (const [name, value] of Object.entries(from.robotFigures))
    query.set(`r.${name}`, String(value));
  for (const [name, value] of Object.entries(from.stairsFigures))
    query.set(`s.${name}`, String(value));
  const text = query.toString();
  return `#/${from.view}${text ? `?${text}` : ""}`;
}

// The question alone, wherever it is looked at.
export function questionOf() {
  return addressOf({ ...state, view: TEXTS.view, tab: TEXTS.tab });
}

export function readAddress() {
  const [path, text] = location.hash.replace(/^#\/?/, "").split("?");
  const found = empty();
  found.view = path || "check";
  for (const [name, value] of new URLSearchParams(text ?? "")) {
    const number = Number(value);
    if (name in TEXTS && name !== "view") found[name] = value;
    else if (TURN.test(name) && TURNS.includes(value)) found.stairsFigures[name.slice(2)] = value;
    else if (!Number.isFinite(number) || value.trim() === "") continue;
    else if (NUMBERS.includes(name)) found.numbers[name] = number;
    else if (name.startsWith("r.")) found.robotFigures[name.slice(2)] = number;
    else if (name.startsWith("s.")) found.stairsFigures[name.slice(2)] = number;
  }
  Object.assign(state, found);
}

// Change the question. `push` makes a step that "back" undoes; a slider under way does not.
export function change(patch, { push = true } = {}) {
  const before = addressOf();
  for (const [name, value] of Object.entries(patch)) {
    if (typeof value === "object" && value !== null) {
      state[name] = { ...state[name], ...value };
      for (const [key, each] of Object.entries(state[name]))
        if (each === null) delete state[name][key];
    } else state[name] = value;
  }
  const after = addressOf();
  if (after !== before) history[push ? "pushState" : "replaceState"](null, "", after);
  for (const listener of listeners) listener();
}

export function clear(name) {
  const before = addressOf();
  state[name] = {};
  if (addressOf() !== before) history.pushState(null, "", addressOf());
  for (const listener of listeners) listener();
}

export function followAddress() {
  window.addEventListener("popstate", () => {
    readAddress();
    for (const listener of listeners) listener();
  });
}

// Sheets that are in no catalogue travel in the address themselves.
export function packed(sheet) {
  const lean = JSON.stringify(sheet, (name, value) =>
    value === null || name === "sources" || name === "notes" ? undefined : value,
  );
  const bytes = new TextEncoder().encode(lean);
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return `~${btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

export function unpacked(text) {
  try {
    const bytes = Uint8Array.from(
      atob(text.slice(1).replaceAll("-", "+").replaceAll("_", "/")),
      (c) => c.charCodeAt(0),
    );
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    return null;
  }
}
