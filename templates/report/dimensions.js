// SPDX-License-Identifier: GPL-3.0-or-later
// The page's dimensions: sizes of the gears, limits, inches, flank tolerances, bill of materials.
'use strict';
(() => {
const {report, model, h, byId, isNumber, text, number, inches, table, column} = window.trueflank;

// ------------------------------------------------------------------------------------ the gears
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
/** The lengths of some rows in inches. */
function inchRows(names, rows, path) {
  return rows.filter(([, , , unit]) => unit === 'mm').map(([title, key]) =>
    h('tr', {}, h('th', {scope: 'row'}, title, h('span', {class: 'unit'}, ' in')),
      names.map((n) => h('td', {class: 'n'}, inches(path(n, key))))));
}
/** All lengths again for a design that speaks inches. */
function drawInches(body, names, columns) {
  const gear = (n, key) => `gears/${n}/${key}`, allowance = (n, key) => `gears/${n}/thickness_allowance/${key}`;
  const limited = names.filter((n) => report.gears[n].thickness_allowance).length === names.length;
  const meshes = Object.keys(report.meshes);
  body.append(h('h3', {}, 'In inches'), table('The same lengths in inches', columns, [
    h('tr', {}, h('th', {scope: 'row'}, 'Diametral pitch'),
      names.map((n) => h('td', {class: 'n'}, number(`inches/gears/${n}/diametral_pitch`)))),
    ...inchRows(names, drawingRows.filter(([, key]) => key !== 'module_mm'), gear), ...inchRows(names, workshopRows, gear),
    ...(limited ? inchRows(names, allowanceRows, allowance) : [])], 'numbers inches'));
  if (meshes.length) body.append(table('Backlash in inches', ['Mesh', column('Backlash')], meshes.map((n) =>
    h('tr', {}, h('th', {scope: 'row'}, n, h('span', {class: 'unit'}, ' in')),
      h('td', {class: 'n'}, inches(`meshes/${n}/backlash_mm`)))), 'numbers inches'));
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
  if (report.inches) drawInches(body, names, columns);
  drawTolerances(body);
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

drawDimensions();
drawBill();
})();
