// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the picture in 3D: slabs bounded by outlines, as surfaces and as sections.
import {BufferGeometry, Float32BufferAttribute, ShapeUtils, SphereGeometry, Vector2} from 'three';

const {model} = window.trueflank;
const turned = (p, angle) => [p[0] * Math.cos(angle) - p[1] * Math.sin(angle), p[0] * Math.sin(angle) + p[1] * Math.cos(angle)];

function circlePoints(x, y, radius) {
  const chord = model.solid_chord_error_um / 1000;
  const n = Math.max(24, Math.ceil(Math.PI / Math.acos(Math.max(0, 1 - chord / radius))));
  return Array.from({length: n}, (_, i) => {
    const angle = 2 * Math.PI * i / n;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}
/** All teeth of a gear from the outline of one. */
function allTeeth(tooth, teeth, rotation) {
  const points = [];
  for (let k = 0; k < teeth; ++k)
    for (let i = 0; i < tooth.length; i += 2)
      points.push(turned([tooth[i], tooth[i + 1]], rotation + 2 * Math.PI * k / teeth));
  return points;
}
/** Closed, counter-clockwise points of an outline, and how it twists or changes with height. */
function outlinePoints(outline) {
  if (outline.circle) return {points: circlePoints(...outline.circle), twist: 0};
  if (outline.polygon) {
    const points = [];
    for (let i = 0; i < outline.polygon.length; i += 2) points.push([outline.polygon[i], outline.polygon[i + 1]]);
    return {points, twist: 0};
  }
  const gear = model.gears[outline.gear];
  const points = allTeeth(gear.coarse_tooth, gear.teeth, outline.rotation);
  const rows = gear.rows?.map(({z, tooth}) =>
    ({height: outline.z_lower + z, points: allTeeth(tooth, gear.teeth, outline.rotation)}));
  return {points, rows, twist: gear.twist_rad_per_mm, herringbone: gear.herringbone, width: gear.width};
}
/** Heights at which an outline needs points, with these. */
function layers(outline, [lower, upper]) {
  const {points, rows} = outline;
  if (rows) return rows.filter(({height}) => height > lower - 1e-4 && height < upper + 1e-4);
  if (!outline.twist) return [{height: lower, points}, {height: upper, points}];
  const height = upper - lower, n = 2 * Math.max(1, Math.ceil(Math.abs(outline.twist * height) / 0.1));
  return Array.from({length: n + 1}, (_, i) => {
    const z = height * i / n, twist = outline.twist * (outline.herringbone ? Math.min(z, height - z) : z);
    return {height: lower + z, points: points.map((p) => turned(p, twist))};
  });
}

class SolidBuilder {
  constructor() { this.positions = []; this.normals = []; this.lines = []; }

  triangle(a, b, c, na, nb, nc) {
    this.positions.push(...a, ...b, ...c);
    this.normals.push(...na, ...nb, ...nc);
  }
  /** Walls of an outline; `outward` is -1 for a hole. */
  walls(steps, outward) {
    const n = steps[0].points.length;
    const rows = steps.map(({height, points}) => {
      const direction = points.map((p, i) => {
        const q = points[(i + 1) % n], d = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
        return [(q[0] - p[0]) / d, (q[1] - p[1]) / d];
      });
      const normal = (d) => [outward * d[1], -outward * d[0]];
      // smooth across a small turn, sharp across an edge
      const blended = (i, j, own) => {
        const [a, b] = [direction[i], direction[j]];
        if (a[0] * b[0] + a[1] * b[1] < 0.85) return normal(direction[own]);
        const sum = [a[0] + b[0], a[1] + b[1]], d = Math.hypot(...sum);
        return normal([sum[0] / d, sum[1] / d]);
      };
      return {points: points.map((p) => [...p, height]),
              before: points.map((_, i) => blended((i + n - 1) % n, i, i)),
              after: points.map((_, i) => blended(i, (i + 1) % n, i))};
    });
    // square to the wall's rise from one row to the next, too
    const rising = (normal, lo, hi) => {
      const up = hi[2] - lo[2] || 1;
      const slope = -(normal[0] * (hi[0] - lo[0]) + normal[1] * (hi[1] - lo[1])) / up;
      const d = Math.hypot(1, slope);
      return [normal[0] / d, normal[1] / d, slope / d];
    };
    for (let k = 0; k + 1 < rows.length; ++k) for (let i = 0; i < n; ++i) {
      const j = (i + 1) % n, lo = rows[k], hi = rows[k + 1];
      const [a, b, c, d] = [lo.points[i], lo.points[j], hi.points[j], hi.points[i]];
      const [na, nb] = [rising(lo.before[i], a, d), rising(lo.after[i], b, c)];
      const [nc, nd] = [rising(hi.after[i], b, c), rising(hi.before[i], a, d)];
      if (outward > 0) { this.triangle(a, b, c, na, nb, nc); this.triangle(a, c, d, na, nc, nd); }
      else { this.triangle(b, a, d, nb, na, nd); this.triangle(b, d, c, nb, nd, nc); }
    }
    for (const {points} of [rows[0], rows[rows.length - 1]])
      for (let i = 0; i < n; ++i) this.lines.push(...points[i], ...points[(i + 1) % n]);
  }
  /** A plane face between points at a height; `up` is 1 or -1. */
  face(outer, holes, height, up) {
    const flat = (points) => points.map((p) => new Vector2(...p));
    const contour = flat(outer), cuts = holes.map(flat);
    const all = [...contour, ...cuts.flat()], normal = [0, 0, up];
    for (const [i, j, k] of ShapeUtils.triangulateShape(contour, cuts)) {
      const [a, b, c] = [i, j, k].map((v) => [all[v].x, all[v].y, height]);
      const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      if (area * up > 0) this.triangle(a, b, c, normal, normal, normal);
      else this.triangle(a, c, b, normal, normal, normal);
    }
  }
  geometry() {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(this.positions, 3));
    geometry.setAttribute('normal', new Float32BufferAttribute(this.normals, 3));
    return geometry;
  }
  edges() {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(this.lines, 3));
    return geometry;
  }
}

/** A ball bearing is bought as the room it takes; it is drawn with its rings and balls. */
function bearingOf(part) {
  const [slab] = part.slabs;
  if (!part.name.startsWith('bearing_') || part.slabs.length !== 1 || !slab.outer.circle || !slab.holes[0]?.circle) return null;
  const [x, y, outer] = slab.outer.circle, bore = slab.holes[0].circle[2], wall = outer - bore, width = slab.z[1] - slab.z[0];
  const ring = (from, to) => ({z: slab.z, outer: {circle: [x, y, to]}, holes: [{circle: [x, y, from]}]});
  const middle = (outer + bore) / 2, radius = Math.min(0.32 * wall, 0.4 * width);
  return {rings: [ring(outer - 0.27 * wall, outer), ring(bore, bore + 0.27 * wall)],
          middle, radius, count: Math.floor(Math.PI / Math.asin(Math.min(1, 1.2 * radius / middle))),
          height: (slab.z[0] + slab.z[1]) / 2};
}
/** The balls as one surface. */
function ballsOf({middle, radius, count, height}) {
  const ball = new SphereGeometry(radius, 20, 12).toNonIndexed(), positions = [], normals = [];
  for (let k = 0; k < count; ++k) {
    const [x, y] = turned([middle, 0], 2 * Math.PI * k / count);
    const p = ball.attributes.position.array, n = ball.attributes.normal.array;
    for (let i = 0; i < p.length; i += 3) positions.push(p[i] + x, p[i + 1] + y, p[i + 2] + height);
    normals.push(...n);
  }
  return {positions, normals};
}

/** Surface, edges and slabs (with the layers of their outlines, for sections) of a part. */
export function solidOf(part) {
  const builder = new SolidBuilder(), bearing = bearingOf(part);
  const slabs = (bearing?.rings ?? part.slabs).map((slab) => ({z: slab.z, outlines: [slab.outer, ...slab.holes]
    .map((outline) => layers(outlinePoints(outline), slab.z))}));
  for (const {z, outlines} of slabs) {
    outlines.forEach((steps, i) => builder.walls(steps, i ? -1 : 1));
    // where slabs touch both faces are drawn: what one leaves open the other may not cover
    for (const [height, up] of [[z[0], -1], [z[1], 1]]) {
      const [outer, ...holes] = outlines.map((steps) => steps[up > 0 ? steps.length - 1 : 0].points);
      builder.face(outer, holes, height, up);
    }
  }
  if (bearing) {
    const {positions, normals} = ballsOf(bearing);
    for (const value of positions) builder.positions.push(value);
    for (const value of normals) builder.normals.push(value);
  }
  return {geometry: builder.geometry(), edges: builder.edges(), slabs};
}

/** Where a line enters and leaves a closed polygon: positions along it from the point nearest `from`. */
function crossings(points, from, along, found) {
  let [px, py] = points[points.length - 1];
  let before = (px - from[0]) * along[1] - (py - from[1]) * along[0];
  for (const [x, y] of points) {
    const side = (x - from[0]) * along[1] - (y - from[1]) * along[0];
    if ((side > 0) !== (before > 0)) {
      const t = before / (before - side);
      found.push((px + t * (x - px) - from[0]) * along[0] + (py + t * (y - py) - from[1]) * along[1]);
    }
    [px, py, before] = [x, y, side];
  }
}
/**
 * The section of a part's slabs with the upright half-plane over a ray in the part's frame: rectangles
 * (trapezoids of twisted teeth) {z0, z1, lower: [from, to], upper: [from, to]}.
 */
export function sectionOf(slabs, from, along) {
  const found = [];
  for (const {z, outlines} of slabs) {
    const steps = outlines.reduce((a, b) => b.length > a.length ? b : a);
    const cut = (k) => {
      const places = [];
      for (const outline of outlines) crossings((outline.length === steps.length ? outline[k] : outline[0]).points, from, along, places);
      places.sort((a, b) => a - b);
      const spans = [];
      for (let i = 0; i + 1 < places.length; i += 2)
        if (places[i + 1] > 0) spans.push([Math.max(0, places[i]), places[i + 1]]);
      return spans;
    };
    let lower = cut(0);
    for (let k = 0; k + 1 < steps.length; ++k) {
      const upper = steps[k + 1].points === steps[k].points ? lower : cut(k + 1);
      const same = upper.length === lower.length;
      lower.forEach((span, i) => found.push({z0: steps[k].height, z1: steps[k + 1].height, lower: span,
        upper: same ? upper[i] : span, low: z[0], high: z[1]}));
      lower = upper;
    }
  }
  return found;
}
