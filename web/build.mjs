// Makes web/dist of web/src and web/page: what oriel-inspect holds. `node build.mjs DIR` writes elsewhere.
import { build } from 'esbuild';
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, 'dist');
mkdirSync(out, { recursive: true });
await build({
  entryPoints: [join(here, 'src/main.ts')],
  outfile: join(out, 'app.js'),
  absWorkingDir: here,
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  charset: 'utf8',
  legalComments: 'inline',
  loader: { '.glsl': 'text', '.vert': 'text', '.frag': 'text' },
  logLevel: 'warning',
});
for (const file of readdirSync(join(here, 'page'))) copyFileSync(join(here, 'page', file), join(out, file));
// Notices that go where the bundle goes.
const notices = ['fzstd'].map((name) => `${name}, part of the viewer's script:\n\n${readFileSync(join(here, 'node_modules', name, 'LICENSE'), 'utf8')}`);
writeFileSync(join(out, 'licences.txt'), notices.join('\n'));
