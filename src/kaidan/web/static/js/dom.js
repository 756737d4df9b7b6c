// Elements of HTML and SVG. Attributes starting with "on" are listeners: no handler is ever inline.

import { kept } from "./kept.js";

const SVG = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

export function h(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function s(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

export function replace(element, ...children) {
  element.replaceChildren(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
}

// Hand a blob to the browser as a file.
export function download(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Put a text on the clipboard; false: the browser does not let a page do it.
export async function copied(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text).then(() => true, () => false);
  const field = h("textarea", { readonly: true, class: "visually-hidden" }, text); // over plain HTTP there is no other way
  document.body.append(field);
  field.select();
  const done = document.execCommand("copy");
  field.remove();
  return done;
}

// Something to fold out, under a summary; it stays as it is when the page is built anew.
export function fold(name, summary, ...children) {
  const open = kept("open", () => new Set());
  const node = h("details", { open: open.has(name), ontoggle: () => (node.open ? open.add(name) : open.delete(name)) }, h("summary", {}, summary), children);
  return node;
}

let count = 0;
export function fresh(prefix) {
  count += 1;
  return `${prefix}-${count}`;
}

// A polyline as the "d" of a path; null breaks it.
export function line(points) {
  let path = "", pen = "M";
  for (const point of points) {
    if (point === null || !Number.isFinite(point[0]) || !Number.isFinite(point[1])) { pen = "M"; continue; }
    path += `${pen}${point[0].toFixed(2)} ${point[1].toFixed(2)}`;
    pen = "L";
  }
  return path;
}
