// Asks for curves, one state at a time: while one is on its way only the newest of the others is remembered.

const kPatience = 400; // ms; a run that takes longer is stopped for a newer state

export class Solver {
  // tell: { started(), progress(stage, fraction), solved(result, milliseconds), failed(problem), idle() }
  constructor(api, tell) {
    this.api = api;
    this.tell = tell;
    this.id = null;
    this.running = null;
    this.waiting = null;
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
  }

  request(state) {
    if (!this.running) return this.run(state);
    this.waiting = state;
    if (performance.now() - this.running.since > kPatience) this.stopRunning();
    return this.running.done;
  }

  cancel() {
    this.waiting = null;
    this.stopRunning();
  }

  stopRunning() {
    const { id, revision } = this.running ?? {};
    if (id) this.api.cancel(id, revision).catch(() => {});
  }

  run(state) {
    const run = { id: this.id, since: performance.now(), revision: `${this.session}-${++this.count}` };
    this.running = run;
    this.tell.started();
    run.done = this.follow(run, state);
    return run.done;
  }

  async follow(run, state) {
    const current = () => this.running === run;
    try {
      const result = await this.api.solve(run.id, run.revision, state, (stage, fraction) => {
        if (current()) this.tell.progress(stage, fraction, performance.now() - run.since);
      });
      if (current()) this.tell.solved(result, performance.now() - run.since);
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

  // When nothing is on its way any more.
  async settled() {
    while (this.running) await this.running.done;
  }
}
