// SPDX-License-Identifier: GPL-3.0-or-later
// The data of a run: a header, and a block of text for each frame (apps/viewer/packed_run.hpp has the format).

/** Bytes of base64 text. */
function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// All 65536 half-precision numbers.
const kHalves = new Float32Array(65536);
for (let h = 0; h < 65536; h++) {
  const exponent = (h >> 10) & 31, fraction = h & 1023;
  const magnitude = exponent === 0 ? fraction * 2 ** -24
    : exponent === 31 ? (fraction ? NaN : Infinity) : (1024 + fraction) * 2 ** (exponent - 25);
  kHalves[h] = h & 32768 ? -magnitude : magnitude;
}

const kSize = { u16: 2, f16: 2, f32: 4, f64: 8, i32: 4 };
const kStored = { u16: Uint16Array, f16: Uint16Array, f32: Float32Array, f64: Float64Array, i32: Int32Array };

/** The bytes come sorted: first the lowest byte of every number, then the next. */
function numbersOf(bytes, type) {
  const size = kSize[type], count = bytes.length / size;
  if (!Number.isInteger(count)) throw new Error('an array is no whole number of values');
  const sorted = new Uint8Array(bytes.length);
  for (let k = 0; k < size; k++)
    for (let i = 0; i < count; i++) sorted[i * size + k] = bytes[k * count + i];
  return new kStored[type](sorted.buffer);
}

/** Steps from the ways (0, 1, 2, 3, ... for 0, -1, 1, -2, ...) from earlier ones; they may be outside of the box of those. */
const stepsFrom = (before, ways) => Int32Array.from(ways, (way, i) => before[i] + ((way >>> 1) ^ -(way & 1)));

/** Numbers of an array, one point or cell after the other, from how they are stored: one component after the other. */
function decoded(bytes, record, before) {
  const { type, components, count } = record;
  const stored = before ? stepsFrom(numbersOf(before, type), numbersOf(bytes, type)) : numbersOf(bytes, type);
  if (stored.length !== components * count)
    throw new Error(`${record.name}: ${stored.length} numbers instead of ${components * count}`);
  if (type === 'i32') for (let i = 1; i < stored.length; i++) stored[i] += stored[i - 1];
  const Values = type === 'i32' ? Int32Array : type === 'f64' ? Float64Array : Float32Array;
  const values = new Values(stored.length);
  for (let c = 0; c < components; c++) {
    const lo = record.lo ? record.lo[c] : 0, step = record.lo ? (record.hi[c] - lo) / 65535 : 0;
    for (let i = 0; i < count; i++) {
      const s = stored[c * count + i];
      values[i * components + c] = type === 'u16' ? lo + step * s : type === 'f16' ? kHalves[s] * record.scale : s;
    }
  }
  return values;
}

/** Keeps what was used last, up to a number of bytes. */
class Cache {
  constructor(limit) { this.limit = limit; this.size = 0; this.map = new Map(); }
  get(key) {
    const hit = this.map.get(key);
    if (hit !== undefined) { this.map.delete(key); this.map.set(key, hit); }
    return hit?.value;
  }
  put(key, value, size) {
    this.size -= this.map.get(key)?.size ?? 0;
    this.map.delete(key);
    this.map.set(key, { value, size });
    this.size += size;
    for (const [old, entry] of this.map) {
      if (this.size <= this.limit || old === key) break;
      this.map.delete(old);
      this.size -= entry.size;
    }
    return value;
  }
  clear() { this.map.clear(); this.size = 0; }
}

export class Run {
  constructor(header, fetchBlock) {
    this.header = header;
    this.fetchBlock = fetchBlock;
    this.blocks = new Cache(256e6);
    this.arrays = new Cache(512e6);
  }

  /** The header and blocks of this page; those of a running simulation come from its server. */
  static async open() {
    const live = document.getElementById('plekton-live');
    if (!live) {
      const header = JSON.parse(document.getElementById('plekton-run').textContent);
      return new Run(header, async (id) => {
        const element = document.getElementById('block-' + id);
        if (!element) throw new Error('block ' + id + ' is missing: the file is cut off');
        return element.textContent;
      });
    }
    const run = new Run(await (await fetch('header')).json(), null);
    run.fetchBlock = async (id) => {
      const answer = await fetch(`block/${run.header.generation}/${id}`);
      if (!answer.ok) throw new Error('block ' + id + ': ' + answer.statusText);
      return answer.text();
    };
    run.live = true;
    return run;
  }

  /** Asks the server for what is new. Of a run that was begun anew and has no frame yet, what was before stays. @returns whether there is something */
  async refresh() {
    const header = await (await fetch('header')).json();
    const before = this.header;
    if (header.version === before.version || !header.frames.length) return false;
    if (header.generation !== before.generation) { this.blocks.clear(); this.arrays.clear(); }
    this.header = header;
    return true;
  }

  get frames() { return this.header.frames; }

  async block(id) {
    const key = `${this.header.generation}/${id}`;
    const hit = this.blocks.get(key);
    if (hit) return hit;
    const text = await this.fetchBlock(id);
    const end = text.indexOf('.');
    if (end < 0) throw new Error('block ' + id + ' is damaged');
    const directory = JSON.parse(new TextDecoder().decode(await inflate(bytesOf(text.slice(0, end)))));
    return this.blocks.put(key, { directory, chunks: text.slice(end + 1) }, text.length);
  }

  /** Bytes at a place: [block, offset, length]. */
  async bytesAt([block, offset, length]) {
    const { chunks } = await this.block(block);
    if (offset + length > chunks.length) throw new Error('block ' + block + ' is cut off');
    return inflate(bytesOf(chunks.slice(offset, offset + length)));
  }

  async values(record) {
    const [block, offset] = record.at;
    const key = `${this.header.generation}/${block}/${offset}/${record.key ?? ''}/${record.type}/${record.scale ?? record.lo}/${record.hi ?? ''}/${record.components}`;
    const hit = this.arrays.get(key);
    if (hit) return hit;
    const values = decoded(await this.bytesAt(record.at), record, record.key && await this.bytesAt(record.key));
    return this.arrays.put(key, values, values.byteLength);
  }

  /** Records of the arrays of a part (grains, membranes, contacts) of a frame. */
  async records(frame, part) {
    return (await this.block(this.frames[frame].block)).directory[part] ?? [];
  }

  /** An array of a frame; nothing if it has none. */
  async array(frame, part, on, name) {
    const record = (await this.records(frame, part)).find((r) => r.on === on && r.name === name);
    return record ? this.values(record) : null;
  }

  /** Files of histories: [{file, columns: [{name, unit, values}]}]. */
  async histories() {
    if (!this.header.histories) return [];
    const { directory } = await this.block(this.header.histories);
    return Promise.all(directory.map(async ({ file, columns }) => ({
      file,
      columns: await Promise.all(columns.map(async (c) => ({ name: c.name, unit: c.unit, values: await this.values(c) }))),
    })));
  }

  field(part, name, on) {
    return this.header.fields[part]?.find((f) => f.name === name && (!on || f.on === on));
  }
}
