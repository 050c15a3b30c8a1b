// Buttons, keys and lines over the view.
import type { LightsPanel } from './lights_panel';
import type { Show } from './show';
import type { Walk } from './walk';

export function element(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no ${id}`);
  return found;
}

export class Panel {
  private walk?: Walk;
  private lights?: LightsPanel;
  private show: () => Show | undefined = () => undefined;
  private timer = 0;

  begin(walk: Walk, lights: LightsPanel, show: () => Show | undefined): void {
    this.walk = walk, this.lights = lights;
    this.show = show;
    const places = element('places') as HTMLSelectElement;
    walk.cameras.forEach((camera, i) => places.append(new Option(camera.name || `place ${i + 1}`, String(i))));
    places.addEventListener('change', () => {
      if (places.value !== '') this.jump(Number(places.value));
      places.value = '';
      element('view').focus();
    });
    element('tour').hidden = !walk.path;
    element('tour').addEventListener('click', () => this.key('p'));
    element('movers').addEventListener('click', () => this.key('m'));
    element('link').addEventListener('click', () => void this.copyLink());
    element('screen').hidden = !document.fullscreenEnabled;
    element('screen').addEventListener('click', () => {
      const change = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
      change.catch(() => this.say('The browser does not give the whole screen.'));
    });
    element('help').addEventListener('click', () => this.key('?'));
    addEventListener('hashchange', () => {
      const camera = walk.fromHash();
      if (camera) this.walk!.jump(camera), this.show()?.changed();
      lights.fromHash();
    });
  }

  /** loaded, held by the device: bytes. */
  sizes(loaded: number, held: number): void {
    element('sheet-sizes').textContent = `Loaded: ${(loaded / 1e6).toFixed(1)} MB. Held on the graphics device: ${(held / 1e6).toFixed(1)} MB, and the frame.`;
    document.body.dataset['held'] = String(held);
  }

  private movers = '';
  moversAre(there: boolean, run: boolean): void {
    const now = `${there} ${run}`;
    if (now === this.movers) return;
    this.movers = now;
    element('movers').hidden = !there;
    element('movers').setAttribute('aria-pressed', String(run));
  }

  progress(share: number): void {
    (element('progress') as HTMLProgressElement).value = share;
    element('bar').hidden = share >= 1;
  }

  say(text: string, stays = false): void {
    element('line').textContent = text;
    clearTimeout(this.timer);
    if (!stays) this.timer = window.setTimeout(() => { element('line').textContent = ''; }, 4000);
  }

  lux(text: string | undefined): void {
    element('lux').hidden = text === undefined;
    element('lux').textContent = text ?? '';
  }

  stick(at: { startX: number; startY: number } | undefined): void {
    const ring = element('stick');
    ring.hidden = !at;
    if (at) ring.style.setProperty('left', `${at.startX}px`), ring.style.setProperty('top', `${at.startY}px`);
    element('tour').setAttribute('aria-pressed', String(!!this.walk?.touring));
  }

  private jump(index: number): void {
    const walk = this.walk!, camera = walk.cameras[index];
    if (!camera) return;
    walk.place = index;
    walk.jump(camera);
    this.show()?.changed();
    this.say(camera.name);
  }

  private async copyLink(): Promise<void> {
    const hash = this.walk!.toHash() + this.lights!.toHash(), url = location.href.split('#')[0] + hash;
    history.replaceState(null, '', hash);
    try {
      await navigator.clipboard.writeText(url);
      this.say('A link to this view is on the clipboard.');
    } catch {
      this.say('The address now leads to this view.');
    }
  }

  key(key: string): void {
    const walk = this.walk, show = this.show();
    if (!walk || !show) return;
    switch (key) {
      case 'c': this.jump((walk.place + 1) % walk.cameras.length); break;
      case 'Home': this.jump(0); break;
      case 'o': this.lights!.toggle(); break;
      case 'm': walk.clock.runs = !walk.clock.runs; break;
      case 'p': walk.toggleTour(); break;
      case 'g': show.go(0.5, 0.5); break;
      case 'l': show.toggleLux(); break;
      case '+': case '=': show.brighter(1); break;
      case '-': show.brighter(-1); break;
      case 'x': show.automatic(); break;
      case '?': (element('sheet') as HTMLDialogElement).showModal(); break;
      default: if (/^[1-9]$/.test(key)) this.jump(Number(key) - 1);
    }
  }
}
