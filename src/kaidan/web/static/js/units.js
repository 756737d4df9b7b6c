// Numbers as people read them. Inside everything is SI, as in the answers' JSON.

import { h } from "./dom.js";

export let lengths = "mm";
export function setLengths(wanted) {
  lengths = wanted === "in" ? "in" : "mm";
}

const MINUS = "\u2212";
const signed = (text) => text.replace(/^-/, MINUS);

// Kinds of figure: factor from SI, digits, unit.
const KINDS = {
  length: () => (lengths === "mm" ? [1000, 0, "mm"] : [1 / 0.0254, 2, "in"]),
  fine: () => (lengths === "mm" ? [1000, 1, "mm"] : [1 / 0.0254, 3, "in"]),
  angle: () => [180 / Math.PI, 1, "°"],
  degrees: () => [1, 1, "°"],
  millimetres: () => (lengths === "mm" ? [1, 1, "mm"] : [1 / 25.4, 3, "in"]),
  mass: () => [1, 1, "kg"],
  speed: () => [1, 2, "m/s"],
  acceleration: () => [1, 2, "m/s²"],
  friction: () => [1, 2, ""],
  share: () => [100, 0, "%"],
  probability: () => [1, 3, ""],
  count: () => [1, 0, ""],
};

export function scaleOf(kind) {
  const [factor, digits, unit] = KINDS[kind]();
  return { factor, digits, unit };
}

export function shown(value, kind, { plus = false } = {}) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const { factor, digits, unit } = scaleOf(kind);
  const number = (value * factor).toFixed(digits);
  const text = signed(plus && value > 0 ? `+${number}` : number);
  return unit === "°" ? `${text}°` : unit ? `${text} ${unit}` : text;
}

// A number of an answer: people read it rounded, `value` holds it as the JSON has it.
export function figure(value, kind, options = {}) {
  if (value === null || value === undefined) return h("span", {}, "–");
  return h(
    "data",
    { value: String(value), "data-of": options.of ?? null },
    shown(value, kind, options),
  );
}

// Kind of a finding's margin by the unit that the answer gives it in.
export const KIND_OF_UNIT = { deg: "degrees", mm: "millimetres", "m/s": "speed" };
