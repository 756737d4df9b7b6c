// Panel of the ground and the manner of going: friction, flippers, leading end, speed, load, doubts.

import { choice, picker, slider } from "./controls.js";
import { fold, h } from "./dom.js";
import { t, titled } from "./i18n.js";
import { catalogue } from "./question.js";
import { change, state } from "./state.js";

const MORE = [
  ["speed", "speed", 0, 2, 0.01, null],
  ["acceleration", "acceleration", -3, 3, 0.05, 0],
  ["yaw", "angle", -Math.PI / 4, Math.PI / 4, Math.PI / 180, 0],
  ["flipper_tolerance", "angle", 0, Math.PI / 12, Math.PI / 180, null],
  ["payload_mass", "mass", 0, 40, 0.5, 0],
  ["payload_behind", "length", -0.5, 1.5, 0.005, 0],
  ["payload_height", "length", 0, 1.5, 0.005, 0],
  ["u.com_from_front", "fine", 0, 0.1, 0.0005, 0],
  ["u.com_height", "fine", 0, 0.1, 0.0005, 0],
  ["u.angle", "angle", 0, 0.1, 0.001, 0],
  ["risk", "probability", 0.001, 0.2, 0.001, 0.01],
];

export function groundPanel(current) {
  const number = (name, kind, low, high, step, usual, label = `ground.${name.replace("u.", "")}`) =>
    slider({
      label: t(label),
      kind,
      low,
      high,
      step,
      get: () => state.numbers[name] ?? usual,
      set: (value, done) => change({ numbers: { [name]: value } }, { push: done }),
    });
  const surface = picker({
    label: t("ground.surface"),
    empty: t("ground.none"),
    get: () => state.surface,
    groups: () => [
      [
        "",
        [
          ...catalogue.surfaces.map((each) => [each.name, titled(each.title)]),
          ["own", t("ground.own")],
        ],
      ],
    ],
    set: (value) =>
      change({
        surface: value,
        numbers:
          value === "own"
            ? { mu_low: state.numbers.mu_low ?? 0.6, mu_high: state.numbers.mu_high ?? 0.9 }
            : { mu_low: null, mu_high: null },
      }),
  });
  const low = number("mu_low", "friction", 0.05, 2, 0.01, 0.6, "ground.low");
  const high = number("mu_high", "friction", 0.05, 2, 0.01, 0.9, "ground.high");
  const own = h("div", { class: "figures" }, low.node, high.node);
  const flippers = choice({
    label: t("ground.flippers"),
    get: () => state.flippers,
    set: (value) => change({ flippers: value }),
    options: ["best", "flat", "stowed", "angles"].map((each) => [each, t(`ground.${each}`)]),
  });
  const other = h("p", { class: "quiet" });
  const front = number("front", "angle", -Math.PI / 2, Math.PI / 2, Math.PI / 180, 0);
  const rear = number("rear", "angle", -Math.PI / 2, Math.PI / 2, Math.PI / 180, 0);
  const angles = h("div", { class: "figures" }, front.node, rear.node);
  const facing = choice({
    label: t("ground.facing"),
    get: () => state.facing,
    set: (value) => change({ facing: value }),
    options: [
      ["", t("ground.either")],
      ["nose-first", t("ground.nose-first")],
      ["tail-first", t("ground.tail-first")],
    ],
  });
  const more = MORE.map((each) => number(...each));

  return {
    node: h(
      "section",
      { class: "panel", "aria-label": t("ground.heading") },
      surface.node,
      own,
      flippers.node,
      other,
      angles,
      fold(
        "more",
        t("ground.more"),
        facing.node,
        h(
          "div",
          { class: "figures" },
          more.map((each) => each.node),
        ),
      ),
    ),
    update() {
      const robot = current.robot;
      own.hidden = state.surface !== "own";
      flippers.node.hidden = Boolean(robot) && !robot.front_flippers && !robot.rear_flippers;
      angles.hidden = flippers.node.hidden || state.flippers !== "angles";
      other.textContent = ["best", "flat", "stowed", "angles"].includes(state.flippers)
        ? ""
        : state.flippers;
      for (const each of [surface, low, high, flippers, front, rear, facing, ...more])
        each.update();
    },
  };
}
