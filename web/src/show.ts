// Which frame is drawn, how large, and how bright: moving ones keep up, and once nothing moves the whole frame is drawn.
import { Renderer, firstFrame, movingFrame, wholeFrame } from './frame';
import { pick, rayThrough } from './pick';
import type { GpuScene } from './scene';
import type { Input } from './input';
import type { LightsPanel } from './lights_panel';
import type { Panel } from './panel';
import type { Walk } from './walk';

const kSamples = 4, kRest = 120, kSlow = 50, kQuick = 25, kLeastScale = 0.25, kFirstScale = 0.5;
const kSettled = 0.002, kMostSettling = 5000;  // stops; ms of a frame that is worth drawing again for them
const kLong = 200, kShare = 4;  // ms of a whole frame while pieces come: longer ones leave the device to the pieces for that many times as long

export class Show {
  private count = 0;        // samples that are shown
  private movedAt = -1e9;
  private scale = 1;
  private hurries = false;  // whole frames take too long while something moves
  private began = false;
  private presented = false;
  private meteredAt = -1e9;
  private byHand?: number;  // stops over what the meter finds
  private luxShown = false;
  private pointer: [number, number] = [0.5, 0.5];
  frames = 0;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly renderer: Renderer, readonly scene: GpuScene,
              private readonly walk: Walk, private readonly panel: Panel, private readonly lights: LightsPanel) {
    if (lights.changed) this.dim();
  }

  /** Something else is to be seen. */
  changed(): void {
    this.count = 0;
    this.settled = false;
  }

  private settled = false;  // the exposure is that of all samples
  loading = true;         // pieces still come
  private came = false;   // some of them since the last frame
  private drawnAt = -1e9;
  private took = 0;       // ms that the last whole frame took
  pieceCame(): void { this.came = true; }
  allCame(): void {
    this.loading = false;
    delete document.body.dataset['rest'];
    this.changed();
  }

  /** Whether a frame at rest can wait, while pieces come to a device that draws slowly. */
  private waits(now: number): boolean {
    const busy = this.loading && this.took > kLong && this.count > 0;
    if (this.came && (!busy || now - this.drawnAt > kShare * this.took)) {
      this.came = false;
      this.changed();
      return false;
    }
    return busy || this.count >= kSamples;
  }

  private dimmed = false;
  /** Lamps are to shine as the panel says, from the next frame on. */
  dim(): void { this.dimmed = true; }

  brighter(stops: number): void {
    this.byHand = (this.byHand ?? 0) - stops / 3;
    this.meteredAt = -1e9;
    this.changed();
  }
  automatic(): void {
    this.byHand = undefined;
    this.meteredAt = -1e9;
    this.changed();
  }

  frame(input: Input, dt: number, now: number): void {
    const walked = this.walk.step(input.take(dt), dt), runs = this.walk.clock.runs && this.scene.movers.animated, moved = walked || runs;
    if (runs) this.walk.clock.seconds += dt;
    this.scene.movers.place(this.walk.clock.seconds);
    this.panel.moversAre(this.scene.movers.animated, runs);
    this.panel.stick(input.stick);
    if (this.dimmed) {
      this.dimmed = false;
      this.scene.setLights(this.lights.factors);
      this.changed();
    }
    const width = Math.max(1, Math.round(this.canvas.clientWidth * Math.min(devicePixelRatio, 2)));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * Math.min(devicePixelRatio, 2)));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width, this.canvas.height = height;
      this.changed();
    }
    if (moved) {
      if (now - this.movedAt < 500) this.adapt(dt * 1000);
      this.movedAt = now;
      this.changed();
      delete document.body.dataset['rest'];
    }
    if (!moved && now - this.movedAt > 500) this.hurries = false;
    const moving = this.began && now - this.movedAt < kRest;
    if (this.frames === 1 && !this.presented) {  // the next frame may take long: the first one is to be seen meanwhile
      this.presented = true;
      return;
    }
    if (moving ? !moved : this.waits(now)) return;
    if (this.began) this.draw(moving, width, height, now);
    else this.drawFirst(width, height, now);
    ++this.frames;
  }

  private adapt(ms: number): void {
    if (ms > kSlow && !this.hurries) this.hurries = true;
    else if (ms > kSlow) this.scale = Math.max(this.scale * Math.max(Math.sqrt(kSlow / ms), 0.5), kLeastScale);
    else if (ms < kQuick) this.scale = Math.min(this.scale * 1.05, 1);
  }

  /** What is there soonest: the baked light alone, coarsely. What reflects follows. */
  private drawFirst(width: number, height: number, now: number): void {
    const half = (n: number): number => Math.max(1, Math.round(n * kFirstScale));
    this.renderer.draw(this.scene, this.walk.camera, half(width), half(height), undefined, firstFrame);
    this.meter(false, now);
    this.renderer.show(this.scene, 0, width, height);
    this.renderer.startRest();
    this.began = true;
    this.changed();
  }

  private draw(moving: boolean, width: number, height: number, now: number): void {
    const scale = moving ? this.scale : 1, w = Math.max(1, Math.round(width * scale)), h = Math.max(1, Math.round(height * scale));
    const begin = performance.now(), meters = moving ? now - this.meteredAt > 200 : this.count === 0 && !this.settled;
    this.renderer.draw(this.scene, this.walk.camera, w, h, moving ? undefined : this.count, moving && this.hurries ? movingFrame : wholeFrame);
    if (meters) this.meter(moving, now);
    if (meters && !moving) this.took = performance.now() - begin;  // the meter waits for the device
    this.drawnAt = performance.now();
    if (!moving && !this.settled) this.renderer.addToMean(1 / kSamples, this.count === 0);
    const last = this.count === kSamples - 1;
    this.renderer.show(this.scene, moving ? 0 : this.count, width, height, moving || !this.settled || last);
    this.count = moving ? 0 : this.count + 1;
    if (this.count < kSamples) return;
    if (!this.settled && this.settle(now)) return;
    document.body.dataset['rest'] = String(this.frames);
    this.panel.lux(this.luxShown ? this.luxThere() : undefined);
  }

  /** The player meters the mean of a pixel's samples, which edges and noise make brighter than one of them: whether all are drawn once more. */
  private settle(now: number): boolean {
    const before = this.renderer.white;
    this.settled = true;
    this.meter(false, now, true);
    if (this.took > kMostSettling || Math.abs(Math.log2(this.renderer.white / before)) < kSettled) return false;
    this.count = 0;
    return true;
  }

  private meter(moving: boolean, now: number, mean = false): void {
    const log = this.renderer.meter(this.scene, mean);
    this.meteredAt = now;
    if (log === undefined) return;
    const ev = Math.min(Math.max(log - Math.log2(1.2 * 0.18), -4), 17) + (this.byHand ?? 0);
    const before = Math.log2(this.renderer.white / 1.2), share = moving ? 0.45 : 1;
    this.renderer.white = 1.2 * 2 ** (before + (ev - before) * share);
  }

  private get aspect(): number { return this.canvas.width / this.canvas.height; }

  private hitAt(x: number, y: number): ReturnType<typeof pick> {
    const ray = rayThrough(this.walk.camera, x, y, this.aspect);
    return pick(this.scene, ray.from, ray.way);
  }

  /** Walks to what is there, or to the floor before it. */
  go(x: number, y: number): void {
    const hit = this.hitAt(x, y);
    if (!hit) return;
    const back = hit.normal[1] > 0.7 ? 0 : 0.5;
    const at: [number, number, number] = [hit.at[0] + hit.normal[0] * back, hit.at[1], hit.at[2] + hit.normal[2] * back];
    if (back > 0) at[1] = this.walk.floors.nearest(this.walk.camera.eye, 1e9)?.eye[1] ?? at[1];
    if (!this.walk.goTo(at, matchMedia('(prefers-reduced-motion: reduce)').matches)) this.panel.say('Nobody can walk there.');
    this.changed();
  }

  hover(x: number, y: number): void {
    this.pointer = [x, y];
    if (this.luxShown) this.panel.lux(this.luxThere());
  }
  private luxThere(): string {
    const hit = this.hitAt(...this.pointer);
    return hit ? `${hit.lux < 10 ? hit.lux.toFixed(1) : Math.round(hit.lux)} lux` : 'no surface';
  }
  toggleLux(): void {
    this.luxShown = !this.luxShown;
    this.panel.lux(this.luxShown ? this.luxThere() : undefined);
  }
}
