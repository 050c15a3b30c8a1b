// The reader of pieces on broken ones: node fuzz_pieces.mjs FOLDER [COUNT [SEED]]. Each is read, or refused with a reason, and soon.
// Exit code 77 where npm's packages are absent.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Folder } from './folder.mjs';

const web = join(dirname(fileURLToPath(import.meta.url)), '..');
if (!existsSync(join(web, 'node_modules/esbuild'))) {
  console.log('skipped: the fuzzer of pieces needs npm ci in web/');
  process.exit(77);
}
const { build } = await import('esbuild');
const { outputFiles } = await build({
  stdin: { contents: `export * from './sections'; export { checkSharp } from './sharp_elements'; export { PieceError } from './bytes';`, resolveDir: join(web, 'src'), loader: 'ts' },
  bundle: true, format: 'esm', write: false,
});
const { readPiece, checkScene, checkMover, checkField, checkPageGroups, checkSharp, PieceError } =
  await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString('base64')}`);
const { decompress } = await import(join(web, 'node_modules/fzstd/esm/index.mjs'));

const folder = new Folder(resolve(process.argv[2])), count = Number(process.argv[3] ?? 5000);
let seed = Number(process.argv[4] ?? 1);
const random = (n) => (seed = (seed * 48271) % 2147483647) % n;

// Without compression a changed byte is one of what the reader sees, not an error of the decompressor.
function stored(bytes) {
  const sections = bytes.readUInt32LE(16), parts = [], table = Buffer.from(bytes.subarray(0, 64 + 64 * sections));
  let at = table.length;
  for (let i = 0; i < sections; ++i) {
    const record = 64 + 64 * i, offset = Number(bytes.readBigUInt64LE(record + 16)), size = Number(bytes.readBigUInt64LE(record + 24));
    const raw = bytes.readUInt32LE(record + 4) === 1 ? decompress(bytes.subarray(offset, offset + size)) : bytes.subarray(offset, offset + size);
    table.writeUInt32LE(0, record + 4);
    for (const [field, value] of [[16, at], [24, raw.length], [32, raw.length]]) table.writeBigUInt64LE(BigInt(value), record + field);
    parts.push(Buffer.from(raw));
    at += raw.length;
  }
  return Buffer.concat([table, ...parts]);
}

const extremes = [0, 1, 2, 0x7f, 0x80, 0xff, 0x7fff, 0x8000, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0x7f800000, 0xff800000, 0x7fc00000];
function broken(bytes) {
  let out = Buffer.from(bytes);
  for (let changes = 1 + random(3); changes > 0; --changes) {
    const at = random(Math.max(out.length - 4, 1));
    switch (random(5)) {
      case 0: out[at] ^= 1 << random(8); break;
      case 1: if (out.length > 4) out.writeUInt32LE(extremes[random(extremes.length)], at); break;
      case 2: out = out.subarray(0, random(out.length + 1)); break;
      case 3: out = Buffer.concat([out, Buffer.alloc(random(5000), random(256))]); break;
      default: out.copy(out, at, random(out.length), random(out.length)); break;
    }
    out = Buffer.from(out);
  }
  return out;
}

const kinds = folder.manifest.pieces.map((p) => p.kind), scene = readPiece(folder.bytes('scene'), 'scene');
const sharp = kinds.includes('sharp') ? readPiece(folder.bytes('sharp'), 'sharp').sharp : undefined;
const whole = (kind, sections) => {
  if (kind === 'scene') checkScene(sections, 1, 1, 1);
  if (kind === 'light') for (const p of sections.pages) checkSharp(p, sharp);
  for (const m of sections.movers) checkMover(m, scene);
  if (sections.field) checkField(sections.field, scene);
  for (const g of sections.pageGroups) checkPageGroups(g, scene, scene.pages[g.page]);
};
let refused = 0, slowest = 0;
for (let i = 0; i < count; ++i) {
  const kind = kinds[i % kinds.length], bytes = broken(i % 3 === 0 ? folder.bytes(kind) : stored(folder.bytes(kind))), begin = performance.now();
  try {
    whole(kind, readPiece(new Uint8Array(bytes), kind));
  } catch (error) {
    assert.ok(error instanceof PieceError, `mutation ${i} of '${kind}': ${error.stack}`);
    assert.ok(error.message.length > 10);
    ++refused;
  }
  slowest = Math.max(slowest, performance.now() - begin);
}
// The fuzzer itself: what is whole is read, and enough of the broken ones are refused.
for (const kind of kinds) whole(kind === 'lamps' ? '' : kind, { ...readPiece(new Uint8Array(stored(folder.bytes(kind))), kind), pageGroups: [] });
assert.ok(refused > 0.3 * count && refused < count, `${refused} of ${count} refused`);
console.log(`${count} broken pieces: ${refused} refused with a reason, the others read; the slowest took ${slowest.toFixed(0)} ms`);
