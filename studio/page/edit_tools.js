// Hand edits: each is named by places of the drawing, so that it means the same curve after the drawing is solved again.

const kReach = 12; // px of the screen

export class EditTools {
  // studio: { drawn, view, anchors(curve), commitEdit(edit, sentence), say(sentence) }
  constructor(studio) {
    this.studio = studio;
    this.first = null; // of a join
  }

  reset() {
    this.first = null;
  }

  get reach() {
    return kReach / this.studio.view.scale;
  }

  // What a click would take, for showing it: { from, to }.
  target(tool, point) {
    const { drawn } = this.studio;
    if (!drawn) return null;
    if (tool === 'split') {
      const found = drawn.at(point, this.reach);
      return found && { from: found.point };
    }
    if (tool !== 'join') return null;
    const end = drawn.endAt(point, this.reach);
    if (this.first) return { from: this.first.point, to: end?.point ?? point };
    return end && { from: end.point };
  }

  async click(tool, point) {
    const act = { delete: () => this.remove(this.studio.drawn.at(point, this.reach)?.curve), split: () => this.split(point), join: () => this.join(point) }[tool];
    if (this.studio.drawn) await act();
  }

  async remove(curve) {
    if (!curve) return this.studio.say('There is no curve here to delete.');
    const { at } = await this.studio.anchors(curve);
    this.studio.commitEdit({ kind: 'delete', at }, 'Curve deleted.');
  }

  split(point) {
    const found = this.studio.drawn.at(point, this.reach);
    if (!found) return this.studio.say('There is no curve here to split.');
    this.studio.commitEdit({ kind: 'split', at: found.point }, 'Curve split.');
  }

  async join(point) {
    const end = this.studio.drawn.endAt(point, this.reach);
    if (!end) {
      this.first = null;
      return this.studio.say('Click the end of a curve.');
    }
    if (!this.first) {
      this.first = end;
      return this.studio.say('Now click the end it goes on with.');
    }
    const from = this.first;
    this.first = null;
    await this.joinEnds(from, end);
  }

  // An end of the curve with the end that is nearest to it.
  async joinNearest(curve) {
    const pair = this.studio.drawn.nearestEnds(curve);
    this.reset();
    if (pair) await this.joinEnds(pair.from, pair.to);
    else this.studio.say('There is no other end to join with.');
  }

  // Each { curve, end: 'start' | 'end' }.
  async joinEnds(from, to) {
    if (from.curve.id === to.curve.id && from.end === to.end) return this.studio.say('These are one end: a join needs two.');
    const [a, b] = [await this.studio.anchors(from.curve), await this.studio.anchors(to.curve)];
    this.studio.commitEdit({ kind: 'join', at: a[from.end], to: b[to.end] }, 'Curves joined.');
  }
}
