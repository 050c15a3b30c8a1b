// Switches, dimmers and colour temperatures of light groups: the twin of player/window/lights_panel.h.
import { clockText } from './elements';
import { changesOf, colorOfKelvin, factorsOf, setHour, setLampKelvin, setLights, settingsOf } from './lights';
import type { Setting } from './lights';
import type { Day, LightGroup } from './sections';
import type { Vec3 } from './vec';

const kMostDimmed = 2, kWarmest = 1800, kColdest = 10000, kWarm = 2700;

const byId = (id: string): HTMLElement => document.getElementById(id)!;

function input(type: string, label: string, change: (input: HTMLInputElement) => void): HTMLInputElement {
  const made = document.createElement('input');
  made.type = type;
  made.setAttribute('aria-label', label);
  made.addEventListener('input', () => change(made));
  return made;
}

function range(made: HTMLInputElement, least: number, most: number, step: number): HTMLInputElement {
  made.min = String(least), made.max = String(most), made.step = String(step);
  return made;
}

/** A quarter of the shortest time between two hours: each hour that was baked can be chosen. */
function stepOf(day: Day): number {
  const times = day.hours.slice(1).map((hour, i) => hour.hour - day.hours[i]!.hour);
  return times.length > 0 ? Math.min(...times) / 4 : 0.25;
}

export class LightsPanel {
  private settings: Setting[];
  private readonly refreshes: (() => void)[] = [];
  private readonly dialog = byId('lights') as HTMLDialogElement;

  /** wanted: called when lamps are to shine otherwise. */
  constructor(private readonly groups: LightGroup[], private readonly day: Day | undefined, private readonly wanted: () => void) {
    this.settings = settingsOf(groups, day);
    if (groups.length === 0) return;
    byId('lamps').hidden = false;
    byId('lamps').addEventListener('click', () => this.toggle());
    byId('lights-close').addEventListener('click', () => this.toggle());
    byId('lights-baked').addEventListener('click', () => this.all(({ hour }) => ({ on: true, value: 1, hour })));
    byId('lights-off').addEventListener('click', () => this.all((s) => ({ ...s, on: false })));
    this.dialog.addEventListener('keydown', (e) => {
      if (e.key === 'Escape' || (e.key === 'o' && !(e.ctrlKey || e.altKey || e.metaKey))) this.toggle(), e.preventDefault();
    });
    if (day) byId('lights-groups').append(this.rowOfHour(day));
    groups.forEach((_, i) => { if (this.settings[i]!.hour === undefined) byId('lights-groups').append(this.rowsOf(i)); });
    this.fromHash();
  }

  get factors(): Vec3[] { return factorsOf(this.groups, this.settings, this.day); }
  /** Some lamp shines otherwise than it was baked. */
  get changed(): boolean { return this.factors.some((f) => f.some((x) => x !== 1)); }

  toggle(): void {
    if (this.groups.length === 0) return;
    if (this.dialog.open) {
      this.dialog.close();
      byId('view').focus();
    } else this.dialog.show();
    byId('lamps').setAttribute('aria-expanded', String(this.dialog.open));
  }

  /** &light=NAME=VALUE of the address, in the words of oriel-play --light; the others as the pack is opened. */
  fromHash(): void {
    const changes = new URLSearchParams(location.hash.slice(1)).getAll('light');
    if (changes.length === 0) return;
    this.settings = settingsOf(this.groups, this.day);
    setLights(this.groups, changes, this.settings, this.day);
    this.refresh();
  }

  toHash(): string {
    return changesOf(this.groups, this.settings, this.day).map((c) => `&light=${encodeURIComponent(c)}`).join('');
  }

  private all(to: (s: Setting) => Setting): void {
    this.settings = this.settings.map(to);
    this.refresh();
  }

  private refresh(): void {
    for (const refresh of this.refreshes) refresh();
    this.wanted();
  }

  private rowOfHour(day: Day): HTMLElement {
    const label = document.createElement('label'), time = document.createElement('output'), shown = (): number => this.settings.find((s) => s.hour !== undefined)!.hour!;
    const hour = range(input('range', `hour, ${day.clock}`, () => { setHour(day, Number(hour.value), this.settings), this.refresh(); }), day.hours[0]!.hour, day.hours.at(-1)!.hour, stepOf(day));
    label.append('hour', hour, time);
    this.refreshes.push(() => { hour.value = String(shown()), time.textContent = `${clockText(shown())} ${day.clock}`; });
    this.refreshes.at(-1)!();
    return label;
  }

  private rowsOf(index: number): HTMLElement {
    const { name, lamps } = this.groups[index]!, box = document.createElement('div'), now = (): Setting => this.settings[index]!;
    const changed = (change: () => void) => (): void => { change(), this.refresh(); };
    const line = (text: string, ...parts: HTMLElement[]): HTMLLabelElement => {
      const label = document.createElement('label');
      label.append(...parts.slice(0, 1), text, ...parts.slice(1));
      box.append(label);
      return label;
    };
    box.setAttribute('role', 'group');
    box.setAttribute('aria-label', name);
    box.title = lamps.join(', ');
    const on = input('checkbox', name, changed(() => { now().on = on.checked; }));
    const dim = range(input('range', `${name}: light, times what was baked`, changed(() => { now().value = Number(dim.value); })), 0, kMostDimmed, 0.05);
    const coloured = input('checkbox', `${name}: a colour of its own`, changed(() => {
      delete now().color, delete now().kelvin;
      if (coloured.checked) setLampKelvin(now(), kWarm);
    }));
    const kelvin = range(input('range', `${name}: colour temperature, kelvin`, changed(() => setLampKelvin(now(), Number(kelvin.value)))), kWarmest, kColdest, 100);
    const light = document.createElement('output'), degrees = document.createElement('output');
    line(name, on);
    const dimmer = line('', dim, light), colour = line('colour', coloured, kelvin, degrees);
    this.refreshes.push(() => {
      const s = now();
      on.checked = s.on, dim.value = String(s.value), coloured.checked = !!s.color, kelvin.value = String(s.kelvin ?? kWarm);
      dimmer.hidden = colour.hidden = !s.on, kelvin.hidden = degrees.hidden = s.kelvin === undefined;
      light.textContent = `× ${s.value.toFixed(2)}`, degrees.textContent = `${Math.round(s.kelvin ?? 0)} K`;
      kelvin.style.setProperty('accent-color', s.kelvin ? tint(s.kelvin) : '');
    });
    this.refreshes.at(-1)!();
    return box;
  }
}

function tint(kelvin: number): string {
  const color = colorOfKelvin(kelvin), most = Math.max(...color);
  return `rgb(${color.map((c) => Math.round(255 * (c / most) ** (1 / 2.2))).join(' ')})`;
}
