// A walkthrough driven as hands do: node walk_test.mjs FOLDER [RANDOM_INPUTS]. Exit code 77 where there is no Chromium.
import assert from 'node:assert/strict';
import { resolve } from 'node:path';
import { Browser, hasChromium, serve } from './chromium.mjs';

if (!hasChromium()) {
  console.log('skipped: there is no Chromium (Debian: apt-get install chromium, or CHROMIUM=/path)');
  process.exit(77);
}
const folder = resolve(process.argv[2]), inputs = Number(process.argv[3] ?? 100);
const site = await serve(folder), browser = await Browser.start(640, 360);
let seed = 1;
const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const place = async () => {  // where the link to this view leads
  await browser.evaluate(`document.getElementById('link').click()`);
  await wait(50);
  return (await browser.evaluate('location.hash')).replace('#camera=', '').split(',').map(Number);
};
const far = (a, b) => Math.hypot(a[0] - b[0], a[2] - b[2]);
const mouse = (type, x, y, clickCount = 1) => browser.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount });
const touch = (type, points) => browser.send('Input.dispatchTouchEvent', { type, touchPoints: points });

try {
  const begin = Date.now();
  await browser.send('Network.emulateNetworkConditions', { offline: false, latency: 0, downloadThroughput: 2.5e6, uploadThroughput: 2.5e6 });
  await browser.open(site.url);
  await browser.until(`document.body?.dataset.state === 'first' || document.body?.dataset.state === 'whole'`);
  const first = Date.now() - begin;
  await browser.rest();
  console.log(`at 20 Mbit/s the first frame is there after ${first} ms, all after ${Date.now() - begin} ms`);
  await browser.evaluate(`document.getElementById('view').focus()`);

  const start = await place();
  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('KeyW', 'w', 1500);
  const walked = await place();
  assert.ok(far(start, walked) > 0.3, `W walks: ${start} to ${walked}`);
  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('ArrowLeft', 'ArrowLeft', 300);
  assert.notEqual((await place())[3], walked[3], 'arrows turn');
  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('KeyW', 'w', 8000);
  const wall = await place();
  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('KeyW', 'w', 1500);
  assert.ok(far(wall, await place()) < 0.2, 'a wall stops');

  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('Home', 'Home');
  await wait(200);
  const home = await place();
  await touch('touchStart', [{ x: 100, y: 200 }]);
  for (let i = 1; i <= 6; ++i) await touch('touchMove', [{ x: 100, y: 200 - 10 * i }]);
  await wait(1200);
  await touch('touchEnd', []);
  assert.ok(far(home, await place()) > 0.2, 'a thumb on the left half walks');
  const before = await place();
  await touch('touchStart', [{ x: 500, y: 150 }]);
  for (let i = 1; i <= 6; ++i) await touch('touchMove', [{ x: 500 + 10 * i, y: 150 }]);
  await touch('touchEnd', []);
  await wait(200);
  assert.notEqual((await place())[3], before[3], 'one on the right half looks');
  await browser.evaluate(`document.getElementById('view').focus()`);
  await browser.key('Home', 'Home');
  await wait(200);
  await touch('touchStart', [{ x: 320, y: 300 }]);
  await touch('touchEnd', []);
  await wait(2500);
  assert.ok(far(home, await place()) > 0.2, 'a tap walks there');

  const keys = ['KeyW', 'KeyA', 'KeyS', 'KeyD', 'ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'KeyC', 'KeyP', 'KeyX', 'KeyL', 'KeyG', 'Home', 'Digit1', 'Digit5', 'Minus'];
  for (let i = 0; i < inputs; ++i) {
    const x = random() * 640, y = random() * 300, code = keys[Math.floor(random() * keys.length)];
    const key = code === 'Minus' ? '-' : code.startsWith('Arrow') || code === 'Home' ? code : code.at(-1).toLowerCase();
    if (random() < 0.6) await browser.key(code, key, random() * 30);
    else if (random() < 0.5) await mouse('mousePressed', x, y).then(() => mouse('mouseMoved', random() * 640, y)).then(() => mouse('mouseReleased', x, y));
    else await touch('touchStart', [{ x, y }]).then(() => touch('touchMove', [{ x: random() * 640, y }])).then(() => touch('touchEnd', []));
  }
  assert.ok((await place()).every(Number.isFinite), 'the eye is somewhere');

  await browser.evaluate(`(() => { const gl = document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context');
    gl.loseContext(); setTimeout(() => gl.restoreContext(), 100); delete document.body.dataset.rest; })()`);
  await browser.until('document.body.dataset.rest');
  const names = await browser.evaluate(`[...document.querySelectorAll('button, select, progress, canvas, dialog')].filter((e) =>
    !(e.textContent.trim() || e.getAttribute('aria-label') || e.getAttribute('aria-labelledby') || e.labels?.length)).map((e) => e.id)`);
  assert.deepEqual(names, [], 'all that can be used has a name');
  await browser.size(320, 640);
  assert.ok(await browser.evaluate('document.documentElement.scrollWidth <= 320'), 'nothing is wider than 320 px');
  assert.deepEqual(browser.errors, []);
  console.log(`${inputs} random inputs, no error`);
} finally {
  await browser.close();
  site.close();
}
