// Mouse, pen and touch on the stage, told as what they mean: move the view, zoom, paint, click, hover.

const kClick = 5; // px that a click may slip

export class Pointer {
  // tell: { isBrush(), pan(dx, dy), zoom(factor, x, y), begin(point), paint(point), end(), abandon(), click(point), hover(point | null) }
  constructor(stage, tell) {
    this.stage = stage;
    this.tell = tell;
    this.down = new Map(); // id -> { x, y, startX, startY }
    this.mode = null; // 'paint', 'pan', 'pinch'
    stage.addEventListener('pointerdown', (event) => this.pressed(event));
    stage.addEventListener('pointermove', (event) => this.moved(event));
    stage.addEventListener('pointerup', (event) => this.lifted(event));
    stage.addEventListener('pointercancel', (event) => this.lost(event));
    stage.addEventListener('pointerleave', () => this.down.size === 0 && tell.hover(null));
    stage.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    stage.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  place(event) {
    const box = this.stage.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  pressed(event) {
    const at = this.place(event);
    this.stage.setPointerCapture(event.pointerId);
    this.stage.focus({ preventScroll: true });
    this.down.set(event.pointerId, { ...at, startX: at.x, startY: at.y });
    if (this.down.size === 2) return this.beginPinch();
    if (this.down.size > 2) return;
    const paints = this.tell.isBrush() && event.button === 0 && !event.ctrlKey;
    this.mode = paints ? 'paint' : 'pan';
    if (paints) this.tell.begin(at);
  }

  beginPinch() {
    if (this.mode === 'paint') this.tell.abandon();
    this.mode = 'pinch';
  }

  moved(event) {
    const at = this.place(event), before = this.down.get(event.pointerId);
    this.tell.hover(at);
    if (!before) return;
    if (this.mode === 'paint') {
      const steps = event.getCoalescedEvents?.() ?? [];
      for (const step of steps.length > 0 ? steps : [event]) this.tell.paint(this.place(step));
    } else if (this.mode === 'pan') {
      this.tell.pan(at.x - before.x, at.y - before.y);
    } else if (this.mode === 'pinch') {
      this.pinch(event.pointerId, before, at);
    }
    Object.assign(before, at);
  }

  pinch(id, before, at) {
    const other = [...this.down.entries()].find(([key]) => key !== id)?.[1];
    if (!other) return;
    const distance = (p) => Math.hypot(p.x - other.x, p.y - other.y);
    this.tell.zoom(Math.max(1, distance(at)) / Math.max(1, distance(before)), (at.x + other.x) / 2, (at.y + other.y) / 2);
    this.tell.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
  }

  lifted(event) {
    const start = this.down.get(event.pointerId), at = this.place(event);
    this.down.delete(event.pointerId);
    if (!start) return;
    const slipped = Math.hypot(at.x - start.startX, at.y - start.startY) > kClick;
    if (this.mode === 'paint') this.tell.end();
    else if (this.mode === 'pan' && !slipped && event.button === 0) this.tell.click(at);
    this.mode = this.down.size === 1 ? 'pan' : this.down.size > 1 ? 'pinch' : null;
    if (event.pointerType === 'touch') this.tell.hover(null);
  }

  lost(event) {
    this.down.delete(event.pointerId);
    if (this.mode === 'paint') this.tell.abandon();
    this.mode = null;
  }

  // A wheel zooms; two fingers on a touchpad pan, and zoom with a pinch, which browsers tell as a wheel with Ctrl.
  wheel(event) {
    event.preventDefault();
    const at = this.place(event);
    const line = event.deltaMode === 1 ? 16 : 1;
    const isWheel = event.deltaMode === 1 || (event.deltaX === 0 && Math.abs(event.deltaY) >= 50);
    if (event.ctrlKey || isWheel) this.tell.zoom(Math.exp(-event.deltaY * line * (event.ctrlKey && !isWheel ? 0.01 : 0.0022)), at.x, at.y);
    else if (event.shiftKey) this.tell.pan(-event.deltaY, 0);
    else this.tell.pan(-event.deltaX, -event.deltaY);
  }
}
