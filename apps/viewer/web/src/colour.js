// SPDX-License-Identifier: GPL-3.0-or-later
// Colour maps. All but those of categories have lightness that rises or falls steadily, and hues that people who
// are colour-blind tell apart.
//
// Sources: viridis and inferno, Smith and van der Walt (2015), CC0; cividis, Nunez, Anderton, Renslow (2018),
// PLOS ONE 13(7); sand and blue-orange are our own; categories, Okabe and Ito (2008), "Color universal design".

const hex = (text) => text.match(/[0-9a-f]{6}/gi).map((h) => [0, 2, 4].map((k) => parseInt(h.slice(k, k + 2), 16)));

export const kMaps = {
  viridis: hex('440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725'),
  cividis: hex('00204d 00336f 39486b 575c6d 707173 8a8779 a69d75 c4b56c e4cf5b ffea46'),
  inferno: hex('000004 160b39 420a68 6a176e 932667 bc3754 dd513a f37819 fca50a f6d746 fcffa4'),
  sand: hex('f4efe4 eadcbd ddbf83 cf9a4c b3712c 8b4a1b 5c2a12 35150c'),
  'blue-orange': hex('12436d 28679b 5b93bd 9cbfd8 dde3e6 ecd3b4 e3a566 c2711f 8a4308'),
  greys: hex('2b2f33 e9ecee'),
};
export const kCategories = hex('e69f00 56b4e9 009e73 0072b2 d55e00 cc79a7 f0e442 8d8d8d');

/** Colour (0..255) at t in [0, 1]. */
export function colourAt(map, t) {
  const stops = kMaps[map], x = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2), f = x - i;
  return stops[i].map((a, k) => a + f * (stops[i + 1][k] - a));
}

/** 256 colours as RGBA bytes, for a texture; of categories 8, over and over. */
export function mapBytes(map) {
  const bytes = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; i++) {
    const c = map === 'categories' ? kCategories[i % 8] : colourAt(map, i / 255);
    bytes.set([...c.map(Math.round), 255], 4 * i);
  }
  return bytes;
}

/** Round numbers from lo to hi, about as many as asked for. */
export function ticks(lo, hi, about) {
  const span = hi - lo;
  if (!(span > 0)) return [lo];
  const rough = span / about, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * span; k++) found.push(k * step);
  return found;
}

const kPrefixes = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p']];
const kPlain = new Set(['', 's', '1']);

/** Factor and name of the unit in which numbers up to this size are short, as in [1e-3, 'mm']. */
export function shortUnit(size, unit) {
  if (unit === '' || !(size > 0) || kPlain.has(unit) && size >= 1e-2) return [1, unit];
  if (/^m[23]$/.test(unit)) return [1, unit];  // a prefix would be squared or cubed with it
  const [factor, prefix] = (size >= 0.1 && size < 1 ? [1, ''] : kPrefixes.find(([f]) => size >= 0.9999 * f)) ?? kPrefixes[kPrefixes.length - 1];
  if (unit.startsWith('rad') && factor < 1) return [1, unit];
  return [factor, prefix + unit];
}

/** Three digits, which is what the values of frames have. */
export function short(x, digits = 3) {
  if (!Number.isFinite(x)) return '–';
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-4) return x.toExponential(digits - 1).replace('e+', 'e').replace('-', '−').replace('e-', 'e−');
  return String(Number(x.toPrecision(digits))).replace('-', '−');
}

/** A value with its unit, as in "12.3 mm". */
export function withUnit(x, unit, digits = 3) {
  const [factor, name] = shortUnit(Math.abs(x), unit);
  return short(x / factor, digits) + (name ? ' ' + name : '');
}
