// SPDX-License-Identifier: GPL-3.0-or-later
// Names beside the picture, each with a line to its part.
const {h} = window.trueflank;
const rowHeight = 22, margin = 10, top = 34;  // above stands what turns how far

export class Labels {
  constructor(stage) {
    this.lines = h('svg', {class: 'leaders', 'aria-hidden': 'true'});
    this.box = h('div', {class: 'labels', 'aria-hidden': 'true'}, this.lines);
    stage.append(this.box);
    this.names = new Map();
    this.drawn = [];
  }
  /** Room at each side, in pixels of a picture this wide. */
  static room(width) { return Math.min(210, 0.3 * width); }

  /** `parts`: {name, title, anchors: [Vector3]}, points of the part that can be pointed at, in the world. */
  show(parts, camera, {width, height}) {
    this.box.hidden = !parts.length;
    this.drawn = [];
    if (!parts.length) return;
    const pixel = (p) => { const q = p.clone().project(camera); return [(q.x + 1) / 2 * width, (1 - q.y) / 2 * height]; };
    const ends = parts.map((part) => {
      const at = part.anchors.map(pixel);
      return [-1, 1].map((side) => at.reduce((a, b) => side * b[0] > side * a[0] ? b : a));
    });
    const order = parts.map((_, i) => i).sort((a, b) => ends[a][1][1] - ends[b][1][1]);
    const sides = [[], []];
    order.forEach((i, k) => sides[(k + 1) % 2].push({part: parts[i], end: ends[i][(k + 1) % 2], y: ends[i][(k + 1) % 2][1]}));
    sides.forEach((rows, right) => { Labels.spread(rows, height); this.place(rows, right, width); });
    this.draw(width, height);
  }
  /** Moves names apart, no more than needed. */
  static spread(rows, height) {
    rows.sort((a, b) => a.y - b.y);
    let below = top;
    for (const row of rows) { row.y = Math.max(row.y, below + rowHeight / 2); below = row.y + rowHeight / 2; }
    let above = height - margin;
    for (const row of [...rows].reverse()) { row.y = Math.min(row.y, above - rowHeight / 2); above = row.y - rowHeight / 2; }
  }
  place(rows, right, width) {
    for (const {part, end, y} of rows) this.drawn.push({...part, end, y, right, x: right ? width - margin : margin});
  }
  draw(width, height) {
    this.lines.setAttribute('viewBox', `0 0 ${width} ${height}`);
    const shown = new Set(), lines = [];
    for (const label of this.drawn) {
      const {name, title, end, x, y, right} = label;
      shown.add(name);
      if (!this.names.has(name)) { const span = h('span', {}, title); this.names.set(name, span); this.box.append(span); }
      const span = this.names.get(name);
      span.hidden = false;
      span.style.top = `${y}px`;
      span.style[right ? 'right' : 'left'] = `${margin}px`;
      span.style[right ? 'left' : 'right'] = 'auto';
      label.from = right ? x - span.offsetWidth - 4 : x + span.offsetWidth + 4;
      lines.push(h('path', {d: `M${label.from} ${y}L${end[0]} ${end[1]}`}), h('circle', {cx: end[0], cy: end[1], r: 2.5}));
    }
    for (const [name, span] of this.names) if (!shown.has(name)) span.hidden = true;
    this.lines.replaceChildren(...lines);
  }
  /** The same on a canvas, for a saved picture. */
  paint(context, scale, ink) {
    context.save();
    context.scale(scale, scale);
    context.strokeStyle = context.fillStyle = ink;
    context.font = '13px sans-serif';
    context.textBaseline = 'middle';
    for (const {title, end, x, y, right, from} of this.drawn) {
      context.globalAlpha = 0.5;
      context.beginPath();
      context.moveTo(from, y);
      context.lineTo(...end);
      context.stroke();
      context.globalAlpha = 1;
      context.textAlign = right ? 'right' : 'left';
      context.fillText(title, x, y);
    }
    context.restore();
  }
}
