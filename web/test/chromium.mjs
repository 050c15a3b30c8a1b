// A headless Chromium, driven by its own protocol over a pipe; and a server of a folder on the loopback.
import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.json': 'application/json', '.png': 'image/png' };

export const chromiumPath = process.env.CHROMIUM ?? '/usr/bin/chromium';
export const hasChromium = () => existsSync(chromiumPath);

/** A folder, or files by name (`site.files`, which may be changed), below a path of the address. */
export async function serve(folder, below = '/') {
  const site = { files: typeof folder === 'string' ? undefined : folder };
  const bytesOf = (name) => {
    if (site.files) return site.files.get(name);
    const file = join(folder, name);
    return file.startsWith(folder) && existsSync(file) && statSync(file).isFile() ? readFileSync(file) : undefined;
  };
  const server = createServer((request, response) => {
    if (site.down) return request.destroy();
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname)).replace(/\/$/, '/index.html');
    const bytes = path.startsWith(below) ? bytesOf(path.slice(below.length)) : undefined;
    if (!bytes) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[extname(path)] ?? 'application/octet-stream', 'cache-control': 'no-cache' }).end(bytes);
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const close = () => {
    server.close();
    server.closeAllConnections();
  };
  return Object.assign(site, { url: `http://127.0.0.1:${server.address().port}${below}`, close });
}

export class Browser {
  #number = 0;
  #waiting = new Map();
  #listeners = [];
  errors = [];

  static async start(width = 640, height = 360, more = []) {
    const browser = new Browser();
    browser.data = mkdtempSync(join(tmpdir(), 'oriel-web-'));
    browser.process = spawn(chromiumPath, ['--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--hide-scrollbars',
      `--user-data-dir=${browser.data}`, `--window-size=${width},${height}`, '--remote-debugging-pipe', ...more, 'about:blank'],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    let text = '';
    browser.process.stdio[4].on('data', (chunk) => {
      text += chunk;
      for (let end; (end = text.indexOf('\0')) >= 0; text = text.slice(end + 1)) browser.#take(JSON.parse(text.slice(0, end)));
    });
    const { targetInfos } = await browser.#send('Target.getTargets', {});
    const page = targetInfos.find((t) => t.type === 'page');
    browser.session = (await browser.#send('Target.attachToTarget', { targetId: page.targetId, flatten: true })).sessionId;
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await browser.send(`${domain}.enable`);
    await browser.size(width, height);
    return browser;
  }

  #take(message) {
    if (message.id) {
      const { done, fail } = this.#waiting.get(message.id);
      this.#waiting.delete(message.id);
      return message.error ? fail(new Error(`${message.error.message}`)) : done(message.result);
    }
    const p = message.params;
    if (message.method === 'Runtime.exceptionThrown') this.errors.push(p.exceptionDetails.exception?.description ?? p.exceptionDetails.text);
    if (message.method === 'Log.entryAdded' && ['error', 'warning'].includes(p.entry.level)) this.errors.push(`${p.entry.text} ${p.entry.url ?? ''}`);
    if (message.method === 'Runtime.consoleAPICalled' && ['error', 'warning'].includes(p.type)) this.errors.push(p.args.map((a) => a.value ?? a.description).join(' '));
    for (const listener of this.#listeners) listener(message);
  }
  #send(method, params, sessionId) {
    const id = ++this.#number;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((done, fail) => this.#waiting.set(id, { done, fail }));
  }
  send(method, params = {}) { return this.#send(method, params, this.session); }
  on(listener) { this.#listeners.push(listener); }

  size(width, height, mobile = false) {
    return this.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile });
  }
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  async until(expression, seconds = 60) {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
      if (await this.evaluate(`!!(${expression})`)) return;
      await new Promise((done) => setTimeout(done, 20));
    }
    throw new Error(`after ${seconds} s there is not: ${expression}; ${await this.evaluate('JSON.stringify(document.body.dataset) + document.body.innerText')}; ${this.errors}`);
  }
  open(url) { return this.send('Page.navigate', { url }); }
  async picture() { return Buffer.from((await this.send('Page.captureScreenshot', { format: 'png' })).data, 'base64'); }
  /** The whole frame is there, with all pieces. */
  async rest() {
    await this.until(`document.body?.dataset.state === "whole"`);
    await this.until(`document.body?.dataset.rest`);
  }
  async key(code, key, ms = 0) {
    await this.send('Input.dispatchKeyEvent', { type: 'keyDown', code, key, text: key.length === 1 ? key : undefined });
    if (ms) await new Promise((done) => setTimeout(done, ms));
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', code, key });
  }
  async close() {
    await this.#send('Browser.close', {}).catch(() => {});
    await new Promise((done) => (this.process.exitCode === null ? this.process.once('exit', done) : done()));
    rmSync(this.data, { recursive: true, force: true, maxRetries: 5 });
  }
}
