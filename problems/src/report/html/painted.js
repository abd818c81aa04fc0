// Draws parts without WebGL: triangles from the back to the front, the shadow flat on the ground.

function painted(canvas) {
  const pen = canvas.getContext("2d");
  const css = (rgb, k = 1) => `rgb(${rgb.map((c) => Math.round(255 * Math.min(1, c * k))).join(" ")})`;
  return ({ parts, thrusts, floor, traces, camera, sun, colours }) => {
    const { width, height } = canvas, { eye } = camera;
    const project = (p) => { const [x, y, z] = camera.project(p); return [(0.5 + 0.5 * x) * width, (0.5 - 0.5 * y) * height, z]; };
    const stroke = (points, style, thick) => {
      pen.beginPath();
      for (const [x, y] of points) pen.lineTo(x, y);
      [pen.strokeStyle, pen.lineWidth] = [style, thick];
      pen.stroke();
    };
    pen.fillStyle = css(colours.page);
    pen.fillRect(0, 0, width, height);
    const dark = [];
    const faces = (list, casts) => list.flatMap(({ mesh, turn, scale, at, first, second }) => {
      const triangles = [];
      const numbers = meshes[mesh];
      for (let i = 0; i < numbers.length; i += 21) {
        const corner = [0, 7, 14].map((k) => plus(at, apply(turn, [0, 1, 2].map((c) => numbers[i + k + c] * scale[c]))));
        const normal = unit(apply(turn, [0, 1, 2].map((c) => (numbers[i + 3 + c] + numbers[i + 10 + c] + numbers[i + 17 + c]) / scale[c])));
        const middle = corner.reduce((sum, c) => plus(sum, c, 1 / 3), [0, 0, 0]);
        if (floor && casts && inner(normal, sun) > 0) {
          const up = floor.turn.slice(6), fall = inner(sun, up);
          dark.push(corner.map((c) => plus(c, sun, -inner(plus(c, floor.at, -1), up) / fall)));
        }
        if (inner(normal, plus(eye, middle, -1)) <= 0) continue;
        const bright = 0.62 + 0.12 * normal[2] + 0.36 * Math.max(inner(normal, sun), 0);
        triangles.push([project(middle)[2], corner, css(numbers[i + 6] > 0.5 ? second : first, bright)]);
      }
      return triangles;
    }).sort((a, b) => b[0] - a[0]);
    const all = [...faces(parts, true), ...faces(thrusts, false)];
    if (floor) {
      const reach = Math.min(Math.ceil((0.6 * floor.wide) / floor.cell), 40) * floor.cell;
      const spot = (x, y) => project(plus(floor.at, apply(floor.turn, [x, y, 0])));
      // Lines end on a circle, and where they pass the eye.
      const line = (at, far) => {
        let seen = [];
        for (let i = -12; i <= 12; i++) {
          const next = at((far * i) / 12), behind = next[2] < 0.05 * reach;
          if (!behind) seen.push(next);
          if (behind || i === 12) { stroke(seen, css(colours.line), 1); seen = []; }
        }
      };
      for (let x = -reach; x <= reach; x += floor.cell) {
        const far = Math.sqrt(Math.max(reach * reach - x * x, 0));
        line((y) => spot(x - floor.begin[0], y), far);
        line((y) => spot(y, x - floor.begin[1]), far);
      }
      pen.beginPath();
      for (const corner of dark) {
        const [a, b, c] = corner.map(project);
        const turned = (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]) ? [a, b, c] : [a, c, b];
        turned.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
      }
      [pen.fillStyle, pen.globalAlpha] = [css(colours.ink), 0.15];
      pen.fill();
      pen.globalAlpha = 1;
    }
    for (const { points, count } of traces) stroke(points.slice(0, count).map(project), css(colours.quiet), 1.5);
    pen.lineWidth = 0.7;
    for (const [, corner, style] of all) {
      pen.beginPath();
      for (const [x, y] of corner.map(project)) pen.lineTo(x, y);
      pen.closePath();
      pen.fillStyle = pen.strokeStyle = style;
      pen.fill();
      pen.stroke();
    }
  };
}
