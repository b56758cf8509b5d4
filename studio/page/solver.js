// Asks for curves, one state at a time: while one is on its way only the newest of the others is remembered.

import { sameProject } from './project.js';

const kPatience = 400; // ms; a run for a slider that is dragged may take as long and still be shown

export class Solver {
  // tell: { started(), progress(stage, fraction), solved(result, milliseconds), failed(problem), idle() }
  constructor(api, tell) {
    this.api = api;
    this.tell = tell;
    this.id = null;
    this.running = null;
    this.waiting = null;
    this.answered = null; // the state that the curves are those of
    this.count = 0;
    this.session = Math.random().toString(36).slice(2, 10);
  }

  get busy() {
    return this.running !== null;
  }

  // Another document: what is on its way is of no use any more.
  use(id) {
    this.id = id;
    this.waiting = null;
    this.running = null;
    this.answered = null;
  }

  // What is on its way is stopped for a newer state, unless it is to be seen on the way of a slider.
  request(state, { dragging = false } = {}) {
    if (!this.running) return this.answered && sameProject(state, this.answered) ? undefined : this.run(state);
    if (!this.running.stopped && sameProject(state, this.running.state)) this.waiting = null;
    else this.wait(state, dragging);
    return this.running.done;
  }

  wait(state, dragging) {
    this.waiting = state;
    if (!dragging || performance.now() - this.running.since > kPatience) this.stopRunning();
  }

  cancel() {
    this.waiting = null;
    this.stopRunning();
  }

  stopRunning() {
    const { running } = this;
    if (!running || running.stopped) return;
    running.stopped = true;
    this.api.cancel(running.id, running.revision).catch(() => {});
  }

  run(state) {
    const run = { id: this.id, state, stopped: false, since: performance.now(), revision: `${this.session}-${++this.count}` };
    this.running = run;
    this.tell.started();
    run.done = this.follow(run);
    return run.done;
  }

  async follow(run) {
    const current = () => this.running === run;
    try {
      const result = await this.api.solve(run.id, run.revision, run.state, (stage, fraction) => {
        if (current()) this.tell.progress(stage, fraction, performance.now() - run.since);
      });
      if (current()) this.answer(run, result);
    } catch (problem) {
      if (current() && !(problem.kind === 'cancelled' && this.waiting)) this.tell.failed(problem);
    }
    if (!current()) return;
    this.running = null;
    const next = this.waiting;
    this.waiting = null;
    if (next) await this.run(next);
    else this.tell.idle();
  }

  answer(run, result) {
    this.answered = run.state;
    this.tell.solved(result, performance.now() - run.since);
  }

  // When nothing is on its way any more.
  async settled() {
    while (this.running) await this.running.done;
  }
}
