// SPDX-License-Identifier: GPL-3.0-or-later
// The gearbox in 3D: turning by the true kinematics, exploded, cut open.
import {
  AmbientLight, BufferGeometry, Color, DirectionalLight, DoubleSide, Float32BufferAttribute, Group,
  HemisphereLight, LineBasicMaterial, LineSegments, Mesh, MeshStandardMaterial, OrthographicCamera,
  Plane, Scene, ShapeUtils, SRGBColorSpace, Vector2, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

const {model, report, still, h} = window.trueflank;
const host = document.getElementById('viewer');
const notice = document.getElementById('viewer-notice');

// --------------------------------------------------------------------------------------- solids
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
  walls(outline, z, outward) {
    const steps = layers(outline, z), n = steps[0].points.length;
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
  /** A plane face at a height; `up` is 1 or -1. */
  face(outline, holes, z, height, up) {
    const flat = (o) => {
      const {points} = layers(o, z).find((layer) => Math.abs(layer.height - height) < 1e-4) ?? o;
      return points.map((p) => new Vector2(...p));
    };
    const contour = flat(outline), cuts = holes.map(flat);
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
const reach = (outline, pick) => pick(...outline.points.map((p) => Math.hypot(...p)));

function solidOf(part) {
  const builder = new SolidBuilder();
  const slabs = part.slabs.map((slab) => ({z: slab.z, outer: outlinePoints(slab.outer), holes: slab.holes.map(outlinePoints)}));
  slabs.forEach((slab, i) => {
    builder.walls(slab.outer, slab.z, 1);
    for (const hole of slab.holes) builder.walls(hole, slab.z, -1);
    // between stacked slabs only the uncovered rim of the larger one is a face
    for (const [other, height, up] of [[slabs[i - 1], slab.z[0], -1], [slabs[i + 1], slab.z[1], 1]]) {
      if (other && reach(slab.outer, Math.max) < reach(other.outer, Math.min)) continue;
      const covered = other && reach(other.outer, Math.max) < reach(slab.outer, Math.min);
      builder.face(slab.outer, covered ? [other.outer] : slab.holes, slab.z, height, up);
    }
  });
  return builder;
}

// ---------------------------------------------------------------------------------------- scene
class Viewer {
  constructor() {
    this.sun = 0;             // angle of the sun [rad]
    this.rate = 1;            // rad/s
    this.playing = !still;
    this.canvas = h('canvas', {tabindex: '0', role: 'img', 'aria-label':
      `The gearbox in 3D: ${model.bodies.map((b) => b.name).join(', ')}. Arrow keys turn it, plus and minus zoom, space stops it.`});
    this.renderer = new WebGLRenderer({canvas: this.canvas, antialias: true, alpha: true});
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.localClippingEnabled = true;
    this.scene = new Scene();
    this.world = new Group();
    this.scene.add(this.world);
    this.cut = new Plane(new Vector3(0, 1, 0), 0);
    this.addLights();
    this.addBodies();
    this.addCamera();
    this.addControls();
    this.resize();
    new ResizeObserver(() => this.resize()).observe(this.stage);
    new IntersectionObserver(([entry]) => { this.visible = entry.isIntersecting; this.wake(); }).observe(this.stage);
    window.addEventListener('beforeprint', () => this.picture());
    this.pose();
    this.wake();
  }

  addLights() {
    this.scene.add(new HemisphereLight(0xffffff, 0x8894a4, 1.6), new AmbientLight(0xffffff, 0.35));
    const key = new DirectionalLight(0xffffff, 2.1);
    key.position.set(0.45, 0.9, 0.7);
    const fill = new DirectionalLight(0xdbe7ff, 0.7);
    fill.position.set(-0.9, -0.3, 0.6);
    this.lamps = new Group();
    this.lamps.add(key, fill);
    this.scene.add(this.lamps);
  }

  material(colour) {
    const material = new MeshStandardMaterial({color: colour, roughness: 0.55, metalness: 0.12, side: DoubleSide, clippingPlanes: []});
    // seen through the cut, the inside of a solid is its own far wall: painted flat it is the section
    const section = new Color(colour).lerp(new Color(0xffffff), 0.35).convertLinearToSRGB();
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>',
        `if (!gl_FrontFacing) gl_FragColor = vec4(${section.r.toFixed(4)}, ${section.g.toFixed(4)}, ${section.b.toFixed(4)}, 1.0);`);
    };
    material.customProgramCacheKey = () => section.getHexString();
    return material;
  }

  addBodies() {
    const built = model.parts.map((part) => {
      const solid = solidOf(part);
      return {geometry: solid.geometry(), edges: solid.edges()};
    });
    this.materials = model.parts.map((part) => this.material(part.colour));
    this.lineMaterial = new LineBasicMaterial({color: 0x101820, transparent: true, opacity: 0.28, clippingPlanes: []});
    this.bodies = model.bodies.map((body) => {
      const group = new Group();
      group.add(new Mesh(built[body.part].geometry, this.materials[body.part]),
        new LineSegments(built[body.part].edges, this.lineMaterial));
      this.world.add(group);
      return {...body, group, radius: Math.hypot(body.at[0], body.at[1]), angle: Math.atan2(body.at[1], body.at[0])};
    });
    this.orderForExplosion();
  }

  /** Bodies leave along the axis, layer by layer: what is on top or inside moves furthest. */
  orderForExplosion() {
    const box = (body) => { const g = body.group.children[0].geometry; g.computeBoundingBox(); return g.boundingBox; };
    const height = (body) => body.at[2] + (box(body).min.z + box(body).max.z) / 2;
    const size = (body) => box(body).max.x;
    const parts = [...new Set(this.bodies.map((b) => this.explodeGroup(b)))].map((name) => {
      const body = this.bodies.find((b) => this.explodeGroup(b) === name);
      return {name, height: height(body), size: size(body), depth: box(body).max.z - box(body).min.z};
    }).sort((a, b) => a.height - b.height || b.size - a.size);
    let lift = 0;
    this.lift = {};
    parts.forEach((part, i) => {
      this.lift[part.name] = lift;
      lift += 0.7 * part.depth + 0.5 * (parts[i + 1]?.depth ?? 0);
    });
    const all = this.bodies.map((b) => ({lo: b.at[2] + box(b).min.z, hi: b.at[2] + box(b).max.z, r: b.radius + size(b), lift: this.lift[this.explodeGroup(b)]}));
    this.floor = Math.min(...all.map((b) => b.lo));
    this.top = Math.max(...all.map((b) => b.hi));
    this.explodedTop = Math.max(...all.map((b) => b.hi + b.lift));
    this.size = Math.max(...all.map((b) => b.r));
    // what turns about the axis is looked at there; a pair between its gears
    this.middle = [0, 0];
    if (this.bodies.some((b) => b.radius > 0) && this.bodies.every((b) => b.orbit === 0)) {
      const ends = [0, 1].map((k) => [Math.min(...this.bodies.map((b) => b.at[k] - size(b))), Math.max(...this.bodies.map((b) => b.at[k] + size(b)))]);
      this.middle = ends.map(([low, high]) => (low + high) / 2);
      this.size = Math.max(...ends.map(([low, high]) => (high - low) / 2));
    }
  }
  explodeGroup(body) { return model.parts[body.part].name.replace(/_\d+$/, ''); }

  addCamera() {
    this.camera = new OrthographicCamera(-1, 1, 1, -1, -50 * this.size, 50 * this.size);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enablePan = false;
    this.controls.addEventListener('change', () => this.wake());
    this.home();
  }
  home() {
    this.camera.zoom = 1;
    const [x, y] = this.middle;
    this.camera.position.set(x + 0.55 * this.size, y - this.size, 0.95 * this.size);
    this.controls.target.set(x, y, 0);
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  // ------------------------------------------------------------------------------------ controls
  addControls() {
    const names = [...new Set(this.bodies.map((b) => this.explodeGroup(b)))];
    this.button = h('button', {type: 'button', 'aria-pressed': this.playing, onclick: () => this.play(!this.playing)}, this.playing ? 'Pause' : 'Play');
    const range = (title, id, max, value, change) => h('label', {for: id}, title,
      h('input', {type: 'range', id, min: 0, max, step: 'any', value, oninput: (e) => { change(Number(e.target.value)); this.wake(); }}));
    const box = (title, id, checked, change, colour) => h('label', {for: id},
      h('input', {type: 'checkbox', id, checked, onchange: (e) => { change(e.target.checked); this.wake(); }}),
      colour ? h('i', {class: 'swatch', style: `background:${colour}`}) : null, title);
    this.exploded = 0;
    this.speeds = h('p', {class: 'speeds', 'aria-hidden': 'true'});
    this.print = h('img', {class: 'print', alt: 'The gearbox'});
    this.stage = h('div', {class: 'stage'}, this.canvas, this.print, this.speeds,
      h('p', {class: 'hint'}, 'Drag to turn, scroll or pinch to zoom, or use the arrow keys'));
    host.replaceChildren(this.stage, h('div', {class: 'controls'}, this.button,
      range('Speed', 'viewer-speed', 12, this.rate, (v) => { this.rate = v; }),
      range('Exploded', 'viewer-explode', 1, 0, (v) => { this.exploded = v; this.pose(); }),
      box('Cut open', 'viewer-cut', false, (on) => this.section(on)),
      h('button', {type: 'button', id: 'viewer-home', onclick: () => { this.home(); this.wake(); }}, 'Reset view'),
      h('fieldset', {class: 'legend', 'aria-label': 'Parts shown'}, names.map((name) => box(name, `viewer-part-${name}`, true,
        (on) => { for (const b of this.bodies) if (this.explodeGroup(b) === name) b.group.visible = on; },
        model.parts.find((p) => p.name.replace(/_\d+$/, '') === name).colour)))));
    this.canvas.addEventListener('keydown', (event) => this.key(event));
  }
  key(event) {
    const turn = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (turn) this.orbit(turn[0] * 0.12, turn[1] * 0.12);
    else if (event.key === '+' || event.key === '=') this.zoom(1.15);
    else if (event.key === '-') this.zoom(1 / 1.15);
    else if (event.key === ' ') this.play(!this.playing);
    else return;
    event.preventDefault();
    this.wake();
  }
  orbit(azimuth, polar) {
    const p = this.camera.position, r = p.length();
    const a = Math.atan2(p.y, p.x) + azimuth, b = Math.min(3.1, Math.max(0.04, Math.acos(p.z / r) + polar));
    p.set(r * Math.sin(b) * Math.cos(a), r * Math.sin(b) * Math.sin(a), r * Math.cos(b));
    this.controls.update();
  }
  zoom(factor) {
    this.camera.zoom = Math.min(40, Math.max(0.3, this.camera.zoom * factor));
    this.camera.updateProjectionMatrix();
  }
  play(on) {
    this.playing = on;
    this.button.textContent = on ? 'Pause' : 'Play';
    this.button.setAttribute('aria-pressed', on);
    this.wake();
  }
  section(on) {
    // outlines of the far side would show through the painted sections
    for (const body of this.bodies) body.group.children[1].visible = !on;
    for (const material of [...this.materials, this.lineMaterial]) {
      material.clippingPlanes = on ? [this.cut] : [];
      material.needsUpdate = true;
    }
  }

  // ------------------------------------------------------------------------------------- drawing
  pose() {
    for (const body of this.bodies) {
      const orbit = body.angle + body.orbit * this.sun;
      const lift = this.exploded * this.lift[this.explodeGroup(body)];
      body.group.position.set(body.radius * Math.cos(orbit), body.radius * Math.sin(orbit), body.at[2] + lift);
      body.group.rotation.z = body.rotation + body.turn * this.sun;
    }
    const top = this.top + this.exploded * (this.explodedTop - this.top);
    this.world.position.z = -(this.floor + top) / 2;
    const turns = (this.sun / (2 * Math.PI)).toFixed(2);
    const out = report.train.ratio ? `, output ${(360 * this.sun / (2 * Math.PI) / report.train.ratio * (report.train.direction === 'same' ? 1 : -1)).toFixed(2)}°` : '';
    this.speeds.textContent = `${model.bodies.length > 1 ? 'input' : 'gear'} ${turns} turns${out}`;
  }
  fit() {
    const {width, height} = this.view, aspect = width / height;
    const tall = this.top - this.floor + this.exploded * (this.explodedTop - this.top);
    const half = Math.max(0.73 * this.size + 0.4 * tall, 1.12 * this.size / aspect);
    Object.assign(this.camera, {left: -half * aspect, right: half * aspect, top: half, bottom: -half});
    this.camera.updateProjectionMatrix();
  }
  resize() {
    this.view = {width: this.stage.clientWidth || 300, height: this.stage.clientHeight || 300};
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.renderer.setSize(this.view.width, this.view.height, false);
    this.wake();
  }
  render() {
    this.fit();
    this.lamps.quaternion.copy(this.camera.quaternion);
    this.renderer.render(this.scene, this.camera);
    host.dataset.frames = Number(host.dataset.frames ?? 0) + 1;
  }
  /** Draws a frame soon, and goes on while it turns and can be seen. */
  wake() {
    if (this.pending) return;
    this.pending = requestAnimationFrame((now) => {
      this.pending = 0;
      const turning = this.playing && this.visible !== false;
      if (turning && this.last) { this.sun += Math.min(0.1, (now - this.last) / 1000) * this.rate; this.pose(); }
      this.last = turning ? now : 0;
      this.render();
      if (turning) this.wake();
    });
  }
  picture() {
    this.render();
    this.print.src = this.canvas.toDataURL('image/png');
  }
}

try {
  window.trueflank.viewer = new Viewer();
} catch (error) {
  notice.hidden = false;
  notice.textContent = `No picture in 3D: this browser has no WebGL (${error.message}).`;
  host.replaceChildren(notice);
}
