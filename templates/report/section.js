// SPDX-License-Identifier: GPL-3.0-or-later
// What is cut away: a wedge about the axis of the gearbox, and the hatched faces where parts are cut.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Group, LineBasicMaterial, LineSegments, Mesh, Plane, ShaderMaterial, Vector3,
} from 'three';
import {sectionOf} from './solids.js';

const hatchAngles = [45, 135, 60, 120, 30, 150].map((a) => a * Math.PI / 180);

/** Floats that grow; the buffer on the graphics card is renewed when they outgrow it. */
class Stream {
  constructor(size) { this.size = size; this.values = new Float32Array(4096 * size); this.used = 0; }
  push(...more) {
    if (this.used + more.length > this.values.length) {
      const larger = new Float32Array(2 * this.values.length);
      larger.set(this.values);
      this.values = larger;
    }
    this.values.set(more, this.used);
    this.used += more.length;
  }
  /** Puts the values into a geometry. */
  into(geometry, name) {
    const old = geometry.getAttribute(name);
    if (old?.array === this.values) old.needsUpdate = true;
    else geometry.setAttribute(name, new BufferAttribute(this.values, this.size));
  }
}

export class Section {
  /** `size`: radius of what is drawn [mm]; `middle`: direction [rad] into the middle of what is taken away. */
  constructor(size, middle) {
    this.size = size;
    this.middle = middle;
    this.planes = [new Plane(new Vector3(), 0), new Plane(new Vector3(), 0)];
    this.streams = {position: new Stream(3), place: new Stream(2), tint: new Stream(3), hatch: new Stream(1)};
    this.edge = new Stream(3);
    this.faces = new Mesh(new BufferGeometry(), this.material());
    this.edges = new LineSegments(new BufferGeometry(), new LineBasicMaterial({color: 0x0c1218}));
    this.group = new Group();
    this.group.add(this.faces, this.edges);
    for (const drawn of this.group.children) drawn.frustumCulled = false;
    this.open(0);
  }

  material() {
    return new ShaderMaterial({side: DoubleSide, uniforms: {pitch: {value: this.size / 19}},
      vertexShader: `attribute vec2 place; attribute vec3 tint; attribute float hatch; varying vec2 p; varying vec3 c; flat varying float a;
        void main() { p = place; c = tint; a = hatch; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
      fragmentShader: `uniform float pitch; varying vec2 p; varying vec3 c; flat varying float a;
        void main() {
          float u = dot(p, vec2(cos(a), sin(a))) / pitch, w = fwidth(u);
          float line = 1.0 - smoothstep(0.5 * 0.1, 0.5 * 0.1 + w, abs(fract(u) - 0.5));
          // lines closer than the pixels are a tint
          line = mix(line, 0.1, smoothstep(0.25, 0.6, w));
          gl_FragColor = vec4(mix(c, c * 0.35, line), 1.0);
        }`});
  }

  /** Takes a wedge of this angle [rad] away; 0: nothing. */
  open(angle) {
    this.angle = angle;
    this.rays = [this.middle - angle / 2, this.middle + angle / 2];
    this.planes[0].normal.set(Math.sin(this.rays[0]), -Math.cos(this.rays[0]), 0);
    this.planes[1].normal.set(-Math.sin(this.rays[1]), Math.cos(this.rays[1]), 0);
    this.group.visible = angle > 0;
  }

  /** Draws the cut faces of these bodies where they stand: {group, slabs, colour, index}. */
  update(bodies) {
    if (!this.group.visible) return;
    for (const stream of [...Object.values(this.streams), this.edge]) stream.used = 0;
    for (const body of bodies) this.rays.forEach((ray, k) => this.cut(body, ray, k ? -1 : 1));
    for (const [name, stream] of Object.entries(this.streams)) stream.into(this.faces.geometry, name);
    this.edge.into(this.edges.geometry, 'position');
    this.faces.geometry.setDrawRange(0, this.streams.position.used / 3);
    this.edges.geometry.setDrawRange(0, this.edge.used / 3);
  }

  /** Whether a point of the world is taken away. */
  removes(point) { return this.angle > 0 && this.planes.every((plane) => plane.distanceToPoint(point) < 0); }

  /** `inwards`: on which side of the ray the opening is. */
  cut({group, slabs, colour, index}, ray, inwards) {
    const {x, y, z} = group.position, turn = group.rotation.z;
    const [cos, sin] = [Math.cos(turn), Math.sin(turn)], along = [Math.cos(ray), Math.sin(ray)];
    const local = (vx, vy) => [cos * vx + sin * vy, cos * vy - sin * vx];
    // a hair before the part's own inner faces, which end in this plane; its edges before it
    const before = (share) => (r, height) => [r * along[0] - share * along[1], r * along[1] + share * along[0], height + z];
    const at = before(0.0008 * this.size * inwards), edge = before(0.0016 * this.size * inwards);
    const tint = new Color(colour).convertLinearToSRGB().lerp(new Color(1, 1, 1), 0.5), hatch = hatchAngles[index % hatchAngles.length];
    const bounds = new Map();  // a height to where material begins and ends below and above it
    const note = (height, span) => { const key = height.toFixed(4); bounds.set(key, [...(bounds.get(key) ?? []), ...span]); };
    for (const {z0, z1, lower, upper} of sectionOf(slabs, local(-x, -y), local(...along))) {
      const corner = [[lower[0], z0], [lower[1], z0], [upper[1], z1], [upper[0], z1]];
      for (const k of [0, 1, 2, 0, 2, 3]) {
        this.streams.position.push(...at(...corner[k]));
        this.streams.place.push(corner[k][0], corner[k][1] + z);
        this.streams.tint.push(tint.r, tint.g, tint.b);
        this.streams.hatch.push(hatch);
      }
      for (const k of [0, 1]) if (lower[k] > 0 || upper[k] > 0) this.edge.push(...edge(lower[k], z0), ...edge(upper[k], z1));
      note(z0, lower);
      note(z1, upper);
    }
    for (const [height, ends] of bounds) {
      ends.sort((a, b) => a - b);
      for (let i = 0; i + 1 < ends.length; i += 2)
        if (ends[i + 1] - ends[i] > 1e-6) this.edge.push(...edge(ends[i], Number(height)), ...edge(ends[i + 1], Number(height)));
    }
  }
}
