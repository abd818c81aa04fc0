// Vectors of three numbers, and matrices of nine, columns one after the other.
const plus = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const inner = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const outer = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const l = Math.hypot(...a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };
const apply = (m, [x, y, z]) => [m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z];

// The rotation of a quaternion, scalar part first, of any length.
function rotation([w, x, y, z]) {
  const n = 2 / (w * w + x * x + y * y + z * z || 1);
  return [
    1 - n * (y * y + z * z), n * (x * y + w * z), n * (x * z - w * y),
    n * (x * y - w * z), 1 - n * (x * x + z * z), n * (y * z + w * x),
    n * (x * z + w * y), n * (y * z - w * x), 1 - n * (x * x + y * y),
  ];
}

// A rotation that takes the third axis to a direction.
function towards(direction) {
  const c = unit(direction), a = unit(outer(Math.abs(c[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], c));
  return [...a, ...outer(c, a), ...c];
}
