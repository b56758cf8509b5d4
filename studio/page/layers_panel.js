// Switches of the layers, each with its sentence.

import { element } from './dom.js';
import { kLayers } from './layers.js';

export class LayersPanel {
  constructor(place, { recordedWork, changed }) {
    this.shown = new Set(kLayers.filter((layer) => layer.on).map((layer) => layer.key));
    this.boxes = new Map();
    this.told = element('p', { className: 'told', 'aria-hidden': 'true' }, 'Each layer shows one step from pixels to curves.');
    place.replaceChildren(element('div', { className: 'chips' }, ...kLayers.map((layer, i) => this.row(layer, i, recordedWork, changed))), this.told);
  }

  row(layer, i, recordedWork, changed) {
    const id = `layer-${layer.key}`;
    const box = element('input', { type: 'checkbox', id, checked: this.shown.has(layer.key), disabled: Boolean(layer.recorded) && !recordedWork, 'aria-describedby': `${id}-help` });
    box.onchange = () => {
      if (box.checked) this.shown.add(layer.key);
      else this.shown.delete(layer.key);
      this.told.textContent = layer.help;
      changed();
    };
    this.boxes.set(layer.key, box);
    const number = i < 9 ? element('kbd', { 'aria-hidden': 'true' }, String(i + 1)) : null;
    return element('div', { className: 'layer' }, box, element('label', { for: id }, layer.title), number,
      element('p', { id: `${id}-help`, className: 'help unseen' }, layer.recorded && !recordedWork ? 'Needs WebGL 2, which this browser does not have.' : layer.help));
  }

  toggle(index) {
    const layer = kLayers[index];
    const box = layer && this.boxes.get(layer.key);
    if (box && !box.disabled) box.click();
    return layer;
  }

  // The server's names of what is switched on.
  get recorded() {
    return kLayers.filter((layer) => layer.recorded && this.shown.has(layer.key)).map((layer) => layer.recorded);
  }
}
