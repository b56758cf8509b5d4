// Every way a drawing comes in: file dialog, drop, paste, sample, command line, and the one of before a reload.

import { byId, element } from './dom.js';

const kRemembered = 'inkgrid-document';

export class Opening {
  // studio: { openFile(file), openSample(name), openDocument(id, project?) }
  constructor(studio, about) {
    this.studio = studio;
    this.file = byId('file');
    this.file.onchange = () => this.file.files[0] && studio.openFile(this.file.files[0]);
    for (const id of ['open', 'welcome-open']) byId(id).onclick = () => this.pick();
    this.listSamples(about.samples);
    this.acceptDrops();
    document.addEventListener('paste', (event) => this.take(event.clipboardData));
  }

  pick() {
    this.file.value = '';
    this.file.click();
  }

  listSamples(names) {
    const titleOf = (name) => name.replace(/\.png$/, '').replaceAll('-', ' ');
    const select = byId('sample');
    select.append(...names.map((name) => element('option', { value: name }, titleOf(name))));
    select.onchange = () => {
      if (select.value) this.studio.openSample(select.value);
      select.value = '';
    };
    byId('samples').replaceChildren(...names.map((name) => element('li', {}, element('button', { type: 'button', onclick: () => this.studio.openSample(name) },
      element('img', { src: `/samples/${name}`, alt: '', loading: 'lazy', width: 150, height: 120 }), titleOf(name)))));
  }

  take(data) {
    const file = [...(data?.files ?? [])][0];
    if (file) this.studio.openFile(file);
  }

  acceptDrops() {
    const veil = byId('drop');
    const holdsFile = (event) => event.dataTransfer?.types?.includes('Files');
    document.addEventListener('dragover', (event) => {
      if (!holdsFile(event)) return;
      event.preventDefault();
      veil.hidden = false;
    });
    document.addEventListener('dragleave', (event) => {
      if (event.relatedTarget === null) veil.hidden = true;
    });
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      veil.hidden = true;
      this.take(event.dataTransfer);
    });
  }

  static remember(id, project) {
    try {
      sessionStorage.setItem(kRemembered, JSON.stringify({ id, project }));
    } catch {
      // more than the browser keeps: a reload begins anew
    }
  }

  static remembered() {
    try {
      return JSON.parse(sessionStorage.getItem(kRemembered));
    } catch {
      return null;
    }
  }
}
