(() => {
  const tip = document.createElement('div');
  tip.className = 'tip';
  tip.hidden = true;
  document.body.append(tip);
  const part = (t, n) => Math.min(n - 1, Math.max(0, Math.floor(t * n)));
  const signed = v => (v > 0 ? '+' : '') + v;
  const text = (c, x, y) => {
    if (c.kind === 'points') {
      let best = 14, said = '';
      for (const [px, py, words] of c.rows) {
        const d = Math.hypot(px - x, py - y);
        if (d < best) { best = d; said = words; }
      }
      return said;
    }
    const u = (x - c.x) / c.w, v = 1 - (y - c.y) / c.h;
    if (u < 0 || u > 1 || v < 0 || v > 1) return '';
    const grid = c.kind === 'grid';
    const k = part(grid ? v : u, c.rows.length), row = c.rows[k], i = part(grid ? u : v, row.length);
    if (row[i] === null) return '';
    const along = Math.round(100 * (i + 0.5) / row.length);
    if (grid) return `${Math.round(100 * (k + 0.5) / c.rows.length)} % root to tip, ${along} % bottom to top: ${signed(row[i])} ${c.unit}`;
    return `${c.row} ${c.numbers[k] ?? k + 1}${c.along ? `, ${along} % ${c.along}` : ''}: ${signed(row[i])} ${c.unit}`;
  };
  for (const svg of document.querySelectorAll('svg[data-chart]')) {
    let chart;
    svg.addEventListener('pointermove', e => {
      chart ??= JSON.parse(svg.dataset.chart);
      const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
      const said = text(chart, p.x, p.y);
      tip.hidden = !said;
      tip.textContent = said;
      tip.style.left = Math.min(e.clientX + 14, innerWidth - tip.offsetWidth - 8) + 'px';
      tip.style.top = e.clientY + 14 + 'px';
    });
    svg.addEventListener('pointerleave', () => { tip.hidden = true; });
  }
})();
