// A scene to scale: what is drawn where has been decided, here it is put down.

function pairs(numbers) {
  const points = [];
  for (let i = 0; i + 1 < numbers.length; i += 2) points.push(`${numbers[i].toFixed(2)},${numbers[i + 1].toFixed(2)}`);
  return points.join(" ");
}

// What is returned shows the scene at a place among the samples.
function picture(stage, run) {
  const { height, marks, arrows, rulers, cut } = run.picture;
  const root = svg("svg", { viewBox: `0 0 1000 ${height}`, role: "img", "aria-label": `${run.title}, drawn to scale` }, stage);

  const forms = {
    circle(shape, [cx, cy, r]) { set(shape, { cx, cy, r }); },
    polygon(shape, n) { set(shape, { points: pairs(n) }); },
    polyline(shape, n) { set(shape, { points: pairs(n) }); },
    ground(shape, [y]) { set(shape, { y }); },
    placed(shape, [x, y, turn, long]) { set(shape, { transform: `translate(${x} ${y}) rotate(${turn}) scale(${long} 1)` }); },
  };
  const elements = { circle: "circle", polygon: "polygon", ground: "rect", trace: "path" };
  const drawn = marks.map((mark) => {
    const shape = svg(elements[mark.form] || "polyline", { class: mark.class }, root);
    if (mark.form === "ground") set(shape, { x: -30000, width: 61000, height: height + 10 });
    if (mark.form === "placed") set(shape, { points: mark.line.map((point) => point.join(",")).join(" ") });
    if (mark.form === "trace") {
      const strokes = mark.strokes.map((points) => {
        const times = points.map(([time]) => time), steps = points.map(([, x, y], i) => `${i ? "L" : "M"}${x} ${y}`), whole = steps.join("");
        // The end goes straight on from point to point.
        const end = (where) => [1, 2].map((k) => at(points.map((point) => point[k]), where)).join(" ");
        return (time) => {
          const count = reached(times, time);
          if (count === 0 || count === steps.length) return count ? whole : "";
          return `${steps.slice(0, count).join("")}L${end(place(times, time))}`;
        };
      });
      return (n, where) => set(shape, { d: strokes.map((stroke) => stroke(at(run.time, where))).join("") });
    }
    return (n) => {
      // What is nowhere is not drawn.
      const there = !n.includes(null);
      shape.style.display = there ? "" : "none";
      if (there) forms[mark.form](shape, n);
    };
  });

  // The window that goes along, and the window that is seen.
  const along = windowAlong(run.picture, run.time.length), whole = [0, 0, 1000, height];
  let seen = whole, following = false;
  // Arrows are as long in a small window as in the whole.
  const shrunk = () => seen[2] / 1000;
  // A ruler that has room in the window: an arrow's for the forces there, and of lengths a round part of it.
  const fitting = ({ length, text }, arrow) => {
    if (arrow) return { length: length * shrunk(), text };
    const parts = [1, 2, 5, 10, 20, 50, 100].find((part) => length / part <= seen[2] / 4) || 100, [value, unit] = text.split(" ");
    return { length: length / parts, text: `${digits(value / parts)} ${unit}` };
  };

  // Letters are as large as those of the page, whatever the size of the picture.
  let letter = 16;
  const scales = svg("g", {}, root);
  const fit = () => {
    const wide = root.getScreenCTM();
    if (wide && wide.a > 0) letter = 13 / wide.a;
    root.style.fontSize = `${letter}px`;
    scales.replaceChildren();
    let x = letter;
    const y = seen[3] - 0.7 * letter, up = 0.35 * letter;
    rulers.forEach((ruler, i) => {
      const { length, text } = fitting(ruler, i > 0);
      const end = x + length;
      const ends = i ? `M${end - up} ${y - up}L${end} ${y}L${end - up} ${y + up}` : `M${x} ${y - up}V${y + up}M${end} ${y - up}V${y + up}`;
      svg("path", { class: "ruler", d: `M${x} ${y}H${end}${ends}` }, scales);
      svg("text", { class: "words", x, y: y - 0.6 * letter }, scales).textContent = text;
      x = Math.max(end, x + 0.6 * letter * text.length) + 1.5 * letter;
    });
  };

  const legend = html("ul", { class: "legend" }, arrows.length ? stage : null);
  const pushes = svg("g", {}, root);
  const pointed = arrows.map((arrow, i) => {
    const shape = svg("polygon", { style: `fill: ${colour(i)}` }, pushes);
    const name = svg("text", { class: "name", style: `fill: ${colour(i)}` }, pushes);
    name.textContent = arrow.name;
    const value = entry(legend, arrow.impulse ? arrow.name : `force ${arrow.name}`, colour(i));
    return (where, taken) => {
      const numbers = arrow.numbers.map((column) => at(column, where)), there = !numbers.includes(null);
      const [x1, y1, dx, dy] = numbers, [x2, y2] = [x1 + dx * shrunk(), y1 + dy * shrunk()];
      value.textContent = `${digits(at(arrow.size, where))} ${arrow.impulse ? "N s" : "N"}`;
      const length = Math.hypot(x2 - x1, y2 - y1);
      const long = there && length >= 2 * shrunk();
      shape.style.display = long ? "" : "none";
      name.style.display = "none";
      if (!long) return;
      const [ux, uy] = [(x2 - x1) / length, (y2 - y1) / length];
      const thick = letter / 16, tip = Math.min(0.5 * length, 12 * thick), neck = length - tip;
      const corners = [[0, thick], [neck, thick], [neck, 0.45 * tip], [length, 0], [neck, -0.45 * tip], [neck, -thick], [0, -thick]];
      set(shape, { points: pairs(corners.flatMap(([along, left]) => [x1 + along * ux - left * uy, y1 + along * uy + left * ux])) });
      const half = 0.3 * letter * arrow.name.length, within = (v, from, most, margin) => Math.max(Math.min(v, from + most - margin), from + margin);
      // Beyond the end where it does not act.
      const [u, v, out] = arrow.impulse ? [x1, y1, -1] : [x2, y2, 1];
      const [left, top, wide, high] = seen, gap = 6 * shrunk();
      const x = within(u + out * ux * (half + gap), left, wide, half), y = within(v + out * uy * (0.5 * letter + gap), top, high, 0.6 * letter) + 0.35 * letter;
      set(name, { x, y });
      // A name that would cover another one is left to the legend.
      if (length < 0.5 * letter || taken.some(([a, b, wide]) => Math.abs(x - a) < half + wide && Math.abs(y - b) < letter)) return;
      taken.push([x, y, half]);
      name.style.display = "";
    };
  });
  if (cut) html("p", { class: "note" }, stage, "The strongest forces are drawn shorter than they are.");

  let last = [0, 0];
  const point = (where) => {
    const taken = [];
    for (const one of pointed) one(where, taken);
  };
  const show = (where, pushing) => {
    last = where;
    if (following) look(along(where));
    marks.forEach((mark, i) => drawn[i](mark.numbers.map((column) => at(column, where)), where));
    point(where);
    pushes.style.display = pushing ? "" : "none";
  };
  function look(window) {
    const [, , wide] = seen;
    seen = window;
    set(root, { viewBox: seen.join(" ") });
    set(scales, { transform: `translate(${seen[0]} ${seen[1]})` });
    if (wide !== seen[2]) fit();
  }
  if (along) {
    const views = html("div", { class: "views" }, stage), chase = html("button", { type: "button", "aria-pressed": false }, views, "Follow");
    chase.addEventListener("click", () => {
      following = !following;
      chase.setAttribute("aria-pressed", following);
      look(following ? along(last) : whole);
      point(last);
    });
  }
  new ResizeObserver(() => { fit(); point(last); }).observe(root);
  fit();
  return show;
}
