// Where a scene in space is seen from: turned about a target, nearer and farther.

const views = { Front: [0, 0.12], Side: [right, 0.12], Top: [0, right - 0.001], Slant: [0.5, 0.4] };
const opening = 0.24; // Tangent of half the height that is seen.

function camera({ low, high }) {
  const middle = low.map((x, k) => (x + high[k]) / 2), corners = [];
  for (const x of [0, 1]) for (const y of [0, 1]) for (const z of [0, 1]) corners.push([x, y, z].map((side, k) => (side ? high : low)[k] - middle[k]));
  const size = Math.max(...high.map((x, k) => x - low[k]), 1e-9);
  const state = { target: middle, turn: 0, tilt: 0, far: 1, wide: 1.8 };

  const axes = () => {
    const [c, s, e, f] = [Math.cos(state.turn), Math.sin(state.turn), Math.cos(state.tilt), Math.sin(state.tilt)];
    const back = [s * e, -c * e, f], side = [c, s, 0];
    return { side, up: outer(back, side), back };
  };
  // The whole box is seen, with some air.
  const fit = () => {
    const { side, up, back } = axes();
    let aim = [0, 0, 0];
    for (let round = 0; round < 4; round++) {
      const seen = corners.map((c) => plus(c, aim, -1)).map((c) => [inner(c, side), inner(c, up), inner(c, back)]);
      state.far = 1.08 * Math.max(...seen.map(([x, y, z]) => z + Math.max(Math.abs(x) / state.wide, Math.abs(y)) / opening), 0.3 * size);
      const off = [0, 1].map((k) => {
        const parts = seen.map((p) => p[k] / (state.far - p[2]));
        return 0.5 * (Math.min(...parts) + Math.max(...parts)) * state.far;
      });
      aim = plus(plus(aim, side, off[0]), up, off[1]);
    }
    state.target = plus(middle, aim);
    state.whole = state.far;
  };
  const look = ([turn, tilt]) => { [state.turn, state.tilt] = [turn, tilt]; fit(); };
  look(views.Slant);

  return {
    look,
    fit,
    turn(dx, dy) {
      state.turn -= dx;
      state.tilt = Math.min(Math.max(state.tilt + dy, -right + 0.001), right - 0.001);
    },
    // How far away the eye is, in terms of where it sees the whole.
    near: () => state.far / state.whole,
    zoom(k) { state.far = Math.min(Math.max(state.far * k, 0.02 * size), 20 * size); },
    // Keeps a point in the middle, so near that a length is a third of the height.
    follow(point, length) {
      state.target = point;
      if (length) state.far = length / (0.66 * opening);
    },
    // By parts of the height of the picture.
    move(dx, dy) {
      const { side, up } = axes(), k = 2 * opening * state.far;
      state.target = plus(plus(state.target, side, -dx * k), up, dy * k);
    },
    shape(wide) {
      if (Math.abs(wide - state.wide) < 1e-3) return;
      state.wide = wide;
      fit();
    },
    // The matrix, the eye, and where a point is: across and up from −1 to 1, and how far away.
    now() {
      const { side, up, back } = axes(), eye = plus(state.target, back, state.far);
      const [near, far] = [0.02 * state.far, state.far + 30 * size];
      const [x, y] = [1 / (opening * state.wide), 1 / opening];
      const a = (far + near) / (near - far), b = (2 * far * near) / (near - far);
      const rows = [[...side.map((c) => c * x), -x * inner(side, eye)], [...up.map((c) => c * y), -y * inner(up, eye)],
        [...back.map((c) => c * a), -a * inner(back, eye) + b], [...back.map((c) => -c), inner(back, eye)]];
      const view = [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
      const project = (p) => {
        const d = plus(p, eye, -1), away = -inner(d, back);
        return [(x * inner(d, side)) / away, (y * inner(d, up)) / away, away];
      };
      return { view, eye, project };
    },
  };
}

// How finely a picture is drawn: what moves gets coarser until it moves smoothly, what rests is drawn in full.
function pace(again) {
  const levels = [[1, 6], [1, 1], [0.7, 1], [0.5, 1]];
  let level = 0, before = 0, slow = 0, rest;
  return () => {
    const now = performance.now(), gap = now - before;
    before = now;
    clearTimeout(rest);
    rest = setTimeout(() => { before = 0; again(); }, 250);
    if (gap > 200) return levels[0];
    slow += gap > 21 ? 1 : -0.5;
    if (slow > 4 && level < levels.length - 1) [level, slow] = [level + 1, 0];
    slow = Math.max(slow, 0);
    return levels[level];
  };
}
