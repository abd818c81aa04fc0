// Draws parts with WebGL: light, the shadows that they throw, a ground with a grid. Nothing if there is no WebGL.

const common = `#version 300 es
precision highp float;
precision highp sampler2DShadow;
`;
const solidVertex = `${common}
in vec3 place; in vec3 normal; in float tone;
uniform mat4 view, light; uniform mat3 turn; uniform vec3 scale, at, first, second; uniform float away;
out vec3 where, facing, base; out vec4 lit;
void main() {
  where = turn * (scale * place) + at;
  facing = turn * (normal / scale);
  base = tone > 0.5 ? second : first;
  gl_Position = view * vec4(where, 1.0);
  lit = light * vec4(where + away * normalize(facing), 1.0);
}`;
const shade = `
uniform sampler2DShadow shadow; uniform float texel, taps;
float bright(vec4 lit) {
  vec3 p = lit.xyz * 0.5 + 0.5;
  if (p.z > 1.0) return 1.0;
  float sum = 0.0;
  for (float i = 0.0; i < taps; i++) {
    float angle = i * 2.4, far = sqrt(i / taps) * 3.0;
    sum += texture(shadow, vec3(p.xy + texel * far * vec2(cos(angle), sin(angle)), p.z));
  }
  return sum / taps;
}`;
const solidFragment = `${common}
in vec3 where, facing, base; in vec4 lit; out vec4 colour;
uniform vec3 sun, eye;
${shade}
void main() {
  vec3 n = normalize(facing), look = normalize(eye - where);
  if (dot(n, look) < 0.0) n = -n;
  float front = dot(n, sun), seen = front > 0.0 ? bright(lit) : 0.0;
  float gloss = pow(max(dot(n, normalize(sun + look)), 0.0), 50.0);
  colour = vec4(base * (0.62 + 0.12 * n.z + 0.36 * max(front, 0.0) * seen) + 0.22 * gloss * seen, 1.0);
}`;
const depthVertex = `${common}
in vec3 place; uniform mat4 light; uniform mat3 turn; uniform vec3 scale, at;
void main() { gl_Position = light * vec4(turn * (scale * place) + at, 1.0); }`;
const depthFragment = `${common}
void main() {}`;
const groundVertex = `${common}
in vec3 place; in float fade; uniform mat4 view; out float strong;
void main() { gl_Position = view * vec4(place, 1.0); strong = fade; }`;
const plainFragment = `${common}
in float strong; uniform vec3 first; out vec4 colour;
void main() { colour = vec4(first, strong); }`;
const shadowVertex = `${common}
in vec2 corner; uniform mat4 view, light; uniform mat3 turn; uniform vec3 at; uniform vec2 wide, begin; out vec4 lit;
void main() {
  vec3 where = turn * vec3(begin + corner * wide, 0.0) + at;
  gl_Position = view * vec4(where, 1.0);
  lit = light * vec4(where, 1.0);
}`;
const shadowFragment = `${common}
in vec4 lit; uniform vec3 first; out vec4 colour;
${shade}
void main() { colour = vec4(first, 0.28 * (1.0 - bright(lit))); }`;
const lineVertex = `${common}
in vec3 place, ahead; in float side, fade; uniform mat4 view; uniform vec2 pixel; out float strong;
void main() {
  strong = fade;
  vec4 a = view * vec4(place, 1.0), b = view * vec4(place + ahead, 1.0);
  vec2 along = b.xy / b.w - a.xy / a.w;
  vec2 screen = normalize(along / pixel + vec2(1e-9, 0.0));
  gl_Position = vec4(a.xy + vec2(-screen.y, screen.x) * side * pixel * a.w, a.z - 1e-4 * a.w, a.w);
}`;
const mapSize = 1024;
// A light whose picture holds nothing.
const beyond = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 1];

// Whether there is WebGL on a graphics card. A program in its place takes three times as long as painting.
function accelerated() {
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return false;
  const named = gl.getExtension("WEBGL_debug_renderer_info"), card = gl.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(card);
}

function webgl(canvas) {
  const gl = canvas.getContext("webgl2", { alpha: false, antialias: true });
  if (!gl) return null;
  const program = (vertex, fragment) => {
    const made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const part = gl.createShader(kind);
      gl.shaderSource(part, text);
      gl.compileShader(part);
      gl.attachShader(made, part);
    }
    ["place", "normal", "tone"].forEach((name, i) => gl.bindAttribLocation(made, i, name));
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made) || "no program");
    const places = {};
    for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(made, i);
      places[name] = gl.getUniformLocation(made, name);
    }
    return { made, places };
  };
  const solid = program(solidVertex, solidFragment), depth = program(depthVertex, depthFragment);
  const ground = program(groundVertex, plainFragment), line = program(lineVertex, plainFragment);
  const fallen = program(shadowVertex, shadowFragment);
  const buffer = (numbers, layout) => {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    const stride = layout.reduce((sum, [, width]) => sum + width, 0);
    let from = 0;
    for (const [where, width] of layout) {
      if (where >= 0) {
        gl.enableVertexAttribArray(where);
        gl.vertexAttribPointer(where, width, gl.FLOAT, false, 4 * stride, 4 * from);
      }
      from += width;
    }
    return { array, count: numbers.length / stride };
  };
  const kept = {};
  const shape = (name) => (kept[name] ??= buffer(meshes[name], [[0, 3], [1, 3], [2, 1]]));
  const layout = ({ made }, ...parts) => parts.map(([name, width]) => [gl.getAttribLocation(made, name), width]);
  const square = buffer(new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), layout(fallen, ["corner", 2]));
  const lineLayout = layout(line, ["place", 3], ["ahead", 3], ["side", 1], ["fade", 1]);
  const ribbon = (points) => {
    const numbers = new Float32Array(points.length * 16);
    points.forEach((point, i) => {
      const ahead = plus(points[Math.min(i + 1, points.length - 1)], points[Math.max(i - 1, 0)], -1);
      for (const side of [0, 1]) numbers.set([...point, ...ahead, 2 * side - 1, 1], 16 * i + 8 * side);
    });
    return buffer(numbers, lineLayout);
  };
  const ribbons = new Map();

  // A round of ground that fades into the page, and the lines of its grid.
  let laid;
  function lay(floor) {
    const { turn, at, wide } = floor;
    const place = (x, y) => plus(at, apply(turn, [x, y, 0])), fan = [...at, 1], lines = [];
    for (let k = 0; k <= 64; k++) fan.push(...place(...round(k / 64).map((x) => x * wide)), 0);
    for (const { ends, strong } of gridded(floor, 12)) {
      const ahead = plus(place(...ends[1]), place(...ends[0]), -1);
      for (const [end, side] of [[0, -1], [0, 1], [1, -1], [1, -1], [0, 1], [1, 1]]) lines.push(...place(...ends[end]), ...ahead, 0.55 * side, strong * faded(ends[end], wide));
    }
    return { fan: buffer(new Float32Array(fan), layout(ground, ["place", 3], ["fade", 1])), lines: buffer(new Float32Array(lines), lineLayout) };
  }
  // The part of the ground that shadows can fall on.
  function reached(parts, { turn, at }, sun) {
    const side = turn.slice(0, 3), up = turn.slice(3, 6), out = turn.slice(6), low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const part of parts) {
      const apart = plus(part.at, at, -1), foot = plus(apart, sun, -inner(apart, out) / inner(sun, out)), reach = 1.6 * Math.max(...part.scale);
      [side, up].forEach((axis, k) => {
        low[k] = Math.min(low[k], inner(foot, axis) - reach);
        high[k] = Math.max(high[k], inner(foot, axis) + reach);
      });
    }
    return { begin: low, wide: [high[0] - low[0], high[1] - low[1]] };
  }

  const texture = gl.createTexture(), target = gl.createFramebuffer();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, mapSize, mapSize);
  for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
  for (const size of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, size, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, texture, 0);
  gl.enable(gl.DEPTH_TEST);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);

  const put = ({ made, places }, values) => {
    gl.useProgram(made);
    for (const [name, value] of Object.entries(values)) {
      const where = places[name];
      if (where === undefined) continue;
      if (typeof value === "number") gl.uniform1f(where, value);
      else if (value.length === 2) gl.uniform2fv(where, value);
      else if (value.length === 3) gl.uniform3fv(where, value);
      else if (value.length === 9) gl.uniformMatrix3fv(where, false, value);
      else gl.uniformMatrix4fv(where, false, value);
    }
  };
  const draw = (which, part) => {
    const { array, count } = shape(part.mesh);
    put(which, part);
    gl.bindVertexArray(array);
    gl.drawArrays(gl.TRIANGLES, 0, count);
  };

  return ({ parts, thrusts, floor, traces, camera, light, away, sun, colours, taps }) => {
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(0, 0, mapSize, mapSize);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2, 6);
    put(depth, { light });
    for (const part of parts) draw(depth, part);
    gl.disable(gl.POLYGON_OFFSET_FILL);

    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...colours.page, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { view, eye } = camera, texel = 1 / mapSize;
    const pixel = [2 / canvas.width, 2 / canvas.height];
    if (floor && parts.length) {
      laid ??= lay(floor);
      gl.enable(gl.BLEND);
      gl.depthMask(false);
      put(ground, { view, first: colours.card });
      gl.bindVertexArray(laid.fan.array);
      gl.drawArrays(gl.TRIANGLE_FAN, 0, laid.fan.count);
      put(line, { view, pixel, first: colours.line });
      gl.bindVertexArray(laid.lines.array);
      gl.drawArrays(gl.TRIANGLES, 0, laid.lines.count);
      put(fallen, { view, light, texel, taps, ...floor, ...reached(parts, floor, sun), first: colours.dark });
      gl.bindVertexArray(square.array);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
      gl.depthMask(true);
      gl.disable(gl.BLEND);
    }
    put(solid, { view, light, sun, eye, texel, taps, away });
    for (const part of parts) draw(solid, part);
    put(line, { view, pixel, first: colours.quiet });
    for (const { points, count } of traces) {
      if (!ribbons.has(points)) ribbons.set(points, ribbon(points));
      gl.bindVertexArray(ribbons.get(points).array);
      if (count > 1) gl.drawArrays(gl.TRIANGLE_STRIP, 0, 2 * count);
    }
    // Forces are in front of all, as they act inside, and no shadow falls on them.
    gl.clear(gl.DEPTH_BUFFER_BIT);
    put(solid, { light: beyond });
    for (const part of thrusts) draw(solid, part);
  };
}
