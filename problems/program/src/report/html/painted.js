// Draws parts on the processor alone: faces from the back to the front, the shadow flat on the ground.

function painted(canvas) {
  const pen = canvas.getContext("2d", { alpha: false });
  const css = (rgb, k = 1) => `rgb(${rgb.map((c) => Math.round(255 * Math.min(1, c * k))).join(" ")})`;
  const trail = (pen, points, style, thick) => {
    pen.beginPath();
    for (const [x, y] of points) pen.lineTo(x, y);
    [pen.strokeStyle, pen.lineWidth] = [style, thick];
    pen.stroke();
  };
  // Where a point is on the canvas, and how far away.
  const looking = (view, width, height) => ([x, y, z]) => {
    const far = view[3] * x + view[7] * y + view[11] * z + view[15];
    const across = view[0] * x + view[4] * y + view[8] * z + view[12], up = view[1] * x + view[5] * y + view[9] * z + view[13];
    return [(0.5 + (0.5 * across) / far) * width, (0.5 - (0.5 * up) / far) * height, far];
  };

  // The page and the grid, which fades into it, stay as they are while the camera rests.
  const backdrop = document.createElement("canvas");
  let shown = "";
  function ground(floor, view, colours) {
    const { width, height } = canvas, wanted = [...view, width, height, ...colours.page, ...colours.line].join();
    if (wanted === shown) return backdrop;
    shown = wanted;
    [backdrop.width, backdrop.height] = [width, height];
    const pen = backdrop.getContext("2d", { alpha: false }), project = looking(view, width, height);
    pen.fillStyle = css(colours.page);
    pen.fillRect(0, 0, width, height);
    if (!floor) return backdrop;
    const { turn, at, wide } = floor, style = css(colours.line);
    for (const { ends, middle, strong } of gridded(floor, 24)) {
      const [from, to] = ends.map(([x, y]) => project(plus(at, apply(turn, [x, y, 0]))));
      if (Math.min(from[2], to[2]) < 0.05 * wide) continue;
      pen.globalAlpha = strong * faded(middle, wide);
      if (pen.globalAlpha > 0.01) trail(pen, [from, to], style, 1);
    }
    return backdrop;
  }

  return ({ parts, thrusts, floor, traces, camera, sun, colours }) => {
    const { width, height } = canvas, { eye, view } = camera, project = looking(view, width, height);
    const up = floor?.turn.slice(6), fall = floor && inner(sun, up), shadow = new Path2D();
    // A mesh is made of faces with four corners, written as two triangles of three times seven numbers.
    const faces = (list, casts) => {
      const found = [];
      for (const { mesh, turn, scale, at, first, second } of list) {
        const numbers = meshes[mesh];
        for (let i = 0; i < numbers.length; i += 42) {
          const corners = [0, 7, 14, 35].map((k) => {
            const [x, y, z] = apply(turn, [numbers[i + k] * scale[0], numbers[i + k + 1] * scale[1], numbers[i + k + 2] * scale[2]]);
            return [at[0] + x, at[1] + y, at[2] + z];
          });
          const sum = (k) => (numbers[i + k] + numbers[i + k + 7] + numbers[i + k + 14] + numbers[i + k + 35]) / scale[k - 3];
          const normal = unit(apply(turn, [sum(3), sum(4), sum(5)]));
          const light = inner(normal, sun), [one, , two] = corners;
          if (casts && light > 0) {
            const flat = corners.map((c) => project(plus(c, sun, -inner(plus(c, floor.at, -1), up) / fall)));
            const area = (flat[2][0] - flat[0][0]) * (flat[3][1] - flat[1][1]) - (flat[2][1] - flat[0][1]) * (flat[3][0] - flat[1][0]);
            trace(shadow, area > 0 ? flat : flat.reverse());
          }
          const middle = [(one[0] + two[0]) / 2, (one[1] + two[1]) / 2, (one[2] + two[2]) / 2];
          if (inner(normal, plus(eye, middle, -1)) <= 0) continue;
          const bright = 0.62 + 0.12 * normal[2] + 0.36 * Math.max(light, 0);
          found.push({ far: project(middle)[2], corners, style: css(numbers[i + 6] > 0.5 ? second : first, bright) });
        }
      }
      return found.sort((a, b) => b.far - a.far);
    };
    const all = [...faces(parts, !!floor), ...faces(thrusts, false)];
    pen.drawImage(ground(floor, view, colours), 0, 0);
    [pen.fillStyle, pen.globalAlpha] = [css(colours.dark), 0.28];
    pen.fill(shadow);
    pen.globalAlpha = 1;
    for (const { points, count } of traces) trail(pen, points.slice(0, count).map(project), css(colours.quiet), 1.5);
    // Faces of one colour that follow each other are filled together, and a line around them hides the seams.
    pen.lineWidth = 0.7;
    for (let i = 0; i < all.length; ) {
      const path = new Path2D(), { style } = all[i];
      for (; i < all.length && all[i].style === style; i++) trace(path, all[i].corners.map(project));
      pen.fillStyle = pen.strokeStyle = style;
      pen.fill(path);
      pen.stroke(path);
    }
  };
}

function trace(path, corners) {
  path.moveTo(corners[0][0], corners[0][1]);
  // `closePath` takes longer with every face that the path has already.
  for (const i of [1, 2, 3, 0]) path.lineTo(corners[i][0], corners[i][1]);
}
