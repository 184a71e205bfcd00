// SPDX-License-Identifier: Apache-2.0
// A stream that the decoder's module has open: what it holds, and the calls that decode its parts.
import {KINDS} from './components.js';
import {DOMAINS} from './domains.js';
import {TksError} from './error.js';
import {SAMPLES} from './instance.js';

const BUDGET_MESH = 1;
/** web_component(). */
const COMPONENT_NUMBERS = 5;
/** tks_globe: its size, and four numbers. */
const GLOBE_BYTES = 40;
/** tks_object_mesh: two counts, five addresses. */
const OBJECT_MESH_BYTES = 28;
/** Texels that become RGBA at a time: the module has no memory for all of them beside a texture. */
const TEXELS = 2 ** 18;

/**
 * A stream that is open, as far as its bytes have come. It decodes on from where it was when more
 * of them do.
 */
export class Opened {
  /** decoder: the address of a tks_decoder; size: how many bytes of its stream have come. */
  constructor(instance, decoder, size) {
    [this.instance, this.decoder, this.size] = [instance, decoder, size];
    this.hasIndex = instance.calls.web_has_index(decoder) !== 0;
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
  /** What to fetch next for a view {clip, width, height, globe}; without a globe of flat ground. */
  plan({view, bytes, triangles, requestBytes}) {
    const {instance} = this;
    return instance.with(21 * 8 + GLOBE_BYTES, (limits) => {
      instance.view(Float64Array, limits, 21)
        .set([bytes, triangles, requestBytes, view.width, view.height, ...view.clip]);
      const globe = view.globe ? limits + 21 * 8 : 0;
      if (globe) this.#putGlobe(globe, view.globe);
      return this.#ranges((out) =>
        instance.calls.web_plan(this.decoder, limits, limits + 3 * 8, globe, out));
    });
  }
  /** tks_globe at an address. */
  #putGlobe(address, {exaggeration, semiMajor, semiMinor}) {
    const {instance} = this;
    instance.view(Uint32Array, address, 1)[0] = GLOBE_BYTES;
    instance.view(Float64Array, address + 8, 4).set([semiMajor, semiMinor, 1, exaggeration]);
  }
  /** What a window {x, y, width, height} of a part of tks_part takes. */
  needed(part, {x, y, width, height}) {
    const {instance} = this;
    return instance.with(16, (window) => {
      instance.view(Uint32Array, window, 4).set([x, y, width, height]);
      return this.#ranges((out) => instance.calls.web_needed(this.decoder, part, window, out));
    });
  }
  check(status) {
    if (status === 0) return;
    const message = this.instance.calls.tks_message(this.decoder);
    throw TksError.ofStatus(status, this.instance.text(message));
  }
  setLevels(heights, texture) {
    this.check(this.instance.calls.tks_set_levels(this.decoder, heights, texture));
  }
  /** Which of info().frames is decoded from now on. */
  setFrame(frame) {
    this.check(this.instance.calls.tks_set_frame(this.decoder, frame));
  }

  #component(number) {
    const {instance} = this;
    return instance.with(8 * COMPONENT_NUMBERS, (out) => {
      const name = instance.text(instance.calls.web_component(this.decoder, number, out));
      const [kind, taken, width, height, bytes] =
        instance.view(Float64Array, out, COMPONENT_NUMBERS);
      return {number, name, kind: KINDS[kind], width, height, bytes, taken: taken !== 0};
    });
  }

  /** The finest mip level of a part of tks_part that the bytes feed. */
  fedLevel(part) {
    return this.instance.with(4, (out) => {
      this.check(this.instance.calls.tks_fed_level(this.decoder, part, out));
      return this.instance.view(Uint32Array, out, 1)[0];
    });
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
      if (/^(h|textureH)as[A-Z]|^(lossless|textureOpaque|voidsKnown|showsSketch)$/.test(name))
        info[name] = info[name] !== 0;
    }
    for (const name of ['domain', 'textureDomain']) info[name] = DOMAINS[info[name]];
    info.isObject = info.basePositionBits > 0 || info.objectTriangles > 0;
    const gather = (letter) =>
      Array.from({length: 6}, (_, i) => {
        const value = info[letter + i];
        delete info[letter + i];
        return value;
      });
    info.components =
      Array.from({length: info.components}, (_, number) => this.#component(number));
    info.hasIndex = this.hasIndex;
    info.geotransform = gather('g');
    info.textureGeotransform = gather('t');
    const texts = ['unit', 'verticalDatum', 'crs', 'textureCrs', 'geoKeys', 'material'];
    texts.forEach((name, i) => (info[name] = instance.text(instance.calls.web_text(decoder, i))));
    info.positions = this.#positions(0);
    info.texturePositions = this.#positions(1);
    return info;
  }

  /** Of the heights (0) or of the texture (1): longitudes and latitudes, as the stream has them. */
  #positions(part) {
    const {instance, decoder} = this;
    return instance.with(4, (out) => {
      const size = instance.calls.web_positions(decoder, part, out);
      const [address] = instance.copy(Uint32Array, out, 1);
      return size > 0 ? instance.copy(Uint8Array, address, size) : null;
    });
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
    const texelBytes = info.textureChannels * SAMPLES[info.textureSample].BYTES_PER_ELEMENT;
    const bytes = count * texelBytes, rgba = new Uint8ClampedArray(4 * count);
    instance.with(bytes, (texels) => {
      this.check(instance.calls.tks_decode_texture(this.decoder, texels, bytes));
      instance.with(4 * TEXELS, (out) => {
        for (let first = 0; first < count; first += TEXELS) {
          const some = Math.min(TEXELS, count - first);
          instance.calls.web_rgba(texels + first * texelBytes, out, some, info.textureChannels,
            info.textureSample, Number(info.textureOpaque), info.textureWhiteLevel);
          rgba.set(instance.view(Uint8ClampedArray, out, 4 * some), 4 * first);
        }
      });
    });
    return rgba;
  }

  /** A mesh round a globe {exaggeration, semiMajor, semiMinor}. */
  globe(triangles, on) {
    const {instance, decoder} = this, {calls} = instance;
    if (!calls.tks_decode_globe) throw new TksError('usage', 'This module makes no meshes.');
    return instance.with(GLOBE_BYTES + 24, (globe) => {
      const out = globe + GLOBE_BYTES;
      this.#putGlobe(globe, on);
      this.check(calls.tks_decode_globe(decoder, BUDGET_MESH, triangles, globe, out));
      return this.#globeAt(out);
    });
  }
  /** tks_globe_mesh at `out`: two counts, four addresses. */
  #globeAt(out) {
    const {instance} = this;
    const [vertices, faces, ...parts] = instance.copy(Uint32Array, out, 6);
    const [positions, pixels, heights, triangles] = parts;
    const mesh = {
      positions: instance.copy(Float64Array, positions, 3 * vertices),
      pixels: instance.copy(Float64Array, pixels, 2 * vertices),
      heights: instance.copy(Float32Array, heights, vertices),
      triangles: instance.copy(Uint32Array, triangles, 3 * faces),
    };
    instance.calls.tks_free_globe_mesh(out);
    return mesh;
  }

  /** The mesh of an object: positions in its unit, and the samples that they lie on; or their
   * places on a texture, of triangles that are coded as they are. */
  object(triangles) {
    const {instance, decoder} = this, {calls} = instance;
    if (!calls.tks_decode_object) throw new TksError('usage', 'This module makes no meshes.');
    return instance.with(OBJECT_MESH_BYTES, (out) => {
      this.check(calls.tks_decode_object(decoder, BUDGET_MESH, triangles, out));
      return this.#objectAt(out);
    });
  }
  /** tks_object_mesh at `out`. */
  #objectAt(out) {
    const {instance} = this;
    const [vertices, faces, positions, pixels, texcoords, , triangles] =
      instance.copy(Uint32Array, out, OBJECT_MESH_BYTES / 4);
    const pairs = (address) =>
      (address ? instance.copy(Float64Array, address, 2 * vertices) : null);
    const mesh = {
      positions: instance.copy(Float64Array, positions, 3 * vertices),
      pixels: pairs(pixels),
      texcoords: pairs(texcoords),
      triangles: instance.copy(Uint32Array, triangles, 3 * faces),
    };
    instance.calls.tks_free_object_mesh(out);
    return mesh;
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
