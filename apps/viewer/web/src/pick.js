// SPDX-License-Identifier: GPL-3.0-or-later
// What a ray hits first, by the formulas that the shaders use. Distances along the ray in m.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Where a ray enters and leaves a ball; nothing if it misses. */
export function throughBall(start, ray, c, r) {
  const to = sub(c, start), middle = dot(to, ray);
  const across = [to[0] - middle * ray[0], to[1] - middle * ray[1], to[2] - middle * ray[2]];
  const h = r * r - dot(across, across);
  return h < 0 ? null : [middle - Math.sqrt(h), middle + Math.sqrt(h)];
}

/** Likewise of a segment swept by a ball: the union of a cylinder and two balls is convex. */
export function throughCapsule(start, ray, a, b, r) {
  let lo = Infinity, hi = -Infinity;
  const take = (t0, t1) => { lo = Math.min(lo, t0); hi = Math.max(hi, t1); };
  for (const end of [a, b]) {
    const ball = throughBall(start, ray, end, r);
    if (ball) take(...ball);
  }
  const along = sub(b, a), l2 = dot(along, along), lr = dot(along, ray);
  if (l2 > 0 && l2 - lr * lr > 1e-12 * l2) {
    const to = sub(start, a), ls = dot(along, to);
    const p = to.map((x, k) => x - along[k] * ls / l2), q = ray.map((x, k) => x - along[k] * lr / l2);
    const qq = dot(q, q), pq = dot(p, q), h = pq * pq - qq * (dot(p, p) - r * r);
    if (h >= 0)
      for (const t of [(-pq - Math.sqrt(h)) / qq, (-pq + Math.sqrt(h)) / qq]) {
        const y = ls + t * lr;
        if (y > 0 && y < l2) take(t, t);
      }
  }
  return lo <= hi ? [lo, hi] : null;
}

/** Where a ray passes a triangle; nothing if it misses. Möller and Trumbore (1997). */
export function throughTriangle(start, ray, a, b, c) {
  const e1 = sub(b, a), e2 = sub(c, a), p = cross(ray, e2), det = dot(e1, p);
  if (det === 0) return null;
  const s = sub(start, a), u = dot(s, p) / det, q = cross(s, e1), v = dot(ray, q) / det;
  return u < 0 || v < 0 || u + v > 1 ? null : dot(e2, q) / det;
}
