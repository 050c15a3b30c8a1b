// Walking on a pack's floors: the twin of player/navigation/floors.h, which tells what the numbers mean.
import type { WalkGrid } from './sections';
import type { Vec3 } from './vec';

const kSettle = 0.08, kGravity = 9.81;

export interface Stand { grid: number; cell: number; eye: Vec3; }

export class Floors {
  readonly eyeHeight: number;
  private readonly step: number;
  private readonly beside: number;
  constructor(readonly grids: WalkGrid[]) {
    this.eyeHeight = grids[0]?.eyeHeight ?? 1.6;
    this.step = (0.4 * this.eyeHeight) / 1.6;
    this.beside = this.eyeHeight / 1.6;
  }

  eyeOf(grid: number, cell: number): Vec3 {
    const g = this.grids[grid]!;
    return [g.lower[0]! + ((cell % g.width) + 0.5) * g.cell, g.floor[cell]! + g.eyeHeight, g.lower[1]! + (Math.floor(cell / g.width) + 0.5) * g.cell];
  }

  /** The highest floor at a place that is at most a step over the feet of an eye at that height. */
  stand(x: number, z: number, eyeY: number, step = this.step): Stand | undefined {
    let highest: Stand | undefined;
    this.grids.forEach((g, grid) => {
      const i = Math.floor((x - g.lower[0]!) / g.cell), j = Math.floor((z - g.lower[1]!) / g.cell), cell = j * g.width + i;
      if (!(i >= 0 && j >= 0 && i < g.width && j < g.height) || !g.walkable[cell]) return;
      const eye = this.eyeOf(grid, cell);
      if (eye[1] <= eyeY + step && (!highest || eye[1] > highest.eye[1])) highest = { grid, cell, eye };
    });
    return highest;
  }

  /** The nearest cell that suits an eye there: not under the floor, and at most two steps over who stands there. */
  nearest(eye: Vec3, reach: number, suits = (floor: number, over: number): boolean => eye[1] > floor && eye[1] <= over + 2 * this.step): Stand | undefined {
    let found: Stand | undefined, least = reach;
    this.grids.forEach((g, grid) => {
      for (let cell = 0; cell < g.floor.length; ++cell) {
        if (!g.walkable[cell] || !suits(g.floor[cell]!, g.floor[cell]! + g.eyeHeight)) continue;
        const at = this.eyeOf(grid, cell), distance = Math.hypot(at[0] - eye[0], at[2] - eye[2]);
        if (distance < least) least = distance, found = { grid, cell, eye: at };
      }
    });
    return found;
  }

  private distance(eye: Vec3): number {
    const found = this.nearest(eye, this.beside);
    return found ? Math.hypot(found.eye[0] - eye[0], found.eye[2] - eye[2]) : Infinity;
  }

  /** Where an eye is that walks from one place to another within dt seconds. fall: how fast it falls, kept by the caller. */
  walk(from: Vec3, to: Vec3, dt: number, state: { fall: number }): Vec3 {
    // A camera near the floor stands on the one below it: it rises as it walks.
    const standing = (this.stand(from[0], from[2], from[1]) ?? this.stand(from[0], from[2], from[1] + this.eyeHeight, 0))?.eye[1];
    if (standing === undefined) {
      const distance = this.distance(from);
      state.fall = 0;
      if (distance === Infinity || this.stand(to[0], to[2], from[1]) || this.distance(to) < distance) return to;
      for (const slid of [[to[0], from[1], from[2]], [from[0], from[1], to[2]]] as Vec3[])
        if ((slid[0] !== from[0] || slid[2] !== from[2]) && this.distance(slid) <= distance) return slid;
      return from;
    }
    let cell = Infinity, step = this.step;
    for (const g of this.grids) cell = Math.min(cell, g.cell), step = Math.max(step, g.cell);
    const way = [to[0] - from[0], to[2] - from[2]] as const, length = Math.hypot(...way) / (0.5 * cell);
    const strides = Math.min(Math.max(Math.ceil(length), 1), 64), each = Math.max(strides, length);
    let x = from[0], z = from[2], level = standing;
    const tryStep = (dx: number, dz: number): boolean => {
      const next = this.stand(x + dx, z + dz, level, step);
      if (!next || level - next.eye[1] > step) return false;
      x += dx, z += dz, level = next.eye[1];
      return true;
    };
    const dx = way[0] / each, dz = way[1] / each;
    for (let i = 0; i < strides; ++i) if (!tryStep(dx, dz) && !tryStep(dx, 0) && !tryStep(0, dz)) break;
    let y = from[1];
    if (y - level > 2 * this.step) {
      state.fall += kGravity * this.beside * dt;
      y = Math.max(y - state.fall * dt, level);
    } else {
      state.fall = 0;
      y += (level - y) * (1 - Math.exp(-dt / kSettle));
      if (Math.abs(level - y) < 1e-3 * this.step) y = level;
    }
    return [x, y, z];
  }

  /** A way over neighbouring cells to the cell nearest to a point of a floor: eyes, the last one first; empty: none. */
  way(eye: Vec3, floor: Vec3): Vec3[] {
    const start = this.stand(eye[0], eye[2], eye[1]) ?? this.nearest(eye, this.beside);
    if (!start) return [];
    const key = (s: { grid: number; cell: number }): number => s.grid * 2 ** 30 + s.cell;
    const came = new Map<number, Stand | undefined>([[key(start), undefined]]), queue = [start];
    let best = start, least = Infinity;
    for (let at = 0; at < queue.length; ++at) {
      const here = queue[at]!, g = this.grids[here.grid]!;
      const off = Math.hypot(here.eye[0] - floor[0], here.eye[1] - this.grids[here.grid]!.eyeHeight - floor[1], here.eye[2] - floor[2]);
      if (off < least) least = off, best = here;
      for (const [dx, dz] of [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]] as const) {
        const next = this.stand(here.eye[0] + dx * g.cell, here.eye[2] + dz * g.cell, here.eye[1], Math.max(this.step, g.cell));
        if (!next || here.eye[1] - next.eye[1] > Math.max(this.step, g.cell) || came.has(key(next))) continue;
        if (dx && dz && (!this.stand(here.eye[0] + dx * g.cell, here.eye[2], here.eye[1]) || !this.stand(here.eye[0], here.eye[2] + dz * g.cell, here.eye[1]))) continue;
        came.set(key(next), here);
        queue.push(next);
      }
    }
    const way: Vec3[] = [];
    for (let s: Stand | undefined = best; s && key(s) !== key(start); s = came.get(key(s))) way.push(s.eye);
    return way;
  }
}
