// SPDX-License-Identifier: GPL-3.0-or-later
// The run inside the page: JSON in #run-meta, arrays as zlib + base64 in #run-data.
// Written by postprocess/report/pack.cpp and viewer_data.cpp.

const TYPES = { u8: Uint8Array, i16: Int16Array, u16: Uint16Array, u32: Uint32Array,
  f32: Float32Array };

/** The bytes of a base64 text that holds a zlib stream. */
async function inflate(base64) {
  const packed = Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/**
 * Undoes pack.cpp's coding of 16-bit series: low bytes of all values, then high bytes; every
 * channel of `rows` values is differenced `order` times, modulo 65536.
 */
export function decodeSeries(bytes, rows, order) {
  const count = bytes.length / 2;
  const values = new Int16Array(count);
  for (let k = 0; k < count; ++k) values[k] = bytes[k] | (bytes[count + k] << 8);
  for (let pass = 0; pass < order; ++pass)
    for (let first = 0; first < count; first += rows)
      for (let k = first + 1; k < first + rows; ++k) values[k] += values[k - 1];
  return values;
}

function makeArray(buffer, a) {
  if (a.order === undefined) return new TYPES[a.type](buffer, a.offset, a.count);
  return decodeSeries(new Uint8Array(buffer, a.offset, 2 * a.count), a.rows, a.order);
}

/** { meta, arrays: name -> typed array } of the page's run. */
export async function readRun() {
  const meta = JSON.parse(document.getElementById('run-meta').textContent);
  const buffer = await inflate(document.getElementById('run-data').textContent);
  const arrays = {};
  for (const [name, a] of Object.entries(meta.arrays)) arrays[name] = makeArray(buffer, a);
  return { meta, arrays };
}

/** Row and fraction of a place in rising values, e.g. of a time among frames. */
export function findPlace(values, x) {
  let low = 0;
  let high = values.length - 1;
  if (high < 1 || x <= values[0]) return { row: 0, part: 0 };
  if (x >= values[high]) return { row: high - 1, part: 1 };
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= x) low = middle;
    else high = middle;
  }
  return { row: low, part: (x - values[low]) / (values[high] - values[low]) };
}
