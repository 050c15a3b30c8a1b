// Makes web/dist of web/src and web/page: what oriel-inspect holds; and web/dist.sha256, by which the tests prove that it
// is made of the sources that are there. `node build.mjs DIR` writes elsewhere.
import { build } from 'esbuild';
import { createHash } from 'node:crypto';
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, 'dist');
mkdirSync(out, { recursive: true });

// Without comments, and spaces that no token needs. Lines stay: a driver tells of them, and directives end with theirs.
function minified(shader) {
  const lines = shader.split('\n').map((line) => line.replace(/\/\/.*$/, '').trim());
  const tight = (line) => (line.startsWith('#') ? line : line.replace(/\s*([=(),;{}*])\s*/g, '$1').replace(/\s+/g, ' '));
  return lines.filter((line) => line !== '').map((line) => `${tight(line)}\n`).join('');
}
const shaders = {
  name: 'shaders',
  setup(it) {
    it.onLoad({ filter: /\.(glsl|vert|frag)$/ }, ({ path }) => ({ contents: minified(readFileSync(path, 'utf8')), loader: 'text' }));
  },
};

const built = await build({
  entryPoints: [join(here, 'src/main.ts')],
  outfile: join(out, 'app.js'),
  absWorkingDir: here,
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  charset: 'utf8',
  legalComments: 'inline',
  plugins: [shaders],
  metafile: true,
  logLevel: 'warning',
});
for (const file of readdirSync(join(here, 'page'))) copyFileSync(join(here, 'page', file), join(out, file));
// Notices that go where the bundle goes.
const notices = ['fzstd'].map((name) => `${name}, part of the viewer's script:\n\n${readFileSync(join(here, 'node_modules', name, 'LICENSE'), 'utf8')}`);
writeFileSync(join(out, 'licences.txt'), notices.join('\n'));

// What it was made of, and what came of it.
if (process.argv[2] === undefined) {
  const root = dirname(here);
  const listed = (folder) => readdirSync(join(here, folder)).map((file) => join(here, folder, file));
  const sources = Object.keys(built.metafile.inputs).map((file) => join(here, file)).filter((file) => !file.includes('node_modules'));
  const files = new Set([...sources, ...listed('src'), ...listed('page'), ...listed('shaders'), ...listed('dist'), join(here, 'build.mjs'), join(here, 'package-lock.json')]);
  const line = (file) => `${createHash('sha256').update(readFileSync(file)).digest('hex')}  ${relative(root, file)}`;
  writeFileSync(join(here, 'dist.sha256'), [...files].sort().map((file) => `${line(file)}\n`).join(''));
}
