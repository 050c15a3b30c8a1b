// The page: loads the pieces, draws what changed, walks.
import { PieceError } from './bytes';
import { Input } from './input';
import { Renderer } from './frame';
import { Walk } from './walk';
import { checkScene, readPiece } from './sections';
import { GpuScene, makeDevice } from './scene';
import { Show } from './show';
import { loadManifest, loadPiece } from './pieces';
import { Panel, element } from './panel';
import type { Manifest, Piece } from './pieces';
import type { Sections } from './sections';

const state = (name: string): void => { document.body.dataset['state'] = name; };

function sayNo(text: string): void {
  element('fallback').hidden = false;
  element('fallback-text').textContent = text;
  element('tools').hidden = element('bar').hidden = true;
  element('view').hidden = true;
  state('refused');
}

let begun = false;  // a scene is there to be shown

const canvas = element('view') as HTMLCanvasElement;
const panel = new Panel();

function contextOf(): WebGL2RenderingContext | null {
  return canvas.getContext('webgl2', { antialias: false, alpha: false, depth: false, powerPreference: 'high-performance' });
}

/** Keeps all that came, so that a lost context is drawn again without loading. */
class Walkthrough {
  readonly pieces = new Map<string, Sections>();
  show?: Show;
  constructor(readonly gl: WebGL2RenderingContext, readonly scene: Sections, readonly walk: Walk) {}

  begin(): void {
    const device = makeDevice(this.gl), pages = this.scene.pages.slice();
    const gpu = new GpuScene(device, { ...this.scene, pages });
    this.show = new Show(canvas, new Renderer(device), gpu, this.walk, panel);
    for (const [name, sections] of this.pieces) this.take(name, sections);
  }

  take(name: string, sections: Sections): void {
    this.pieces.set(name, sections);
    const show = this.show, [kind, index] = name.split(' ') as [string, string], at = Number(index);
    if (!show) return;
    if (kind === 'light' && sections.pages[0]) show.scene.setPage(at, sections.pages[0]);
    if (kind === 'texture' && sections.textures[0]) show.scene.setTexture(at, sections.textures[0], false);
    if (kind === 'normal' && sections.normals[0]) show.scene.setTexture(at, sections.normals[0], true);
    show.changed();
  }
}

async function keepOffline(manifest: Manifest): Promise<void> {
  if (!('serviceWorker' in navigator) || !isSecureContext) return;
  const number = /pieces-([0-9a-f]+)\.json/.exec(document.body.dataset['pieces']!)?.[1];
  try {
    const cache = await caches.open(`oriel ${number}`);
    const own = [...document.querySelectorAll<HTMLElement>('script[src], link[href]')].map((e) => e.getAttribute('src') ?? e.getAttribute('href')!);
    await cache.addAll(['./', document.body.dataset['pieces']!, ...own, ...manifest.pieces.map((p) => p.file)]);
    await navigator.serviceWorker.register('offline.js');
    document.body.dataset['offline'] = 'kept';
  } catch { /* it is shown all the same */ }
}

const nameOf = (piece: Piece): string => `${piece.kind} ${piece.index}`;

async function run(): Promise<void> {
  const manifest = await loadManifest(document.body.dataset['pieces']!, document.body.dataset['integrity']!);
  const all = manifest.pieces.reduce((sum, p) => sum + p.bytes, 0), first = manifest.pieces.find((p) => p.kind === 'scene');
  if (!first) throw new PieceError('found no scene among the pieces');
  const gl = contextOf();
  if (!gl) return sayNo('This page shows a building in three dimensions. Your browser cannot draw it: it lacks WebGL 2.');
  let done = first.bytes;
  panel.progress(0.05);
  const scene = readPiece(await loadPiece(first), first.file);
  const count = (kind: string): number => manifest.pieces.filter((p) => p.kind === kind).length;
  checkScene(scene, count('texture'), count('normal'));
  const walk = new Walk(scene);
  const walkthrough = new Walkthrough(gl, scene, walk);
  walkthrough.begin();
  begun = true;
  panel.begin(walk, () => walkthrough.show);
  const input = new Input(canvas, {
    key: (key) => panel.key(key), go: (x, y) => walkthrough.show?.go(x, y), hover: (x, y) => walkthrough.show?.hover(x, y),
  });
  let lost = false, last = performance.now();
  canvas.addEventListener('webglcontextlost', (e) => {
    e.preventDefault();
    lost = true;
    walkthrough.show = undefined;
  });
  canvas.addEventListener('webglcontextrestored', () => {
    lost = false;
    walkthrough.begin();
  });
  const tick = (now: number): void => {
    requestAnimationFrame(tick);
    const dt = Math.min((now - last) / 1000, 0.25);
    last = now;
    if (lost) return;
    walkthrough.show?.frame(input, dt, now);
    if (walkthrough.show?.frames && document.body.dataset['state'] === 'loading') {
      gl.finish();
      state('first');
    }
  };
  requestAnimationFrame(tick);
  panel.progress(done / all);
  for (const piece of manifest.pieces) {
    if (piece === first) continue;
    const sections = readPiece(await loadPiece(piece), piece.file);
    if (piece.kind === 'light') checkPage(sections, piece);
    walkthrough.take(nameOf(piece), sections);
    panel.progress((done += piece.bytes) / all);
  }
  state('whole');
  panel.progress(1);
  await keepOffline(manifest);
}

function checkPage(sections: Sections, piece: Piece): void {
  if (sections.pages.length !== 1) throw new PieceError(`${piece.file}: found ${sections.pages.length} pages, expected one`);
}

run().catch((error: unknown) => {
  if (!begun) sayNo(`This walkthrough cannot be shown: ${(error as Error).message}`);
  else panel.say(`A part is missing: ${(error as Error).message}`, true);
  if (!(error instanceof PieceError)) console.error(error);
});
