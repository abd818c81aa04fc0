"use strict";

// Elements of a drawing; the page lends the name of their language.
const svgSpace = document.getElementById("blank").namespaceURI;

function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes || {})) element.setAttribute(name, value);
  return element;
}

function svg(kind, attributes, parent) {
  const element = set(document.createElementNS(svgSpace, kind), attributes);
  if (parent) parent.append(element);
  return element;
}

function html(kind, attributes, parent, text) {
  const element = set(document.createElement(kind), attributes);
  if (text !== undefined) element.textContent = text;
  if (parent) parent.append(element);
  return element;
}

// How many colours are taken in turn.
const TURN = 12;
const colour = (i) => `var(--c${i % TURN})`;

// Phases by what is seen of them in a bar of modes: those too short to be told apart stand together, but over no more than a stripe.
function gathered(phases, part) {
  const SHORT = 0.004, STRIPE = 0.02;
  const long = (first, last) => part(last.to) - part(first.from);
  return phases.reduce((groups, phase) => {
    const group = groups[groups.length - 1];
    const short = group && long(group[0], group[0]) < SHORT && long(phase, phase) < SHORT;
    if (short && long(group[0], phase) < STRIPE) group.push(phase);
    else groups.push([phase]);
    return groups;
  }, []);
}

// The ground of such a group: a layer for each mode, as high as the mode takes part, in the same order everywhere.
function layers(phases, modes) {
  const lasts = new Map();
  for (const { from, to, mode } of phases) lasts.set(mode, (lasts.get(mode) || 0) + to - from);
  const all = [...lasts.values()].reduce((a, b) => a + b, 0);
  let below = 0;
  const seen = modes.filter((mode) => lasts.has(mode));
  const stops = seen.map((mode) => {
    const above = below;
    below += all > 0 ? (100 * lasts.get(mode)) / all : 100;
    return `${colour(modes.indexOf(mode))} ${above}% ${below}%`;
  });
  return lasts.size > 1 ? `linear-gradient(${stops.join(", ")})` : colour(modes.indexOf(phases[0].mode));
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

// How many of ascending times have come.
const reached = (times, t) => (t < times[0] ? 0 : place(times, t)[0] + 1);

function at(column, [index, part]) {
  if (!Array.isArray(column)) return column;
  const a = column[index], b = column[index + 1];
  if (part === 0 || b === undefined) return a;
  return a === null || b === null ? null : a + part * (b - a);
}

// A line of a legend: a sample of the stroke, a name, and a place for the present value.
function entry(legend, name, stroke, dashes) {
  const item = html("li", {}, legend);
  const swatch = svg("svg", { viewBox: "0 0 32 14", "aria-hidden": "true" }, item);
  svg("line", { x1: 1, x2: 31, y1: 7, y2: 7, style: `stroke: ${stroke}; stroke-width: 3`, "stroke-dasharray": dashes || "none" }, swatch);
  item.append(` ${name} `);
  return html("output", { "aria-live": "off" }, item);
}
