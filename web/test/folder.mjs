// A walkthrough's files, to be changed and signed anew: what somebody would hand out who wants to harm.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';

const integrity = (bytes) => `sha256-${createHash('sha256').update(bytes).digest('base64')}`;

export class Folder {
  constructor(folder) {
    this.files = new Map();
    const add = (at) => {
      for (const name of readdirSync(join(folder, at))) {
        const path = join(at, name);
        if (statSync(join(folder, path)).isDirectory()) add(path);
        else this.files.set(path, readFileSync(join(folder, path)));
      }
    };
    add('');
    this.page = this.files.get('index.html').toString();
    this.manifestName = /data-pieces="([^"]+)"/.exec(this.page)[1];
    this.manifest = JSON.parse(this.files.get(this.manifestName));
  }
  piece(kind) { return this.manifest.pieces.find((p) => p.kind === kind); }
  bytes(kind) { return Buffer.from(this.files.get(this.piece(kind).file)); }

  /** The files with other pieces, by kind, and another manifest, all with the hashes that they have then. */
  signed(pieces = {}, change = (text) => text) {
    const files = new Map(this.files), manifest = structuredClone(this.manifest);
    for (const [kind, bytes] of Object.entries(pieces)) {
      const piece = manifest.pieces.find((p) => p.kind === kind);
      piece.bytes = bytes.length, piece.integrity = integrity(bytes);
      files.set(piece.file, bytes);
    }
    const text = Buffer.from(change(JSON.stringify(manifest)));
    files.set(this.manifestName, text);
    files.set('index.html', Buffer.from(this.page.replace(/data-integrity="[^"]+"/, `data-integrity="${integrity(text)}"`)));
    return files;
  }
}
