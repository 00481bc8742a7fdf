// SPDX-License-Identifier: GPL-3.0-or-later
// The page without its picture in 3D: tables of report.json, and the meshes drawn in 2D.
'use strict';
(() => {
const read = (id) => JSON.parse(document.getElementById(id).textContent);
const report = read('report-data');
const model = read('model-data');
const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
window.trueflank = {report, model, still};

// ------------------------------------------------------------------------------------- building
const svgNames = new Set(['svg', 'g', 'path', 'line', 'circle', 'use', 'defs']);
/** An element with attributes and children; a child that is null is left out. */
function h(name, attributes = {}, ...children) {
  const element = svgNames.has(name)
    ? document.createElementNS('http://www.w3.org/2000/svg', name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? '' : value);
  }
  for (const child of children.flat()) if (child !== null && child !== undefined) element.append(child);
  return element;
}
window.trueflank.h = h;
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
const words = (id) => { const s = id.replaceAll('_', ' '); return s[0].toUpperCase() + s.slice(1); };
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

// --------------------------------------------------------------------------------------- header
const kinds = {'3k': '3K (Wolfrom) planetary gearbox', stepped: 'planetary gearbox with stepped planets', simple: 'planetary gearbox', pair: 'gear pair', gear: 'single gear'};
function summary() {
  const train = report.train;
  const parts = [kinds[train.kind] ?? train.kind];
  if (train.planets) parts.push(`${train.planets} ${train.identical_planets ? 'identical planets, equally spaced'
    : train.assembles ? 'planets equally spaced, not all alike' : 'planets that do not go in at equal spacing'}`);
  if (train.input !== 'none')
    parts.push(`${train.input} drives` + (train.planets ? `, ${train.output} is the output` : ''));
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
    cards.push(card('Centre distance', number('train/centre_distance_mm', 4), h('small', {}, 'mm')));
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
function checkRow(check, index) {
  const path = (key) => `checks/${index}/${key}`;
  const cell = (key, label) => h('td', {class: 'n', 'data-label': label},
    isNumber(check[key]) ? number(path(key), null, check.unit) : '–');
  return h('tr', {'data-status': check.status}, h('td', {}, badge(check.status)),
    h('th', {scope: 'row'}, words(check.id)), h('td', {}, check.where),
    cell('value', 'value'), cell('limit', 'limit'), cell('margin', 'margin'),
    h('td', {class: 'message'}, check.message, check.cure ? h('span', {class: 'cure'}, `Cure: ${check.cure}`) : null));
}
function drawChecks() {
  const body = byId('checks-body');
  if (!report.checks.length) { body.append(h('p', {class: 'note'}, 'No checks were run.')); return; }
  const order = ['fail', 'warn', 'pass', 'not_applicable'];
  const rows = report.checks.map((check, index) => ({check, row: checkRow(check, index)}))
    .sort((a, b) => order.indexOf(a.check.status) - order.indexOf(b.check.status));
  const show = (status) => {
    for (const {check, row} of rows) row.hidden = status !== 'all' && check.status !== status;
    for (const button of body.querySelectorAll('.filters button'))
      button.setAttribute('aria-pressed', button.dataset.status === status);
  };
  const filters = ['all', ...order].map((status) => {
    const n = status === 'all' ? rows.length : rows.filter((r) => r.check.status === status).length;
    return n ? h('button', {type: 'button', 'data-status': status, 'aria-pressed': status === 'all',
      onclick: () => show(status)}, `${status === 'all' ? 'All' : words(statusWord[status])} (${n})`) : null;
  });
  drawJointCure(body);
  body.append(h('div', {class: 'filters', role: 'group', 'aria-label': 'Show checks'}, filters),
    table('Every check with how far it is on the good side of its limit', ['Status', 'Check', 'Where',
      column('Value'), column('Limit'), column('Margin'), 'Finding'], rows.map((r) => r.row), 'checks-table'));
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

// ----------------------------------------------------------------------------------- dimensions
const drawingRows = [
  ['Teeth', 'teeth', 0], ['Module', 'module_mm', null, 'mm'], ['Profile shift coefficient', 'shift', 5],
  ['Reference diameter', 'reference_diameter_mm', 4, 'mm'], ['Base diameter', 'base_diameter_mm', 4, 'mm'],
  ['Tip diameter', 'tip_diameter_mm', 4, 'mm'], ['Tip form diameter', 'tip_form_diameter_mm', 4, 'mm'],
  ['Start of active profile, diameter', 'start_active_profile_diameter_mm', 4, 'mm'],
  ['Root form diameter', 'root_form_diameter_mm', 4, 'mm'], ['Root diameter', 'root_diameter_mm', 4, 'mm'],
  ['Root fillet radius, of the module', 'root_radius_coefficient', 4],
  ['Transverse module', 'transverse_module_mm', 5, 'mm'],
  ['Transverse pressure angle', 'transverse_pressure_angle_deg', 4, '°'],
  ['Base helix angle', 'base_helix_angle_deg', 4, '°'], ['Lead', 'lead_mm', 4, 'mm'],
  ['Face width', 'face_width_mm', 3, 'mm'], ['Tooth thickness at reference circle', 'reference_thickness_mm', 4, 'mm'],
  ['Tooth thickness at tip', 'tip_thickness_mm', 4, 'mm'], ['Thinning for backlash', 'thinning_um', 2, 'µm'],
];
const workshopRows = [
  ['Teeth spanned', 'span_teeth', 0], ['Span', 'span_mm', 4, 'mm'], ['Pin or ball diameter', 'pin_diameter_mm', 3, 'mm'],
  ['Over pins (ring: between pins)', 'over_pins_mm', 4, 'mm'],
];
const allowanceRows = [
  ['Tooth thickness allowance, upper', 'upper_um', 1, 'µm'], ['Tooth thickness allowance, lower', 'lower_um', 1, 'µm'],
  ['Span, smallest', 'span_min_mm', 4, 'mm'], ['Span, largest', 'span_max_mm', 4, 'mm'],
  ['Over pins, smallest', 'over_pins_min_mm', 4, 'mm'], ['Over pins, largest', 'over_pins_max_mm', 4, 'mm'],
];
function drawAllowances(body) {
  const names = Object.keys(report.gears).filter((n) => report.gears[n].thickness_allowance);
  if (!names.length) return;
  body.append(h('h3', {}, 'Tooth thickness and backlash limits'),
    table('Sizes at both ends of the tolerance', ['Size', ...names.map(column)], allowanceRows.map(([title, key, digits, unit]) =>
      h('tr', {}, h('th', {scope: 'row'}, title, h('span', {class: 'unit'}, ` ${unit}`)),
        names.map((n) => h('td', {class: 'n'}, number(`gears/${n}/thickness_allowance/${key}`, digits))))), 'numbers'));
  const meshes = Object.keys(report.meshes).filter((n) => isNumber(report.meshes[n].backlash_min_mm));
  if (meshes.length) body.append(table('Backlash from these allowances, at the exact centre distance',
    ['Mesh', 'Smallest', 'Largest'], meshes.map((n) => h('tr', {}, h('th', {scope: 'row'}, n, h('span', {class: 'unit'}, ' mm')),
      h('td', {class: 'n'}, number(`meshes/${n}/backlash_min_mm`, 4)), h('td', {class: 'n'}, number(`meshes/${n}/backlash_max_mm`, 4)))), 'numbers'));
}
const noteWords = {undercut: 'undercut', pointed: 'pointed tooth', full_round_root: 'full round root',
  closed_space: 'space closed before the root', tip_inside_base_circle: 'tip inside the base circle',
  tip_trimmed_by_cutter: 'tip trimmed by the cutter'};
function gearRows(names, rows) {
  return rows.filter(([, key]) => names.some((n) => report.gears[n][key] !== undefined)).map(([title, key, digits, unit]) =>
    h('tr', {}, h('th', {scope: 'row'}, title, unit ? h('span', {class: 'unit'}, ` ${unit}`) : null),
      names.map((n) => h('td', {class: 'n'}, number(`gears/${n}/${key}`, digits)))));
}
const toleranceRows = [
  ['Single pitch', 'f_p', '±'], ['Total cumulative pitch', 'F_p', ''], ['Profile slope', 'f_Ha', '±'],
  ['Profile form', 'f_fa', ''], ['Total profile', 'F_a', ''], ['Helix slope', 'f_Hb', '±'],
  ['Helix form', 'f_fb', ''], ['Total helix', 'F_b', ''], ['Runout (informative)', 'F_r', ''],
];
const toleranceSymbols = {f_p: 'fp', F_p: 'Fp', f_Ha: 'fHα', f_fa: 'ffα', F_a: 'Fα', f_Hb: 'fHβ', f_fb: 'ffβ', F_b: 'Fβ', F_r: 'Fr'};
function drawTolerances(body) {
  const inScope = model.gears.filter((g) => Object.keys(g.iso1328.classes).length);
  const outside = model.gears.filter((g) => g.iso1328.scope);
  body.append(h('h3', {}, 'Flank tolerances, ISO 1328-1:2013'));
  if (inScope.length) {
    const holder = h('div');
    const fill = (k) => holder.replaceChildren(table(`Allowed deviations in µm, class ${k}`,
      ['Deviation', ...inScope.map((g) => column(g.name))], toleranceRows.map(([title, key, sign]) =>
        h('tr', {}, h('th', {scope: 'row'}, `${title} ${toleranceSymbols[key]}`),
          inScope.map((g) => h('td', {class: 'n'}, sign + g.iso1328.classes[k][key])))), 'numbers'));
    const select = h('select', {id: 'tolerance-class', onchange: (e) => fill(e.target.value)},
      Object.keys(inScope[0].iso1328.classes).map((k) => h('option', {value: k, selected: k === '8'}, `class ${k}`)));
    fill('8');
    body.append(h('p', {class: 'controls', style: 'border:0;padding:0 0 .6rem'},
      h('label', {for: 'tolerance-class'}, 'Tolerance class', select)), holder);
  }
  for (const gear of outside) body.append(h('p', {class: 'note'}, `${gear.name}: ${gear.iso1328.scope}.`));
}
function drawDimensions() {
  const body = byId('dimensions-body');
  const names = Object.keys(report.gears);
  const rows = gearRows(names, drawingRows);
  rows.splice(2, 0, h('tr', {}, h('th', {scope: 'row'}, 'Pressure angle', h('span', {class: 'unit'}, ' °')),
    model.gears.map((g) => h('td', {class: 'n'}, text(g.pressure_angle_deg)))),
    h('tr', {}, h('th', {scope: 'row'}, 'Helix angle, right hand positive', h('span', {class: 'unit'}, ' °')),
      model.gears.map((g) => h('td', {class: 'n'}, text(g.helix_deg)))));
  rows.push(h('tr', {}, h('th', {scope: 'row'}, 'Remarks'), names.map((n) => h('td', {class: 'n', style: 'white-space:normal'},
    Object.entries(noteWords).filter(([key]) => report.gears[n][key]).map(([, word]) => word).join(', ') || '–'))));
  const columns = ['', ...names.map((n) => column(n + (report.gears[n].internal ? ' (internal)' : '')))];
  body.append(h('h3', {}, 'For the drawing'), table('Geometry of each gear as it is cut', columns, rows, 'numbers'),
    h('h3', {}, 'For the workshop'),
    table('Sizes to measure; thinning for backlash is in them', columns, gearRows(names, workshopRows), 'numbers'));
  drawAllowances(body);
  drawTolerances(body);
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

// ---------------------------------------------------------------------------- bill of materials
function drawBill() {
  const bill = report.bill_of_materials ?? [];
  if (!bill.length) return;
  byId('dimensions-body').append(table('Bill of materials', ['Part', 'To order', column('Count'), 'Material', column('Mass of one, solid, g')],
    bill.map((line, i) => h('tr', {}, h('th', {scope: 'row'}, line.part ?? '–'), h('td', {}, line.designation ?? '–'),
      h('td', {class: 'n'}, number(`bill_of_materials/${i}/count`, 0)), h('td', {}, line.material ?? '–'),
      h('td', {class: 'n'}, isNumber(line.mass_g) ? number(`bill_of_materials/${i}/mass_g`, 1) : '–')))));
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
    table('Files of this design', ['File', 'Part', 'Format', column('Size'), column('Triangles'), column('Accuracy µm'), column('Volume mm³')],
      files.map((f, i) => h('tr', {}, h('th', {scope: 'row'}, h('a', {href: encodeURI(f.path)}, f.path)), h('td', {}, f.part), h('td', {}, f.format),
        h('td', {class: 'n'}, size(f.bytes)), h('td', {class: 'n'}, number(`files/${i}/triangles`, 0)),
        h('td', {class: 'n'}, number(`files/${i}/accuracy_um`, 3)), h('td', {class: 'n'}, number(`files/${i}/volume_mm3`, 3))))));
}

// --------------------------------------------------------------------------------------- meshes
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
function sectorPath(gear) {
  const reach = Math.min(6, Math.floor((gear.teeth - 1) / 2));
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
    this.draw(index);
    this.show();
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
    this.shape1 = h('path', {class: 'g1', d: sectorPath(this.gear1)});
    this.shape2 = h('path', {class: this.internal ? 'g2 ring' : 'g2', d: sectorPath(this.gear2)});
    this.marks = h('g');
    const scene = h('g', {id: `mesh-scene-${index}`}, this.shape2, this.shape1);
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
    this.pairs = h('dd', {class: 'pairs'});
    this.gapNow = h('dd', {class: 'gap-now'});
    this.lensCaption = h('figcaption');
    const fact = (title, value) => h('div', {}, h('dt', {}, title), value);
    const item = (title, path, digits, unit) => fact(title, h('dd', {}, number(`meshes/${mesh.name}/${path}`, digits, unit)));
    this.element = h('article', {class: 'mesh', id: `mesh-${mesh.name}`}, h('h3', {}, mesh.name),
      h('figure', {}, this.svg, h('figure', {class: 'lens'}, this.lensView, this.lensCaption)),
      h('div', {class: 'key'}, h('span', {}, h('i', {style: 'background:var(--gear1-line)'}), this.gear1.name),
        h('span', {}, h('i', {style: 'background:var(--gear2-line)'}), this.gear2.name),
        h('span', {}, h('i', {style: 'background:var(--action);height:3px;vertical-align:.2rem'}), 'path of contact (dashed: other flank)')),
      h('div', {class: 'controls', style: 'border:0;padding:.6rem 1rem 0'}, this.button, this.slider),
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
    const {gear1, gear2, mesh} = this, m = gear1.module;
    const turn1 = (this.phase - 0.5) * 2 * Math.PI / gear1.teeth;
    const turn2 = (this.internal ? 1 : -1) * turn1 * gear1.teeth / gear2.teeth;
    const degrees = (a) => a * 180 / Math.PI;
    this.shape1.setAttribute('transform', `rotate(${degrees(turn1)})`);
    this.shape2.setAttribute('transform', `translate(${this.axis2} 0) rotate(${degrees(this.start2 + turn2)})`);
    const drive = this.contacts(turn1), coast = this.contacts(-turn1);
    const dot = (s, sign) => { const [x, y] = this.onLine(s); return h('circle', {class: 'touch', cx: x, cy: sign * y, r: 0.09 * m, 'fill-opacity': sign > 0 ? 1 : .45}); };
    const near = ([x, y]) => Math.hypot(x - mesh.pitch_radius1, y) < 3.5 * m;
    const a = this.points1.map(([x, y]) => rotated(x, y, turn1)).filter(near);
    const b = this.points2.map(([x, y]) => { const p = rotated(x, y, this.start2 + turn2); return [p[0] + this.axis2, p[1]]; }).filter(near);
    const gap = closest(a, b);
    const marks = [...coast.map((s) => dot(s, -1)), ...drive.map((s) => dot(s, 1))];
    if (gap.p) marks.push(h('circle', {class: 'gapring', cx: gap.p[0], cy: gap.p[1], r: 0.22 * m}));
    this.marks.replaceChildren(...marks);
    this.pairs.textContent = String(drive.length);
    const um = 1000 * gap.distance, fine = 2 * model.mesh_chord_error_um;
    this.gapNow.textContent = um <= fine ? `under ${fine} µm` : `${um.toFixed(1)} µm`;
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
      if (entry.isIntersecting && !drawing.met && !still) drawing.play(true);
      drawing.met ||= entry.isIntersecting;
    }
  });
  for (const drawing of drawings) { body.append(drawing.element); watch.observe(drawing.element); }
  window.trueflank.meshes = drawings;
}

drawHeader();
drawChecks();
drawMeshes();
drawDimensions();
drawEfficiency();
drawBill();
drawFiles();
if (!document.querySelector('#licences pre').textContent.trim()) byId('licences').remove();
// viewer.js takes this back when it runs
const notice = byId('viewer-notice');
notice.hidden = false;
notice.textContent = 'No picture in 3D: this Trueflank was built without three.js (run scripts/install-dependencies, then build again).';
})();
