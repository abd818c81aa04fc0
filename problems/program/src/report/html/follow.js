// The part of a plane in which all is that moves, for scenes that go far: what it shows stays as large as it is, and the window goes along.

// The window around what moves at a place among the samples, `[left, top, width, height]`; nothing where the whole is not much larger.
function windowAlong({ height, marks }, count) {
  const moves = (mark) => ["circle", "polygon", "polyline", "placed"].includes(mark.form) && mark.numbers.some(Array.isArray);
  const moving = marks.filter(moves);
  if (!moving.length) return null;
  const span = (mark, where) => {
    const n = mark.numbers.map((column) => at(column, where));
    if (mark.form === "circle") return [n[0] - n[2], n[1] - n[2], n[0] + n[2], n[1] + n[2]];
    if (mark.form === "placed") {
      const turn = (n[2] * Math.PI) / 180, end = [n[0] + n[3] * Math.cos(turn), n[1] + n[3] * Math.sin(turn)];
      return [Math.min(n[0], end[0]), Math.min(n[1], end[1]), Math.max(n[0], end[0]), Math.max(n[1], end[1])];
    }
    const xs = n.filter((_, i) => i % 2 === 0), ys = n.filter((_, i) => i % 2);
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  };
  const there = (where) => moving.filter((mark) => mark.numbers.every((column) => at(column, where) !== null));
  const none = [Infinity, Infinity, -Infinity, -Infinity];
  const all = (where) => there(where).map((mark) => span(mark, where)).reduce(([a, b, c, d], [e, f, g, h]) => [Math.min(a, e), Math.min(b, f), Math.max(c, g), Math.max(d, h)], none);
  let wide = 0;
  for (let i = 0; i < count; i++) {
    const [left, top, right, low] = all([i, 0]);
    wide = Math.max(wide, right - left, ((low - top) * 1000) / height);
  }
  // Arrows and the surroundings need room too.
  wide *= 2.5;
  if (!(wide > 0 && wide < 600)) return null;
  const high = (wide * height) / 1000;
  let window = [0, 0, wide, high];
  return (where) => {
    const [left, top, right, low] = all(where);
    // Where nothing is it stays.
    if (left <= right) window = [(left + right - wide) / 2, (top + low - high) / 2, wide, high];
    return window;
  };
}
