// A walkthrough driven as hands do: node walk_test.mjs FOLDER [RANDOM_INPUTS [STAIRS]]. Exit code 77 where there is no Chromium.
// STAIRS is a link's place (x,y,z,yaw,pitch) before stairs of half a metre or more, which looks up them to the floor at their end.
import assert from 'node:assert/strict';
import { resolve } from 'node:path';
import { Browser, hasChromium, serve } from './chromium.mjs';

if (!hasChromium()) {
  console.log('skipped: there is no Chromium (Debian: apt-get install chromium, or CHROMIUM=/path)');
  process.exit(77);
}
const folder = resolve(process.argv[2]), inputs = Number(process.argv[3] ?? 100), stairs = process.argv[4];
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
const view = () => browser.evaluate(`document.getElementById('view').focus()`);
// Again and again, for a busy machine draws few frames in a second and each takes a step; how far that went at last.
const until = async (done, act, times = 12) => {
  for (let before = await place(), n = 0; n < times; ++n) {
    await view();
    await act();
    const now = await place();
    if (done(before, now)) return now;
    before = now;
  }
  return undefined;
};
const touch = (type, points) => browser.send('Input.dispatchTouchEvent', { type, touchPoints: points });

try {
  const begin = Date.now();
  await browser.send('Network.emulateNetworkConditions', { offline: false, latency: 0, downloadThroughput: 2.5e6, uploadThroughput: 2.5e6 });
  await browser.open(site.url);
  await browser.until(`document.body?.dataset.state === 'first' || document.body?.dataset.state === 'whole'`);
  await browser.rest();
  const first = Math.round(await browser.evaluate(`performance.getEntriesByName('first frame')[0].startTime`));
  console.log(`at 20 Mbit/s the first frame is there after ${first} ms, all after ${Date.now() - begin} ms`);

  const start = await place();
  const walked = await until((_, now) => far(start, now) > 0.3, () => browser.key('KeyW', 'w', 1000));
  assert.ok(walked, `W walks from ${start}`);
  assert.ok(await until((was, now) => was[3] !== now[3], () => browser.key('ArrowLeft', 'ArrowLeft', 300)), 'arrows turn');
  const hurry = async () => {  // with Shift
    await browser.send('Input.dispatchKeyEvent', { type: 'keyDown', code: 'ShiftLeft', key: 'Shift' });
    await browser.key('KeyW', 'W', 2000);
    await browser.send('Input.dispatchKeyEvent', { type: 'keyUp', code: 'ShiftLeft', key: 'Shift' });
  };
  assert.ok(await until((was, now) => far(was, now) < 0.01, hurry, 30), 'a wall stops');

  const goHome = async () => {
    await view();
    await browser.key('Home', 'Home');
    await wait(500);
    return place();
  };
  const home = await goHome();
  const drag = async (x, y, dx, dy, held) => {
    await touch('touchStart', [{ x, y }]);
    for (let i = 1; i <= 6; ++i) await touch('touchMove', [{ x: x + dx * i, y: y + dy * i }]);
    await wait(held);
    await touch('touchEnd', []);
  };
  assert.ok(await until((_, now) => far(home, now) > 0.2, () => drag(100, 200, 0, -10, 1000)), 'a thumb on the left half walks');
  assert.ok(await until((was, now) => was[3] !== now[3], () => drag(500, 150, 10, 0, 200)), 'one on the right half looks');
  const back = await goHome();
  const tap = async () => {  // both at once: however late the page sees them, a tap is short
    const at = Date.now() / 1000, send = (type, touchPoints, timestamp) => browser.send('Input.dispatchTouchEvent', { type, touchPoints, timestamp });
    await Promise.all([send('touchStart', [{ x: 320, y: 300 }], at), send('touchEnd', [], at + 0.05)]);
    await wait(1500);
  };
  assert.ok(await until((_, now) => far(back, now) > 0.2, tap, 6), 'a tap walks there');

  if (stairs) {
    const foot = Number(stairs.split(',')[1]), risen = (_, now) => now[1] > foot + 0.5, down = (_, now) => Math.abs(now[1] - foot) < 0.02;
    await browser.evaluate(`location.hash = 'camera=${stairs}'`);
    assert.ok(await until(risen, () => browser.key('KeyW', 'w', 1000)), `stairs at ${stairs} climb`);
    assert.ok(await until(down, () => browser.key('KeyS', 's', 1000)), 'and lead down again');
    await browser.evaluate(`location.hash = 'camera=${stairs},60'`);  // another link to the same place
    assert.ok(await until(risen, () => browser.key('KeyG', 'g').then(() => wait(1500)), 6), 'a way leads up them');
  }

  const keys = ['KeyW', 'KeyA', 'KeyS', 'KeyD', 'ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'KeyC', 'KeyP', 'KeyX', 'KeyL', 'KeyG', 'KeyO', 'KeyM', 'Home', 'Digit1', 'Digit5', 'Minus'];
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
  console.log(`${inputs} random inputs, no error; the device holds ${(Number(await browser.evaluate('document.body.dataset.held')) / 1e6).toFixed(1)} MB`);
} finally {
  await browser.close();
  site.close();
}
