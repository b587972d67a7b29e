// SPDX-License-Identifier: Apache-2.0
// Writes streams of npm's meshoptimizer and what its own decoder makes of them, for MeshoptLibraryTest.cpp:
//   node meshopt_streams.mjs FOLDER_WITH_NODE_MODULES OUTPUT
// A record: mode, filter, isKhr, stride, count, bytes of the stream, bytes of the result (uint32 each), stream, result.
import { writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const require = createRequire(pathToFileURL(process.argv[2] + '/'));
const load = async (name) => import(pathToFileURL(require.resolve('meshoptimizer/' + name)));
const { MeshoptEncoder: encoder } = await load('encoder');
const { MeshoptDecoder: decoder } = await load('decoder');
await encoder.ready;
await decoder.ready;

const kModes = ['ATTRIBUTES', 'TRIANGLES', 'INDICES'];
const kFilters = ['NONE', 'OCTAHEDRAL', 'QUATERNION', 'EXPONENTIAL', 'COLOR'];
const kCounts = [1, 2, 15, 16, 17, 31, 64, 255, 256, 257, 511, 512, 513, 1000, 2049];

let state = 1;
const random = () => { // xorshift32: the same streams in every run
  state ^= state << 13;
  state ^= state >>> 17;
  state ^= state << 5;
  return (state >>> 0) / 2 ** 32;
};
const below = (n) => Math.floor(random() * n);
const pick = (list) => list[below(list.length)];

const records = [];
const add = (mode, filter, version, stride, count, stream) => {
  const result = new Uint8Array(stride * count);
  decoder.decodeGltfBuffer(result, count, stride, stream, mode, filter);
  const head = [kModes.indexOf(mode), kFilters.indexOf(filter), version, stride, count, stream.length, result.length];
  records.push(new Uint8Array(new Uint32Array(head).buffer), stream, result);
};

// ------------------------------------------------------------------------------------------------- attributes
const kShapes = {
  noise: (view, at) => view.setUint32(at, random() * 2 ** 32, true),
  constant: (view, at) => view.setUint32(at, 0x01020304, true),
  bytes: (view, at, i) => view.setUint32(at, (i & 255) | ((i * 3) & 255) << 8 | below(2) << 16 | below(4) << 24, true),
  words: (view, at, i) => { view.setUint16(at, i * 7 + below(40), true); view.setInt16(at + 2, -i + below(9), true); },
  floats: (view, at, i) => view.setFloat32(at, 100 + i * 0.01 + random() * 0.001, true),
  sparse: (view, at) => view.setUint32(at, random() < 0.1 ? below(2 ** 31) : 0, true),
  bits: (view, at) => view.setUint32(at, below(4) * 0x01010101, true),
};
const attributes = (stride, count, shapes) => {
  const bytes = new Uint8Array(stride * count), view = new DataView(bytes.buffer);
  for (let channel = 0; channel < stride / 4; ++channel) {
    const shape = kShapes[shapes[channel % shapes.length]];
    for (let i = 0; i < count; ++i) shape(view, i * stride + channel * 4, i);
  }
  return bytes;
};
const kNames = Object.keys(kShapes);
for (let stride = 4; stride <= 256; stride += 4) {
  for (let i = 0; i < 4; ++i) {
    const count = pick(kCounts), version = i & 1, level = below(4);
    const shapes = i < 2 ? [pick(kNames)] : Array.from({ length: 8 }, () => pick(kNames));
    const source = attributes(stride, count, shapes);
    add('ATTRIBUTES', 'NONE', version, stride, count,
        encoder.encodeVertexBufferLevel(source, count, stride, level, version));
  }
}
for (const count of kCounts) {
  for (const name of kNames) {
    for (const version of [0, 1]) {
      add('ATTRIBUTES', 'NONE', version, 12, count,
          encoder.encodeVertexBufferLevel(attributes(12, count, [name]), count, 12, 3, version));
    }
  }
}

// --------------------------------------------------------------------------------------------------- filters
const filtered = (filter, stride, count, encoded) => {
  for (const version of filter === 'COLOR' ? [1] : [0, 1]) {
    add('ATTRIBUTES', filter, version, stride, count,
        encoder.encodeVertexBufferLevel(encoded, count, stride, below(4), version));
  }
};
const vectors = (count) => { // unit length
  const values = new Float32Array(count * 4);
  for (let i = 0; i < count; ++i) {
    const v = i < 8 ? [0, 1, 2, 3].map((k) => (k === i >> 1 ? 1 - 2 * (i & 1) : 0)) // the axes
        : [0, 1, 2, 3].map(() => random() * 2 - 1);
    const length = Math.hypot(...v);
    v.forEach((x, k) => { values[i * 4 + k] = x / length; });
  }
  return values;
};
for (let bits = 2; bits <= 16; ++bits) {
  const count = pick(kCounts), directions = vectors(count);
  for (let i = 0; i < count; ++i) { // three components of unit length, the fourth is free
    const [x, y, z] = directions.slice(i * 4, i * 4 + 3), length = Math.hypot(x, y, z) || 1;
    directions.set(length === 1 && x + y + z === 0 ? [0, 0, 1, -1] : [x / length, y / length, z / length, 1], i * 4);
  }
  const colors = Float32Array.from({ length: count * 4 }, (_, i) => (i < 16 ? i >> 2 & 1 : random()));
  for (const stride of bits <= 8 ? [4, 8] : [8]) {
    filtered('OCTAHEDRAL', stride, count, encoder.encodeFilterOct(directions, count, stride, bits));
    filtered('COLOR', stride, count, encoder.encodeFilterColor(colors, count, stride, bits));
  }
  if (bits >= 4) filtered('QUATERNION', 8, count, encoder.encodeFilterQuat(vectors(count), count, 8, bits));
}
for (const mode of ['Separate', 'SharedVector', 'SharedComponent', 'Clamped']) {
  for (const bits of [1, 2, 8, 12, 16, 23, 24]) {
    const count = pick(kCounts), stride = 4 * (1 + below(16)), scale = 10 ** (below(30) - 15);
    const values = Float32Array.from({ length: count * stride / 4 }, () => (random() * 2 - 1) * scale);
    values[0] = 0;
    filtered('EXPONENTIAL', stride, count, encoder.encodeFilterExp(values, count, stride, bits, mode));
  }
}

// --------------------------------------------------------------------------------------------------- indices
const grid = (width, height) => {
  const list = [];
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const a = y * (width + 1) + x, b = a + width + 1;
      list.push(a, a + 1, b, b, a + 1, b + 1);
    }
  }
  return list;
};
const bytesOf = (list, stride) =>
    new Uint8Array((stride === 2 ? Uint16Array.from(list) : Uint32Array.from(list)).buffer);
const meshes = [[], [0, 1, 2], [2, 1, 0], [5, 5, 5], grid(1, 1), grid(7, 5), grid(31, 20), grid(100, 100)];
meshes.push([...grid(5, 5), ...grid(5, 5)], grid(9, 9).reverse());
for (let i = 0; i < 20; ++i) meshes.push(Array.from({ length: 3 * (1 + below(400)) }, () => below(2 ** (1 + below(16)))));
for (const list of meshes) {
  for (const stride of [2, 4]) {
    const bytes = bytesOf(list, stride);
    add('TRIANGLES', 'NONE', 1, stride, list.length, encoder.encodeIndexBuffer(bytes, list.length, stride));
    add('INDICES', 'NONE', 1, stride, list.length, encoder.encodeIndexSequence(bytes, list.length, stride));
  }
}
const large = Array.from({ length: 999 }, () => below(2 ** 32));
add('TRIANGLES', 'NONE', 1, 4, large.length, encoder.encodeIndexBuffer(bytesOf(large, 4), large.length, 4));
const ordered = Uint32Array.from(grid(40, 40));
encoder.reorderMesh(ordered, true, true);
add('TRIANGLES', 'NONE', 1, 4, ordered.length, encoder.encodeIndexBuffer(bytesOf(ordered, 4), ordered.length, 4));
const strip = Array.from({ length: 5000 }, (_, i) => (i % 2) * 70000 + (i >> 1));
add('INDICES', 'NONE', 1, 4, strip.length, encoder.encodeIndexSequence(bytesOf(strip, 4), strip.length, 4));

writeFileSync(process.argv[3], Buffer.concat(records));
