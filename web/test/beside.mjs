// Packs in the browser beside oriel-play: node beside.mjs BIN [--cameras N] PACK.oriel… (BIN: where the programs are). A row for each
// camera, FLIP and means of the pixels; the pictures lie in the folder that is told. Exit code 1 where the console tells of an error, or a
// frame is black that the desktop's is not; 77 where there is no Chromium. Takes 10 s or more a pack, so no test calls it.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { Browser, hasChromium, serve } from './chromium.mjs';

if (!hasChromium()) {
  console.log('skipped: there is no Chromium (Debian: apt-get install chromium, or CHROMIUM=/path)');
  process.exit(77);
}
const [bin, ...words] = process.argv.slice(2), given = words.indexOf('--cameras'), most = given < 0 ? 1 : Number(words[given + 1]);
const packs = given < 0 ? words : words.toSpliced(given, 2), work = mkdtempSync(join(tmpdir(), 'oriel-beside-'));
const run = (program, ...args) => execFileSync(join(bin, program), args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
const size = [640, 360];

/** The mean of a picture's pixels, 0 to 1, by the browser. */
async function meanOf(browser, png) {
  return browser.evaluate(`(async () => {
    const image = new Image(), canvas = document.createElement('canvas'), [w, h] = [canvas.width, canvas.height] = ${JSON.stringify(size)};
    image.src = 'data:image/png;base64,${png.toString('base64')}';
    await image.decode();
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, w, h).data.reduce((sum, x, i) => sum + (i % 4 < 3 ? x : 0), 0) / (3 * 255 * w * h);
  })()`);
}

async function show(site, browser, camera) {
  await browser.open('about:blank');
  await browser.open(`${site.url}#camera=${encodeURIComponent(camera)}&time=0`);
  await browser.until(`document.body?.dataset.state === 'refused' || (document.body?.dataset.state === 'whole' && document.body.dataset.rest)`, 300);
  if (await browser.evaluate(`document.body.dataset.state === 'refused'`)) throw new Error(await browser.evaluate(`document.getElementById('fallback-text').textContent`));
  await browser.evaluate(`for (const e of document.querySelectorAll('main > :not(canvas)')) e.style.display = 'none'`);
  await new Promise((done) => setTimeout(done, 300));
  return browser.picture();
}

async function row(browser, site, pack, camera, at) {
  const [web, desktop, difference] = ['web', 'desktop', 'difference'].map((what) => `${at}.${what}.png`);
  writeFileSync(web, await show(site, browser, camera));
  const wanted = [pack, '--offscreen', '--size', size.join('x'), ...(camera ? ['--camera', camera] : [])];
  run('oriel-play', ...wanted, '-o', desktop);
  const flip = Number(/FLIP\D*([0-9.e-]+)/.exec(run('oriel-play', ...wanted, '-o', difference, '--compare', web))?.[1] ?? NaN);
  await browser.open('about:blank');
  const [here, there] = [await meanOf(browser, readFileSync(web)), await meanOf(browser, readFileSync(desktop))];
  const wrong = [...browser.errors, ...(here < 0.002 && there > 0.004 ? ['the frame is black'] : [])];
  browser.errors.length = 0;
  return { flip, here, there, wrong };
}

let failed = 0;
for (const pack of packs) {
  const name = basename(pack, '.oriel'), folder = join(work, name);
  let site, browser;
  try {
    run('oriel-inspect', 'web', pack, '-o', folder);
    [site, browser] = [await serve(folder), await Browser.start(...size)];
    const cameras = [...run('oriel-play', pack, '--list').matchAll(/^camera \d+ (.*) at /gm)].map((m) => m[1]);
    for (const camera of cameras.length > 0 ? cameras.slice(0, most) : ['']) {
      const { flip, here, there, wrong } = await row(browser, site, pack, camera, join(work, `${name} ${camera}`.trim().replaceAll('/', '-')));
      console.log(`${name}, ${camera || 'no camera'}: FLIP ${flip}, mean ${here.toFixed(3)}, desktop ${there.toFixed(3)}${wrong.map((w) => `\n  ${w}`).join('')}`);
      failed += wrong.length > 0;
    }
  } catch (error) {
    console.log(`${name}: ${error.stderr || error.message}`);
    ++failed;
  } finally {
    await browser?.close();
    site?.close();
  }
}
console.log(`${packs.length} packs, ${failed} with what is wrong; pictures: ${work}`);
process.exitCode = failed > 0 ? 1 : 0;
