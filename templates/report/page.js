// SPDX-License-Identifier: GPL-3.0-or-later
// The page without its picture in 3D: header, checks, efficiency and files, from report.json.
'use strict';
(() => {
const read = (id) => JSON.parse(document.getElementById(id).textContent);
const report = read('report-data');
const model = read('model-data');
const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
window.trueflank = {report, model, still};

// ------------------------------------------------------------------------------------- building
const svgNames = new Set(['svg', 'g', 'path', 'line', 'circle', 'use', 'defs', 'clipPath']);
/** An element with attributes and children; a child that is null is left out. */
function h(name, attributes = {}, ...children) {
  const element = svgNames.has(name)
    ? document.createElementNS('http://www.w3.org/2000/svg', name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? '' : value);
  }
  for (const child of children.flat(Infinity)) if (child !== null && child !== undefined) element.append(child);
  return element;
}

const byId = (id) => document.getElementById(id);
const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

/** Enough digits to tell the value, no more: five significant, never an exponent for usual sizes. */
function digitsFor(value) {
  if (value === 0 || Number.isInteger(value)) return 0;
  return Math.min(6, Math.max(0, 4 - Math.floor(Math.log10(Math.abs(value)))));
}
function text(value, digits = null) {
  if (!isNumber(value)) return '–';
  const fixed = value.toFixed(digits ?? digitsFor(value));
  const shown = digits === null && fixed.includes('.') ? fixed.replace(/\.?0+$/, '') : fixed;
  return (Number(shown) === 0 ? shown.replace('-', '') : shown).replace('-', '−');
}
/** A number of the report: the element carries its path, so that anyone can compare. */
function number(path, digits = null, unit = '') {
  const value = path.split('/').reduce((at, key) => at?.[key], report);
  return h('span', {'data-path': path}, text(value, digits),
    unit && isNumber(value) ? h('span', {class: 'unit'}, ' ' + unit) : null);
}
/** A length of the report in inches, to 1e-5 in; its element carries path and factor. */
function inches(path) {
  const mm = path.split('/').reduce((at, key) => at?.[key], report);
  return h('span', {'data-path': path, 'data-factor': 1 / 25.4}, isNumber(mm) ? text(mm / 25.4, 5) : '–');
}
const words = (id) => { const s = id.replaceAll('_', ' '); return s[0].toUpperCase() + s.slice(1); };
/** A part as people call it: "carrier_pin" is Carrier pin, "screw_m3x60_housing" Screw M3×60, housing. */
function properName(name) {
  const size = (s) => s.replace(/^m(?=\d)/, 'M').replace(/(\d)x(\d)/, '$1×$2').replace(/(\d)_(\d)/g, '$1.$2');
  const bought = name.match(/^(motor|screw|insert|bearing|pin)_([^_]*\d(?:_\d+)?)(?:_([a-z_]+))?$/);
  if (bought) return `${words(bought[1])} ${bought[1] === 'motor' ? bought[2].replace(/^nema/, 'NEMA ') : size(bought[2])}${bought[3] ? `, ${bought[3]}` : ''}`;
  return words(name).replace(/([a-z])(\d)/g, '$1 $2');
}
const statusWord = {pass: 'pass', warn: 'warning', fail: 'fail', not_applicable: 'not applicable'};
const badge = (status) => h('span', {class: `badge ${status}`}, statusWord[status] ?? status);
function table(caption, columns, rows, className = '') {
  return h('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption},
    h('table', {class: className}, h('caption', {}, caption),
      h('thead', {}, h('tr', {}, columns.map((c, i) =>
        h('th', {scope: 'col', class: i > 0 && c.number ? 'n' : null}, c.title ?? c)))),
      h('tbody', {}, rows)));
}
const column = (title) => ({title, number: true});
Object.assign(window.trueflank, {h, byId, isNumber, text, number, inches, properName, table, column});

// --------------------------------------------------------------------------------------- header
const kinds = {'3k': '3K (Wolfrom) planetary gearbox', stepped: 'planetary gearbox with stepped planets', simple: 'planetary gearbox',
  'two-stage': 'planetary gearbox of two stages', pair: 'gear pair', gear: 'single gear'};
function summary() {
  const train = report.train;
  const parts = [kinds[train.kind] ?? train.kind];
  const stages = train.stages ?? [train];
  for (const stage of stages.filter((s) => s.planets))
    parts.push(`${stage.planets} ${stage.identical_planets ? 'identical planets, equally spaced'
      : stage.assembles ? 'planets equally spaced, not all alike' : 'planets that do not go in at equal spacing'}`);
  if (train.input !== 'none')
    parts.push(`${train.input} drives` + (stages[0].planets ? `, ${train.output} is the output` : ''));
  const teeth = Object.entries(report.gears).map(([name, gear]) => `${name} ${gear.teeth}`).join(', ');
  return `${parts.join(', ')}. Teeth: ${teeth}.`;
}
function drawHeader() {
  byId('design-name').textContent = report.design || 'Unnamed design';
  byId('summary').textContent = summary();
  const count = (status) => report.checks.filter((c) => c.status === status).length;
  const fails = count('fail'), warns = count('warn');
  const plural = (n, word) => `${n} ${word}${n === 1 ? '' : 's'}`;
  const verdict = byId('verdict');
  verdict.className = report.verdict;
  verdict.textContent = !report.checks.length ? 'No checks were run'
    : fails ? `${plural(fails, 'check')} failed` + (warns ? `, ${plural(warns, 'warning')}` : '')
    : warns ? `Every check passed, ${plural(warns, 'warning')}` : 'Every check passed';
  const card = (title, ...value) => h('div', {}, h('dt', {}, title), h('dd', {}, ...value));
  const cards = [];
  if (report.train.ratio !== null)
    cards.push(card(`Ratio, ${report.train.direction} direction`, number('train/ratio', 4), h('small', {}, ': 1')));
  if (report.efficiency.forward !== null) {
    const percent = (key) => h('span', {'data-path': `efficiency/${key}`, 'data-factor': 100},
      text(100 * report.efficiency[key], 2), h('small', {}, '%'));
    cards.push(card('Efficiency forward', percent('forward')));
    cards.push(card('Efficiency backward', report.efficiency.self_locking
      ? h('small', {}, 'none: self-locking') : percent('backward')));
  }
  if (report.train.centre_distance_mm !== null)
    cards.push(card('Centre distance', number('train/centre_distance_mm', 4), h('small', {}, 'mm'),
      report.inches ? [' ', inches('train/centre_distance_mm'), h('small', {}, 'in')] : null));
  (report.train.stages ?? []).forEach((stage, i) => cards.push(card(`Stage ${i + 1}`,
    number(`train/stages/${i}/ratio`, 4), h('small', {}, ': 1, axes '),
    number(`train/stages/${i}/centre_distance_mm`, 4), h('small', {}, 'mm'))));
  const strength = model.strength?.output_torque_nm;
  if (isNumber(strength)) cards.push(card('Allowable output torque', text(strength, 2), h('small', {}, `N m, ${report.strength.limiting_material}`)));
  const runs = report.checks.find((c) => c.id === 'tolerance' && c.where === 'train' && isNumber(c.value));
  if (runs) cards.push(card('Sets that assemble and run', text(100 - runs.value, 2), h('small', {}, '% within tolerances')));
  const files = report.files ?? [];
  const worst = Math.max(...files.map((f) => f.accuracy_um ?? -1));
  if (files.length) cards.push(card(`${files.length} files written`,
    worst >= 0 ? [text(worst, 3), h('small', {}, 'µm at worst')] : h('small', {}, 'exact curves')));
  byId('key-figures').append(...cards);
  for (const section of document.querySelectorAll('main section'))
    byId('nav').append(h('a', {href: `#${section.id}`}, section.querySelector('h2').textContent));
}

// --------------------------------------------------------------------------------------- checks
/** The mesh that a finding is about: by its own name, or the first of a gear. */
function meshOf(where) {
  const gear = model.gears.findIndex((g) => g.name === where);
  return model.meshes.find((m) => m.name === where) ?? model.meshes.find((m) => gear >= 0 && [m.gear1, m.gear2].includes(gear));
}
function checkRow(check, index) {
  const path = (key) => `checks/${index}/${key}`;
  const cell = (key, label) => h('td', {class: 'n', 'data-label': label},
    isNumber(check[key]) ? number(path(key), null, check.unit) : '–');
  const mesh = ['fail', 'warn'].includes(check.status) ? meshOf(check.where) : null;
  return h('tr', {'data-status': check.status}, h('td', {}, badge(check.status)),
    h('th', {scope: 'row'}, words(check.id)), h('td', {}, check.where),
    cell('value', 'value'), cell('limit', 'limit'), cell('margin', 'margin'),
    h('td', {class: 'message'}, check.message, check.cure ? h('span', {class: 'cure'}, `Cure: ${check.cure}`) : null,
      mesh ? h('button', {type: 'button', class: 'show', 'aria-label': `Show it: ${mesh.name}, ${words(check.id)}`,
        onclick: () => window.trueflank.showMesh(mesh.name)}, 'Show it') : null));
}
/** What failed and what warns is open to the eye; what passed is one line that opens. */
function drawChecks() {
  const body = byId('checks-body');
  if (!report.checks.length) { body.append(h('p', {class: 'note'}, 'No checks were run.')); return; }
  const order = ['fail', 'warn', 'pass', 'not_applicable'];
  const rows = report.checks.map((check, index) => ({check, row: checkRow(check, index)}))
    .sort((a, b) => order.indexOf(a.check.status) - order.indexOf(b.check.status));
  const told = rows.filter(({check}) => ['fail', 'warn'].includes(check.status)), good = rows.filter((r) => !told.includes(r));
  const all = (caption, list) => table(caption, ['Status', 'Check', 'Where', column('Value'), column('Limit'), column('Margin'), 'Finding'],
    list.map((r) => r.row), 'checks-table');
  drawJointCure(body);
  if (told.length) body.append(all('Failures first; the margin is how far a value is on the good side of its limit', told));
  if (!good.length) return;
  const passed = good.filter((r) => r.check.status === 'pass').length, other = good.length - passed;
  const places = new Map();
  for (const {check} of good) if (check.status === 'pass') places.set(check.id, [...(places.get(check.id) ?? []), check.where]);
  body.append(h('details', {id: 'passed'},
    h('summary', {}, `${told.length ? 'What passed' : 'Every check passed'}: ${passed} findings${other ? `, ${other} not applicable` : ''}`),
    all('What passed, with how far it is on the good side of its limit', good)),
  h('p', {class: 'print-only note'}, `Passed: ${[...places].map(([id, where]) => `${words(id)} (${where.join(', ')})`).join('; ')}.`));
}

/** The one change that mends what fails; what it costs; what would still fail. */
function drawJointCure(body) {
  const cure = report.joint_cure;
  if (!cure) return;
  const box = h('div', {class: 'joint-cure', id: 'joint-cure'});
  box.append(h('h3', {}, cure.cured ? 'One change after which every check passes'
    : cure.changes.length ? 'The nearest that was found, which still fails' : 'No change near this design mends it'));
  if (cure.changes.length) {
    box.append(table('Keys of the design file that change', ['Key', column('Was'), column('Is')],
      cure.changes.map((c) => h('tr', {}, h('th', {scope: 'row'}, c.key), h('td', {class: 'n'}, c.before ?? '–'),
        h('td', {class: 'n'}, c.after ?? '–'))), 'numbers'));
    const cost = (path, digits, factor = 1) => {
      const pair = path.reduce((at, key) => at[key], cure);
      const one = (value) => isNumber(value) ? text(factor * value, digits) : '–';
      return [h('td', {class: 'n'}, one(pair.before)), h('td', {class: 'n'}, one(pair.after))];
    };
    box.append(table('What it costs', ['Figure', column('Was'), column('Is')],
      [...Object.keys(cure.contact_ratio).map((mesh) =>
        h('tr', {}, h('th', {scope: 'row'}, `Contact ratio ${mesh}`), cost(['contact_ratio', mesh], 3))),
      ...['forward', 'backward'].map((way) => h('tr', {}, h('th', {scope: 'row'}, `Efficiency ${way}`,
        h('span', {class: 'unit'}, ' %')), cost(['efficiency', way], 2, 100)))], 'numbers'));
  }
  for (const f of cure.still_failing)
    box.append(h('p', {class: 'note'}, `Still fails: ${words(f.id)} ${f.where}: ${f.message}`));
  if (cure.contradiction) box.append(h('p', {class: 'note'}, cure.contradiction));
  box.append(h('p', {class: 'note'}, cure.cured ? 'trueflank fix DESIGN -o FIXED.toml writes it'
    + (cure.search_ended ? '.' : ', and searches longer, for a smaller change.')
    : 'trueflank fix DESIGN -o FIXED.toml searches longer.'));
  body.append(box);
}

// ----------------------------------------------------------------------------------- efficiency
function meshTable() {
  const share = (name, key) => model.forward.meshes.find((m) => m.name === name)?.[key];
  const percent = (value) => isNumber(value) ? `${text(100 * value, 2)} %` : '–';
  return table('Each mesh; power and loss are shares of the driving power, sun driving',
    ['Mesh', column('Working angle °'), column('Approach e₁'), column('Recess e₂'), column('Contact ratio'),
      column('effective'), column('Overlap ratio'), column('Basic efficiency'), column('Rolling power'), column('Loss')],
    Object.keys(report.meshes).map((name) => h('tr', {}, h('th', {scope: 'row'}, name),
      ['working_pressure_angle_deg', 'approach_contact_ratio', 'recess_contact_ratio', 'contact_ratio',
        'effective_contact_ratio', 'overlap_ratio', 'basic_efficiency'].map((key) =>
        h('td', {class: 'n'}, number(`meshes/${name}/${key}`, key === 'basic_efficiency' ? 5 : 3))),
      ['rolling_power', 'loss'].map((key) => h('td', {class: 'n'}, percent(share(name, key)))))), 'numbers');
}
function thrustTable() {
  const thrust = report.axial_thrust;
  if (!thrust || !Object.values(thrust.meshes).some((m) => m.on_gear1_n_per_nm)) return [];
  return [h('h3', {}, 'Axial thrust'),
    table('Net force along z on each body, the sun (pinion) driven counter-clockwise; the other way with the other sign',
      ['Body', column('N per N m at the sun'), column('N at the allowable torque')],
      Object.keys(thrust.bodies).map((name) => h('tr', {}, h('th', {scope: 'row'}, name),
        ['n_per_nm', 'n'].map((key) => h('td', {class: 'n'}, number(`axial_thrust/bodies/${name}/${key}`, 3))))), 'numbers')];
}
function torqueTable(direction, torque) {
  const members = direction.members;
  const driving = members.find((m) => m.power > 0 && Math.abs(m.power - 1) < 1e-9) ?? members[0];
  const scale = torque / Math.abs(driving.torque);
  return table('Speed per turn of the sun, torque on each member with this driving torque, power',
    ['Member', column('Speed'), column('Torque N m'), column('Power of the drive')], members.map((m) =>
      h('tr', {}, h('th', {scope: 'row'}, m.name), h('td', {class: 'n'}, text(m.speed, 6)),
        h('td', {class: 'n'}, text(m.torque * scale, 4)), h('td', {class: 'n'}, isNumber(m.power) ? `${text(100 * m.power, 2)} %` : '–'))), 'numbers');
}
function drawStrength(body) {
  const strength = model.strength;
  if (!strength) return;
  body.append(h('h3', {}, 'Allowable torque'),
    h('p', {class: 'note'}, `Root bending and surface durability after JGMA 401 and 402 allow ${text(strength.output_torque_nm, 2)} N m at the output; `
      + `${strength.limiting_gear} in ${strength.limiting_mesh} is the limit, by ${strength.limiting_mode} (${report.strength.limiting_material}).`),
    table('Output torque at which each mesh reaches its limit, N m', ['Mesh', 'Materials', column('Root bending'), column('Flank contact')],
      strength.meshes.map((m) => h('tr', {}, h('th', {scope: 'row'}, m.name), h('td', {}, m.material1 === m.material2 ? m.material1 : `${m.material1} / ${m.material2}`),
        h('td', {class: 'n'}, text(m.bending_output_nm, 2)), h('td', {class: 'n'}, text(m.contact_output_nm, 2)))), 'numbers'));
}
/** The same limits after ISO 6336, or of plastics after VDI 2736, from report.json. */
function drawOtherRatings(body) {
  const {iso6336: iso, plastic} = report.strength ?? {};
  if (iso && isNumber(iso.output_torque_nm)) body.append(h('p', {class: 'note'},
    `In the form of ISO 6336 ${text(iso.output_torque_nm, 2)} N m, limited by ${iso.limiting_mode} of ${iso.limiting_gear} `
    + `(${report.strength.limiting_material}).`));
  if (!plastic) return;
  body.append(h('p', {class: 'note'}, `Plastics in the form of VDI 2736: ${text(plastic.output_torque_nm, 3)} N m, limited by `
    + `${plastic.limiting_mode} of ${plastic.limiting_gear}. At that torque:`),
  table('Plastic teeth at the allowable torque', ['Gear', 'Mesh', 'Material', column('Root °C'), column('Flank °C'), column('Root MPa'),
    column('of'), column('Flank MPa'), column('of'), column('Bent µm')],
  plastic.teeth.map((t) => h('tr', {}, h('th', {scope: 'row'}, t.gear), h('td', {}, t.mesh), h('td', {}, t.material),
    ['root_c', 'flank_c', 'root_stress_mpa', 'root_limit_mpa', 'flank_stress_mpa', 'flank_limit_mpa', 'bent_um'].map((key) =>
      h('td', {class: 'n'}, isNumber(t[key]) ? text(t[key], 1) : '–')))), 'numbers'));
}
function drawEfficiency() {
  const body = byId('efficiency-body');
  const e = report.efficiency;
  if (e.forward === null) {
    body.append(h('p', {class: 'note'}, Object.keys(report.meshes).length ? 'Contact is interrupted: there is no efficiency.'
      : 'A single gear has no mesh to lose power in.'));
    return;
  }
  const bar = (title, key) => [h('span', {}, title),
    h('div', {class: 'track'}, h('div', {class: 'fill', style: `width:${Math.max(0, 100 * e[key])}%`})),
    h('span', {class: 'value', 'data-path': `efficiency/${key}`, 'data-factor': 100},
      key === 'backward' && e.self_locking ? '0 %, self-locking' : `${text(100 * e[key], 2)} %`)];
  body.append(h('div', {class: 'bars'}, bar('Forward', 'forward'), bar('Backward', 'backward')),
    h('p', {class: 'note'}, `Friction in the meshes alone, coefficient ${e.friction}; bearings, seals and grease cost more and must be measured.`),
    h('h3', {}, 'Meshes'), meshTable(), ...thrustTable());
  if (model.forward.members.length) {
    const holder = h('div');
    const torque = h('input', {type: 'number', id: 'torque', min: '0', step: 'any', value: '1'});
    const way = h('select', {id: 'direction'}, h('option', {value: 'forward'}, 'forward: the input drives'),
      e.self_locking ? null : h('option', {value: 'backward'}, 'backward: the output drives'));
    const fill = () => holder.replaceChildren(torqueTable(model[way.value], Number(torque.value) || 0));
    torque.addEventListener('input', fill);
    way.addEventListener('change', fill);
    body.append(h('h3', {}, 'Torques'), h('p', {class: 'controls', style: 'border:0;padding:0 0 .6rem'},
      h('label', {for: 'torque'}, 'Driving torque, N m', torque), h('label', {for: 'direction'}, 'Direction', way)), holder);
    fill();
  }
  drawStrength(body);
  drawOtherRatings(body);
}

// ---------------------------------------------------------------------------------------- files
function drawFiles() {
  const files = report.files ?? [];
  if (!files.length) {
    byId('files').remove();
    document.querySelector('#nav a[href="#files"]').remove();
    return;
  }
  const size = (bytes) => bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(2)} MB`;
  byId('files-body').append(
    h('p', {class: 'lead'}, 'Each file was measured again after it was written: the largest distance between its surface and the exact one, both ways',
      isNumber(report.tolerance_um) ? `; ${report.tolerance_um} µm was asked for.` : '.'),
    h('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Files of this design'},
      h('table', {class: 'numbers files'}, h('caption', {}, 'Files of this design, part by part'),
        h('thead', {}, h('tr', {}, ['File', 'Format'].map((c) => h('th', {scope: 'col'}, c)),
          ['Size', 'Triangles', 'Accuracy µm', 'Volume mm³'].map((c) => h('th', {scope: 'col', class: 'n'}, c)))),
        [...new Set(files.map((f) => f.part))].map((part) => h('tbody', {},
          h('tr', {class: 'group'}, h('th', {colspan: '6', scope: 'rowgroup'}, part ? properName(part) : 'All parts')),
          files.map((f, i) => f.part !== part ? null : h('tr', {'data-file': f.path}, h('th', {scope: 'row'}, h('a', {href: encodeURI(f.path)}, f.path)),
            h('td', {}, f.format), h('td', {class: 'n'}, size(f.bytes)), h('td', {class: 'n'}, number(`files/${i}/triangles`, 0)),
            h('td', {class: 'n'}, number(`files/${i}/accuracy_um`, 3)), h('td', {class: 'n'}, number(`files/${i}/volume_mm3`, 3)))))))));
}

if (report.inches) byId('lengths').textContent = 'Lengths in millimetres and, as the design speaks them, in inches';
drawHeader();
drawChecks();
drawEfficiency();
drawFiles();
// the file's own date: the page itself has none, so that the same input gives the same bytes
if (location.protocol === 'file:')
  byId('made').append(` This file was written ${new Date(document.lastModified).toLocaleString('sv-SE').slice(0, 16)}.`);
if (!document.querySelector('#licences pre').textContent.trim()) byId('licences').remove();
// viewer.js takes this back when it runs
const notice = byId('viewer-notice');
notice.hidden = false;
notice.textContent = 'No picture in 3D: this Trueflank was built without three.js (run scripts/install-dependencies, then build again).';
})();
