// The page: loads the pieces, draws what changed, walks.
import { PieceError } from './bytes';
import { Input } from './input';
import { Renderer } from './frame';
import { Walk } from './walk';
import { checkField, checkMover, checkPageGroups, checkScene, readPiece } from './sections';
import { checkSharp } from './sharp_elements';
import { sharpColumns, sharpRows } from './sharp_light';
import { GpuScene, makeDevice } from './scene';
import { LightsPanel } from './lights_panel';
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

const kAhead = 3;    // pieces that are fetched at once, in the order that they are needed
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
  readonly lights: LightsPanel;
  constructor(readonly gl: WebGL2RenderingContext, readonly scene: Sections, readonly walk: Walk) {
    this.lights = new LightsPanel(scene.groups, scene.day, () => this.show?.dim());
  }

  begin(renderer = new Renderer(makeDevice(this.gl))): void {
    const gpu = new GpuScene(renderer.device, { ...this.scene, pages: this.scene.pages.slice() });
    this.show = new Show(canvas, renderer, gpu, this.walk, panel, this.lights);
    for (const [name, sections] of this.pieces) this.take(name, sections);
  }

  take(name: string, sections: Sections): void {
    this.pieces.set(name, sections);
    const show = this.show, [kind, index] = name.split(' ') as [string, string], at = Number(index);
    if (!show) return;
    if (kind === 'light' && sections.pages[0]) show.scene.setPage(at, sections.pages[0]);
    if (kind === 'sharp' && sections.sharp) show.scene.setSharp(sections.sharp);
    if (kind === 'texture' && sections.textures[0]) show.scene.setTexture(at, sections.textures[0], false);
    if (kind === 'normal' && sections.normals[0]) show.scene.setTexture(at, sections.normals[0], true);
    if (kind === 'surround' && sections.surrounds[0]) show.scene.setSurround(at, sections.surrounds[0]);
    if (kind === 'sky' && sections.skyMap) show.scene.setSky(sections.skyMap);
    if (kind === 'field' && sections.field) show.scene.movers.setField(sections.field);
    if (kind === 'mover' && sections.movers[0]) show.scene.movers.add(at, sections.movers[0]);
    if (kind === 'lamps' && sections.pageGroups[0]) show.scene.setPageGroups(sections.pageGroups[0]);
    show.pieceCame();
  }
}

async function keepOffline(manifest: Manifest): Promise<void> {
  if (!('serviceWorker' in navigator) || !isSecureContext) return;
  const number = /pieces-([0-9a-f]+)\.json/.exec(document.body.dataset['pieces']!)?.[1];
  try {
    const cache = await caches.open(`oriel ${new URL('./', location.href).pathname} ${number}`);
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
  // While the scene comes the device wakes up, and compiles what the first frame needs.
  const coming = loadPiece(first);
  coming.catch(() => { /* told where it is awaited */ });
  const gl = contextOf();
  if (!gl) return sayNo('This page shows a building in three dimensions. Your browser cannot draw it: it lacks WebGL 2.');
  const renderer = new Renderer(makeDevice(gl));
  renderer.start();
  let done = first.bytes;
  panel.progress(0.05);
  const scene = readPiece(await coming, first.file);
  const most = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
  checkSizes(scene, first.file, most);
  const count = (kind: string): number => manifest.pieces.filter((p) => p.kind === kind).length;
  checkScene(scene, count('texture'), count('normal'), count('surround'));
  const walk = new Walk(scene);
  const walkthrough = new Walkthrough(gl, scene, walk);
  walkthrough.begin(renderer);
  begun = true;
  panel.begin(walk, walkthrough.lights, () => walkthrough.show);
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
    if (document.body.dataset['state'] === 'whole') walkthrough.show!.allCame();
  });
  const tick = (now: number): void => {
    requestAnimationFrame(tick);
    const dt = Math.min((now - last) / 1000, 0.25);
    last = now;
    if (lost) return;
    walkthrough.show?.frame(input, dt, now);
    if (walkthrough.show?.frames && document.body.dataset['state'] === 'loading') {
      gl.finish();
      performance.mark('first frame');
      state('first');
    }
  };
  const rest = manifest.pieces.filter((p) => p !== first), fetched: Promise<Uint8Array>[] = [];
  const fetchTo = (end: number): void => {
    for (let i = fetched.length; i < Math.min(end, rest.length); ++i) (fetched[i] = loadPiece(rest[i]!)).catch(() => { /* told where it is awaited */ });
  };
  fetchTo(kAhead);
  tick(last);
  panel.progress(done / all);
  for (const [i, piece] of rest.entries()) {
    fetchTo(i + kAhead);
    const sections = readPiece(await fetched[i]!, piece.file);
    checkPiece(sections, piece, most);
    if (piece.kind === 'light') checkSharp(sections.pages[0]!, walkthrough.pieces.get('sharp 0')?.sharp);
    if (piece.kind === 'mover') checkMover(sections.movers[0]!, scene);
    if (piece.kind === 'field') checkField(sections.field!, scene);
    if (piece.kind === 'lamps') checkPageGroups(sections.pageGroups[0]!, scene, walkthrough.pieces.get(`light ${sections.pageGroups[0]!.page}`)?.pages[0]);
    walkthrough.take(nameOf(piece), sections);
    panel.progress((done += piece.bytes) / all);
  }
  walkthrough.show?.allCame();
  state('whole');
  panel.progress(1);
  panel.sizes(all, walkthrough.show?.scene.bytes ?? 0);
  await keepOffline(manifest);
}

/** A piece of another kind than the manifest says is no piece of this pack. */
function checkPiece(sections: Sections, piece: Piece, most: number): void {
  const held: Record<string, unknown[]> = {
    light: sections.pages, texture: sections.textures, normal: sections.normals, surround: sections.surrounds,
    lamps: sections.pageGroups, mover: sections.movers, field: sections.field ? [sections.field] : [],
    sharp: sections.sharp ? [sections.sharp] : [], sky: sections.skyMap ? [sections.skyMap] : [],
  };
  const found = held[piece.kind]?.length ?? 0;
  if (found !== 1) throw new PieceError(`${piece.file}: found ${found} of kind '${piece.kind}', expected one`);
  checkSizes(sections, piece.file, most);
}

/** Refuses images that the device cannot hold. */
function checkSizes(sections: Sections, file: string, most: number): void {
  const sizes = [...sections.textures, ...sections.normals, ...sections.pages].map((t) => [t.width, t.height]);
  for (const p of sections.pages) sizes.push([p.detailWidth, p.detailHeight]);
  if (sections.skyMap) sizes.push([sections.skyMap.width, sections.skyMap.height]);
  for (const s of sections.surrounds) sizes.push([1.5 * s.size + 4, s.size + 64]);
  if (sections.sharp) sizes.push([sharpColumns, sharpRows(sections.sharp)]);
  for (const [w, h] of sizes)
    if (Math.max(w!, h!) > most) throw new PieceError(`${file}: found an image of ${w} x ${h} texels, but this device holds at most ${most} a side`);
}

run().catch((error: unknown) => {
  if (!begun) sayNo(`This walkthrough cannot be shown: ${(error as Error).message}`);
  else panel.say(`A part is missing: ${(error as Error).message}`, true);
  if (!(error instanceof PieceError)) console.error(error);
});
