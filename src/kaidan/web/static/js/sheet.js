// The printed sheet: one page for the field, of the answer on the screen.

import { h, replace } from "./dom.js";
import { language, said, t } from "./i18n.js";

export function fillSheet(place, answer) {
  if (!answer) return replace(place);
  replace(
    place,
    h(
      "footer",
      {},
      h("p", { class: "stop" }, t("sheet.stop")),
      answer.notes.length
        ? [
            h("h3", {}, t("answer.notes")),
            h(
              "ul",
              {},
              answer.notes.map((note) => said(note, "li")),
            ),
          ]
        : null,
      h(
        "p",
        {},
        h("b", {}, t("sheet.heading")),
        ". ",
        t("sheet.when", {
          time: new Date().toLocaleString(language === "ja" ? "ja" : navigator.language),
          model: answer.model,
        }),
      ),
      h("p", { class: "link" }, t("sheet.link"), " ", location.href),
    ),
  );
}
