// The files of a walkthrough: a manifest and pieces, each compared with its hash by the browser itself.
import { PieceError } from './bytes';

export const webVersion = 2;
export interface Piece { kind: string; index: number; file: string; bytes: number; integrity: string; }
export interface Manifest { version: number; title: string; pieces: Piece[]; }

async function load(file: string, integrity: string): Promise<Uint8Array> {
  let response: Response;
  try {
    response = await fetch(file, { integrity });
  } catch {
    throw new PieceError(`${file} did not come, or is not the one that this page was made with`);
  }
  if (!response.ok) throw new PieceError(`${file}: ${response.status} ${response.statusText}`);
  return new Uint8Array(await response.arrayBuffer());
}

export async function loadManifest(file: string, integrity: string): Promise<Manifest> {
  const manifest = JSON.parse(new TextDecoder().decode(await load(file, integrity))) as Manifest;
  if (manifest.version !== webVersion)
    throw new PieceError(`${file} is of version ${manifest.version}, this viewer of ${webVersion}: write the folder anew`);
  for (const p of manifest.pieces)
    if (!/^pieces\/[a-z]+-[0-9a-f]+\.oriel$/.test(p.file) || !(p.bytes > 0) || !(p.index >= 0)) throw new PieceError(`${file}: found piece '${p.file}'`);
  return manifest;
}

export async function loadPiece(piece: Piece): Promise<Uint8Array> {
  const bytes = await load(piece.file, piece.integrity);
  if (bytes.length !== piece.bytes) throw new PieceError(`${piece.file}: found ${bytes.length} bytes, expected ${piece.bytes}`);
  return bytes;
}
