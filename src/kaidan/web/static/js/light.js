// The traffic light: a shape, a word and a colour for each verdict; any one of them is enough.

import { s } from "./dom.js";

const SHAPES = {
  go: () => [
    s("circle", { cx: 24, cy: 24, r: 22 }),
    s("path", { class: "mark", d: "M13 25l8 8 15-17" }),
  ],
  rough: () => [
    s("path", { d: "M24 3L47 44H1Z" }),
    s("path", { class: "mark", d: "M13 34c3-6 7-6 11-2s8 4 11-2" }),
  ],
  unsure: () => [
    s("path", { d: "M24 1L47 24 24 47 1 24Z" }),
    s("path", { class: "mark", d: "M24 12v15M24 35v.5" }),
  ],
  "no-go": () => [
    s("path", { d: "M15 2h18l13 13v18L33 46H15L2 33V15Z" }),
    s("path", { class: "mark", d: "M15 15l18 18M33 15L15 33" }),
  ],
  "outside-model": () => [
    s("rect", { x: 3, y: 3, width: 42, height: 42, rx: 4 }),
    s("path", { class: "mark", d: "M17 18a7 7 0 1 1 10 6c-3 2-3 3-3 6M24 37v.5" }),
  ],
  working: () => [
    s("circle", { class: "open", cx: 24, cy: 24, r: 20 }),
    s("path", { class: "mark", d: "M24 12v13l8 5" }),
  ],
  empty: () => [
    s("rect", { class: "open", x: 5, y: 5, width: 38, height: 38, rx: 4 }),
    s("path", { class: "mark", d: "M15 24h18" }),
  ],
  offline: () => [
    s("rect", { class: "open", x: 5, y: 5, width: 38, height: 38, rx: 4 }),
    s("path", { class: "mark", d: "M12 36L36 12M14 22c6-6 14-6 20 0M20 29c3-2 6-2 8 0" }),
  ],
  failed: () => [
    s("rect", { class: "open", x: 5, y: 5, width: 38, height: 38, rx: 4 }),
    s("path", { class: "mark", d: "M24 13v15M24 35v.5" }),
  ],
};

export function symbol(verdict, size = 48) {
  const shape = SHAPES[verdict] ?? SHAPES["outside-model"];
  return s(
    "svg",
    {
      class: `symbol is-${verdict}`,
      viewBox: "0 0 48 48",
      width: size,
      height: size,
      "aria-hidden": "true",
    },
    shape(),
  );
}
