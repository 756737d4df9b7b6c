// An answer in sentences: in English its own; in Japanese built from its JSON, its own beneath.

import { h } from "./dom.js";
import { advice, english, has, language, t } from "./i18n.js";
import { shown } from "./units.js";

const FRICTION = ["slides_down", "slides_up", "friction_unknown"];

export function modeName(key, answer) {
  const label = answer?.findings?.[key]?.label;
  if (language === "en" && label) return label;
  return has(`mode.${key}`) ? t(`mode.${key}`) : label ?? key.replaceAll("_", " ");
}

export function placeName(phase, step) {
  if (!phase) return "–";
  return step === null || step === undefined ? t(`phase.${phase}`) : t("answer.place", { phase: t(`phase.${phase}`), step });
}

export function stated(friction) {
  if (!friction) return t("answer.not_stated");
  const [low, high] = friction;
  return low === high ? shown(low, "friction") : `${shown(low, "friction")} – ${shown(high, "friction")}`;
}

// Why this verdict, in the language of the page.
export function reason(answer) {
  if (language === "en") return h("p", { class: "reason" }, answer.reason);
  const values = {
    mode: modeName(answer.governs, answer),
    place: placeName(answer.phase, answer.step),
    margin: shown(answer.margin_deg, "degrees", { plus: true }),
    best: shown(answer.margin_best_deg, "degrees", { plus: true }),
    required: shown(answer.required_friction, "friction"),
    stated: stated(answer.friction),
  };
  let key = answer.verdict;
  if (answer.verdict === "outside-model") key = "outside";
  else if (answer.verdict !== "go" && FRICTION.includes(answer.governs)) key = "friction";
  return h("div", { class: "reason" },
    h("p", {}, t(`reason.${key}`, values)),
    h("details", {}, h("summary", {}, t("app.english")), english(answer.reason, "p")));
}

export function change(sentence) {
  const text = advice(sentence);
  return text === null ? english(sentence) : h("span", {}, text);
}
