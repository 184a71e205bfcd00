// SPDX-License-Identifier: Apache-2.0
// Loads the decoder's WebAssembly module and calls it. The module is built without JavaScript of
// emscripten's, so this file is all of its glue. Nothing here waits: it runs in a worker as well.
import {TksError} from './error.js';

export const SAMPLES = [
  Uint8Array, Int8Array, Uint16Array, Int16Array, Uint32Array, Int32Array, Float32Array,
];
/** Magic, version, profile, level and a varint: these tell how many bytes the header takes. */
const MOST_BEFORE_BODY = 17;
const BUDGET_MESH = 1;
export const MESSAGE_BYTES = 400;
/** A module counts its memory by 32 bits: of more bytes malloc would see the lower bits only. */
const ADDRESSES = 2 ** 32;

/** A function with a vector in it: engines without SIMD refuse it. */
const VECTOR_FUNCTION = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15,
  253, 98, 11,
]);
export const hasVectors = () => WebAssembly.validate(VECTOR_FUNCTION);

/** What a module imports: a notice that memory grew, and an exit that only an abort calls. */
function importsOf(module, given) {
  const imports = {};
  for (const {module: space, name} of WebAssembly.Module.imports(module)) {
    const abort = () => {
      throw new WebAssembly.RuntimeError(`aborted in ${name}`);
    };
    const known = given[name] ?? (name.startsWith('emscripten_notify') ? () => {} : abort);
    (imports[space] ??= {})[name] = known;
  }
  return imports;
}

/** An instance with the few operations on its memory that codecs need. */
export class Instance {
  /** given: functions that the module imports. */
  constructor(module, given = {}) {
    this.calls = new WebAssembly.Instance(module, importsOf(module, given)).exports;
    this.calls._initialize?.();
  }
  /**
   * Anew at each use: growing memory detaches the old buffer. Addresses above 2 GiB, which functions
   * of the module give as negative numbers, are made whole here.
   */
  view(Type, address, length) {
    return new Type(this.calls.memory.buffer, address >>> 0, length);
  }
  copy(Type, address, length) {
    return this.view(Type, address, length).slice();
  }
  text(address) {
    const bytes = this.view(Uint8Array, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }
  /** Memory to be freed. */
  allocate(bytes) {
    const address = bytes < ADDRESSES ? this.calls.malloc(Math.max(bytes, 1)) : 0;
    if (address === 0) throw new TksError('memory', `There is no memory for ${bytes} bytes more.`);
    return address;
  }
  /** Calls `use` with memory that is freed afterwards. */
  with(bytes, use) {
    const address = this.allocate(bytes);
    try {
      return use(address);
    } finally {
      this.calls.free(address);
    }
  }
}

/** Mip level at which neither side has more than `most` samples. */
function levelFor(width, height, most, coarsest) {
  let level = 0;
  while (level < coarsest && Math.max(width, height) / 2 ** level > most) ++level;
  return level;
}

/**
 * A stream that is open, as far as its bytes have come. It decodes on from where it was when more
 * of them do. Close it.
 */
class Opened {
  #header;  // a copy, which the decoder reads until it gets more bytes
  /** first: gives so many of the first bytes, as far as they are here. */
  constructor(instance, first, memory) {
    this.instance = instance;
    const {calls} = instance;
    const needed = Opened.#headerBytes(instance, first(MOST_BEFORE_BODY));
    const header = first(needed);
    this.size = header.length;
    this.#header = instance.allocate(this.size);
    instance.view(Uint8Array, this.#header, this.size).set(header);
    instance.with(4 + MESSAGE_BYTES, (out) => {
      const status = calls.web_open(this.#header, this.size, memory, out, out + 4, MESSAGE_BYTES);
      if (status !== 0) {
        calls.free(this.#header);
        throw Object.assign(TksError.ofStatus(status, instance.text(out + 4)), {needed});
      }
      [this.decoder] = instance.view(Uint32Array, out, 1);
    });
    this.hasIndex = calls.web_has_index(this.decoder) !== 0;
  }
  /** Of what is no header so many bytes that decoders refuse them. */
  static #headerBytes(instance, first) {
    return instance.with(8 + first.length, (out) => {
      instance.view(Uint8Array, out + 8, first.length).set(first);
      instance.calls.tks_header_bytes(out + 8, first.length, out);
      return instance.view(Uint32Array, out, 1)[0] || first.length;  // below 2^21
    });
  }
  /** More bytes, from this place of the stream on. */
  put(place, bytes) {
    const {instance} = this;
    instance.with(bytes.length, (address) => {
      instance.view(Uint8Array, address, bytes.length).set(bytes);
      this.check(instance.calls.web_put(this.decoder, place, address, bytes.length));
    });
    this.size += bytes.length;
  }
  /** Ranges {begin, end, gain} of a call that writes their count and their address. */
  #ranges(call) {
    const {instance} = this;
    return instance.with(8, (out) => {
      this.check(call(out));
      const [count, address] = instance.copy(Uint32Array, out, 2);
      const numbers = instance.copy(Float64Array, address, 3 * count);
      instance.calls.free(address);
      return Array.from({length: count}, (_, i) => {
        const [begin, end, gain] = numbers.subarray(3 * i);
        return {begin, end, gain};
      });
    });
  }
  /** What to fetch next for a view {clip, width, height}. */
  plan({view, bytes, triangles, requestBytes}) {
    const {instance} = this;
    return instance.with(21 * 8, (limits) => {
      instance.view(Float64Array, limits, 21)
        .set([bytes, triangles, requestBytes, view.width, view.height, ...view.clip]);
      return this.#ranges((out) =>
        instance.calls.web_plan(this.decoder, limits, limits + 3 * 8, out));
    });
  }
  /** What a window {x, y, width, height} of a part of tks_part takes. */
  needed(part, {x, y, width, height}) {
    const {instance} = this;
    return instance.with(16, (window) => {
      instance.view(Uint32Array, window, 4).set([x, y, width, height]);
      return this.#ranges((out) => instance.calls.web_needed(this.decoder, part, window, out));
    });
  }
  close() {
    this.instance.calls.tks_close(this.decoder);
    this.instance.calls.free(this.#header);
  }
  check(status) {
    if (status === 0) return;
    throw TksError.ofStatus(status, this.instance.text(this.instance.calls.tks_message(this.decoder)));
  }
  setLevels(heights, texture) {
    this.check(this.instance.calls.tks_set_levels(this.decoder, heights, texture));
  }

  info() {
    const {instance, decoder} = this;
    const names = instance.text(instance.calls.web_names()).split(' ');
    const numbers = instance.with(8 * names.length, (out) => {
      this.check(instance.calls.web_numbers(decoder, out));
      return instance.copy(Float64Array, out, names.length);
    });
    const info = Object.fromEntries(names.map((name, i) => [name, numbers[i]]));
    for (const name of Object.keys(info)) {
      if (/^(h|textureH)as[A-Z]|^(lossless|textureOpaque|voidsKnown)$/.test(name))
        info[name] = info[name] !== 0;
    }
    const gather = (letter) =>
      Array.from({length: 6}, (_, i) => {
        const value = info[letter + i];
        delete info[letter + i];
        return value;
      });
    info.hasIndex = this.hasIndex;
    info.geotransform = gather('g');
    info.textureGeotransform = gather('t');
    const texts = ['unit', 'verticalDatum', 'crs', 'textureCrs'];
    texts.forEach((name, i) => (info[name] = instance.text(instance.calls.web_text(decoder, i))));
    return info;
  }

  /** What a call writes into memory of `length` elements. */
  decoded(name, Type, length, size) {
    const bytes = length * Type.BYTES_PER_ELEMENT;
    return this.instance.with(bytes, (out) => {
      this.check(this.instance.calls[name](this.decoder, out, size ?? length));
      return this.instance.copy(Type, out, length);
    });
  }
  heights(info) {
    const Type = SAMPLES[info.sample], length = info.width * info.height;
    return this.decoded('tks_decode_heights', Type, length, length * Type.BYTES_PER_ELEMENT);
  }
  surface(info) {
    return this.decoded('tks_decode_surface', Float32Array, info.width * info.height);
  }
  texels(info) {
    const Type = SAMPLES[info.textureSample];
    const length = info.textureWidth * info.textureHeight * info.textureChannels;
    return this.decoded('tks_decode_texture', Type, length, length * Type.BYTES_PER_ELEMENT);
  }
  rgba(info) {
    const {instance} = this, count = info.textureWidth * info.textureHeight;
    const bytes = count * info.textureChannels * SAMPLES[info.textureSample].BYTES_PER_ELEMENT;
    return instance.with(bytes, (texels) => {
      this.check(instance.calls.tks_decode_texture(this.decoder, texels, bytes));
      return instance.with(4 * count, (out) => {
        instance.calls.web_rgba(texels, out, count, info.textureChannels, info.textureSample,
          Number(info.textureOpaque));
        return instance.copy(Uint8ClampedArray, out, 4 * count);
      });
    });
  }

  /** tks_mesh at `out`: two counts, three addresses. */
  #meshAt(out) {
    const {instance} = this;
    const [vertices, faces, grid, heights, triangles] = instance.copy(Uint32Array, out, 5);
    const mesh = {
      gridIndex: instance.copy(Uint32Array, grid, vertices),
      heights: instance.copy(Float32Array, heights, vertices),
      triangles: instance.copy(Uint32Array, triangles, 3 * faces),
    };
    instance.calls.tks_free_mesh(out);
    return mesh;
  }
  mesh(triangles, view) {
    const {instance, decoder} = this, {calls} = instance;
    if (!calls.tks_decode_mesh) throw new TksError('usage', 'This module makes no meshes.');
    if (!view) {
      return instance.with(20, (out) => {
        this.check(calls.tks_decode_mesh(decoder, BUDGET_MESH, triangles, out));
        return this.#meshAt(out);
      });
    }
    return instance.with(20 + 4 + 128, (out) => {
      this.check(calls.tks_decode_mesh_tree(decoder, BUDGET_MESH, triangles, out + 20));
      const [tree] = instance.view(Uint32Array, out + 20, 1);
      instance.view(Float64Array, out + 24, 16).set(view);
      const status = calls.tks_view_mesh(tree, out + 24, out);
      calls.tks_free_mesh_tree(tree);
      if (status !== 0) throw TksError.ofStatus(status, 'The view is not a matrix of 16 numbers.');
      return this.#meshAt(out);
    });
  }
}

/**
 * Unit normals of a mesh's vertices by central differences of a surface: x along the rows, y up,
 * z down the rows. Cells beside voids count as flat.
 */
function normalsOf(mesh, width, level, surface, scale) {
  const normals = new Float32Array(3 * mesh.gridIndex.length);
  const side = 2 ** level, {data, width: w, height: h} = surface;
  const slope = (a, b, distance) => (distance > 0 && a === a && b === b ? (b - a) / distance : 0);
  mesh.gridIndex.forEach((index, i) => {
    const x = Math.min(Math.round((index % width) / side), w - 1);
    const y = Math.min(Math.round(Math.floor(index / width) / side), h - 1);
    const left = Math.max(x - 1, 0), right = Math.min(x + 1, w - 1);
    const above = Math.max(y - 1, 0), below = Math.min(y + 1, h - 1);
    const across = data[y * w + x];
    const dx = slope(data[y * w + left] ?? across, data[y * w + right], (right - left) * side);
    const dz = slope(data[above * w + x] ?? across, data[below * w + x], (below - above) * side);
    const nx = (-dx * scale.height) / scale.x, nz = (-dz * scale.height) / scale.y;
    const length = Math.hypot(nx, 1, nz);
    normals.set([nx / length, 1 / length, nz / length], 3 * i);
  });
  return normals;
}

const METRES = {ft: 0.3048, foot: 0.3048, feet: 0.3048, 'us-ft': 1200 / 3937};

/** Metres of one unit of height, of one column and of one row; where nothing is stated, 1. */
export function groundScale(info) {
  return {
    height: METRES[info.unit.toLowerCase()] ?? 1,
    x: info.spacingX > 0 ? info.spacingX : 1,
    y: info.spacingY > 0 ? info.spacingY : info.spacingX > 0 ? info.spacingX : 1,
  };
}

/** Enough for shading, in the time of a first picture. */
const NORMAL_SAMPLES = 1024;

/** Makes the parts of a frame that `request` asks for, one at each step; returns them all. */
function* partsOf(opened, info, request) {
  const parts = {};
  const textureLevel =
    request.textureLevel ??
    levelFor(info.textureWidth, info.textureHeight, request.texels, info.textureCoarsestLevel);
  const surfaceLevel =
    request.surfaceLevel ?? levelFor(info.width, info.height, request.samples, info.coarsestLevel);
  if (request.mesh && info.hasHeights) {
    parts.mesh = opened.mesh(request.triangles, request.cut);
    yield;
  }
  const shown = (level) => {
    opened.setLevels(Math.min(level, info.coarsestLevel), info.hasTexture ? textureLevel : 0);
    return opened.info();
  };
  const surfaceAt = (level) => {
    const at = shown(level);
    return {level, width: at.width, height: at.height, spacingX: at.spacingX,
      spacingY: at.spacingY, geotransform: at.geotransform, data: opened.surface(at)};
  };
  if (request.surface && info.hasHeights) {
    parts.surface = surfaceAt(surfaceLevel);
    yield;
  }
  if (request.normals && parts.mesh) {
    const level = levelFor(info.width, info.height, NORMAL_SAMPLES, info.coarsestLevel);
    const surface = parts.surface?.level === level ? parts.surface : surfaceAt(level);
    parts.mesh.normals = normalsOf(parts.mesh, info.width, level, surface, groundScale(info));
    yield;
  }
  if (request.texture && info.hasTexture) {
    const at = shown(0);
    parts.texture = {level: textureLevel, width: at.textureWidth, height: at.textureHeight,
      geotransform: at.textureGeotransform, data: opened.rgba(at)};
  }
  return parts;
}

/** What steps return at their end. */
function lastOf(steps) {
  for (;;) {
    const {done, value} = steps.next();
    if (done) return value;
  }
}

/**
 * Decodes one stream from the first so many bytes that came. They live here, so that fewer than
 * before can be decoded anew, and an instance that aborted be replaced.
 */
export class Decoder {
  #instance = null;
  #opened = null;
  #chunks = [];  // in the order in which they came
  #length = 0;

  constructor(module, memory) {
    this.module = module;
    this.memory = memory;
  }

  /** Bytes that are not here yet, from a place of the stream on. All of its header comes first. */
  put({place, chunk}) {
    this.#chunks.push({place, bytes: chunk, before: this.#length});
    this.#length += chunk.length;
  }
  /** The same, of bytes that come in the order of the stream. */
  append(bytes) {
    this.put({place: this.#length, chunk: bytes});
  }

  #first(size) {
    const first = new Uint8Array(size);
    let length = 0;
    for (const {bytes} of this.#chunks) {
      if (length === size) break;
      const part = bytes.subarray(0, size - length);
      first.set(part, length);
      length += part.length;
    }
    return first.subarray(0, length);
  }
  /** Those behind the ones that were open cost what they tell. */
  #openedTo(size) {
    if (this.#opened && this.#opened.size > size) this.#close();
    this.#instance ??= new Instance(this.module);
    this.#opened ??= new Opened(
      this.#instance, (bytes) => this.#first(Math.min(bytes, size)), this.memory);
    for (const {place, bytes, before} of this.#chunks) {
      const from = Math.max(this.#opened.size - before, 0);
      const part = bytes.subarray(from, Math.max(from, size - before));
      if (part.length > 0) this.#opened.put(place + from, part);
    }
    this.#opened.setLevels(0, 0);
    return this.#opened;
  }
  #close() {
    const opened = this.#opened;
    this.#opened = null;
    opened?.close();
  }

  /** Takes the steps of `use`, a generator, with the first `bytes` bytes that came, opened. */
  *#steps(bytes, use) {
    try {
      try {
        return yield* use(this.#openedTo(Math.min(bytes, this.#length)));
      } catch (error) {
        if (error instanceof TksError) this.#close();  // it may take no more bytes
        throw error;
      }
    } catch (error) {
      if (error instanceof TksError) throw error;
      this.#opened = this.#instance = null;
      throw new TksError('memory', 'The decoder ran out of memory. Ask for fewer texels, samples ' +
        'or triangles.', {cause: error});
    }
  }
  /** What `use` gives, called with the first `bytes` bytes that came, opened. */
  opened(bytes, use) {
    return lastOf(this.#steps(bytes, function* (opened) {
      return use(opened);
    }));
  }

  /** Makes a frame, a part of it at each step. Until it returns it no other call may be made, or it
   * has to be given up. */
  parts(request) {
    return this.#steps(request.bytes, function* (opened) {
      yield;
      const info = opened.info();
      return {
        bytes: opened.size,
        complete: opened.size >= info.streamBytes,
        info,
        ...(yield* partsOf(opened, info, request)),
      };
    });
  }
  decode(request) {
    return lastOf(this.parts(request));
  }

  plan(request) {
    return this.opened(Infinity, (opened) => opened.plan(request));
  }
  needed({part, window}) {
    return this.opened(Infinity, (opened) => opened.needed(part, window));
  }

  /** The very samples, as the conformance vectors state them. */
  samples(bytes, level) {
    return this.opened(bytes, (opened) => {
      const whole = opened.info();
      opened.setLevels(Math.min(level, whole.coarsestLevel),
        Math.min(level, whole.textureCoarsestLevel));
      const info = opened.info();
      return {
        heights: info.hasHeights ? opened.heights(info) : null,
        texture: info.hasTexture ? opened.texels(info) : null,
      };
    });
  }
}

/** The buffers of a frame, to be handed over between threads instead of copied. */
export function buffersOf(frame) {
  const arrays = [frame.texture?.data, frame.surface?.data, ...Object.values(frame.mesh ?? {})];
  return arrays.filter(Boolean).map((array) => array.buffer);
}
