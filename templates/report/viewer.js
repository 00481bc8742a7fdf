// SPDX-License-Identifier: GPL-3.0-or-later
// The gearbox in 3D: turning by the true kinematics, exploded, cut open.
import {
  BufferGeometry, CircleGeometry, Color, DirectionalLight, DoubleSide, Float32BufferAttribute, Group, HemisphereLight, LineBasicMaterial, LineSegments,
  Mesh, MeshBasicMaterial, MeshStandardMaterial, NeutralToneMapping, OrthographicCamera, PCFShadowMap, Scene,
  ShadowMaterial, SRGBColorSpace, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {Labels} from './labels.js';
import {Section} from './section.js';
import {solidOf} from './solids.js';

const {model, report, still, h, properName} = window.trueflank;
const host = document.getElementById('viewer');
const notice = document.getElementById('viewer-notice');
const degrees = Math.PI / 180;
const cuts = {none: ['closed', 0], quarter: ['a quarter away', 100 * degrees], half: ['half away', Math.PI]};
// the middle of the opening from the first planet: that one is seen, and the sun beside it
const beside = 34 * degrees;
const encloses = ['ring', 'upper_ring', 'carrier', 'casing', 'output'];

/** Plastics by their names; anything else is drawn as metal. */
const isPlastic = (material) => /^(pla|petg|abs|asa|pa\d|pom|peek|nylon|resin|pc|tpu)/i.test(material ?? '');
function materialOf(part) {
  const line = (report.bill_of_materials ?? []).find((l) => l.part === part.name.replace(/_\d+$/, ''));
  if (line?.material) return line.material;
  return model.strength?.meshes[0]?.material1;
}

class Viewer {
  constructor() {
    this.sun = 0;             // angle of the sun [rad]
    this.rate = 1;            // rad/s
    this.playing = !still;
    this.exploded = 0;
    this.hiddenParts = new Set();
    this.canvas = h('canvas', {tabindex: '0', role: 'img', 'aria-label':
      `The gearbox in 3D: ${[...new Set(model.bodies.map((b) => properName(model.parts[b.part].name)))].join(', ')}. `
      + 'Arrow keys turn it, plus and minus zoom, space stops it.'});
    this.renderer = new WebGLRenderer({canvas: this.canvas, antialias: true, alpha: true});
    Object.assign(this.renderer, {outputColorSpace: SRGBColorSpace, localClippingEnabled: true, toneMapping: NeutralToneMapping});
    Object.assign(this.renderer.shadowMap, {enabled: true, type: PCFShadowMap});
    this.scene = new Scene();
    this.world = new Group();
    this.scene.add(this.world);
    this.addBodies();
    this.addLights();
    this.addFloor();
    this.addSection();
    this.addCamera();
    this.addControls();
    this.home();
    this.takeHash();
    this.resize();
    new ResizeObserver(() => this.resize()).observe(this.stage);
    new IntersectionObserver(([entry]) => { this.visible = entry.isIntersecting; if (this.playing) this.wake(); }).observe(this.stage);
    window.addEventListener('beforeprint', () => this.picture());
    window.addEventListener('hashchange', () => this.takeHash());
    this.pose();
    this.wake();
  }

  // --------------------------------------------------------------------------------------- scene
  material(part) {
    const plastic = isPlastic(materialOf(part)) && part.role !== 'bought';
    const material = new MeshStandardMaterial({color: part.colour, roughness: plastic ? 0.7 : 0.38, metalness: plastic ? 0 : 0.1,
      side: DoubleSide, clippingPlanes: [], clipIntersection: true, clipShadows: true});
    // what the hatched faces leave open, the balls of a bearing, is painted as flat as they are
    const flat = {value: new Color(part.colour).convertLinearToSRGB().lerp(new Color(1, 1, 1), 0.5)};
    material.onBeforeCompile = (shader) => {
      shader.uniforms.flatColour = flat;
      shader.fragmentShader = `uniform vec3 flatColour;\n${shader.fragmentShader}`.replace('#include <dithering_fragment>',
        'if (!gl_FrontFacing) gl_FragColor = vec4(flatColour, 1.0);');
    };
    material.customProgramCacheKey = () => 'flat inside';
    return material;
  }
  lineMaterial() { return new LineBasicMaterial({color: 0x101820, transparent: true, opacity: 0.3, clippingPlanes: [], clipIntersection: true}); }

  addBodies() {
    const built = model.parts.map(solidOf);
    this.bodies = model.bodies.map((body) => {
      const part = model.parts[body.part], {geometry, edges, slabs} = built[body.part];
      const group = new Group(), radius = Math.hypot(body.at[0], body.at[1]);
      // in a quarter view the gears, their pins and bearings, and the motor stay whole
      const whole = ['sun', 'planet'].includes(part.role) || /^(pin_|carrier\d?_pin|motor_)/.test(part.name) || (radius > 0 && part.name.startsWith('bearing_'));
      const mesh = new Mesh(geometry, this.material(part));
      mesh.castShadow = mesh.receiveShadow = true;
      group.add(mesh, new LineSegments(edges, this.lineMaterial()));
      this.world.add(group);
      const pivot = body.pivot ?? [0, 0];
      return {...body, group, slabs, whole, radius, colour: part.colour, index: body.part, arm: Math.hypot(body.at[0] - pivot[0], body.at[1] - pivot[1]), angle: Math.atan2(body.at[1] - pivot[1], body.at[0] - pivot[0]), pivot};
    });
    this.orderForExplosion();
  }
  box(body) { const g = body.group.children[0].geometry; if (!g.boundingBox) g.computeBoundingBox(); return g.boundingBox; }
  partGroup(body) { return model.parts[body.part].name.replace(/^(planet)_\d+$/, '$1'); }
  groupTitle(name) {
    const count = this.bodies.filter((b) => this.partGroup(b) === name).length;
    return properName(name) + (count > 1 ? ` ×${count}` : '');
  }

  /** Bodies leave along the axis, layer by layer: what is on top or inside moves furthest. */
  orderForExplosion() {
    const height = (body) => body.at[2] + (this.box(body).min.z + this.box(body).max.z) / 2;
    const size = (body) => this.box(body).max.x;
    this.groups = [...new Set(this.bodies.map((b) => this.partGroup(b)))];
    const parts = this.groups.map((name) => {
      const body = this.bodies.find((b) => this.partGroup(b) === name);
      // what is bought is slim: it may stand in the room of its neighbours
      const depth = (this.box(body).max.z - this.box(body).min.z) * (model.parts[body.part].role === 'bought' ? 0.3 : 1);
      return {name, height: height(body), size: size(body), depth};
    }).sort((a, b) => a.height - b.height || b.size - a.size);
    let lift = 0;
    this.lift = {};
    parts.forEach((part, i) => {
      this.lift[part.name] = lift;
      lift += 0.5 * part.depth + 0.4 * (parts[i + 1]?.depth ?? 0);
    });
    const all = this.bodies.map((b) => ({lo: b.at[2] + this.box(b).min.z, hi: b.at[2] + this.box(b).max.z, r: b.radius + size(b), lift: this.lift[this.partGroup(b)]}));
    this.floor = Math.min(...all.map((b) => b.lo));
    this.top = Math.max(...all.map((b) => b.hi));
    this.explodedTop = Math.max(...all.map((b) => b.hi + b.lift));
    this.size = Math.max(...all.map((b) => b.r));
    // what turns about the axis is looked at there; a pair between its gears
    this.middle = [0, 0];
    this.aboutAxis = !(this.bodies.some((b) => b.radius > 0) && this.bodies.every((b) => b.orbit === 0 || b.pivot[0] || b.pivot[1]));
    if (!this.aboutAxis) {
      const ends = [0, 1].map((k) => [Math.min(...this.bodies.map((b) => b.at[k] - size(b))), Math.max(...this.bodies.map((b) => b.at[k] + size(b)))]);
      this.middle = ends.map(([low, high]) => (low + high) / 2);
      this.size = Math.max(...ends.map(([low, high]) => (high - low) / 2));
    }
  }

  addLights() {
    const sky = new HemisphereLight(0xf4f8ff, 0x8a929e, 1.95);
    sky.position.set(0, 0, 1);
    this.lamp = new DirectionalLight(0xfffaf2, 2.5);
    this.lamp.castShadow = true;
    this.lamp.shadow.mapSize.set(1536, 1536);
    this.lamp.shadow.bias = -0.0004;
    this.lamp.shadow.normalBias = 0.005 * this.size;
    this.lamp.shadow.radius = 4;
    this.fill = new DirectionalLight(0xdbe7ff, 0.9);
    this.scene.add(sky, this.lamp, this.lamp.target, this.fill);
  }
  /** The lamps stand where the eye has them: the picture is lit from every side it is looked at. */
  light() {
    const azimuth = this.controls.getAzimuthalAngle() - Math.PI / 2, tall = (this.shownTop() - this.floor) / 2, far = 2 * (this.size + tall);
    const from = (turn, up) => { const a = azimuth + turn * degrees, e = up * degrees; return new Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)).multiplyScalar(far); };
    const centre = new Vector3(...this.middle, 0);
    this.lamp.position.copy(from(-38, 52)).add(centre);
    this.lamp.target.position.copy(centre);
    this.fill.position.copy(from(70, 20)).add(centre);
    const half = 1.25 * Math.hypot(this.size, tall);
    if (this.shadowHalf !== half) {
      this.shadowHalf = half;
      Object.assign(this.lamp.shadow.camera, {left: -half, right: half, top: half, bottom: -half, near: 0.1, far: 2.2 * far});
      this.lamp.shadow.camera.updateProjectionMatrix();
    }
  }

  /** A floor that shows nothing but the shadows on it, darkest where something stands. */
  addFloor() {
    this.ground = new Group();
    const floor = new Mesh(new CircleGeometry(3 * this.size, 64), new ShadowMaterial({opacity: 0.13}));
    floor.receiveShadow = true;
    this.ground.add(floor);
    for (const body of this.bodies.filter((b) => b.orbit === 0)) {
      const r = this.box(body).max.x;
      if (body.at[2] + this.box(body).min.z > this.floor + 0.4 * r) continue;
      if (this.bodies.some((b) => b !== body && b.radius === body.radius && b.orbit === 0 && this.box(b).max.x > r)) continue;
      this.ground.add(this.contactShadow(r, body.at));
    }
    this.ground.position.set(0, 0, this.floor - 0.002 * this.size);
    this.world.add(this.ground);
  }
  contactShadow(r, at) {
    const rings = [[0, 0.34], [0.97, 0.34], [1.04, 0.16], [1.14, 0.06], [1.3, 0]], n = 72, positions = [], colours = [];
    const vertex = ([share, alpha], i) => {
      const a = 2 * Math.PI * i / n;
      positions.push(at[0] + share * r * Math.cos(a), at[1] + share * r * Math.sin(a), 0.0005 * this.size);
      colours.push(0.03, 0.05, 0.09, alpha);
    };
    for (let k = 0; k + 1 < rings.length; ++k) for (let i = 0; i < n; ++i)
      for (const [ring, step] of [[k, i], [k + 1, i], [k + 1, i + 1], [k, i], [k + 1, i + 1], [k, i + 1]]) vertex(rings[ring], step);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(positions, 3));
    geometry.setAttribute('color', new Float32BufferAttribute(colours, 4));
    return new Mesh(geometry, new MeshBasicMaterial({vertexColors: true, transparent: true, depthWrite: false}));
  }

  addSection() {
    const planet = this.bodies.find((b) => model.parts[b.part].role === 'planet' && b.radius > 0);
    this.section = new Section(this.size, this.aboutAxis && planet ? planet.angle + beside : -Math.PI / 2);
    this.world.add(this.section.group);
    const roles = model.parts.map((p) => p.role);
    this.firstCut = this.aboutAxis && roles.some((r) => encloses.includes(r)) ? 'quarter' : 'none';
  }
  cutOpen(kind) {
    this.cut = kind in cuts ? kind : 'none';
    this.section.open(cuts[this.cut][1]);
    this.cutChoice.value = this.cut;
    for (const body of this.bodies) {
      body.cut = this.cut !== 'none' && !(this.cut === 'quarter' && body.whole);
      for (const drawn of body.group.children) {
        drawn.material.clippingPlanes = body.cut ? this.section.planes : [];
        drawn.material.needsUpdate = true;
      }
    }
    this.pose();
  }

  addCamera() {
    this.camera = new OrthographicCamera(-1, 1, 1, -1, -50 * this.size, 50 * this.size);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enablePan = false;
    this.controls.minZoom = 0.3;
    this.controls.maxZoom = 40;
    this.controls.addEventListener('change', () => this.wake());
  }
  /** Where the eye is: azimuth and elevation [degrees], and the zoom. */
  eye() {
    const p = this.camera.position.clone().sub(this.controls.target), r = p.length();
    return [Math.atan2(p.y, p.x) / degrees, Math.asin(p.z / r) / degrees, this.camera.zoom];
  }
  lookFrom(azimuth, elevation, zoom) {
    const [a, e] = [azimuth * degrees, Math.min(89, Math.max(-89, elevation)) * degrees], r = 2 * this.size;
    this.controls.target.set(...this.middle, 0);
    this.camera.position.set(r * Math.cos(e) * Math.cos(a), r * Math.cos(e) * Math.sin(a), r * Math.sin(e)).add(this.controls.target);
    this.camera.zoom = Math.min(40, Math.max(0.3, zoom));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.wake();
  }
  home() {
    this.lookFrom(this.firstCut === 'none' ? -61 : this.section.middle / degrees + 8, 38, 1);
    this.cutOpen(this.firstCut);
  }

  // ------------------------------------------------------------------------------------ controls
  addControls() {
    this.button = h('button', {type: 'button', 'aria-pressed': this.playing, onclick: () => this.play(!this.playing)}, this.playing ? 'Pause' : 'Play');
    const range = (title, id, max, value, change) => h('label', {for: id}, title,
      h('input', {type: 'range', id, min: 0, max, step: 'any', value, oninput: (e) => { change(Number(e.target.value)); this.wake(); }}));
    const box = (title, id, checked, change, colour) => h('label', {for: id},
      h('input', {type: 'checkbox', id, checked, onchange: (e) => { change(e.target.checked); this.wake(); }}),
      colour ? h('i', {class: 'swatch', style: `background:${colour}`}) : null, title);
    const action = (title, id, act) => h('button', {type: 'button', id, onclick: act}, title);
    this.speeds = h('p', {class: 'speeds', 'aria-hidden': 'true'});
    this.print = h('img', {class: 'print', alt: 'The gearbox'});
    this.stage = h('div', {class: 'stage'}, this.canvas, this.print, this.speeds,
      h('p', {class: 'hint'}, 'Drag to turn, scroll or pinch to zoom, or use the arrow keys'));
    this.labels = new Labels(this.stage);
    this.cutChoice = h('select', {id: 'viewer-cut', onchange: (e) => { this.cutOpen(e.target.value); this.wake(); }},
      Object.entries(cuts).map(([key, [title]]) => h('option', {value: key}, title)));
    this.said = h('span', {class: 'said', role: 'status'});
    const colourOf = (name) => model.parts.find((p) => p.name.replace(/^(planet)_\d+$/, '$1') === name).colour;
    host.replaceChildren(this.stage, h('div', {class: 'controls'}, this.button,
      range('Speed', 'viewer-speed', 12, this.rate, (v) => { this.rate = v; }),
      range('Exploded', 'viewer-explode', 1, 0, (v) => { this.exploded = v; this.pose(); }),
      h('label', {for: 'viewer-cut'}, 'Cut', this.cutChoice),
      box('Names', 'viewer-labels', false, (on) => { this.named = on; }),
      action('Reset view', 'viewer-home', () => { this.home(); this.wake(); }),
      action('Save picture', 'viewer-save', () => this.save()),
      document.fullscreenEnabled ? action('Full screen', 'viewer-full', () => this.fullScreen()) : null,
      action('Link to this view', 'viewer-link', () => this.link()), this.said,
      h('details', {class: 'parts', open: this.groups.length <= 8}, h('summary', {}, 'Parts shown'),
        h('fieldset', {class: 'legend', 'aria-label': 'Parts shown'}, this.groups.map((name) =>
          box(this.groupTitle(name), `viewer-part-${name}`, true, (on) => this.showPart(name, on), colourOf(name)))))));
    this.canvas.addEventListener('keydown', (event) => this.key(event));
  }
  showPart(name, on) {
    if (on) this.hiddenParts.delete(name); else this.hiddenParts.add(name);
    for (const b of this.bodies) if (this.partGroup(b) === name) b.group.visible = on;
    this.pose();
  }
  key(event) {
    const turn = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    const [azimuth, elevation, zoom] = this.eye();
    if (turn) this.lookFrom(azimuth + 7 * turn[0], elevation + 7 * turn[1], zoom);
    else if (event.key === '+' || event.key === '=') this.lookFrom(azimuth, elevation, 1.15 * zoom);
    else if (event.key === '-') this.lookFrom(azimuth, elevation, zoom / 1.15);
    else if (event.key === ' ') this.play(!this.playing);
    else return;
    event.preventDefault();
    this.wake();
  }
  play(on) {
    this.playing = on;
    this.button.textContent = on ? 'Pause' : 'Play';
    this.button.setAttribute('aria-pressed', on);
    this.wake();
  }
  fullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else host.requestFullscreen().catch((error) => { this.said.textContent = error.message; });
  }

  /** The view as the part of the address after '#'. */
  viewHash() {
    const parts = [`view=${this.eye().map((v) => Number(v.toFixed(2))).join(',')}`, `cut=${this.cut}`];
    if (this.exploded) parts.push(`exploded=${Number(this.exploded.toFixed(3))}`);
    if (this.sun) parts.push(`turns=${Number((this.sun / (2 * Math.PI)).toFixed(4))}`);
    if (this.named) parts.push('names=1');
    if (this.hiddenParts.size) parts.push(`without=${[...this.hiddenParts].join(',')}`);
    return `#${parts.join('&')}`;
  }
  takeHash() {
    if (!location.hash.startsWith('#view=')) return;
    const wanted = new URLSearchParams(location.hash.slice(1)), number = (key) => Number(wanted.get(key)) || 0;
    const [azimuth, elevation, zoom] = wanted.get('view').split(',').map(Number);
    if (![azimuth, elevation, zoom].every(Number.isFinite)) return;
    this.play(false);
    this.sun = 2 * Math.PI * number('turns');
    this.exploded = Math.min(1, Math.max(0, number('exploded')));
    this.named = wanted.has('names');
    document.getElementById('viewer-explode').value = this.exploded;
    document.getElementById('viewer-labels').checked = this.named;
    const without = (wanted.get('without') ?? '').split(',');
    for (const name of this.groups) {
      document.getElementById(`viewer-part-${name}`).checked = !without.includes(name);
      this.showPart(name, !without.includes(name));
    }
    this.cutOpen(wanted.get('cut') ?? 'none');
    this.lookFrom(azimuth, elevation, zoom);
  }
  link() {
    history.replaceState(null, '', this.viewHash());
    const told = (text) => { this.said.textContent = text; };
    const address = 'The address of this page now leads to this view.';
    if (!navigator.clipboard) told(address);
    else navigator.clipboard.writeText(location.href).then(() => told('Copied: the link leads to this view.'), () => told(address));
  }
  /** A PNG of what is seen, on the page's ground. */
  save() {
    const picture = this.painted(), link = h('a', {download: `${report.design || 'gearbox'}.png`, href: picture.toDataURL('image/png')});
    link.click();
    this.said.textContent = `Saved as ${link.download}.`;
  }
  painted(ground = getComputedStyle(document.documentElement).getPropertyValue('--card')) {
    this.render();
    const picture = h('canvas', {width: this.canvas.width, height: this.canvas.height}), context = picture.getContext('2d');
    context.fillStyle = ground;
    context.fillRect(0, 0, picture.width, picture.height);
    context.drawImage(this.canvas, 0, 0);
    this.labels.paint(context, picture.width / this.view.width, getComputedStyle(document.body).color);
    return picture;
  }

  // ------------------------------------------------------------------------------------- drawing
  shownTop() { return this.top + this.exploded * (this.explodedTop - this.top); }
  pose() {
    for (const body of this.bodies) {
      const orbit = body.angle + body.orbit * this.sun;
      const lift = this.exploded * this.lift[this.partGroup(body)];
      body.group.position.set(body.pivot[0] + body.arm * Math.cos(orbit), body.pivot[1] + body.arm * Math.sin(orbit), body.at[2] + lift);
      body.group.rotation.z = body.rotation + body.turn * this.sun;
    }
    this.section.update(this.bodies.filter((b) => b.cut && b.group.visible));
    this.world.position.z = -(this.floor + this.shownTop()) / 2;
    const turns = (this.sun / (2 * Math.PI)).toFixed(2);
    const out = report.train.ratio ? `, output ${(360 * this.sun / (2 * Math.PI) / report.train.ratio * (report.train.direction === 'same' ? 1 : -1)).toFixed(2)}°` : '';
    this.speeds.textContent = `${model.bodies.length > 1 ? 'input' : 'gear'} ${turns} turns${out}`;
  }
  hasNames() { return this.named || this.exploded > 0.12; }
  fit() {
    const {width, height} = this.view, aspect = width / height, elevation = Math.abs(this.eye()[1]) * degrees;
    const tall = (this.shownTop() - this.floor) / 2, sides = this.hasNames() ? 1 - 2 * Labels.room(width) / width : 1;
    const half = Math.max(1.1 * (this.size * Math.sin(elevation) + tall * Math.cos(elevation)), 1.1 * this.size / aspect / sides);
    Object.assign(this.camera, {left: -half * aspect, right: half * aspect, top: half, bottom: -half});
    this.camera.updateProjectionMatrix();
  }
  resize() {
    const view = {width: this.stage.clientWidth || 300, height: this.stage.clientHeight || 300, ratio: Math.min(2, devicePixelRatio || 1)};
    // an observer's first call tells the size that is drawn already: a frame of a housed gearbox is expensive
    if (this.view && Object.keys(view).every((key) => view[key] === this.view[key])) return;
    this.view = view;
    this.renderer.setPixelRatio(view.ratio);
    this.renderer.setSize(this.view.width, this.view.height, false);
    this.wake();
  }
  /** Points of a body that a name may point at: on four fifths of its radius, where it is not cut away. */
  anchors(body) {
    const {min, max} = this.box(body), found = [];
    const centre = body.group.position.clone().add(new Vector3(0, 0, (min.z + max.z) / 2)).add(this.world.position);
    for (let k = 0; k < 24; ++k) {
      const p = new Vector3(Math.cos(k * Math.PI / 12), Math.sin(k * Math.PI / 12), 0).multiplyScalar(0.8 * max.x).add(centre);
      if (!body.cut || !this.section.removes(p)) found.push(p);
    }
    return found;
  }
  label() {
    const parts = !this.hasNames() ? [] : this.groups.filter((name) => !this.hiddenParts.has(name)).map((name) => ({name,
      title: this.groupTitle(name), anchors: this.bodies.filter((b) => this.partGroup(b) === name).flatMap((b) => this.anchors(b))}));
    this.labels.show(parts.filter(({anchors}) => anchors.length), this.camera, this.view);
  }
  render() {
    this.fit();
    this.light();
    this.renderer.render(this.scene, this.camera);
    this.label();
    host.dataset.frames = Number(host.dataset.frames ?? 0) + 1;
  }
  /** Draws a frame soon, and goes on while it turns and can be seen. */
  wake() {
    if (this.pending || !this.stage) return;
    this.pending = requestAnimationFrame((now) => {
      this.pending = 0;
      const turning = this.playing && this.visible !== false;
      if (turning && this.last) { this.sun += Math.min(0.1, (now - this.last) / 1000) * this.rate; this.pose(); }
      this.last = turning ? now : 0;
      this.render();
      if (turning) this.wake();
    });
  }
  picture() { this.print.src = this.painted('#fff').toDataURL('image/png'); }
}

try {
  window.trueflank.viewer = new Viewer();
} catch (error) {
  notice.hidden = false;
  notice.textContent = `No picture in 3D: this browser has no WebGL (${error.message}).`;
  host.replaceChildren(notice);
}
