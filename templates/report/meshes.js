// SPDX-License-Identifier: GPL-3.0-or-later
// The drawings of the meshes, turning in 2D, and where one fails.
'use strict';
(() => {
const {report, model, still, h, byId, number} = window.trueflank;

const rotated = (x, y, angle) => [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle)];
/** Points of teeth first .. last, tooth 0 centred on +x. */
function teethPoints(gear, first, last) {
  const points = [];
  for (let k = first; k <= last; ++k)
    for (let i = 0; i < gear.tooth.length; i += 2)
      points.push(rotated(gear.tooth[i], gear.tooth[i + 1], 2 * Math.PI * k / gear.teeth));
  return points;
}
/** Teeth around tooth 1 as a filled outline: an external gear closes at its axis, a ring outside. */
function sectorPath(gear, most) {
  const reach = Math.min(most, Math.floor((gear.teeth - 1) / 2));
  const points = teethPoints(gear, -reach, reach);
  const path = points.map(([x, y]) => `${x.toFixed(5)} ${y.toFixed(5)}`);
  if (!gear.internal) return `M0 0L${path.join('L')}Z`;
  const rim = gear.root_radius + 6 * gear.module;
  const out = ([x, y]) => { const s = rim / Math.hypot(x, y); return `${(x * s).toFixed(4)} ${(y * s).toFixed(4)}`; };
  return `M${path.join('L')}L${points.filter((_, i) => i % 8 === 0 || i === points.length - 1).reverse().map(out).join('L')}Z`;
}
/** Nearest points of two polylines (vertices of either against segments of the other). */
function closest(a, b) {
  let best = {distance: Infinity};
  const scan = (points, line, swap) => {
    for (const p of points) for (let i = 0; i + 1 < line.length; ++i) {
      const [ax, ay] = line[i], dx = line[i + 1][0] - ax, dy = line[i + 1][1] - ay;
      const t = Math.max(0, Math.min(1, ((p[0] - ax) * dx + (p[1] - ay) * dy) / (dx * dx + dy * dy || 1)));
      const qx = ax + t * dx, qy = ay + t * dy, d = Math.hypot(p[0] - qx, p[1] - qy);
      if (d < best.distance) best = {distance: d, p: swap ? [qx, qy] : p, q: swap ? p : [qx, qy]};
    }
  };
  scan(a, b, false);
  scan(b, a, true);
  return best;
}

/** How deep points of one gear stand in the teeth of another, in that one's frame (tooth 1 on +x). */
class ToothSpace {
  constructor(gear) {
    this.gear = gear;
    this.line = teethPoints(gear, -1, 1);
    const radii = this.line.map((p) => Math.hypot(...p));
    [this.low, this.high] = [Math.min(...radii), Math.max(...radii)];
    const far = gear.internal ? this.high + gear.module : 0, angle = 3 * Math.PI / gear.teeth;
    this.closed = [...this.line, ...(far ? [rotated(far / Math.cos(angle), 0, angle), rotated(far / Math.cos(angle), 0, -angle)] : [[0, 0]])];
  }
  inside([x, y]) {
    let odd = false;
    this.closed.forEach(([ax, ay], i) => {
      const [bx, by] = this.closed[(i + 1) % this.closed.length];
      if ((ay > y) !== (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)) odd = !odd;
    });
    return odd;
  }
  depth(p) {
    const r = Math.hypot(...p);
    if (r < this.low || r > this.high) return 0;
    const pitch = 2 * Math.PI / this.gear.teeth, near = rotated(...p, -pitch * Math.round(Math.atan2(p[1], p[0]) / pitch));
    return this.inside(near) ? closest([near], this.line).distance : 0;
  }
}

class MeshDrawing {
  constructor(mesh, index) {
    this.mesh = mesh;
    this.gear1 = model.gears[mesh.gear1];
    this.gear2 = model.gears[mesh.gear2];
    this.internal = this.gear2.internal;
    this.phase = 0;
    this.playing = false;
    this.axis2 = this.internal ? -mesh.centre_distance : mesh.centre_distance;
    // tooth 1 of gear 1 stands on the line of centres, in the middle of a gap of gear 2
    this.start2 = this.internal ? -Math.PI / this.gear2.teeth : Math.PI + Math.PI / this.gear2.teeth;
    this.points1 = teethPoints(this.gear1, -2, 2);
    this.points2 = teethPoints(this.gear2, -2, 2);
    this.centre = [mesh.pitch_radius1, 0];
    this.failing = report.checks.some((c) => c.status === 'fail' && c.where === mesh.name);
    this.overlaps = report.meshes[mesh.name].penetration_um > 1;
    this.reach = this.overlaps ? 12 : 6;  // teeth drawn on either side
    this.draw(index);
    if (this.overlaps) this.showWorst();
    else this.show();
  }

  /** Angles of both gears at a phase of the pitch. */
  turns(phase) {
    const turn1 = (phase - 0.5) * 2 * Math.PI / this.gear1.teeth;
    return [turn1, this.start2 + (this.internal ? 1 : -1) * turn1 * this.gear1.teeth / this.gear2.teeth];
  }
  /** Where a tooth stands deepest in the other gear, of 96 positions: {phase, depth, p} or null. */
  worst() {
    if (this.deepest !== undefined) return this.deepest;
    const reach = (gear) => Math.min(this.reach, Math.floor((gear.teeth - 1) / 2));
    const [one, two] = [this.gear1, this.gear2].map((g) => ({points: teethPoints(g, -reach(g), reach(g)), space: new ToothSpace(g)}));
    this.deepest = null;
    for (let i = 0; i < 96; ++i) {
      const phase = i / 96, [a, b] = this.turns(phase);
      const look = (depth, p) => { if (depth > (this.deepest?.depth ?? 0)) this.deepest = {phase, depth, p}; };
      for (const point of one.points) {
        const [x, y] = rotated(...point, a);
        look(two.space.depth(rotated(x - this.axis2, y, -b)), [x, y]);
      }
      for (const point of two.points) {
        const [x, y] = rotated(...point, b);
        look(one.space.depth(rotated(x + this.axis2, y, -a)), [x + this.axis2, y]);
      }
    }
    return this.deepest;
  }
  /** Stops where it is worst, and looks there. */
  showWorst() {
    const worst = this.worst();
    this.play(false);
    if (worst) { this.phase = worst.phase; this.look(worst.p); }
    this.show();
    this.said.textContent = worst ? `Here they overlap by ${(1000 * worst.depth).toFixed(0)} µm: the red area.` : '';
  }
  look(centre) {
    this.centre = centre;
    const w = 11 * this.gear1.module, height = w * 10 / 16;
    this.svg.setAttribute('viewBox', `${-centre[1] - w / 2} ${-centre[0] - height / 2} ${w} ${height}`);
  }

  line(className) {
    const {start, end} = this.mesh.line;
    const [a, b] = [this.onLine(start), this.onLine(end)];
    const sign = className.includes('coast') ? -1 : 1;
    return h('line', {class: className, x1: a[0], y1: sign * a[1], x2: b[0], y2: sign * b[1]});
  }
  /** Point of the line of action at a roll length of gear 1. */
  onLine(length) {
    const sin = Math.sin(this.mesh.working_angle), cos = Math.cos(this.mesh.working_angle), rb = this.gear1.base_radius;
    return [rb * cos + length * sin, -rb * sin + length * cos];
  }

  draw(index) {
    const {mesh} = this, m = this.gear1.module, w = 11 * m, height = w * 10 / 16;
    const circle = (x, r) => h('circle', {class: 'thin', cx: x, cy: 0, r});
    this.shape1 = h('path', {class: 'g1', d: sectorPath(this.gear1, this.reach)});
    this.shape2 = h('path', {class: this.internal ? 'g2 ring' : 'g2', d: sectorPath(this.gear2, this.reach)});
    this.marks = h('g');
    const clip = h('clipPath', {id: `mesh-clip-${index}`}, this.clip1 = h('path', {d: sectorPath(this.gear1, this.reach)}));
    this.shared = h('path', {class: 'overlap', d: sectorPath(this.gear2, this.reach)});
    const scene = h('g', {id: `mesh-scene-${index}`}, this.shape2, this.shape1, this.overlaps
      ? [clip, h('g', {'clip-path': `url(#mesh-clip-${index})`}, this.shared)] : []);
    // turned so that gear 1 is below and the line of centres upright
    const view = 'matrix(0 -1 -1 0 0 0)';
    this.svg = h('svg', {viewBox: `${-w / 2} ${-mesh.pitch_radius1 - height / 2} ${w} ${height}`, role: 'img',
      'aria-label': `Teeth of ${this.gear1.name} below and ${this.gear2.name} above, in mesh`},
      h('g', {transform: view}, scene, circle(0, mesh.pitch_radius1), circle(this.axis2, mesh.pitch_radius2),
        this.line('action coast'), this.line('action'), this.marks));
    this.lensView = h('svg', {viewBox: '0 0 1 1', 'aria-hidden': 'true'},
      h('g', {transform: view}, h('use', {href: `#mesh-scene-${index}`}), this.lensMarks = h('g')));
    this.slider = h('input', {type: 'range', min: 0, max: 1, step: 'any', value: 0, 'aria-label': 'Position within one pitch',
      oninput: () => { this.play(false); this.phase = Number(this.slider.value); this.show(); }});
    this.button = h('button', {type: 'button', 'aria-pressed': 'false', onclick: () => this.play(!this.playing)}, 'Play');
    this.said = h('p', {class: 'overlap-note', role: 'status'});
    this.pairs = h('dd', {class: 'pairs'});
    this.gapNow = h('dd', {class: 'gap-now'});
    this.lensCaption = h('figcaption');
    const fact = (title, value) => h('div', {}, h('dt', {}, title), value);
    const item = (title, path, digits, unit) => fact(title, h('dd', {}, number(`meshes/${mesh.name}/${path}`, digits, unit)));
    this.element = h('article', {class: `mesh${this.failing ? ' failing' : ''}`, id: `mesh-${mesh.name}`, tabindex: '-1'},
      h('h3', {}, mesh.name, this.failing ? h('span', {class: 'badge fail'}, 'fail') : null), this.said,
      h('figure', {}, this.svg, h('figure', {class: 'lens'}, this.lensView, this.lensCaption)),
      h('div', {class: 'key'}, h('span', {}, h('i', {style: 'background:var(--gear1-line)'}), this.gear1.name),
        h('span', {}, h('i', {style: 'background:var(--gear2-line)'}), this.gear2.name),
        h('span', {}, h('i', {style: 'background:var(--action);height:3px;vertical-align:.2rem'}), 'path of contact (dashed: other flank)')),
      h('div', {class: 'controls', style: 'border:0;padding:.6rem 1rem 0'}, this.button, this.slider,
        this.overlaps ? h('button', {type: 'button', onclick: () => this.showWorst()}, 'Show where it fails') : null),
      h('dl', {}, fact('Pairs in contact now', this.pairs), fact('Closest approach now', this.gapNow),
        item('Closest in a whole cycle', 'minimum_clearance_um', 3, 'µm'), item('Deepest overlap', 'penetration_um', 3, 'µm'),
        item('Backlash at pitch circle', 'backlash_mm', 4, 'mm'), item('Contact ratio, effective', 'effective_contact_ratio', 4),
        item('Working pressure angle', 'working_pressure_angle_deg', 4, '°')));
  }

  /** Roll lengths at which flanks of one side touch with gear 1 turned by `turn`. */
  contacts(turn) {
    const {line} = this.mesh, found = [];
    if (!(line.effective_start < line.effective_end)) return found;
    let s = this.gear1.base_radius * (this.gear1.base_half_angle + turn + this.mesh.working_angle);
    s += line.base_pitch * Math.ceil((line.effective_start - s) / line.base_pitch);
    for (; s <= line.effective_end; s += line.base_pitch) found.push(s);
    return found;
  }

  show() {
    const {gear1, mesh} = this, m = gear1.module;
    const [turn1, turn2] = this.turns(this.phase);
    const degrees = (a) => a * 180 / Math.PI;
    this.shape1.setAttribute('transform', `rotate(${degrees(turn1)})`);
    this.clip1.setAttribute('transform', `rotate(${degrees(turn1)})`);
    for (const shape of [this.shape2, this.shared]) shape.setAttribute('transform', `translate(${this.axis2} 0) rotate(${degrees(turn2)})`);
    const drive = this.contacts(turn1), coast = this.contacts(-turn1);
    const dot = (s, sign) => { const [x, y] = this.onLine(s); return h('circle', {class: 'touch', cx: x, cy: sign * y, r: 0.09 * m, 'fill-opacity': sign > 0 ? 1 : .45}); };
    const near = ([x, y]) => Math.hypot(x - mesh.pitch_radius1, y) < 3.5 * m;
    const a = this.points1.map(([x, y]) => rotated(x, y, turn1)).filter(near);
    const b = this.points2.map(([x, y]) => { const p = rotated(x, y, turn2); return [p[0] + this.axis2, p[1]]; }).filter(near);
    const held = this.deepest && this.phase === this.deepest.phase && this.overlaps ? this.deepest : null;
    const gap = held ? {distance: held.depth, p: held.p, q: held.p} : closest(a, b);
    if (!held) this.said.textContent = '';
    const marks = [...coast.map((s) => dot(s, -1)), ...drive.map((s) => dot(s, 1))];
    if (gap.p) marks.push(h('circle', {class: 'gapring', cx: gap.p[0], cy: gap.p[1], r: 0.22 * m}));
    this.marks.replaceChildren(...marks);
    this.pairs.textContent = String(drive.length);
    const um = 1000 * gap.distance, fine = 2 * model.mesh_chord_error_um;
    this.gapNow.textContent = held ? 'they overlap' : um <= fine ? `under ${fine} µm` : `${um.toFixed(1)} µm`;
    this.showLens(gap, m);
    this.slider.value = this.phase;
  }
  showLens(gap, m) {
    if (!gap.p) return;
    const size = Math.min(2 * m, Math.max(5 * gap.distance, 0.12 * m));
    const [x, y] = [(gap.p[0] + gap.q[0]) / 2, (gap.p[1] + gap.q[1]) / 2];
    this.lensView.setAttribute('viewBox', `${-y - size / 2} ${-x - size / 2} ${size} ${size}`);
    this.lensMarks.replaceChildren(h('line', {class: 'gap', x1: gap.p[0], y1: gap.p[1], x2: gap.q[0], y2: gap.q[1]}));
    this.lensCaption.textContent = `${(size * 1000).toFixed(0)} µm wide`;
  }

  play(on) {
    this.playing = on;
    this.button.setAttribute('aria-pressed', on);
    this.button.textContent = on ? 'Pause' : 'Play';
    if (on) this.look([this.mesh.pitch_radius1, 0]);
    if (on) requestAnimationFrame((now) => { this.last = now; this.frame(now); });
  }
  frame(now) {
    if (!this.playing) return;
    if (this.visible) {
      this.phase = (this.phase + (now - this.last) / 6000) % 1;
      this.show();
    }
    this.last = now;
    requestAnimationFrame((next) => this.frame(next));
  }
}
function drawMeshes() {
  const body = byId('meshes-body');
  if (!model.meshes.length) {
    byId('meshes').remove();
    document.querySelector('#nav a[href="#meshes"]').remove();
    return;
  }
  const drawings = model.meshes.map((mesh, i) => new MeshDrawing(mesh, i));
  const watch = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const drawing = drawings.find((d) => d.element === entry.target);
      drawing.visible = entry.isIntersecting;
      if (entry.isIntersecting && !drawing.met && !still && !drawing.overlaps) drawing.play(true);
      drawing.met ||= entry.isIntersecting;
    }
  });
  for (const drawing of drawings) { body.append(drawing.element); watch.observe(drawing.element); }
  window.trueflank.meshes = drawings;
  /** Goes to a mesh, stopped where it fails. */
  window.trueflank.showMesh = (name) => {
    const drawing = drawings.find((d) => d.mesh.name === name);
    if (drawing.overlaps) drawing.showWorst();
    drawing.element.scrollIntoView({block: 'center', behavior: still ? 'instant' : 'smooth'});
    drawing.element.focus({preventScroll: true});
  };
}

drawMeshes();
})();
