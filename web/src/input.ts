// Keys, mouse, touch and gamepad as one wish. One thumb on the left half of a touch screen moves, the other looks.

export interface Wish { right: number; ahead: number; yaw: number; pitch: number; fast: boolean; }
export interface InputEvents { key: (key: string) => void; go: (x: number, y: number) => void; hover: (x: number, y: number) => void; }

const kTap = 12;         // pixels that a tap may move
const kTapTime = 800;    // ms that it may take: slow devices tell late of both its ends
const kStick = 60;       // pixels of a thumb's way that are full speed
const kDeadZone = 0.15;

interface Finger { x: number; y: number; startX: number; startY: number; begin: number; moves: boolean; far: boolean; }

export class Input {
  private readonly down = new Set<string>();
  private readonly fingers = new Map<number, Finger>();
  private yaw = 0;
  private pitch = 0;
  private pressed: boolean[] = [];

  constructor(private readonly canvas: HTMLCanvasElement, private readonly events: InputEvents) {
    addEventListener('keydown', (e) => this.key(e));
    addEventListener('keyup', (e) => this.down.delete(e.code));
    addEventListener('blur', () => this.reset());
    canvas.addEventListener('pointerdown', (e) => this.begin(e));
    canvas.addEventListener('pointermove', (e) => this.move(e));
    canvas.addEventListener('pointerup', (e) => this.end(e));
    canvas.addEventListener('pointercancel', (e) => this.fingers.delete(e.pointerId));
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
  }

  reset(): void {
    this.down.clear();
    this.fingers.clear();
  }

  private key(e: KeyboardEvent): void {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const own = e.target instanceof Element && e.target.closest('button, select, dialog, a');
    if (own && !/^Key[WASD]$/.test(e.code)) return;
    if (e.target instanceof HTMLSelectElement) return;
    if (/^Arrow|^Space$/.test(e.code)) e.preventDefault();
    if (!e.repeat) this.events.key(e.key.length === 1 ? e.key.toLowerCase() : e.key);
    this.down.add(e.code);
  }

  private begin(e: PointerEvent): void {
    if (e.button !== 0) return;
    this.canvas.focus({ preventScroll: true });
    try {
      this.canvas.setPointerCapture(e.pointerId);
    } catch { /* it has gone already */ }
    const moves = e.pointerType === 'touch' && e.clientX < 0.5 * innerWidth && ![...this.fingers.values()].some((f) => f.moves);
    this.fingers.set(e.pointerId, { x: e.clientX, y: e.clientY, startX: e.clientX, startY: e.clientY, begin: e.timeStamp, moves, far: false });
  }

  private move(e: PointerEvent): void {
    const finger = this.fingers.get(e.pointerId);
    if (!finger) {
      if (e.pointerType === 'mouse') this.events.hover(...this.place(e));
      return;
    }
    finger.far ||= Math.hypot(e.clientX - finger.startX, e.clientY - finger.startY) > kTap;
    if (!finger.moves) {
      const pace = e.pointerType === 'touch' ? 0.006 : 0.004;
      this.yaw += (e.clientX - finger.x) * pace, this.pitch += (e.clientY - finger.y) * pace;
    }
    finger.x = e.clientX, finger.y = e.clientY;
  }

  private end(e: PointerEvent): void {
    const finger = this.fingers.get(e.pointerId);
    this.fingers.delete(e.pointerId);
    if (!finger || finger.far || e.timeStamp - finger.begin > kTapTime) return;
    if (e.pointerType !== 'mouse' || e.detail >= 2 || this.doubled(e)) this.events.go(...this.place(e));
  }

  private lastClick = -1e9;
  private doubled(e: PointerEvent): boolean {
    const soon = e.timeStamp - this.lastClick < 400;
    this.lastClick = e.timeStamp;
    return soon;
  }

  private place(e: PointerEvent): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [(e.clientX - box.left) / box.width, (e.clientY - box.top) / box.height];
  }

  /** Where the thumb that moves lies, for a picture of it. */
  get stick(): { x: number; y: number; startX: number; startY: number } | undefined {
    return [...this.fingers.values()].find((f) => f.moves && f.far);
  }

  private gamepad(wish: Wish, dt: number): void {
    const pad = (navigator.getGamepads?.() ?? []).find((p) => p?.connected);
    if (!pad) return;
    const axis = (i: number): number => {
      const x = pad.axes[i] ?? 0;
      return Math.abs(x) < kDeadZone ? 0 : (x - Math.sign(x) * kDeadZone) / (1 - kDeadZone);
    };
    wish.right += axis(0), wish.ahead -= axis(1);
    wish.yaw += axis(2) * 2 * dt, wish.pitch += axis(3) * 2 * dt;
    const names = ['g', undefined, 'p', undefined, 'Shift', 'c', undefined, undefined, '?', 'Home', undefined, undefined, '+', '-'];
    wish.fast ||= !!pad.buttons[4]?.pressed;
    pad.buttons.forEach((b, i) => {
      const name = names[i];
      if (b.pressed && !this.pressed[i] && name && i !== 4) this.events.key(name);
      this.pressed[i] = b.pressed;
    });
  }

  take(dt: number): Wish {
    const on = (code: string): number => Number(this.down.has(code));
    const wish: Wish = {
      right: on('KeyD') - on('KeyA'), ahead: on('KeyW') - on('KeyS'), fast: !!(on('ShiftLeft') + on('ShiftRight')),
      yaw: -this.yaw + (on('ArrowRight') - on('ArrowLeft')) * 1.5 * dt, pitch: -this.pitch + (on('ArrowDown') - on('ArrowUp')) * 1.2 * dt,
    };
    this.yaw = this.pitch = 0;
    for (const f of this.fingers.values()) {
      if (!f.moves || !f.far) continue;
      wish.right += (f.x - f.startX) / kStick, wish.ahead -= (f.y - f.startY) / kStick;
    }
    this.gamepad(wish, dt);
    const clamp = (x: number): number => Math.min(Math.max(x, -1), 1);
    wish.right = clamp(wish.right), wish.ahead = clamp(wish.ahead);
    return wish;
  }
}
