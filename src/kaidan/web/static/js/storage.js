// Robots and stairs that stay on the device, and travel as files.

import { packed } from "./state.js";

const KEY = "kaidan.sheets";

function all() {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? {};
  } catch {
    return {};
  }
}

export function sheetsOf(kind) {
  return all()[kind] ?? {};
}

export function save(kind, name, sheet) {
  const kept = all();
  kept[kind] = { ...kept[kind], [name]: sheet };
  localStorage.setItem(KEY, JSON.stringify(kept));
}

export function remove(kind, name) {
  const kept = all();
  delete kept[kind]?.[name];
  localStorage.setItem(KEY, JSON.stringify(kept));
}

// Name under which a packed sheet is kept; null: it is not.
export function nameOf(kind, text) {
  for (const [name, sheet] of Object.entries(sheetsOf(kind)))
    if (packed(sheet) === text) return name;
  return null;
}

export function exported() {
  return new Blob([JSON.stringify({ kaidan: "sheets", ...all() }, null, 1)], {
    type: "application/json",
  });
}

// Number of sheets taken in; null: the text is no such file.
export function imported(text) {
  let found;
  try {
    found = JSON.parse(text);
  } catch {
    return null;
  }
  if (found?.kaidan !== "sheets") return null;
  let count = 0;
  for (const kind of ["robots", "stairs"]) {
    for (const [name, sheet] of Object.entries(found[kind] ?? {})) {
      if (typeof sheet !== "object" || sheet === null) continue;
      save(kind, name, sheet);
      count += 1;
    }
  }
  return count;
}

export function preference(name, fallback) {
  try {
    return localStorage.getItem(`kaidan.${name}`) ?? fallback;
  } catch {
    return fallback;
  }
}

export function prefer(name, value) {
  localStorage.setItem(`kaidan.${name}`, value);
}
