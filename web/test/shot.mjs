// Pictures of a walkthrough: node shot.mjs FOLDER OUT.png [CAMERA or camera=NAME&light=NAME=VALUE&time=SECONDS [WIDTH HEIGHT [ui [KEYS]]]].
// Without ui only the view; KEYS are pressed first (o opens the lamps); without a time movers stand where they begin.
import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { Browser, serve } from './chromium.mjs';

const [folder, out, camera = '', width = '640', height = '360', ui = '', keys = ''] = process.argv.slice(2);
const site = await serve(resolve(folder)), browser = await Browser.start(Number(width), Number(height));
try {
  await browser.size(Number(width), Number(height), Number(width) < 500);
  const hash = camera.includes('=') ? camera : `camera=${encodeURIComponent(camera)}`;
  await browser.open(`${site.url}#${hash.includes('time=') ? hash : `${hash}&time=0`}`);
  await browser.rest();
  if (!ui) await browser.evaluate(`for (const e of document.querySelectorAll('main > :not(canvas)')) e.style.display = 'none'`);
  for (const key of keys) await browser.key(`Key${key.toUpperCase()}`, key);
  await new Promise((done) => setTimeout(done, 300));
  writeFileSync(out, await browser.picture());
  for (const error of browser.errors) console.error(error);
} finally {
  await browser.close();
  site.close();
}
