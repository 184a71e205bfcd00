// SPDX-License-Identifier: Apache-2.0
import type {Domain, OpenOptions} from './index.js';

export {Domain, TksError} from './index.js';

export type Samples =
  | Uint8Array | Int8Array | Uint16Array | Int16Array | Uint32Array | Int32Array | Float32Array;
export type Registration = 'unknown' | 'area' | 'point';

/** Longitude and latitude of coordinates of a CRS. */
export type Project = (x: number, y: number, crs?: string) => [number, number];

export interface HeightsInput {
  /** Row by row. A sample v is the height v * scale + offset in `unit`; NaN, `nodata` are voids. */
  data: Samples;
  width: number;
  height: number;
  /** "auto": -9999 and the like, where all other samples lie closer together than to it. */
  nodata?: number | 'auto' | null;
  unit?: string;
  /** Metres between samples, or those between columns and between rows. */
  spacing?: number | [number, number];
  scale?: number;
  offset?: number;
  /** Quantisation step in samples. Default: chosen. */
  step?: number;
  /** "EPSG:code", WKT or a name. */
  crs?: string;
  /** As GDAL's. */
  geotransform?: ArrayLike<number>;
  registration?: Registration;
  /** Default: "plane". Samples that patches of a cube share are equal. */
  domain?: Exclude<Domain, 'forest'>;
  /** Called here some 2000 times; what it gives is fitted to a tenth of a sample, and the stream
   * takes it along, in at most 200 bytes: who does not know the CRS places the stream by it. */
  project?: Project;
  verticalDatum?: string;
  description?: string;
  geoKeys?: string;
}

/** Over the same ground as the heights; an ImageData is one. */
export interface TextureInput {
  data: Uint8Array | Uint8ClampedArray | Uint16Array;
  width: number;
  height: number;
  /** 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA. Default: as the length of the data tells. */
  channels?: number;
  /** No channel is alpha: the last of 2 or 4 is a further colour, such as near infrared. */
  opaque?: boolean;
  /** The value that pictures show as white, of 16 bits. Default: found. */
  whiteLevel?: number;
  crs?: string;
  geotransform?: ArrayLike<number>;
  registration?: Registration;
  /** Default: "plane". */
  domain?: Exclude<Domain, 'forest'>;
  /** As of heights; without it, those of heights in the same CRS count. */
  project?: Project;
  geoKeys?: string;
}

export interface EncodeInput {
  heights?: HeightsInput;
  texture?: TextureInput;
  /** Targets above 0, of which one may be given; without any, lossless. The stream takes at most so
   * many bytes; heights and texture each reach so many dB; heights are within so much, in their
   * unit. */
  bytes?: number;
  psnr?: number;
  maxError?: number;
  lossless?: boolean;
  /** Meshes will have at most so many. Default: any number. */
  triangles?: number;
  /** Side of the spatial regions, a power of two from 16; 1: none. Default: chosen. */
  regions?: number;
  /** Write the index by which viewers fetch what they look at. Default false. 'windows' (lossless
   * only): also lay each region out in one piece, for who reads windows. */
  index?: boolean | 'windows';
  /** Default 'psnr'. */
  weights?: 'psnr' | 'visual';
}

export type ObjectKind = 'auto' | 'resampled' | 'triangles';

/** A mesh of triangles, such as a scan or a designed part. Points at equal places are joined,
 * degenerate and double triangles dropped, edges of more than two triangles cut. */
export interface ObjectInput {
  /** x, y, z of each vertex, finite, in `unit`. At most 2^26 vertices. */
  positions: ArrayLike<number>;
  /** Three vertices each, counter-clockwise seen from outside. At most 2^26 triangles. */
  triangles: ArrayLike<number>;
  /** With `texture`: a place on it for each vertex. (0, 0) is its upper left corner, and (1, 1) its
   * lower right one; it repeats beyond these. */
  texcoords?: ArrayLike<number>;
  texture?: Pick<TextureInput, 'data' | 'width' | 'height' | 'channels' | 'opaque' | 'whiteLevel'>;
  /** Beside a texture: images of any size that lie on the mesh as it does, channel by channel as
   * glTF has them. A resampled object leaves `normal` out, whose normals count from texcoords. */
  maps?: Partial<Record<'normal' | 'metallic_roughness' | 'occlusion' | 'emissive',
    Pick<TextureInput, 'data' | 'width' | 'height' | 'channels'>>>;
  /** Factors of a glTF material, by its names, or their JSON. */
  material?: object | string;
  unit?: string;
  description?: string;
  /** 'resampled': only the surface comes back, in as many triangles as one likes; for scans and
   * sculptures. 'triangles': they are coded as they are, or fewer ones where the target takes no
   * more; for designed parts. Default 'auto': in whichever way comes nearer to the mesh. */
  kind?: ObjectKind;
  /** What the stream begins with, so that something is seen before a long header is there: a coarse
   * stream of about so many bytes. Default 'auto': a 32nd part, where the header is long. */
  sketch?: number | 'auto' | 'none';
  /** The targets, above 0, of which one is given; beside a texture it is `bytes`. The stream takes
   * at most so many bytes; the surface reaches 20 log10(diagonal / error) dB; all samples, or
   * corners, stay within so much of their places, in `unit`. */
  bytes?: number;
  psnr?: number;
  maxError?: number;
  /** Write the index of packets. Default false. */
  index?: boolean;
}

/** What became of a mesh. Distances are between its surface and that of the whole stream, in its
 * unit, of 20000 places of either. */
export interface ObjectReport {
  /** Those that are left after cleaning. */
  triangles: number;
  droppedTriangles: number;
  cutEdges: number;
  /** Connected parts, and closed rings of open edges. */
  components: number;
  borders: number;
  kind: Exclude<ObjectKind, 'auto'>;
  /** Of a resampled one, else 0: patches of (2^depth + 1)^2 samples, those of its texture, and the
   * distance that resampling alone makes. */
  patches: number;
  depth: number;
  textureDepth: number;
  resamplingError: number;
  /** Of one of triangles, else 0. */
  codedTriangles: number;
  /** Of the sketch that the stream begins with; 0: there is none. */
  sketchBytes: number;
  /** Of the box around the mesh. */
  diagonal: number;
  /** The larger of the two RMS distances, and the largest distance. */
  error: number;
  largest: number;
  /** 20 log10(diagonal / error), dB. */
  psnr: number;
}

export interface EncodeOptions extends Pick<OpenOptions, 'signal' | 'wasm'> {
  /** false: on this thread, which then hears no signal. A URL: where bundlers do not find
   * `tetrakis/encode_worker`. In Node true or false. */
  worker?: boolean | string | URL;
  /** Told how much is done, from 0 to 1. If it throws, the encoding ends and rejects with that. */
  progress?: (done: number) => void;
}

/** The bytes of a stream. Rejects with a TksError, also where an option is none of these. */
export function encode(input: EncodeInput, options?: EncodeOptions): Promise<Uint8Array>;

/** Likewise of a mesh of triangles, with what became of it. */
export function encodeObject(
  mesh: ObjectInput, options?: EncodeOptions): Promise<{stream: Uint8Array; report: ObjectReport}>;
