// From the page's state to the body that the service takes: keywords of kaidan.assess.

import { get } from "./api.js";
import { state, unpacked } from "./state.js";

const sheets = { robots: new Map(), stairs: new Map(), surfaces: new Map() };
export const catalogue = { robots: [], stairs: [], surfaces: [] };

export async function loadCatalogue() {
  Object.assign(catalogue, await get("catalogue"));
}

// Sheet of a name of the catalogue, or of one that travels in the address.
export async function sheetOf(kind, name) {
  if (!name) return null;
  if (name.startsWith("~")) return unpacked(name);
  if (!sheets[kind].has(name))
    sheets[kind].set(name, await get(`catalogue/${kind}/${encodeURIComponent(name)}`));
  return sheets[kind].get(name);
}

// What a sheet itself has under a name; an address may name what every object has.
function own(place, name) {
  return place && Object.hasOwn(place, name) ? place[name] : null;
}

// Sheet with changed figures, by dotted names, in their places.
export function withFigures(sheet, figures) {
  if (!sheet) return null;
  const made = structuredClone(sheet);
  for (const [name, value] of Object.entries(figures)) {
    const path = name.split(".");
    const last = path.pop();
    let place = made;
    for (const part of path) place = own(place, part);
    if (place && typeof place === "object" && !(last in {})) place[last] = value;
  }
  return made;
}

export function valueOf(sheet, name) {
  return name.split(".").reduce(own, sheet) ?? null;
}

// Sheet of stairs with changed figures. Where the way goes straight on there is no passage; a passage
// of no width is none.
export function stairsWithFigures(sheet) {
  const made = withFigures(sheet, state.stairsFigures);
  for (const end of ["lower", "upper"]) {
    if (!made[`${end}_passage`] || (made[`${end}_turn`] ?? "none") === "none")
      delete made[`${end}_passage`];
  }
  return made;
}

// Stairs as a body has them: a name, a sheet, flights, or points.
export function terrainOf(sheet) {
  if (Array.isArray(sheet)) return sheet;
  const changed = Object.keys(state.stairsFigures).length > 0;
  if (!changed) return state.stairs.startsWith("~") ? sheet : state.stairs;
  const made = stairsWithFigures(sheet);
  if (!state.stairs.startsWith("~")) made.name = `${made.name} (own figures)`;
  return made;
}

function ground() {
  const { mu_low: low, mu_high: high } = state.numbers;
  if (state.surface === "own" && low !== undefined)
    return { friction: [low, Math.max(low, high ?? low)] };
  return state.surface && state.surface !== "own" ? { surface: state.surface } : {};
}

const degrees = (angle) => `${((angle * 180) / Math.PI).toFixed(3)}deg`;

function flippers(robot) {
  if (!robot?.front_flippers && !robot?.rear_flippers) return {};
  if (state.flippers !== "angles") return { flippers: state.flippers };
  const { front = 0, rear = 0 } = state.numbers;
  if (!robot.front_flippers || !robot.rear_flippers) {
    return { flippers: degrees(robot.front_flippers ? front : rear) };
  }
  return { flippers: `${degrees(front)},${degrees(rear)}` };
}

// The body of a question; null while robot or stairs are not chosen.
export function bodyOf(robot, stairs) {
  if (!robot || !stairs) return null;
  const { numbers } = state;
  /** @type {Record<string, any>} */
  const body = {
    robot: state.robot.startsWith("~") ? robot : state.robot,
    stairs: terrainOf(stairs),
    ...ground(),
    ...flippers(robot),
    direction: state.direction,
  };
  if (Object.keys(state.robotFigures).length > 0) body.override = state.robotFigures;
  if (state.facing) body.facing = state.facing;
  for (const name of ["speed", "acceleration", "yaw", "risk", "flipper_tolerance"]) {
    if (numbers[name] !== undefined) body[name] = numbers[name];
  }
  if (numbers.payload_mass) {
    body.payload = [
      {
        mass: numbers.payload_mass,
        from_front: numbers.payload_behind ?? 0,
        height: numbers.payload_height ?? 0,
      },
    ];
  }
  const doubts = {};
  for (const [name, value] of Object.entries(numbers)) {
    if (name.startsWith("u.") && value > 0) doubts[name.slice(2)] = value;
  }
  if (Object.keys(doubts).length > 0) body.uncertainty = doubts;
  return body;
}

// The closed form takes one posture: a first estimate where the best is still to be found.
export function quickBody(body) {
  const { yaw: _, flipper_tolerance: __, ...rest } = body;
  return { ...rest, ...(body.flippers === "best" ? { flippers: "flat" } : {}) };
}

export function marginBody(body) {
  const names = ["robot", "flippers", "payload", "acceleration", "direction", "facing", "override"];
  const rest = Object.fromEntries(
    names.filter((name) => name in body).map((name) => [name, body[name]]),
  );
  return rest.flippers === "best" ? { ...rest, flippers: "flat" } : rest;
}

export function planeBody(body) {
  const {
    yaw: _,
    risk: __,
    uncertainty: ___,
    speed: ____,
    flipper_tolerance: _____,
    ...rest
  } = body;
  return rest.flippers === "best" ? { ...rest, flippers: "flat" } : rest;
}
