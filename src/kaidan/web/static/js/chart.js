// Axes in SVG, for the charts of answers.

import { line, s } from "./dom.js";

const LEFT = 58,
  RIGHT = 16,
  TOP = 14,
  BOTTOM = 50;

function ticks(low, high, about = 6) {
  const raw = (high - low) / about,
    power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((each) => each * power >= raw);
  const found = [];
  for (let value = Math.ceil(low / step) * step; value <= high + 1e-9; value += step)
    found.push(Math.abs(value) < 1e-12 ? 0 : value);
  return { found, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

export class Chart {
  constructor({ x: [left, right], y: [low, high], xLabel, yLabel, label }) {
    const small = matchMedia("(max-width: 40rem)").matches; // a phone: as many letters need as many pixels
    const [wide, tall] = small ? [360, 330] : [640, 400];
    this.wide = wide;
    this.x = (value) => LEFT + ((value - left) / (right - left)) * (wide - LEFT - RIGHT);
    this.y = (value) => tall - BOTTOM - ((value - low) / (high - low)) * (tall - TOP - BOTTOM);
    this.limits = { left, right, low, high };
    this.inside = s("g", {});
    this.above = s("g", {});
    const axes = s("g", { class: "axes" });
    const across = ticks(left, right, small ? 3 : 6),
      up = ticks(low, high);
    for (const value of across.found) {
      axes.append(
        s("path", { class: "grid", d: `M${this.x(value)} ${TOP}V${tall - BOTTOM}` }),
        s(
          "text",
          { x: this.x(value), y: tall - BOTTOM + 18, "text-anchor": "middle" },
          value.toFixed(across.digits).replace("-", "\u2212"),
        ),
      );
    }
    for (const value of up.found) {
      axes.append(
        s("path", { class: "grid", d: `M${LEFT} ${this.y(value)}H${wide - RIGHT}` }),
        s(
          "text",
          { x: LEFT - 8, y: this.y(value) + 4, "text-anchor": "end" },
          value.toFixed(up.digits).replace("-", "\u2212"),
        ),
      );
    }
    axes.append(
      s(
        "text",
        { x: small ? wide / 2 : (LEFT + wide - RIGHT) / 2, y: tall - 10, "text-anchor": "middle" },
        xLabel,
      ),
      s(
        "text",
        {
          transform: `translate(14 ${(TOP + tall - BOTTOM) / 2}) rotate(-90)`,
          "text-anchor": "middle",
        },
        yLabel,
      ),
      s("path", { class: "axis", d: `M${LEFT} ${TOP}V${tall - BOTTOM}H${wide - RIGHT}` }),
    );
    this.node = s(
      "svg",
      { viewBox: `0 0 ${wide} ${tall}`, role: "img", class: "chart", "aria-label": label },
      s("defs", {}, patterns()),
      this.inside,
      axes,
      this.above,
    );
  }

  clamp(value) {
    return Math.max(this.limits.low, Math.min(this.limits.high, value));
  }

  holds([x, y]) {
    const { left, right, low, high } = this.limits;
    return x >= left && x <= right && y >= low && y <= high;
  }

  band(points, kind) {
    // [x, low, high]
    if (points.length === 0) return;
    const up = points.map(([x, , high]) => [this.x(x), this.y(this.clamp(high))]);
    const down = points.map(([x, low]) => [this.x(x), this.y(this.clamp(low))]).reverse();
    this.inside.append(s("path", { class: `band ${kind}`, d: `${line([...up, ...down])}Z` }));
  }

  curve(points, kind) {
    this.inside.append(
      s("path", {
        class: `curve ${kind}`,
        d: line(
          points.map((each) =>
            each === null || each[1] === null || !this.holds(each)
              ? null
              : [this.x(each[0]), this.y(each[1])],
          ),
        ),
      }),
    );
  }

  text(x, y, text, kind = "") {
    this.above.append(
      s(
        "text",
        { class: `label ${kind}`, x: this.x(x), y: this.y(y), "text-anchor": "middle" },
        text,
      ),
    );
  }

  // Where this question is: a ring with a cross, and words beside it.
  here(x, y, text) {
    const [at, up] = [
      this.x(Math.max(this.limits.left, Math.min(this.limits.right, x))),
      this.y(this.clamp(y)),
    ];
    const end = at > this.wide * (this.wide < 400 ? 0.55 : 0.7);
    this.above.append(
      s(
        "g",
        { class: "here" },
        s("circle", { cx: at, cy: up, r: 9 }),
        s("path", { d: `M${at - 15} ${up}h30M${at} ${up - 15}v30` }),
        s(
          "text",
          { x: at + (end ? -18 : 18), y: up - 8, "text-anchor": end ? "end" : "start" },
          text,
        ),
      ),
    );
  }
}

// Hatchings, so that no area is told by its colour alone.
function patterns() {
  const hatch = (id, path, turn) =>
    s(
      "pattern",
      {
        id,
        width: 10,
        height: 10,
        patternUnits: "userSpaceOnUse",
        patternTransform: `rotate(${turn})`,
      },
      s("path", { class: "hatch", d: path }),
    );
  return [
    hatch("hatch-down", "M0 5H10", 45),
    hatch("hatch-up", "M0 5H10", -45),
    hatch("hatch-dots", "M4 4h2v2h-2Z", 0),
    hatch("hatch-cross", "M0 5H10M5 0V10", 45),
  ];
}
