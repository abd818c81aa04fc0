"use strict";

// Elements of a drawing; the page lends the name of their language.
const svgSpace = document.getElementById("blank").namespaceURI;

function svg(kind, attributes, parent) {
  const element = document.createElementNS(svgSpace, kind);
  for (const [name, value] of Object.entries(attributes || {})) element.setAttribute(name, value);
  if (parent) parent.append(element);
  return element;
}

function html(kind, attributes, parent, text) {
  const element = document.createElement(kind);
  for (const [name, value] of Object.entries(attributes || {})) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  if (parent) parent.append(element);
  return element;
}

const digits = (x) => (x === null || x === undefined ? "–" : Number(x.toPrecision(4)).toString().replace("-", "−"));

// Where a time lies among the samples: index of the one before, and the part of the way to the next.
function place(times, t) {
  let low = 0, high = times.length - 1;
  if (high < 1 || t >= times[high]) return [Math.max(high, 0), 0];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  const width = times[high] - times[low];
  return [low, width > 0 ? Math.min(Math.max((t - times[low]) / width, 0), 1) : 0];
}

function at(column, [index, part]) {
  if (!Array.isArray(column)) return column;
  const a = column[index], b = column[index + 1];
  if (part === 0 || a === null || b === null || b === undefined) return a;
  return a + part * (b - a);
}

const pairs = (numbers) => {
  const points = [];
  for (let i = 0; i + 1 < numbers.length; i += 2) points.push([numbers[i], numbers[i + 1]]);
  return points;
};

// Draws a scene to scale into `stage`; what is returned shows it at a place among the samples.
function picture(stage, run) {
  const { frame, shapes, arrows } = run.picture;
  let [left, right, low, high] = frame;
  const size = Math.max(right - left, high - low, 1e-9);
  // All arrows have one scale: nearly the largest force is a fifth of the picture.
  const forces = arrows.map(({ numbers }) => run.time.map((_, i) => numbers.map((column) => at(column, [i, 0]))));
  const strong = forces.flat().map(([, , fx, fy]) => Math.hypot(fx, fy)).filter((f) => f > 0).sort((a, b) => a - b);
  const largest = strong[Math.floor(0.95 * strong.length)] || 1;
  const reach = (force) => (Math.min(force / largest, 1.2) * 0.2 * size) / (force || 1);
  for (const [x, y, fx, fy] of forces.flat()) {
    const length = reach(Math.hypot(fx, fy));
    [left, right] = [Math.min(left, x + fx * length), Math.max(right, x + fx * length)];
    [low, high] = [Math.min(low, y + fy * length), Math.max(high, y + fy * length)];
  }

  const grow = (from, to, least) => {
    const more = Math.max(0, (least - (to - from)) / 2) + 0.06 * size;
    return [from - more, to + more];
  };
  [left, right] = grow(left, right, 0.5 * size);
  [low, high] = grow(low, high, 0.25 * size);
  const scale = 1000 / (right - left);
  const height = (high - low) * scale;
  const X = (x) => (x - left) * scale, Y = (y) => (high - y) * scale;
  const list = (points) => points.map(([x, y]) => X(x).toFixed(1) + "," + Y(y).toFixed(1)).join(" ");
  const root = svg("svg", { viewBox: `0 0 1000 ${height.toFixed(1)}`, role: "img", "aria-label": `${run.title}, drawn to scale` }, stage);
  // High pictures are shown smaller.
  const letter = 24 * Math.max(1, height / 560);
  const words = { style: `font-size: ${letter}px` };
  const unit = size * scale;
  const masses = shapes.filter((shape) => shape.kind === "mass").length;

  const kinds = {
    floor() {
      const box = svg("rect", { class: "ground", x: -3000, width: 7000, height: height + 10 }, root);
      return ([y]) => box.setAttribute("y", Y(y));
    },
    fixed() {
      const shape = svg("polygon", { class: "ground" }, root);
      return (n) => shape.setAttribute("points", list(pairs(n)));
    },
    shell: () => circle("ground"),
    bowl: () => circle("hollow"),
    disc() {
      const group = svg("g", {}, root);
      const rim = svg("circle", { class: "body" }, group);
      const spoke = svg("line", { class: "rod", x1: 0, y1: 0, x2: 0 }, group);
      return ([x, y, r, angle]) => {
        rim.setAttribute("r", r * scale);
        spoke.setAttribute("y2", -r * scale);
        group.setAttribute("transform", `translate(${X(x)} ${Y(y)}) rotate(${(angle * 180) / Math.PI})`);
      };
    },
    block() {
      const shape = svg("polygon", { class: "body" }, root);
      return (n) => shape.setAttribute("points", list(pairs(n)));
    },
    rod() {
      const shape = svg("polyline", { class: "rod" }, root);
      return (n) => shape.setAttribute("points", list(pairs(n)));
    },
    spring() {
      const shape = svg("polyline", { class: "spring" }, root);
      return ([x1, y1, x2, y2]) => {
        const dx = x2 - x1, dy = y2 - y1, long = Math.hypot(dx, dy) || 1, wide = 0.025 * size;
        const points = [[x1, y1]];
        for (let i = 1; i < 16; i++) {
          const side = (i % 2 ? 1 : -1) * wide;
          points.push([x1 + (dx * i) / 16 - (dy / long) * side, y1 + (dy * i) / 16 + (dx / long) * side]);
        }
        shape.setAttribute("points", list([...points, [x2, y2]]));
      };
    },
    mass() {
      const shape = svg("circle", { class: "point", r: (0.016 * unit) / Math.max(1, masses / 4) }, root);
      return ([x, y]) => { shape.setAttribute("cx", X(x)); shape.setAttribute("cy", Y(y)); };
    },
    trace(columns) {
      const shape = svg("polyline", { class: "trace" }, root);
      const points = run.time.map((_, i) => list([[at(columns[0], [i, 0]), at(columns[1], [i, 0])]]));
      return ([x, y], [index]) => shape.setAttribute("points", [...points.slice(0, index + 1), list([[x, y]])].join(" "));
    },
  };
  function circle(name) {
    const shape = svg("circle", { class: name }, root);
    return ([x, y, r]) => {
      shape.setAttribute("cx", X(x)); shape.setAttribute("cy", Y(y)); shape.setAttribute("r", r * scale);
    };
  }
  const drawn = shapes.map((shape) => [shape.numbers, kinds[shape.kind](shape.numbers)]);

  // A ruler of 1, 2 or 5 times a power of ten.
  const long = nice((right - left) / 6);
  svg("line", { class: "ruler", x1: 20, x2: 20 + long * scale, y1: height - 18, y2: height - 18 }, root);
  svg("text", { ...words, x: 20, y: height - 28 }, root).textContent = `${digits(long)} m`;

  const legend = html("ul", { class: "legend" }, arrows.length ? stage : null);
  const pushes = svg("g", {}, root);
  const pointed = arrows.map((arrow, i) => {
    const colour = `var(--c${i % 6})`;
    const group = svg("g", {}, pushes);
    const shaft = svg("line", { style: `stroke: ${colour}; stroke-width: 3` }, group);
    const head = svg("polygon", { style: `fill: ${colour}` }, group);
    const label = svg("text", { style: `${words.style}; fill: ${colour}` }, group);
    label.textContent = arrow.name;
    const value = entry(legend, `force ${arrow.name}`, colour, false);
    return (where) => {
      const [x, y, fx, fy] = arrow.numbers.map((column) => at(column, where));
      const force = Math.hypot(fx, fy);
      value.textContent = `${digits(force)} ${arrow.unit}`;
      const length = reach(force) * force * scale;
      group.style.display = length < 2 ? "none" : "";
      if (length < 2) return;
      const [ux, uy] = [fx / force, -fy / force], x1 = X(x), y1 = Y(y), tip = Math.min(14, 0.5 * length);
      const [x2, y2] = [x1 + ux * length, y1 + uy * length], [bx, by] = [x2 - ux * tip, y2 - uy * tip];
      for (const [name, v] of Object.entries({ x1, y1, x2: bx, y2: by })) shaft.setAttribute(name, v);
      const wing = 0.45 * tip;
      head.setAttribute("points", `${x2},${y2} ${bx - uy * wing},${by + ux * wing} ${bx + uy * wing},${by - ux * wing}`);
      label.setAttribute("x", Math.min(x2 + 8, 1000 - letter * 0.6 * arrow.name.length)); label.setAttribute("y", Math.max(y2 - 6, letter));
    };
  });

  return (where, pushing) => {
    for (const [columns, show] of drawn) show(columns.map((column) => at(column, where)), where);
    for (const show of pointed) show(where);
    pushes.style.display = pushing ? "" : "none";
  };
}

// A line of a legend: a sample of the stroke, a name, and a place for the present value.
function entry(legend, name, colour, dashed) {
  const item = html("li", {}, legend);
  const swatch = svg("svg", { viewBox: "0 0 32 14", "aria-hidden": "true" }, item);
  svg("line", { x1: 1, x2: 31, y1: 7, y2: 7, style: `stroke: ${colour}; stroke-width: 3${dashed ? "; stroke-dasharray: 7 4" : ""}` }, swatch);
  item.append(` ${name} `);
  return html("output", { "aria-live": "off" }, item);
}

// The largest of 1, 2 and 5 times a power of ten that is not above x.
function nice(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * (x / power >= 5 ? 5 : x / power >= 2 ? 2 : 1);
}
