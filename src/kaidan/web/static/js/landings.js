// Landings at both ends of a flight: their lengths, whether the way turns on them, doors.

import { choice, slider } from "./controls.js";
import { h } from "./dom.js";
import { t } from "./i18n.js";
import { valueOf } from "./question.js";
import { change, state } from "./state.js";

const ENDS = ["lower", "upper"];
/** @type {[string, number, number][]} */
const LENGTHS = [
  ["landing", 0.2, 5],
  ["landing_width", 0.2, 5],
  ["passage", 0, 3],
  ["leaf", 0, 1.5],
];
const OF_A_TURN = ["landing_width", "passage"];

// Groups of fields of both ends of a sheet's flight.
export function landingsOf(sheet) {
  const held = (name) => state.stairsFigures[name] ?? valueOf(sheet, name);
  const groups = ENDS.map((end) => {
    const turn = choice({
      label: t("landing.turn"),
      options: ["none", "quarter", "half", "unknown"].map((each) => [each, t(`landing.${each}`)]),
      get: () => held(`${end}_turn`) ?? "none",
      set: (value) => change({ stairsFigures: { [`${end}_turn`]: value } }),
    });
    /** @type {[string, ReturnType<typeof slider>][]} */
    const sliders = LENGTHS.map(([of, low, high]) => [
      of,
      slider({
        label: t(`landing.${of}`),
        kind: "length",
        low,
        high,
        step: 0.01,
        get: () => held(`${end}_${of}`),
        set: (value, done) =>
          change({ stairsFigures: { [`${end}_${of}`]: value } }, { push: done }),
      }),
    ]);
    const missing = h("p", { class: "quiet", role: "status" });
    const node = h(
      "fieldset",
      { class: "landing" },
      h("legend", {}, t(`landing.${end}`)),
      turn.node,
      h(
        "div",
        { class: "figures" },
        sliders.map(([, each]) => each.node),
      ),
      missing,
    );
    function update() {
      const turns = ["quarter", "half"].includes(held(`${end}_turn`));
      turn.update();
      for (const [of, each] of sliders) {
        each.node.hidden = OF_A_TURN.includes(of) && !turns;
        each.update();
      }
      const needed = [
        ["width", t("figure.width")],
        ...["landing", "landing_width"].map((of) => [`${end}_${of}`, t(`landing.${of}`)]),
      ];
      const unknown = turns
        ? needed.filter(([name]) => held(name) === null).map(([, label]) => label)
        : [];
      missing.textContent = unknown.length
        ? t("landing.needed", { what: unknown.join(t("landing.and")) })
        : "";
    }
    return { node, update };
  });
  return {
    nodes: groups.map((each) => each.node),
    update() {
      for (const each of groups) each.update();
    },
  };
}
