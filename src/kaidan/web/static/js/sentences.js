// An answer in sentences: in English its own; in Japanese what they say, its own beneath.

import { h } from "./dom.js";
import { has, japanese, language, said, t } from "./i18n.js";
import { shown } from "./units.js";

export function modeName(key, answer) {
  const label = answer?.findings?.[key]?.label;
  if (language === "en" && label) return label;
  return has(`mode.${key}`) ? t(`mode.${key}`) : (label ?? key.replaceAll("_", " "));
}

export function placeName(phase, step) {
  if (!phase) return "–";
  return step === null || step === undefined
    ? t(`phase.${phase}`)
    : t("answer.place", { phase: t(`phase.${phase}`), step });
}

export function stated(friction) {
  if (!friction) return t("answer.not_stated");
  const [low, high] = friction;
  return low === high
    ? shown(low, "friction")
    : `${shown(low, "friction")} – ${shown(high, "friction")}`;
}

// Why this verdict, in the language of the page; in Japanese the answer's own words beneath.
export function reason(answer) {
  if (language === "en" || japanese(answer.reason) === null)
    return h("p", { class: "reason", lang: "en" }, answer.reason);
  return h(
    "div",
    { class: "reason" },
    said(answer.reason, "p"),
    h("details", {}, h("summary", {}, t("app.english")), h("p", { lang: "en" }, answer.reason)),
  );
}
