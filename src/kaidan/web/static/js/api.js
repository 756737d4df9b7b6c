// The server: JSON in, the command's JSON out. Of questions that overtake each other the last wins.

export class Refused extends Error {}
export class Unreachable extends Error {}

/** @type {(there: boolean) => void} */
let reached = () => {};
export function onReach(listener) {
  reached = listener;
}

async function answered(response) {
  const type = response.headers.get("content-type") ?? "";
  const body = type.includes("json") ? await response.json() : { error: await response.text() };
  if (response.ok) return body;
  const detail = body.error ?? body.detail ?? response.statusText;
  throw new Refused(typeof detail === "string" ? detail : JSON.stringify(detail));
}

async function fetched(address, options) {
  let response;
  try {
    response = await fetch(address, options);
  } catch (error) {
    if (error.name === "AbortError") throw error;
    reached(false);
    throw new Unreachable();
  }
  reached(true);
  return answered(response);
}

export function get(path, signal) {
  return fetched(`api/${path}`, { signal });
}

export function ask(path, body, signal) {
  return fetched(`api/${path}`, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });
}

export async function fetchedText(path) {
  const response = await fetch(`api/${path}`).catch(() => {
    throw new Unreachable();
  });
  return response.ok ? response.text() : answered(response);
}

export async function remove(path) {
  const response = await fetch(`api/${path}`, { method: "DELETE" }).catch(() => {
    throw new Unreachable();
  });
  if (!response.ok) await answered(response);
}

// A file that the server makes of a question.
export async function fetchedFile(path, body) {
  const response = await fetch(`api/${path}`, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
  }).catch(() => {
    throw new Unreachable();
  });
  if (!response.ok) return answered(response);
  return response.blob();
}

export function upload(path, file, fields = [], signal) {
  const form = new FormData();
  form.append("file", file);
  for (const [name, value] of fields) form.append(name, value);
  return fetched(`api/${path}`, { method: "POST", body: form, signal });
}

// One line of questions: while one is under way, only the newest of those that follow is kept.
export class Latest {
  #busy = false;
  #next = null;
  #number = 0;
  #abort = null;

  constructor(path) {
    this.path = path;
  }

  // Calls `done(answer, error)` for the newest question alone. With `cancel`, an older question
  // under way is given up at once; without, it is finished first, so that a slider keeps drawing.
  ask(body, done, { cancel = false } = {}) {
    this.#number += 1;
    const turn = { number: this.#number, body, done, cancel };
    if (this.#busy && !cancel) {
      this.#next = turn;
      return;
    }
    this.#abort?.abort();
    this.#run(turn);
  }

  drop() {
    this.#number += 1;
    this.#next = null;
    this.#abort?.abort();
  }

  async #run(turn) {
    this.#busy = true;
    const abort = new AbortController();
    this.#abort = abort;
    let answer = null,
      failed = null;
    try {
      answer = await ask(this.path, turn.body, abort.signal);
    } catch (error) {
      failed = error;
    }
    if (this.#abort !== abort) return;
    this.#busy = false;
    this.#abort = null;
    const next = this.#next;
    this.#next = null;
    if (failed?.name !== "AbortError" && (turn.number === this.#number || next)) {
      turn.done(answer, failed, turn.number === this.#number);
    }
    if (next) this.#run(next);
  }
}
