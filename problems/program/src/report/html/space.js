// A scene in space: solids in the light, that can be turned, moved and zoomed; forces as arrows with names.

const sun = unit([-0.45, -0.5, 1]);
const paints = { "half ellipsoid": ["body", "c0"], ball: ["body", "c0"], "rolled ball": ["body", "c0"], disc: ["body", "c0"], shell: ["body", "c0"], bowl: ["body", "edge"],
  box: ["body", "body"], rod: ["edge", "edge"], mass: ["c0", "c0"], pivot: ["quiet", "quiet"] };

// What is returned shows the scene at a place among the samples.
function space(stage, run) {
  const { bodies, arrows, low, high, cut } = run.space;
  const size = Math.max(...high.map((x, k) => x - low[k]));
  // Many rods are thin.
  const thin = (bodies.filter((body) => body.kind === "rod").length > 8 ? 0.003 : 0.006) * size;
  const box = html("div", { class: "view", tabindex: 0, role: "application", "aria-label":
    `${run.title} in space. Arrow keys turn it, with Shift they move it; plus and minus zoom; 0 shows the whole; F, R and T show it from the front, the right and the top.` }, stage);
  const canvas = html("canvas", {}, box), over = svg("svg", { "aria-hidden": "true" }, box);
  const buttons = html("div", { class: "views", role: "group", "aria-label": "Seen from" }, box);
  const seen = camera(run.space);

  // `#webgl` and `#painted` behind the page's address choose how it is drawn.
  const drawn = { "#webgl": webgl, "#painted": painted }[location.hash] || (accelerated() ? webgl : painted);
  const render = drawn(canvas) || painted(canvas);

  let colours = {};
  const paint = () => {
    const style = getComputedStyle(document.documentElement);
    const read = (name) => {
      const text = style.getPropertyValue(`--${name}`).trim();
      return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
    };
    for (const name of ["page", "card", "line", "edge", "ink", "quiet", "body", ...Array.from({ length: TURN }, (_, i) => `c${i}`)]) colours[name] = read(name);
    colours.dark = [0, 0, 0];
  };
  paint();

  // The ground: the plane of the body that is called so, around the middle of the scene.
  const still = (columns) => columns.map((column) => at(column, [0, 0]));
  const ground = bodies.find(({ kind, places, turn }) => kind === "ground" && !still([...places, ...turn]).includes(null));
  const middle = low.map((x, k) => (x + high[k]) / 2);
  const cell = nice(size / 8);
  const floor = ground && (() => {
    const turn = rotation(still(ground.turn)), origin = still(ground.places), up = turn.slice(6);
    const foot = plus(middle, up, -inner(plus(middle, origin, -1), up)), apart = plus(foot, origin, -1);
    return { turn, at: foot, wide: 2 * size, cell, begin: [inner(apart, turn.slice(0, 3)), inner(apart, turn.slice(3, 6))] };
  })();

  // Light falls in parallel; its picture holds all that is ever there.
  const light = (() => {
    const turn = towards(sun), side = turn.slice(0, 3), up = turn.slice(3, 6), r = 0.5 * Math.hypot(...high.map((x, k) => x - low[k])) * 1.02;
    const deep = 4 * r;
    const rows = [[...side.map((c) => c / r), -inner(side, middle) / r], [...up.map((c) => c / r), -inner(up, middle) / r],
      [...sun.map((c) => -c / deep), inner(sun, middle) / deep], [0, 0, 0, 1]];
    return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
  })();

  const traces = bodies.flatMap(({ strokes }) => strokes || []).map((stroke) => ({ times: stroke.map(([time]) => time), points: stroke.map((point) => point.slice(1)) }));
  const straight = (mesh, from, to, wide, paint) => {
    const along = plus(to, from, -1);
    return { mesh, turn: towards(along), scale: [wide, wide, Math.hypot(...along)], at: from, first: paint, second: paint };
  };
  const upright = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const bead = (mesh, where, wide, paint) => ({ mesh, turn: upright, scale: [wide, wide, wide], at: where, first: paint, second: paint });

  function solids({ kind, size: edges, places, turn }, where) {
    if (kind === "ground" || kind === "trace") return [];
    // What is nowhere is not drawn.
    if ([...places, ...(turn || []), ...edges].some((column) => at(column, where) === null)) return [];
    const numbers = places.map((column) => at(column, where)), [first, second] = paints[kind].map((name) => colours[name]);
    if (kind === "rod") {
      const joints = [], parts = [];
      for (let i = 0; i < numbers.length; i += 3) joints.push(numbers.slice(i, i + 3));
      joints.forEach((joint, i) => {
        if (i) parts.push(straight("rod", joints[i - 1], joint, thin, first));
        if (joints.length > 2) parts.push(bead("bead", joint, thin, first));
      });
      return parts;
    }
    if (kind === "mass") return [bead("mass", numbers, 4 * thin, first)];
    if (kind === "pivot") {
      const top = plus(numbers, [0, 0, 5 * thin]);
      const plate = { mesh: "box", turn: upright, scale: [9 * thin, 9 * thin, 1.5 * thin], at: plus(top, [0, 0, 0.7 * thin]), first, second };
      return [straight("tip", top, numbers, 3 * thin, first), plate];
    }
    const scale = edges.length === 1 ? [edges[0], edges[0], edges[0]] : edges.length === 2 ? [edges[0], edges[0], edges[1]] : edges;
    return [{ mesh: kind === "rolled ball" ? "ball" : kind, turn: turn ? rotation(turn.map((column) => at(column, where))) : upright, scale, at: numbers, first, second }];
  }

  const legend = html("ul", { class: "legend" }, stage);
  const pointed = arrows.map((arrow, i) => {
    const name = svg("text", { class: "name", style: `fill: ${colour(i)}` }, over);
    name.textContent = arrow.name;
    return { ...arrow, label: name, value: entry(legend, arrow.impulse ? arrow.name : `force ${arrow.name}`, colour(i)), paint: `c${i % TURN}` };
  });
  if (cut) html("p", { class: "note" }, stage, "The strongest forces are drawn shorter than they are.");
  const scale = svg("text", { class: "words", x: 10 }, over);
  if (floor) scale.textContent = `Grid ${digits(cell)} m`;

  // Where each force acts and where it points; near by, arrows are as large to the eye as from afar.
  const ends = ({ numbers, impulse }, where) => {
    // An arrow that is nowhere has no length.
    const known = numbers.map((column) => at(column, where)), n = known.includes(null) ? [0, 0, 0, 0, 0, 0] : known, along = n.slice(3).map((x) => x * seen.near());
    // Forces begin where they act, impulses end there.
    const acts = impulse ? plus(n.slice(0, 3), n.slice(3)) : n.slice(0, 3), from = impulse ? plus(acts, along, -1) : acts;
    return { from, along, acts, long: Math.hypot(...along) };
  };

  // Shaft and tip of each force that is strong enough to be seen, and a dot where it acts.
  function thrusts(where) {
    return pointed.flatMap((arrow) => {
      const { from, along, acts, long } = ends(arrow, where), fine = thin * seen.near(), paint = colours[arrow.paint];
      if (long < fine) return [];
      const tip = Math.min(0.5 * long, 6 * fine), neck = plus(from, along, 1 - tip / long);
      return [straight("shaft", from, neck, 0.6 * fine, paint), straight("tip", neck, plus(from, along), 0.3 * tip, paint), bead("bead", acts, 1.1 * fine, paint)];
    });
  }

  // The body that can be followed: the first that moves.
  const leader = bodies.find(({ kind, places }) => !["ground", "trace", "rod"].includes(kind) && places.some(Array.isArray));
  const leading = () => leader.places.map((column) => at(column, last));
  let last = [0, 0], pushing = true, asked = false, following = false;
  function draw() {
    asked = false;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!width || !height) return;
    const [part, taps] = finely(), fine = part * Math.min(devicePixelRatio || 1, 2);
    if (canvas.width !== Math.round(width * fine) || canvas.height !== Math.round(height * fine)) {
      [canvas.width, canvas.height] = [Math.round(width * fine), Math.round(height * fine)];
      seen.shape(width / height);
      set(over, { viewBox: `0 0 ${width} ${height}` });
      set(scale, { y: height - 10 });
    }
    if (following && !leading().includes(null)) seen.follow(leading());
    const now = seen.now();
    const parts = bodies.flatMap((body) => solids(body, last));
    render({ parts, thrusts: pushing ? thrusts(last) : [], floor, camera: now, light, away: 0.004 * size, taps, sun, colours, traces: traces.map(({ times, points }) => ({ points, count: reached(times, at(run.time, last)) })) });
    const taken = [];
    for (const arrow of pointed) {
      const { size: strength, label, value, name, impulse } = arrow, { acts, along, long } = ends(arrow, last), fine = thin * seen.near();
      value.textContent = `${digits(at(strength, last))} ${impulse ? "N s" : "N"}`;
      const [across, up] = now.project(plus(acts, along, (impulse ? -1 : 1) * (1 + (2.5 * fine) / (long || 1))));
      const x = (0.5 + 0.5 * across) * width, y = (0.5 - 0.5 * up) * height, half = 4 * name.length;
      // A name that would cover another one is left to the legend.
      const free = pushing && long > 5 * fine && taken.every(([u, v, wide]) => Math.abs(x - u) > half + wide || Math.abs(y - v) > 14);
      if (free) taken.push([x, y, half]);
      label.style.display = free ? "" : "none";
      set(label, { x, y });
    }
  }
  const finely = pace(draw);
  const soon = () => { if (!asked) { asked = true; requestAnimationFrame(draw); } };

  for (const [name, view] of Object.entries(views)) {
    html("button", { type: "button" }, buttons, name).addEventListener("click", () => { seen.look(view); if (following) follow(true); soon(); });
  }
  function follow(yes) {
    following = yes && !!leader;
    if (following) seen.follow(leading(), 3 * Math.max(...leader.size, 4 * thin));
    if (leader) chase.setAttribute("aria-pressed", following);
  }
  const chase = leader && html("button", { type: "button", "aria-pressed": false }, buttons, "Follow");
  if (chase) chase.addEventListener("click", () => { if (following) seen.look(views.Slant); follow(!following); soon(); });
  const step = 0.1;
  const keys = {
    ArrowLeft: [() => seen.turn(step, 0), () => seen.move(step, 0)], ArrowRight: [() => seen.turn(-step, 0), () => seen.move(-step, 0)],
    ArrowUp: [() => seen.turn(0, step), () => seen.move(0, step)], ArrowDown: [() => seen.turn(0, -step), () => seen.move(0, -step)],
    "+": [() => seen.zoom(0.85)], "=": [() => seen.zoom(0.85)], "-": [() => seen.zoom(1 / 0.85)], 0: [() => { follow(false); seen.look(views.Slant); }],
    f: [() => seen.look(views.Front)], r: [() => seen.look(views.Side)], t: [() => seen.look(views.Top)],
  };
  box.addEventListener("keydown", (key) => {
    if (key.altKey || key.ctrlKey || key.metaKey) return;
    const acts = keys[key.key] || keys[key.key.toLowerCase()];
    if (!acts) return;
    (acts[key.shiftKey ? 1 : 0] || acts[0])();
    key.preventDefault();
    key.stopPropagation();
    soon();
  });

  // One finger or button turns, two fingers, Shift or another button move; two fingers apart zoom.
  const held = new Map();
  const spread = () => {
    const [a, b] = [...held.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, far: Math.hypot(a.x - b.x, a.y - b.y) };
  };
  box.addEventListener("pointerdown", (event) => {
    if (event.target.closest("button")) return;
    box.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY, moves: event.shiftKey || event.button > 0 });
  });
  box.addEventListener("pointermove", (event) => {
    const hand = held.get(event.pointerId);
    if (!hand) return;
    const before = held.size > 1 ? spread() : hand, moves = held.size > 1 || hand.moves;
    held.set(event.pointerId, { ...hand, x: event.clientX, y: event.clientY });
    const after = held.size > 1 ? spread() : held.get(event.pointerId);
    const [dx, dy] = [(after.x - before.x) / canvas.clientHeight, (after.y - before.y) / canvas.clientHeight];
    if (moves) { follow(false); seen.move(dx, dy); }
    else seen.turn(3.5 * dx, 3.5 * dy);
    if (held.size > 1 && after.far > 0) seen.zoom(before.far / after.far);
    soon();
  });
  for (const end of ["pointerup", "pointercancel"]) box.addEventListener(end, (event) => held.delete(event.pointerId));
  box.addEventListener("contextmenu", (event) => event.preventDefault());
  // The wheel belongs to the page until the picture has been chosen.
  box.addEventListener("wheel", (event) => {
    if (document.activeElement !== box && !event.ctrlKey) return;
    event.preventDefault();
    seen.zoom(Math.exp(0.0015 * event.deltaY));
    soon();
  }, { passive: false });

  // What WebGL has drawn is gone with the frame: paper gets a copy.
  const copy = html("canvas", { class: "printed", "aria-hidden": "true" }, box);
  addEventListener("beforeprint", () => {
    draw();
    [copy.width, copy.height] = [canvas.width, canvas.height];
    if (canvas.width) copy.getContext("2d").drawImage(canvas, 0, 0);
  });

  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { paint(); soon(); });
  new ResizeObserver(soon).observe(canvas);
  return (where, arrowsToo) => {
    [last, pushing] = [where, arrowsToo];
    draw();
  };
}
