// Lamps that are switched, dimmed or coloured: the twin of player/session/light_settings.h and formats/query/group_light.h.
import { halfFromFloat, halfToFloat } from './bytes';
import type { Day, LightGroup, Page, PageGroups } from './sections';
import type { Vec3 } from './vec';

/** hour: of a group that is an hour of the day, the time shown, by which it counts. */
export interface Setting { on: boolean; value: number; color?: Vec3; kelvin?: number; hour?: number; }

export const leastKelvin = 1667, mostKelvin = 25000;
const kMostValue = 100, kLeastOwn = 0.01;

const luminance = (c: Vec3): number => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
const ofLuminanceOne = (c: Vec3): Vec3 => c.map((x) => x / Math.max(luminance(c), 1e-6)) as Vec3;

export function colorOfKelvin(kelvin: number): Vec3 {
  const t = 1000 / Math.min(Math.max(kelvin, leastKelvin), mostKelvin);
  const x = kelvin <= 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.17991
                           : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.24039;
  const y = kelvin <= 2222 ? ((-1.1063814 * x - 1.3481102) * x + 2.18555832) * x - 0.20219683
          : kelvin <= 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                           : ((3.081758 * x - 5.8733867) * x + 3.75112997) * x - 0.37001483;
  const X = x / y, Z = (1 - x - y) / y;
  return ofLuminanceOne([
    3.2404542 * X - 1.5371385 - 0.4985314 * Z, -0.969266 * X + 1.8760108 + 0.041556 * Z, 0.0556434 * X - 0.2040259 + 1.0572252 * Z,
  ].map((c) => Math.max(c, 0)) as Vec3);
}

function colorOfHex(text: string): Vec3 | undefined {
  if (!/^#[0-9a-f]{6}$/i.test(text)) return undefined;
  const color = [1, 3, 5].map((i) => {
    const s = parseInt(text.slice(i, i + 2), 16) / 255;
    return s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
  }) as Vec3;
  return Math.max(...color) > 0 ? ofLuminanceOne(color) : undefined;
}

function hexOf(color: Vec3): string {
  const most = Math.max(...color);
  return `#${color.map((c) => {
    const v = c / most <= 0.0031308 ? (12.92 * c) / most : 1.055 * (c / most) ** (1 / 2.4) - 0.055;
    return Math.round(255 * Math.min(Math.max(v, 0), 1)).toString(16).padStart(2, '0');
  }).join('')}`;
}

/** As when the pack is opened. */
export const settingsOf = (groups: LightGroup[], day?: Day): Setting[] => groups.map((g, i) => {
  const setting: Setting = { on: true, value: g.value };
  if (day?.hours.some((h) => h.group === i)) setting.value = 1, setting.hour = day.shown;
  if (g.color.some((c) => c !== 1)) setting.color = ofLuminanceOne(g.color.map((c, i) => c * g.ownColor[i]!) as Vec3);
  return setting;
});

function takeValue(value: string, setting: Setting): void {
  const color = colorOfHex(value), kelvin = /^([0-9.]+)k$/i.exec(value), number = Number(value);
  if (value === 'on' || value === 'off') setting.on = value === 'on';
  else if (color) setting.color = color, delete setting.kelvin;
  else if (kelvin && Number(kelvin[1]) >= leastKelvin && Number(kelvin[1]) <= mostKelvin) setLampKelvin(setting, Number(kelvin[1]));
  else if (value !== '' && number >= 0 && number <= kMostValue) setting.value = number, setting.on = true;
}

export function setLampKelvin(setting: Setting, kelvin: number): void {
  setting.kelvin = kelvin, setting.color = colorOfKelvin(kelvin);
}

/** NAME=0.3, NAME=off, NAME=2700K, NAME=#rrggbb, several with spaces; * is all, day sun and sky. What is none of these changes nothing. */
export function setLights(groups: LightGroup[], changes: string[], settings: Setting[], day?: Day): void {
  for (const change of changes) {
    const divides = change.lastIndexOf('='), name = change.slice(0, divides);
    if (day && name === 'hour' && groups.every((g) => g.name !== name)) setHour(day, Number(change.slice(divides + 1)), settings);
    groups.forEach((g, i) => {
      const meant = name === '*' || (settings[i]!.hour === undefined ? name === g.name : name === 'day');
      if (divides > 0 && meant) change.slice(divides + 1).split(/\s+/).forEach((v) => takeValue(v, settings[i]!));
    });
  }
}

/** Hours that the day has; others change nothing. */
export function setHour(day: Day, hour: number, settings: Setting[]): void {
  if (!(hour >= day.hours[0]!.hour && hour <= day.hours.at(-1)!.hour)) return;
  for (const s of settings) if (s.hour !== undefined) s.hour = hour;
}

/** By group, how many times what was baked it is shown at its hour: linear between the two around it. */
function weightsOf(settings: Setting[], day?: Day): number[] {
  const hour = settings.find((s) => s.hour !== undefined)?.hour;
  if (!day || hour === undefined) return settings.map(() => 1);
  const { hours } = day, lit = hours.filter((h) => h.group < settings.length).length;
  const after = Math.max(hours.findIndex((h) => h.hour >= hour), 0), before = Math.max(after - 1, 0);
  const from = hours[before]!.hour, to = hours[after]!.hour, share = to > from ? (hour - from) / (to - from) : 1;
  return settings.map((s, i) => s.hour === undefined ? 1
    : lit * ((hours[after]!.group === i ? share : 0) + (before < after && hours[before]!.group === i ? 1 - share : 0)));
}

/** What differs from how the pack is opened, as setLights() reads it. */
export function changesOf(groups: LightGroup[], settings: Setting[], day?: Day): string[] {
  const text = (s: Setting): string => [String(+s.value.toFixed(3)), s.kelvin ? `${Math.round(s.kelvin)}K` : s.color ? hexOf(s.color) : '', s.on ? '' : 'off'].filter(Boolean).join(' ');
  const before = settingsOf(groups, day), hour = settings.find((s) => s.hour !== undefined)?.hour;
  const changes = settings.flatMap((s, i) => (text(s) === text(before[i]!) ? [] : [`${groups[i]!.name}=${text(s)}`]));
  return hour === undefined || hour === day?.shown ? changes : [`hour=${hour}`, ...changes];
}

/** By group, how many times what was baked its lamps shine. */
export const factorsOf = (groups: LightGroup[], settings: Setting[], day?: Day, weights = weightsOf(settings, day)): Vec3[] => settings.map((s, i) =>
  [0, 1, 2].map((c) => (s.on ? weights[i]! * s.value * (s.color ? s.color[c]! / Math.max(groups[i]!.ownColor[c]!, kLeastOwn) : 1) : 0)) as Vec3);

// The light of all codes there are.
let lightOfCode: Float32Array | undefined;

function relight(of: PageGroups, details: boolean, factors: Vec3[], light: Uint16Array, scale: number, to: number): Uint16Array {
  const rest = details ? of.restOfDetail : of.rest, out = new Uint16Array(light.length), table = (lightOfCode ??= Float32Array.from({ length: 0x7c0 }, (_, i) => halfToFloat(i << 4)));
  for (let i = 0; i < rest.length; ++i) {
    const r = rest[i]!, own = factors[r]!;
    for (let c = 0; c < 3; ++c) {
      let sum = own[c]! * halfToFloat(light[3 * i + c]!) * scale;
      for (const other of of.others)
        if (other.group !== r) sum += (factors[other.group]![c]! - own[c]!) * of.scale * table[(details ? other.detail : other.light)[3 * i + c]!]!;
      out[3 * i + c] = halfFromFloat(Math.max(sum, 0) / to);
    }
  }
  return out;
}

/** A page as lamps shine now; itself where all shine as they were baked. */
export function relit(page: Page, groups: PageGroups | undefined, factors: Vec3[]): Page {
  if (!groups || groups.width !== page.width || groups.height !== page.height || factors.every((f) => f.every((x) => x === 1))) return page;
  const most = Math.max(1, ...factors.flat()), scale = page.scale * 2 ** Math.ceil(Math.log2(most));
  return {
    ...page, scale, light: relight(groups, false, factors, page.light, page.scale, scale),
    detail: page.detail && relight(groups, true, factors, page.detail, page.scale, scale),
  };
}

/** The day's sky, cd/m²: the twin of sky_of_day() in player/scene/lights.h. */
export function skyOfDay(day: Day, factors: Vec3[]): number[] {
  const lit = day.hours.filter((h) => h.group < factors.length);
  return [0, 1, 2].map((c) => lit.reduce((sum, h) => sum + (factors[h.group]![c]! / lit.length) * h.sky[c]!, 0));
}

/** What light of which groups have these shares becomes, over what it was: the twin of mean_factor() in player/scene/lights.h. */
export function meanFactor(groups: LightGroup[], factors: Vec3[], shares: 'reflectors' | 'surrounds' | 'probes', index: number): Vec3 {
  return [0, 1, 2].map((c) => Math.max(0, groups.reduce((sum, g, i) => sum + (factors[i]![c]! - 1) * (g[shares][3 * index + c] ?? 0), 1))) as Vec3;
}
