// Texts of the page: one catalogue for both languages, served by kaidan (kaidan/text/page.toml).

import { h } from "./dom.js";

let texts = {};
let patterns = {};
export let language = "en";

export async function loadTexts() {
  const found = await (await fetch("api/texts")).json();
  patterns = Object.fromEntries(
    Object.entries(found.sentences).map(([name, all]) => [
      name,
      all.map(([en, ja, tables]) => ({ en: new RegExp(en), ja, tables })),
    ]),
  );
  texts = found;
}

export function setLanguage(wanted) {
  language = wanted === "ja" ? "ja" : "en";
  document.documentElement.lang = language;
}

export function has(key) {
  const [topic, name] = key.split(".");
  return Boolean(texts[topic]?.[name]?.[language]);
}

export function t(key, values = {}) {
  const [topic, name] = key.split(".");
  const text = texts[topic]?.[name]?.[language] ?? key;
  return text.replace(/\{(\w+)\}/g, (whole, field) => values[field] ?? whole);
}

// A sentence of an answer in Japanese, as kaidan/text/japanese.py; null where it is only known in English.
export function japanese(text, table = "sentence") {
  for (const { en, ja, tables } of patterns[table]) {
    const found = en.exec(text);
    if (found) {
      const parts = tables.map(
        (of, index) => (of ? japanese(found[index + 1], of) : null) ?? found[index + 1],
      );
      return ja.replace(/\{(\d)\}/g, (_, number) => parts[number - 1]);
    }
  }
  return null;
}

// A title of the catalogue in the language of the page; names stay as they are.
export function titled(title) {
  return (language === "ja" ? japanese(title, "title") : null) ?? title;
}

// A sentence of an answer in the language of the page, or in English and marked as such.
export function said(sentence, tag = "span") {
  const text = language === "ja" ? japanese(sentence) : null;
  return text === null ? h(tag, { lang: "en" }, sentence) : h(tag, {}, text);
}
