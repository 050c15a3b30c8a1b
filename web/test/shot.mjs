// Pictures of a walkthrough: node shot.mjs FOLDER OUT.png [CAMERA [WIDTH HEIGHT [ui]]]. Without ui only the view.
import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { Browser, serve } from './chromium.mjs';

const [folder, out, camera = '', width = '640', height = '360', ui = ''] = process.argv.slice(2);
const site = await serve(resolve(folder)), browser = await Browser.start(Number(width), Number(height));
try {
  await browser.size(Number(width), Number(height), Number(width) < 500);
  await browser.open(`${site.url}#camera=${encodeURIComponent(camera)}`);
  await browser.rest();
  if (!ui) await browser.evaluate(`for (const e of document.querySelectorAll('main > :not(canvas)')) e.style.display = 'none'`);
  await new Promise((done) => setTimeout(done, 300));
  writeFileSync(out, await browser.picture());
  for (const error of browser.errors) console.error(error);
} finally {
  await browser.close();
  site.close();
}
