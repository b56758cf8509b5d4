// Undo and redo over values that never change.

export class History {
  constructor(value) {
    this.past = [];
    this.value = value;
    this.future = [];
    this.group = null;
  }

  // Steps of one group, as the positions of a slider that is being dragged, are undone together.
  push(value, group = null) {
    if (group === null || group !== this.group) this.past.push(this.value);
    this.group = group;
    this.value = value;
    this.future = [];
  }

  closeGroup() {
    this.group = null;
  }

  undo() {
    if (!this.canUndo) return false;
    this.future.push(this.value);
    this.value = this.past.pop();
    this.group = null;
    return true;
  }

  redo() {
    if (!this.canRedo) return false;
    this.past.push(this.value);
    this.value = this.future.pop();
    this.group = null;
    return true;
  }

  get canUndo() {
    return this.past.length > 0;
  }
  get canRedo() {
    return this.future.length > 0;
  }
}
