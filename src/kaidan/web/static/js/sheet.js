// The printed sheet: one page for the field, of the answer on the screen.

import { h, replace } from "./dom.js";
import { t } from "./i18n.js";

export function fillSheet(place, answer) {
  if (!answer) return replace(place);
  replace(place, h("footer", {},
    h("h2", {}, t("sheet.heading")), h("p", { class: "stop" }, t("sheet.stop")),
    h("p", {}, t("sheet.when", { time: new Date().toLocaleString(document.documentElement.lang), model: answer.model })),
    h("p", { class: "link" }, t("sheet.link"), " ", location.href)));
}
