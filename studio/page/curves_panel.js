// The curves as a list, for those who can't point at them.

import { element } from './dom.js';

const kMostListed = 400;

export function measureText(curve, pixelsPerMm = 0) {
  const mm = pixelsPerMm > 0 ? ` (${(curve.length / pixelsPerMm).toFixed(1)} mm)` : '';
  const parts = curve.segments === 1 ? '1 segment' : `${curve.segments} segments`;
  return `${curve.length.toFixed(0)} px long${mm}, ${curve.width.toFixed(1)} px wide, ${parts}, ${Math.round(100 * curve.coverage)} % on ink${curve.closed ? ', closed' : ''}`;
}

export class CurvesPanel {
  constructor(place, count, { select, hover }) {
    this.place = place;
    this.count = count;
    this.tell = { select, hover };
    this.drawn = null;
  }

  show(drawn, selected) {
    this.count.textContent = drawn ? String(drawn.curves.length) : '';
    if (!drawn) return this.place.replaceChildren();
    if (this.drawn !== drawn) this.fill(drawn);
    this.drawn = drawn;
    for (const row of this.place.querySelectorAll('button')) row.setAttribute('aria-pressed', String(row.dataset.id === selected?.id));
  }

  fill(drawn) {
    const rows = drawn.curves.slice(0, kMostListed).map((curve, i) => {
      const row = element('button', { type: 'button', onclick: () => this.tell.select(curve), onpointerenter: () => this.tell.hover(curve), onpointerleave: () => this.tell.hover(null) },
        `${i + 1}. ${measureText(curve)}`);
      row.dataset.id = curve.id;
      row.style.setProperty('--colour', curve.colour);
      return row;
    });
    const rest = drawn.curves.length - rows.length;
    this.place.replaceChildren(...rows, ...(rest > 0 ? [element('p', { className: 'help' }, `and ${rest} more`)] : []));
  }
}
