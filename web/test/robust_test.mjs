// A walkthrough in bad company: node robust_test.mjs FOLDER. Broken and foreign pieces, other versions, no network, no WebGL 2; and
// whether all can be read and reached by keys. Exit code 77 where there is no Chromium.
import assert from 'node:assert/strict';
import { resolve } from 'node:path';
import { Browser, hasChromium, serve } from './chromium.mjs';
import { Folder } from './folder.mjs';

if (!hasChromium()) {
  console.log('skipped: there is no Chromium (Debian: apt-get install chromium, or CHROMIUM=/path)');
  process.exit(77);
}
const folder = new Folder(resolve(process.argv[2])), wait = (ms) => new Promise((done) => setTimeout(done, ms));
const site = await serve(folder.signed(), '/a/path/below/'), browser = await Browser.start(640, 360);
const shown = () => browser.evaluate(`({ state: document.body.dataset.state, text: document.getElementById('fallback-text').textContent,
  seen: !document.getElementById('fallback').hidden, line: document.getElementById('line').textContent })`);
// Of a page that is loaded anew: without what a visit before kept.
const load = async (files, done) => {
  site.files = files;
  await browser.send('Storage.clearDataForOrigin', { origin: new URL(site.url).origin, storageTypes: 'all' });
  browser.errors.length = 0;
  await browser.open('about:blank');
  await browser.open(`${site.url}#time=0`);
  await browser.until(done);
  return shown();
};
const refused = `document.body?.dataset.state === 'refused' || document.getElementById('line')?.textContent.startsWith('A part')`;
const whole = `document.body?.dataset.rest && document.body.dataset.state === 'whole'`;

async function hostile() {
  const scene = folder.bytes('scene'), at = (bytes, offset, value) => { const out = Buffer.from(bytes); out.writeUInt32LE(value, offset); return out; };
  const cases = [
    ['nothing at all', { scene: Buffer.alloc(0) }, /did not come|found|no piece/],
    ['a truncated scene', { scene: scene.subarray(0, scene.length >> 1) }, /ends|outside|decompress/],
    ['a scene that is none', { scene: at(scene, 0, 0x12345678) }, /is no piece of a pack/],
    ['a scene of a later format', { scene: at(scene, 8, 9) }, /format version 9, expected 1/],
    ['a table without an end', { scene: at(scene, 16, 0xffffffff) }, /ends inside its table/],
    ['a section of an unknown kind', { scene: at(scene, 64, 0x41414141) }, /section that a piece does not have/],
    ['a section that claims a gigabyte', { scene: at(scene, 64 + 32, 0x3fffffff) }, /found \d+ bytes/],
    ['light in the scene\'s place', { scene: folder.bytes('light') }, /found no mesh/],
    ['a texture in the place of light', { light: folder.bytes('texture') }, /found 0 of kind 'light'/],
    ['truncated light', { light: folder.bytes('light').subarray(0, 100) }, /ends|outside/],
  ];
  for (const [what, pieces, reason] of cases) {
    const { state, text, seen, line } = await load(folder.signed(pieces), refused), said = state === 'refused' ? text : line;
    assert.match(said, reason, what);
    assert.ok(seen || state !== 'refused', `${what}: the reason is seen`);
    assert.deepEqual(browser.errors, [], what);
  }
  console.log(`${cases.length} hostile folders are refused with the reason`);
}

async function versions() {
  for (const version of [1, 99]) {  // a folder of before with the program of today, and the reverse: never half
    const files = folder.signed({}, (text) => text.replace(/"version":\d+/, `"version":${version}`)), { state, text } = await load(files, refused);
    assert.equal(state, 'refused');
    assert.match(text, new RegExp(`of version ${version}, this viewer of \\d+: write the folder anew`));
  }
  const nonsense = await load(folder.signed({}, () => 'no JSON'), refused);
  assert.match(nonsense.text, /cannot be shown/);
  // A piece that is another than was signed: the browser itself tells of it, and the page says so.
  const files = folder.signed(), light = folder.piece('light').file;
  files.set(light, Buffer.from(files.get(light)).fill(7, 70, 71));
  const { line } = await load(files, refused);
  assert.match(line, /is not the one that this page was made with/);
  assert.ok(browser.errors.every((e) => /integrity/i.test(e)), browser.errors.join('\n'));
  console.log('other versions and pieces of other hashes are refused');
}

async function offline() {
  await load(folder.signed(), whole);
  await browser.until(`document.body.dataset.offline === 'kept'`);
  await browser.until(`navigator.serviceWorker.controller`);
  site.down = true;  // nobody answers any more, and the page has no network either
  await browser.send('Network.emulateNetworkConditions', { offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0 });
  await browser.open('about:blank');
  await browser.open(`${site.url}#time=0`);
  await browser.until(whole);
  await browser.send('Network.emulateNetworkConditions', { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput: -1 });
  site.down = false;
  const keys = await browser.evaluate('caches.keys()');
  assert.equal(keys.length, 1);
  console.log('shown again without a network');
}

// WCAG 2's contrast of text with what lies behind it, where that is black and where it is white.
const contrasts = `(() => {
  const parse = (c) => { const n = c.match(/[\\d.]+/g).map(Number); return [n[0], n[1], n[2], n[3] ?? 1]; };
  const over = (top, under) => [0, 1, 2].map((i) => top[i] * top[3] + under[i] * (1 - top[3]));
  const light = (c) => c.map((x) => x / 255).map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4)).reduce((s, x, i) => s + x * [0.2126, 0.7152, 0.0722][i], 0);
  const ratio = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
  const out = [];
  for (const e of document.querySelectorAll('button, select, p, h2, th, td, label, output')) {
    if (!e.getClientRects().length || e.classList.contains('hidden') || !e.textContent.trim()) continue;
    for (const view of [[0, 0, 0], [255, 255, 255]]) {
      let under = view;
      const chain = [];
      for (let p = e; p && p.tagName !== 'MAIN'; p = p.parentElement) chain.unshift(parse(getComputedStyle(p).backgroundColor));
      for (const c of chain) under = over(c, under);
      out.push({ name: e.id || e.textContent.trim().slice(0, 20), ratio: ratio(parse(getComputedStyle(e).color).slice(0, 3), under) });
    }
  }
  return out;
})()`;

async function readable() {
  await load(folder.signed(), whole);
  await browser.evaluate(`document.getElementById('line').textContent = 'a line'; document.getElementById('lux').hidden = false; document.getElementById('lux').textContent = '12 lux'`);
  const over = await browser.evaluate(contrasts);
  await browser.key('KeyO', 'o');
  await wait(200);
  over.push(...await browser.evaluate(contrasts));
  await browser.key('Escape', 'Escape');
  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('Slash', '?');
  await browser.until(`document.getElementById('sheet').open`);
  over.push(...await browser.evaluate(contrasts));
  assert.match(await browser.evaluate(`document.getElementById('sheet-sizes').textContent`), /Loaded: [\d.]+ MB.*device: [\d.]+ MB/);
  await browser.evaluate(`document.getElementById('sheet').close()`);
  assert.ok(over.length > 40, `${over.length} texts`);
  const worst = over.reduce((a, b) => (b.ratio < a.ratio ? b : a));
  assert.ok(worst.ratio >= 4.5, `${worst.name}: contrast ${worst.ratio}`);
  console.log(`${over.length} contrasts of text, the least ${worst.ratio.toFixed(1)} (${worst.name})`);
}

const focused = `(() => { const e = document.activeElement, s = getComputedStyle(e); return { id: e.id || e.getAttribute('aria-label') || e.tagName, ring: s.outlineStyle !== 'none' && parseFloat(s.outlineWidth) >= 2 }; })()`;
async function reachable() {
  await load(folder.signed(), whole);  // where a visitor begins
  const order = [];
  for (let i = 0; i < 12; ++i) {
    await browser.key('Tab', 'Tab');
    const { id, ring } = await browser.evaluate(focused);
    if (id === 'BODY' || order.includes(id)) break;
    assert.ok(ring, `${id} shows that it has the focus`);
    order.push(id);
  }
  const wanted = ['view', 'places', 'lamps', 'tour', 'movers', 'link', 'screen', 'help'];
  const there = await browser.evaluate(`${JSON.stringify(wanted)}.filter((id) => !document.getElementById(id).hidden)`);
  assert.deepEqual(order, there);
  console.log(`focus goes ${order.join(', ')}`);
}

async function lights() {
  if (await browser.evaluate(`document.getElementById('lamps').hidden`)) return console.log('no light groups here');
  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('KeyO', 'o');
  await browser.until(`document.getElementById('lights').open`);
  await browser.evaluate(`document.querySelector('#lights input[type=checkbox]').focus()`);
  const first = await browser.evaluate(`document.activeElement.getAttribute('aria-label')`);
  await browser.key('Space', ' ');
  assert.equal(await browser.evaluate(`document.activeElement.checked`), false, 'Space switches a lamp off');
  await browser.key('Tab', 'Tab');
  const unnamed = await browser.evaluate(`[...document.querySelectorAll('#lights input')].filter((e) => !e.getAttribute('aria-label')).length`);
  assert.equal(unnamed, 0);
  await browser.key('Escape', 'Escape');
  assert.equal(await browser.evaluate(`document.activeElement.id`), 'view', 'Escape leads back to the view');
  await browser.evaluate(`document.getElementById('link').click()`);
  await wait(100);
  const link = await browser.evaluate('location.hash');
  assert.deepEqual(new URLSearchParams(link.slice(1)).getAll('light').map((l) => /off$/.test(l) && l.startsWith(first)), [true], link);
  console.log(`lamps are switched by keys, and the link tells of them: ${link}`);
}

async function withoutWebGl2() {
  const plain = await Browser.start(640, 360, ['--disable-3d-apis']);
  try {
    site.files = folder.signed();
    await plain.open(site.url);
    await plain.until(`document.body?.dataset.state === 'refused'`);
    assert.match(await plain.evaluate(`document.getElementById('fallback').innerText`), /lacks WebGL 2/);
    assert.ok(await plain.evaluate(`document.getElementById('view').hidden && document.getElementById('tools').hidden`));
    const picture = folder.files.has('picture.png');
    assert.equal(await plain.evaluate(`document.querySelectorAll('#fallback img').length`), Number(picture));
    assert.deepEqual(plain.errors, []);
  } finally {
    await plain.close();
  }
  console.log('without WebGL 2 there is a sentence');
}

try {
  await hostile();
  await versions();
  await offline();
  await readable();
  await reachable();
  await lights();
  assert.deepEqual(browser.errors, []);
  await withoutWebGl2();
} finally {
  await browser.close();
  site.close();
}
