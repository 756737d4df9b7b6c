// Robots and stairs on this device: use, delete, export, import.

import { button, fileButton } from "./controls.js";
import { download, h, replace } from "./dom.js";
import { t } from "./i18n.js";
import { change, clear, packed } from "./state.js";
import { exported, imported, remove, sheetsOf } from "./storage.js";

export function savedView(shell) {
  const lists = h("div", {});
  const node = h(
    "section",
    { class: "panel saved" },
    h("h2", {}, t("saved.heading")),
    lists,
    h(
      "div",
      { class: "buttons" },
      button(t("saved.export"), send),
      fileButton(t("saved.import"), ".json", async (file) => {
        const count = imported(await file.text());
        shell.say(count === null ? t("saved.not_one") : t("saved.imported", { count }));
        update();
      }),
    ),
  );

  function send() {
    download(exported(), "kaidan-sheets.json");
  }

  function use(kind, sheet) {
    const one = kind === "robots" ? "robot" : "stairs";
    clear(`${one}Figures`);
    change({ view: "check", [one]: packed(sheet) });
  }

  function update() {
    /** @type {[string, [string, any][]][]} */
    const all = ["robots", "stairs"].map((kind) => [kind, Object.entries(sheetsOf(kind))]);
    replace(
      lists,
      all.every(([, sheets]) => sheets.length === 0)
        ? h("p", {}, t("saved.none"))
        : all.map(([kind, sheets]) =>
            sheets.length === 0
              ? null
              : [
                  h("h3", {}, t(`saved.${kind}`)),
                  h(
                    "ul",
                    { class: "cards" },
                    sheets.map(([name, sheet]) =>
                      h(
                        "li",
                        {},
                        h("span", {}, name),
                        button(t("saved.use", { name }), () => use(kind, sheet), { class: "main" }),
                        button(t("saved.remove", { name }), () => {
                          remove(kind, name);
                          update();
                        }),
                      ),
                    ),
                  ),
                ],
          ),
    );
  }

  return { node, update };
}
