// Direct light of lamps that is computed by pixel: its section, and its light at a point, the twin of formats/query/sharp_light.h.
import * as v from './vec';
import { vec3, list } from './elements';
import { PieceError } from './bytes';
import type { ByteReader } from './bytes';
import type { LampProfile, Page, SharpLamp, SharpLight } from './types';
import type { Vec3 } from './vec';

const split = 0xffffffff, mostSplits = 5, mostShines = 16, mostListed = 64, mostLamps = 1024, mostProfileSteps = 720;

function readLamp(r: ByteReader): SharpLamp {
  const kind = r.choice(2, 'kind of lamp');
  for (let i = 0; i < 3; ++i) r.choice(0, 'reserved byte');
  const lamp = {
    sun: kind === 1, position: vec3(r), direction: vec3(r), intensity: vec3(r), cosOuter: r.f32(), inverseFalloff: r.f32(), angularRadius: r.f32(), group: r.u32(),
    ...(kind === 2 ? { profile: r.u32(), right: vec3(r), over: vec3(r) } : { profile: -1, right: [1, 0, 0] as Vec3, over: [0, 1, 0] as Vec3 }),
  };
  if (lamp.intensity.some((c) => c < 0) || !(lamp.angularRadius >= 0 && lamp.angularRadius < Math.PI / 2)) r.fail('found a lamp of negative light or size');
  if (lamp.profile >= mostLamps) r.fail(`found profile ${lamp.profile}`);
  return lamp;
}

function readProfile(r: ByteReader): LampProfile {
  const first = r.f32(), last = r.f32(), rows = r.size(mostProfileSteps + 1, 'rows'), columns = r.size(mostProfileSteps, 'columns');
  if (!(first >= 0 && first < last && last <= 180 && rows > 1 && columns > 0)) r.fail('found a profile without angles');
  const candela = r.planesF32(rows * columns, 1);
  if (candela.some((c) => !(c >= 0))) r.fail('found a profile with intensities below 0');
  return { first, last, rows, columns, candela };
}

// By word: 0, or 1 and how many splits are below the record that begins there.
function recordsOf(r: ByteReader, words: Uint32Array, lamps: number, triangles: number): Uint8Array {
  const levels = new Uint8Array(words.length), fail = (): never => r.fail('found a record of sharp light that makes no sense');
  for (let place = 0; place < words.length;) {
    let level = 1, at = place + 1;
    if (words[place] === split) {
      for (const end = at + 4; at < end; ++at) {
        const below = words[at]! < place ? levels[words[at]!]! : 0;
        if (below === 0 || below > mostSplits) fail();
        level = Math.max(level, below + 1);
      }
    } else {
      if (words[place]! > (place === 0 ? 0 : mostShines)) fail();
      for (let k = words[place]!; k > 0; --k) {
        const code = words[at]!, from = at + 1 + ((code >>> 10) & 1);
        at = from + (code >>> 11);
        if ((code & 1023) >= lamps || code >>> 11 > mostListed || !(at <= words.length)) fail();
        for (let t = from; t < at; ++t) if ((words[t]! & 0x1fffffff) >= triangles) fail();
      }
    }
    levels[place] = level;
    place = at;
  }
  return levels;
}

export function readSharp(r: ByteReader): SharpLight {
  const lamps = r.size(mostLamps, 'lamps'), words = r.size(2 ** 25, 'words'), triangles = r.size(2 ** 24, 'triangles');
  if (lamps === 0 || words === 0) r.fail('found no lamps');
  const read = { lamps: list(r, lamps, readLamp), words: r.planesU32(words), triangles: r.planesF32(triangles, 9) };
  const profiles = list(r, Math.max(...read.lamps.map((l) => l.profile)) + 1, readProfile);
  return { ...read, profiles, records: recordsOf(r, read.words, lamps, triangles) };
}

/** Refuses a page whose places are not those of records. */
export function checkSharp(page: Page, light: SharpLight | undefined): void {
  if (page.sharpAt?.some((place) => !light?.records[place])) throw new PieceError('light: found a place of sharp light where there is none');
}

/** Of its lamp, as it shines now. */
export const powerOf = (lamp: SharpLamp, factors: Vec3[]): Vec3 => lamp.intensity.map((c, i) => c * (factors[lamp.group]?.[i] ?? 1)) as Vec3;

/** Places of a disk of radius 1, each of an equal share of it (Vogel 1979). */
export const sunPlaces = Array.from({ length: 64 }, (_, i): [number, number] => {
  const r = Math.sqrt((i + 0.5) / 64), turn = i * Math.PI * (3 - Math.sqrt(5));
  return [r * Math.cos(turn), r * Math.sin(turn)];
});
const endStep = 1e-7;

// How much of each direction is covered, with a triangle more. ways: into a sun's disk, or one to a point.
function coverBy(covered: number[], ways: Vec3[], corners: Vec3[], word: number): void {
  const [a, b, c] = corners as [Vec3, Vec3, Vec3], turn = Math.sign(v.dot(v.cross(v.sub(b, a), v.sub(c, a)), a));
  const edges = [[a, b], [b, c], [c, a]].map(([from, to], k) => {
    const across = v.cross(from!, to!), size = Math.max(v.length(across), 1e-20);
    return { inwards: v.scale(across, turn / size), hard: (1e-6 * (v.dot(from!, from!) + v.dot(to!, to!))) / size, ends: ((word >>> (29 + k)) & 1) > 0 };
  });
  ways.forEach((way, i) => {
    const inside = edges.map((e) => {
      const sine = v.dot(e.inwards, way);
      return e.ends ? Math.min(Math.max(sine / endStep + 0.5, 0), 1) : Number(sine >= -e.hard);
    });
    covered[i] = Math.max(covered[i]!, Math.min(...inside));
  });
}

function visibleShare(light: SharpLight, lamp: { towards: Vec3; distance: number; spread: number }, words: Uint32Array, p: Vec3): number {
  const { towards, distance, spread } = lamp, t = towards;
  const right = v.normalize(Math.abs(t[0]) < 0.7 ? [0, t[2], -t[1]] : [-t[2], 0, t[0]], [1, 0, 0]), up = v.cross(t, right);
  const ways = spread > 0 ? sunPlaces.map(([x, y]) => v.add(t, v.add(v.scale(right, spread * x), v.scale(up, spread * y)))) : [t];
  const covered = ways.map(() => 0);
  for (const word of words) {
    const at = 9 * (word & 0x1fffffff), corners = [0, 3, 6].map((k) => v.sub(Array.from(light.triangles.subarray(at + k, at + k + 3)) as Vec3, p));
    const normal = v.cross(v.sub(corners[1]!, corners[0]!), v.sub(corners[2]!, corners[0]!)), height = v.dot(normal, corners[0]!), ofLamp = v.dot(normal, t) * distance;
    if (height * (ofLamp - height) > 0) coverBy(covered, ways, corners, word);
  }
  return 1 - covered.reduce((sum, c) => sum + c / ways.length, 0);
}

// Where the record of a place of a page begins.
function recordAt(light: SharpLight, page: Page, s: number, t: number): number {
  const x = Math.min(Math.max(s, 0), 1) * page.width, y = Math.min(Math.max(t, 0), 1) * page.height;
  const column = Math.min(Math.floor(x), page.width - 1), row = Math.min(Math.floor(y), page.height - 1);
  let place = page.sharpAt![row * page.width + column]!, inX = x - column, inY = y - row;
  while (light.words[place] === split) {
    const right = Number(inX >= 0.5), below = Number(inY >= 0.5);
    inX = 2 * inX - right, inY = 2 * inY - below;
    place = light.words[place + 1 + right + 2 * below]!;
  }
  return place;
}

// Along a unit direction that leaves the lamp.
function candelaOf(profile: LampProfile, lamp: SharpLamp, direction: Vec3): number {
  const { first, last, rows, columns, candela } = profile, x = v.dot(lamp.right, direction), y = v.dot(lamp.over, direction);
  const vertical = (Math.atan2(Math.hypot(x, y), v.dot(lamp.direction, direction)) * 180) / Math.PI;
  if (vertical < first - 1e-4 || vertical > last + 1e-4) return 0;
  const down = Math.min(Math.max((vertical - first) / (last - first), 0), 1) * (rows - 1), turns = Math.atan2(y, x) / (2 * Math.PI), around = (turns - Math.floor(turns)) * columns;
  const row = Math.min(Math.floor(down), rows - 2), column = Math.min(Math.floor(around), columns - 1);
  const at = (c: number): number => candela[row * columns + (c % columns)]! * (1 + row - down) + candela[(row + 1) * columns + (c % columns)]! * (down - row);
  return at(column) * (1 + column - around) + at(column + 1) * (around - column);
}

/** Luminance of it at a place of a page, lux. normal: unit. */
export function sharpLux(light: SharpLight, page: Page, uv: [number, number], p: Vec3, normal: Vec3, factors: Vec3[]): number {
  let at = recordAt(light, page, ...uv), sum = 0;
  const { words } = light;
  for (let lamps = words[at++]!; lamps > 0; --lamps) {
    const code = words[at++]!, l = light.lamps[code & 1023]!, count = code >>> 11;
    const tint = code & 1024 ? words[at++]! : 0, to = l.sun ? v.scale(l.direction, -1) : v.sub(l.position, p), distance = Math.max(v.length(to), 1e-6);
    const towards = v.scale(to, 1 / distance), cosine = v.dot(normal, towards), cone = Math.min(Math.max((-v.dot(l.direction, towards) - l.cosOuter) * l.inverseFalloff, 0), 1);
    const scale = Math.max(cosine, 0) * (l.sun ? 1 : (l.profile < 0 ? cone ** 2 : candelaOf(light.profiles[l.profile]!, l, v.scale(towards, -1))) / distance ** 2);
    const lux = powerOf(l, factors).reduce((y, c, k) => y + [0.2126, 0.7152, 0.0722][k]! * c * (code & 1024 ? ((tint >>> (9 * k)) & 511) * 2 ** ((tint >>> 27) - 24) : 1), 0);
    const lamp = { towards, distance: l.sun ? 1e20 : distance, spread: l.sun ? Math.tan(l.angularRadius) : 0 };
    if (scale * lux > 0) sum += scale * lux * visibleShare(light, lamp, words.subarray(at, at + count), p);
    at += count;
  }
  return sum;
}
