// Texts of the page: one catalogue for both languages, served by kaidan (kaidan/text/page.toml).

import { h } from "./dom.js";

let texts = {};
let patterns = [];
export let language = "en";

export async function loadTexts() {
  const found = await (await fetch("api/texts")).json();
  patterns = found.advice.map((each) => ({ pattern: new RegExp(each.en), ja: each.ja }));
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

// What would help, in the language of the page; null where it is only known in English.
export function advice(sentence) {
  if (language === "en") return sentence;
  for (const { pattern, ja } of patterns) {
    const found = pattern.exec(sentence);
    if (found) return ja.replace(/\{(\d)\}/g, (_, index) => found[index] ?? "");
  }
  return null;
}

// A sentence that the answer has in English alone, marked as such for screen readers.
export function english(sentence, tag = "span") {
  return h(tag, { lang: "en" }, sentence);
}
