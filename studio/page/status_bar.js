// Progress of a run that takes a while, and what there is to say.

const kQuick = 250; // ms; a run shorter than this shows no bar

export class StatusBar {
  constructor({ progress, stage, bar, said, zoom }) {
    Object.assign(this, { progress, stage, bar, said, zoom });
    this.since = 0;
  }

  started() {
    this.since = performance.now();
    this.stage.textContent = 'waiting';
    this.bar.value = 0;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => (this.progress.hidden = false), kQuick);
  }

  show(stage, fraction) {
    this.stage.textContent = stage;
    this.bar.value = fraction;
  }

  ended() {
    clearTimeout(this.timer);
    this.progress.hidden = true;
  }

  say(sentence, isError = false) {
    this.said.textContent = sentence;
    this.said.classList.toggle('error', isError);
  }

  showZoom(scale) {
    this.zoom.textContent = `${Math.round(100 * scale)} %`;
  }
}
