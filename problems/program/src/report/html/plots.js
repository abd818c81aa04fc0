// The largest of 1, 2 and 5 times a power of ten that is not above x.
function nice(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * (x / power >= 5 ? 5 : x / power >= 2 ? 2 : 1);
}

const dashes = ["none", "7 4", "2 3", "9 3 2 3"];

// A piece of paper as wide as there is room, so that letters keep their size, and a sheet of glass over it for what moves: so the
// paper need not be drawn again with every frame.
function paper(figure) {
  const width = Math.min(Math.max(Math.round(figure.clientWidth) || 440, 280), 1600), height = width > 900 ? 200 : 240;
  const sheet = html("div", { class: "sheet" }, figure), viewBox = `0 0 ${width} ${height}`;
  const root = svg("svg", { viewBox, role: "img", tabindex: 0 }, sheet), glass = svg("svg", { class: "glass", viewBox, "aria-hidden": "true" }, sheet);
  return { root, glass, left: 62, right: width - 12, top: 26, bottom: height - 40, width, height };
}

// What the numbers of an axis are counted from: where values hardly change beside their size, a round number near them, so that
// the numbers are short and differ.
function origin(low, high) {
  const length = high - low;
  if (length >= 1e-4 * Math.max(Math.abs(low), Math.abs(high))) return { number: 0, text: "" };
  const power = Math.ceil(Math.log10(length)), text = (Math.round((low + high) / 2 / 10 ** power) * 10 ** power).toFixed(Math.min(Math.max(-power, 0), 100));
  return { number: Number(text), text: ` from ${text.replace("-", "−")}` };
}

// Axes with ticks around ranges; gives the scales.
function axes(box, [x0, x1], [y0, y1], xName, yName) {
  const { root, right, top, bottom, height } = box;
  const widen = (a, b) => (b > a ? [a, b] : [a - (Math.abs(a) || 1) * 0.5, b + (Math.abs(b) || 1) * 0.5]);
  [x0, x1] = widen(x0, x1);
  [y0, y1] = widen(y0, y1);
  const air = 0.05 * (y1 - y0);
  [y0, y1] = [y0 - air, y1 + air];
  const [xFrom, yFrom] = [origin(x0, x1), origin(y0, y1)];
  const Y = (y) => bottom - ((y - y0) / (y1 - y0)) * (bottom - top);
  const ticks = (low, high, base, most) => {
    const [from, to] = [low - base.number, high - base.number];
    const step = nice((2.4 * (to - from)) / most), decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), list = [];
    const plain = Math.max(Math.abs(from), Math.abs(to)) < 1e6 && decimals < 7;
    for (let i = Math.ceil(from / step); i * step <= to; i++) {
      const text = plain ? (i * step).toFixed(decimals) : i ? Number((i * step).toPrecision(6)).toExponential().replace("+", "") : "0";
      list.push([base.number + i * step, text.replace(/^-(?=0\.?0*$)/, "").replace("-", "−")]);
    }
    return list;
  };
  const steps = ticks(y0, y1, yFrom, 10);
  // Long numbers need room.
  const left = (box.left = Math.max(box.left, 12 + 7.5 * Math.max(...steps.map(([, text]) => text.length))));
  const X = (x) => left + ((x - x0) / (x1 - x0)) * (right - left);
  const across = ticks(x0, x1, xFrom, (right - left) / 45), letters = Math.max(...across.map(([, text]) => text.length));
  for (const [x, text] of letters > 7 ? ticks(x0, x1, xFrom, (right - left) / (10 * letters)) : across) {
    svg("line", { class: "grid", x1: X(x), x2: X(x), y1: top, y2: bottom }, root);
    // The last one may end where the picture does.
    const middle = Math.min(X(x), box.width - 4 * text.length);
    svg("text", { class: "words", x: middle, y: bottom + 18, "text-anchor": "middle" }, root).textContent = text;
  }
  for (const [y, text] of steps) {
    svg("line", { class: "grid", x1: left, x2: right, y1: Y(y), y2: Y(y) }, root);
    svg("text", { class: "words", x: left - 6, y: Y(y) + 4, "text-anchor": "end" }, root).textContent = text;
  }
  svg("text", { class: "words", x: right, y: height - 6, "text-anchor": "end" }, root).textContent = xName + xFrom.text;
  svg("text", { class: "words", x: 4, y: 14 }, root).textContent = yName + yFrom.text;
  return { X, Y, x0, x1 };
}

function range(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value === null) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 1];
}

const named = (name, unit) => (unit ? `${name} [${unit}]` : name);

// A line that is broken where there is no value.
function path(xs, ys, { X, Y }) {
  let text = "", pen = "M";
  ys.forEach((y, i) => {
    if (y === null) { pen = "M"; return; }
    text += `${pen}${X(xs[i]).toFixed(1)} ${Y(y).toFixed(1)}`;
    pen = "L";
  });
  return text;
}

// The ground of a plot in the colours of the modes.
function shades(box, { X }, run, modes) {
  if (run.phases.length > 60) return;
  for (const { from, to, mode } of run.phases) {
    const fill = colour(modes.indexOf(mode));
    const [x, end] = [from, to].map((t) => Math.min(Math.max(X(t), box.left), box.right));
    svg("rect", { class: "shade", x, width: end - x, y: box.top, height: box.bottom - box.top, style: `fill: ${fill}` }, box.root);
  }
}

// The part of an axis that several plots show; null for all of it.
function zooming() {
  const zoom = { part: null, redraws: [] };
  zoom.set = (part) => { zoom.part = part; for (const redraw of zoom.redraws) redraw(); };
  return zoom;
}

// Curves [{ name, xs, ys, times, dash }]; over time a click goes there. A part that is pulled over is enlarged, a double click or 0
// shows all again; at the pointer the legend tells the values there.
function chart(figure, legend, { title, xName, axis, whole, span, lines, seek, under, zoom }) {
  const box = paper(figure), { root, glass } = box;
  const outputs = lines.map(({ name, dash }, i) => entry(legend, name, colour(i), dash));
  const note = html("span", { class: "note", hidden: "" }, figure);
  const all = html("button", { type: "button", class: "all" }, figure, "Show all");
  all.addEventListener("click", () => zoom.set(null));
  let scale, cursor, last = 0, pointed = null, dots = [];

  function draw() {
    const part = zoom.part;
    const within = ({ xs, ys }) => ys.filter((_, i) => xs[i] >= part[0] && xs[i] <= part[1]);
    const ys = part ? range(lines.flatMap(within)) : span || range(lines.flatMap((line) => line.ys));
    root.replaceChildren();
    glass.replaceChildren();
    set(root, { "aria-label": `${title}: ${lines.map((line) => line.name).join(", ")} over ${xName}, ${axis} from ${digits(ys[0])} to ${digits(ys[1])}` });
    scale = axes(box, part || whole, ys, xName, axis);
    if (under) under(box, scale);
    const [x, y, width, height] = [box.left, box.top, box.right - box.left, box.bottom - box.top];
    const window = { x, y, width, height, viewBox: `${x} ${y} ${width} ${height}` };
    const inside = svg("svg", window, root), above = svg("svg", window, glass);
    lines.forEach(({ xs, ys, dash }, i) => svg("path", { class: "curve", style: `stroke: ${colour(i)}`, "stroke-dasharray": dash, d: path(xs, ys, scale) }, inside));
    cursor = seek ? svg("line", { class: "cursor", y1: box.top, y2: box.bottom }, glass) : null;
    dots = seek ? [] : lines.map((_, i) => svg("circle", { class: "point", r: 5, style: `fill: ${colour(i)}` }, above));
    all.hidden = !part;
    show(last);
  }

  function show(t) {
    last = t;
    const time = seek && pointed !== null ? pointed : t;
    if (cursor) {
      const now = scale.X(Math.min(Math.max(time, scale.x0), scale.x1));
      set(cursor, { x1: now, x2: now, "stroke-dasharray": pointed === null ? "none" : "3 3" });
    }
    lines.forEach(({ xs, ys, times }, i) => {
      const where = place(times, time), end = times[times.length - 1], over = time > end + 1e-9 * (end - times[0]);
      outputs[i].textContent = digits(over ? null : at(ys, where));
      if (dots[i]) set(dots[i], { cx: scale.X(at(xs, where)), cy: scale.Y(at(ys, where) ?? 0) });
    });
  }

  const value = (event) => {
    const on = root.getBoundingClientRect(), at = ((event.clientX - on.left) / on.width) * box.width;
    const x = scale.x0 + ((at - box.left) / (box.right - box.left)) * (scale.x1 - scale.x0);
    return Math.min(Math.max(x, scale.x0), scale.x1);
  };
  let begun = null, band = null;
  root.addEventListener("pointerdown", (event) => { begun = [event.clientX, value(event)]; });
  root.addEventListener("pointermove", (event) => {
    if (begun && event.buttons && Math.abs(event.clientX - begun[0]) > 6) {
      band ??= svg("rect", { class: "shade", y: box.top, height: box.bottom - box.top, style: "fill: var(--ink)" }, root);
      const [from, to] = [begun[1], value(event)].map(scale.X).sort((a, b) => a - b);
      set(band, { x: from, width: to - from });
    }
    if (seek) {
      pointed = value(event);
      note.hidden = false;
      note.textContent = `At ${digits(pointed)} s`;
      show(last);
    }
  });
  root.addEventListener("pointerup", (event) => {
    if (!begun) return;
    const [from, to] = [begun[1], value(event)].sort((a, b) => a - b);
    if (band) { band.remove(); zoom.set([from, to]); } else if (seek) seek(value(event));
    begun = band = null;
  });
  root.addEventListener("pointerleave", () => {
    [begun, pointed, note.hidden] = [null, null, true];
    if (band) band.remove();
    band = null;
    show(last);
  });
  root.addEventListener("dblclick", () => zoom.set(null));
  root.addEventListener("keydown", (event) => {
    const factor = { "+": 0.5, "=": 0.5, "-": 2 }[event.key];
    if (event.key !== "0" && !factor) return;
    event.preventDefault();
    event.stopPropagation();
    if (!factor) return zoom.set(null);
    const [low, high] = zoom.part || whole, middle = seek && last >= low && last <= high ? last : (low + high) / 2;
    const part = [Math.max(whole[0], middle + factor * (low - middle)), Math.min(whole[1], middle + factor * (high - middle))];
    zoom.set(part[0] > whole[0] || part[1] < whole[1] ? part : null);
  });
  zoom.redraws.push(draw);
  draw();
  return show;
}

// A line over time: through points of its own where the samples are too few to show it.
function overTime(times, values, fine) {
  return fine ? { xs: fine.time, ys: fine.values, times: fine.time } : { xs: times, ys: values, times };
}

// A plot of a run over time.
function plot(parent, spec, run, { modes, span, clock, seek, zoom }) {
  const times = spec.time || run.time;
  const figure = html("figure", {}, parent);
  html("figcaption", {}, figure, spec.title);
  const lines = spec.curves.map(({ name, values, limit, fine }) => ({ name, ...overTime(times, values, fine), dash: limit ? "7 4" : "none" }));
  const legend = html("ul", { class: "legend" });
  const under = (box, scale) => shades(box, scale, run, modes);
  const show = chart(figure, legend, { title: spec.title, xName: "time [s]", axis: spec.axis, whole: clock, span, lines, seek, under, zoom });
  figure.append(legend);
  return show;
}

// All that a run has over time, to be drawn over time or over each other.
function quantities(run) {
  const all = [{ name: "time", unit: "s", values: run.time }];
  for (const c of run.phase) all.push({ name: c.name, unit: c.unit, values: c.q, fine: c.q_fine }, { name: `d${c.name}/dt`, unit: c.rate_unit, values: c.v, fine: c.v_fine });
  for (const o of run.outputs) all.push(o);
  for (const { title, axis, time, curves } of run.plots) {
    const unit = (axis.match(/\[(.*)\]/) || [, ""])[1];
    if (!time) for (const { name, values, fine } of curves) all.push({ name: `${title}: ${name}`, unit, values, fine });
  }
  return all;
}

// Any quantity over any other; they are chosen by their places among all.
function free(parent, run, [vertical, horizontal], { modes, clock, seek, zoom, spans }) {
  const list = quantities(run);
  if (list.length < 2) return () => {};
  const figure = html("figure", {}, parent);
  const row = html("figcaption", { class: "choices" }, figure);
  const choice = (label, chosen) => {
    const select = html("select", { "aria-label": `${label} axis of a plot of ${run.title}` }, row);
    list.forEach((quantity, i) => html("option", { value: i }, select, quantity.name));
    select.value = Math.min(chosen, list.length - 1);
    return select;
  };
  const y = choice("Vertical", vertical);
  row.append(" over ");
  const x = choice("Horizontal", horizontal);
  const stage = html("div", {}, figure);
  let last = clock[0], show = () => {};
  const draw = () => {
    const [up, across] = [list[y.value], list[x.value]], timed = across === list[0];
    stage.replaceChildren();
    const legend = html("ul", { class: "legend" });
    const line = timed ? overTime(run.time, up.values, up.fine) : { xs: across.values, ys: up.values, times: run.time };
    const lines = [{ name: up.name, ...line, dash: "none" }];
    const own = zooming();
    show = chart(stage, legend, {
      title: `${up.name} over ${across.name}`, xName: named(across.name, across.unit), axis: named(up.name, up.unit),
      whole: timed ? clock : spans(across.name) || range(across.values), span: spans(up.name), lines, seek: timed ? seek : null,
      under: timed ? (box, scale) => shades(box, scale, run, modes) : null, zoom: timed ? zoom : own,
    });
    stage.append(legend);
    show(last);
  };
  for (const select of [x, y]) select.addEventListener("change", draw);
  draw();
  return (t) => { last = t; show(t); };
}
