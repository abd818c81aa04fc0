// Solids of size one as triangles: places, normals, and which of two colours.

// A surface over two parameters from 0 to 1; `at` gives a place and a normal, `tone` the colour of each cell.
function surface(mesh, across, along, at, tone = () => 0) {
  for (let i = 0; i < across; i++) {
    for (let k = 0; k < along; k++) {
      const corners = [[i, k], [i + 1, k], [i + 1, k + 1], [i, k + 1]].map(([u, v]) => at(u / across, v / along));
      const colour = tone((i + 0.5) / across, (k + 0.5) / along);
      for (const c of [0, 1, 2, 0, 2, 3]) mesh.push(...corners[c][0], ...corners[c][1], colour);
    }
  }
  return mesh;
}

const round = (u) => [Math.cos(2 * Math.PI * u), Math.sin(2 * Math.PI * u)];

// A part of the sphere, from one height to another.
function cap(mesh, across, along, [low, high], tone) {
  return surface(mesh, across, along, (u, v) => {
    const [c, s] = round(u), tilt = low + v * (high - low);
    const place = [c * Math.cos(tilt), s * Math.cos(tilt), Math.sin(tilt)];
    return [place, place];
  }, tone);
}

// A flat round face at a height.
function plate(mesh, across, along, height, tone) {
  const side = Math.sign(height) || 1;
  return surface(mesh, across, along, (u, v) => {
    const [c, s] = round(side * u);
    return [[v * c, v * s, height], [0, 0, side]];
  }, tone);
}

// The second half of a mesh turned inside out.
function inward(mesh) {
  for (let i = mesh.length / 2; i < mesh.length; i += 7) {
    for (const k of [0, 1, 2]) mesh[i + k] *= 0.99;
    for (const k of [3, 4, 5]) mesh[i + k] *= -1;
  }
  return mesh;
}

function tube(mesh, across, along, [low, high], [from, to], tone) {
  const slope = (from - to) / (high - low);
  return surface(mesh, across, along, (u, v) => {
    const [c, s] = round(u), wide = from + v * (to - from), long = Math.hypot(1, slope);
    return [[wide * c, wide * s, low + v * (high - low)], [c / long, s / long, slope / long]];
  }, tone);
}

function cube(mesh, cells) {
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      surface(mesh, cells, cells, (u, v) => {
        const place = [0, 0, 0], normal = [0, 0, 0];
        place[axis] = side / 2;
        place[(axis + 1) % 3] = side * (u - 0.5);
        place[(axis + 2) % 3] = v - 0.5;
        normal[axis] = side;
        return [place, normal];
      });
    }
  }
  return mesh;
}

// The lines of a ground's grid in pieces: the two ends of each, in the plane, and how strong it is; every fifth line is stronger.
function gridded({ wide, cell, begin }, parts) {
  const count = Math.min(Math.floor(wide / cell), 60), pieces = [], first = begin.map((x) => -(((x % cell) + cell) % cell));
  for (const across of [0, 1]) {
    for (let k = -count; k <= count; k++) {
      const off = first[across] + k * cell, far = Math.sqrt(Math.max(wide * wide - off * off, 0));
      const strong = Math.round((off + begin[across]) / cell) % 5 === 0 ? 1 : 0.5;
      const spot = (i) => { const on = far * ((2 * i) / parts - 1); return across ? [on, off] : [off, on]; };
      for (let i = 0; i < parts; i++) pieces.push({ ends: [spot(i), spot(i + 1)], middle: spot(i + 0.5), strong });
    }
  }
  return pieces;
}
// The ground fades into the page towards its border.
const faded = ([x, y], wide) => Math.max(0, Math.min(1, 1.6 * (1 - Math.hypot(x, y) / wide))) ** 2;

const right = Math.PI / 2;
// A belt and two poles: no turn of the ball goes unseen.
const striped = (u, v) => (Math.abs(v - 0.5) < 0.125 || Math.abs(v - 0.5) > 0.43 || (u < 0.0625 && v > 0.5) ? 1 : 0);
const sector = (u) => (u < 1 / 16 ? 1 : 0);
const meshes = {
  ball: cap([], 48, 28, [-right, right], striped),
  bead: cap([], 8, 5, [-right, right]),
  pivot: cap([], 20, 10, [-right, right]),
  mass: cap([], 28, 16, [-right, right]),
  "half ellipsoid": plate(cap([], 56, 14, [-right, 0], () => 1), 56, 3, 0),
  box: cube([], 4),
  shell: cap([], 56, 28, [-right, right]),
  // Both sides are seen: that from outside first.
  bowl: inward(cap(cap([], 56, 14, [-right, 0], () => 1), 56, 14, [-right, 0])),
  disc: plate(plate(tube([], 64, 1, [-0.5, 0.5], [1, 1]), 64, 3, 0.5, sector), 64, 3, -0.5, sector),
  rod: tube([], 12, 1, [0, 1], [1, 1]),
  shaft: tube([], 10, 1, [0, 1], [1, 1]),
  tip: plate(tube([], 14, 1, [0, 1], [1, 0]), 14, 1, 0),
};
for (const name of Object.keys(meshes)) meshes[name] = new Float32Array(meshes[name]);
