// Little-endian bytes with bounds checks, as docs/notes/format.md has them. Every byte is treated as hostile.

export class PieceError extends Error {}

export class ByteReader {
  private at = 0;
  private readonly view: DataView;
  constructor(private readonly bytes: Uint8Array, private readonly name: string) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get left(): number { return this.bytes.length - this.at; }

  fail(text: string): never { throw new PieceError(`${this.name}: ${text}`); }

  private take(size: number): number {
    if (size > this.left) this.fail(`found ${this.left} bytes more, expected ${size}`);
    this.at += size;
    return this.at - size;
  }
  u8(): number { return this.view.getUint8(this.take(1)); }
  u32(): number { return this.view.getUint32(this.take(4), true); }
  u16(): number { return this.view.getUint16(this.take(2), true); }
  i32(): number { return this.view.getInt32(this.take(4), true); }
  f64(): number { return this.view.getFloat64(this.take(8), true); }
  f32(): number {
    const value = this.view.getFloat32(this.take(4), true);
    if (!Number.isFinite(value)) this.fail('found a number that is not finite');
    return value;
  }
  floats(n: number): number[] {
    const out: number[] = [];
    for (let i = 0; i < n; ++i) out.push(this.f32());
    return out;
  }
  /** A count of things of at least `size` bytes each: never more than can be there. */
  count(size: number): number {
    const n = this.u32();
    if (n * size > this.left) this.fail(`found ${n} elements in ${this.left} bytes`);
    return n;
  }
  text(): string {
    const n = this.count(1), from = this.take(n);
    return new TextDecoder().decode(this.bytes.subarray(from, from + n));
  }
  choice(most: number, what: string): number {
    const value = this.u8();
    if (value > most) this.fail(`found ${what} ${value}, expected 0 to ${most}`);
    return value;
  }
  size(most: number, what: string): number {
    const value = this.u32();
    if (value > most) this.fail(`found ${what} ${value}, expected at most ${most}`);
    return value;
  }
  /** n values of `width` bytes from byte planes with differences. */
  planes(n: number, width: number): Uint8Array {
    if (n * width > this.left) this.fail(`found ${this.left} bytes, expected ${n * width}`);
    const from = this.take(n * width), out = new Uint8Array(n * width);
    for (let b = 0; b < width; ++b) {
      let byte = 0;
      for (let i = 0, to = b, at = from + b * n; i < n; ++i, to += width) {
        byte = (byte + this.bytes[at + i]!) & 255;
        out[to] = byte;
      }
    }
    return out;
  }
  planesF32(n: number, of = 1): Float32Array {
    const out = new Float32Array(this.planes(n, 4 * of).buffer);
    for (let i = 0; i < out.length; ++i) if (!Number.isFinite(out[i])) this.fail('found a number that is not finite');
    return out;
  }
  planesU32(n: number): Uint32Array { return new Uint32Array(this.planes(n, 4).buffer); }
  planesU16(n: number, of = 1): Uint16Array { return new Uint16Array(this.planes(n, 2 * of).buffer); }
  f32s(n: number): Float32Array {
    if (4 * n > this.left) this.fail(`found ${this.left} bytes, expected ${4 * n}`);
    return Float32Array.from(this.floats(n));
  }
  u32s(n: number): Uint32Array {
    if (4 * n > this.left) this.fail(`found ${this.left} bytes, expected ${4 * n}`);
    const from = this.take(4 * n), out = new Uint32Array(n);
    for (let i = 0; i < n; ++i) out[i] = this.view.getUint32(from + 4 * i, true);
    return out;
  }
  end(): void {
    if (this.left > 0) this.fail(`found ${this.left} bytes more than expected`);
  }
}

export function halfToFloat(h: number): number {
  const exponent = (h >> 10) & 31, mantissa = h & 1023, sign = h & 0x8000 ? -1 : 1;
  if (exponent === 0) return sign * mantissa * 2 ** -24;
  return exponent === 31 ? NaN : sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
}

const float = new Float32Array(1), bits = new Uint32Array(float.buffer);
/** Of a number that is not negative; the nearest half, the largest for what is larger. */
export function halfFromFloat(value: number): number {
  if (!(value < 65504)) return 0x7bff;
  if (value < 2 ** -14) return Math.round(value * 2 ** 24);
  float[0] = value;
  const b = bits[0]! - 0x38000000, down = b >>> 13, rest = b & 0x1fff;
  return down + Number(rest > 0x1000 || (rest === 0x1000 && (down & 1) > 0));
}
