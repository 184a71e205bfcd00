// SPDX-License-Identifier: Apache-2.0

declare global {
  interface SymbolConstructor {
    readonly dispose: unique symbol;
  }
}

export type TksCode =
  | 'usage' | 'io' | 'corrupt' | 'truncated' | 'unsupported' | 'limit' | 'memory' | 'changed'
  | 'mismatch';

/** What promises are rejected with; `message` is one or two sentences for people. */
export class TksError extends Error {
  readonly code: TksCode;
}

export interface OpenOptions {
  /** Ends opening; later calls take signals of their own. */
  signal?: AbortSignal;
  /** Of the requests to a URL, as fetch() takes them. */
  request?: Pick<RequestInit, 'headers' | 'credentials'>;
  /** false: decode on this thread, as Node always does. A Worker or its URL: where bundlers do not
   * find `tetrakis/worker`. A Worker serves one terrain: another is refused it, and dispose() ends
   * it. */
  worker?: boolean | Worker | string | URL;
  /** Where bundlers do not find `tetrakis/tetrakis.wasm`: its URL, bytes, or compiled module. */
  wasm?: string | URL | BufferSource | WebAssembly.Module;
  /** Bytes that one decoding may take; default 2^30. */
  memory?: number;
  /**
   * What a request costs, in bytes that the link brings meanwhile: the more, the fewer requests a
   * view takes. Default 4096, or more, the more bytes are here and asked for; 0: each byte is asked
   * for in the order in which it helps.
   */
  requestBytes?: number;
}

export interface View {
  /** 16 numbers, row by row, from (column, row, height, 1) to clip coordinates; with `globe` from
   * the positions of its mesh. */
  clip: ArrayLike<number>;
  /** Of the picture, in pixels. */
  width: number;
  height: number;
  /** Also: of the mesh only what this view may show. Default false. */
  cut?: boolean;
}

/** Names or numbers of components of a stream; a name may be that of heights and of a texture. */
export type ComponentChoice = string | number | (string | number)[];

export interface FrameOptions {
  /** Of a sequence, or of a stream of several frames: which, by its number. Default: the first. */
  frame?: number;
  /** Of a stream of several rasters: heights, a texture or both in the place of the first ones. The
   * frame is then about these: its parts, and its `info`. What was decoded of each choice is kept
   * for more bytes. Default: the first heights and the first texture. */
  component?: ComponentChoice | null;
  /** Use no more than the first bytes that came: of the stream, or for views. Default: all. */
  bytes?: number;
  /** Ends the call with its requests, and rejects it with its reason; what is being decoded ends at
   * its next part. */
  signal?: AbortSignal;
  /** The mesh has at most so many, a whole number from 2 on, or those of the coarsest one: of long
   * grids that has as many as squares of the short side take (1025 x 3: 1024). Default 20000. Of a
   * part of the stream it has no more than its bytes feed; of info.objectTriangles it has as many
   * of any part. */
  triangles?: number;
  /** What is looked at. 16 numbers: of the mesh only what they may show. With a picture: bytes are
   * fetched that help it most, if the stream has an index and the server knows ranges. Of objects
   * it counts for nothing. */
  view?: ArrayLike<number> | View | null;
  mesh?: boolean;
  /** A mesh round a globe in the place of the flat one, of heights that go round it (goesRound()).
   * The view of a picture then looks at the globe, whose far side it does not ask for, and cuts
   * nothing off. */
  globe?: GlobeOptions | null;
  /** Unit normals for the vertices of the mesh; where `mesh` is false, for the samples of the
   * surface. Default false. */
  normals?: boolean;
  texture?: boolean;
  /** With the texture, those of an object's material. Default true. */
  maps?: boolean;
  /** The heights as a grid. Default false. */
  surface?: boolean;
  /** Longest side of the texture, by the mip levels of the stream, of which none is finer than the
   * bytes that are here feed; where that is an atlas, of the atlas. Default 4096. */
  texels?: number;
  /** Longest side of the grid of heights, likewise. Default 4096. */
  samples?: number;
  /** The mip levels themselves, in place of `texels` and `samples`, however few bytes are here; to
   * info.textureCoarsestLevel and info.coarsestLevel. */
  textureLevel?: number;
  surfaceLevel?: number;
}

export interface GlobeOptions {
  /** What heights are multiplied by. Default 1. */
  exaggeration?: number;
  /** Of the ellipsoid, in metres. Default: those that the stream's keys or CRS state or name (the
   * Moon, Mars), else those of WGS 84. */
  semiMajor?: number;
  semiMinor?: number;
}

export interface RefineOptions extends FrameOptions {
  /** Of the first frame alone, which is to be soon: fewer triangles, texels. */
  first?: FrameOptions;
  /** Of a frame that the caller shows already: all that come have more bytes. */
  after?: number;
}

/** Of a cylinder the last column lies beside the first one, as on a globe. A forest has square
 * patches one below the other; a cube is one of six patches round a globe (tks_cube_sides). */
export type Domain = 'plane' | 'cylinder' | 'forest' | 'cube';

/** One of the rasters of a stream. */
export interface StreamComponent {
  number: number;
  /** '': it has none. */
  name: string;
  /** 'unknown': of a later version. */
  kind: 'heights' | 'texture' | 'unknown';
  /** Of what is coded; 0 of what is unknown. */
  width: number;
  height: number;
  /** In this prefix. */
  bytes: number;
  /** It is what `info` and the frame are about. */
  taken: boolean;
}

export interface TerrainInfo {
  formatVersion: number;
  headerBytes: number;
  streamBytes: number;
  /** The fewest bytes that show something: the header or, with a sketch, that of the sketch. */
  leastBytes: number;
  /** Of an index in pages, which lie behind `streamBytes`; 0: there is none. */
  indexBytes: number;
  /** The bytes end inside the header: all else is about the sketch that the stream begins with. */
  showsSketch: boolean;
  /** How many frames the stream has, and which of them this is. */
  frames: number;
  frame: number;
  /** All rasters of the stream, by their numbers. */
  components: StreamComponent[];
  /** Payload of either component in this prefix. */
  geometryBytes: number;
  textureBytes: number;
  hasHeights: boolean;
  hasTexture: boolean;
  /** A scan, a sculpture, a designed part: frames have an `object`. */
  isObject: boolean;
  /** How many triangles an object has that are coded as they are; frames have as many as they are
   * asked for. 0: any other stream. An object has heights, over a base mesh, or such triangles. */
  objectTriangles: number;
  /** What its surface is made of: factors of a glTF material, as JSON with glTF's names; ''. */
  material: string;
  width: number;
  height: number;
  /** Metres; 0: unknown. */
  spacingX: number;
  spacingY: number;
  textureWidth: number;
  textureHeight: number;
  textureChannels: number;
  /** No channel is alpha: the last of 2 or 4 is a further colour, such as near infrared. */
  textureOpaque: boolean;
  /** The value that pictures show as white. */
  textureWhiteLevel: number;
  /** What the prefix states of its quality, in `unit` and dB; less than 0: nothing yet. */
  heightsRmse: number;
  texturePsnr: number;
  /** Guaranteed for the complete stream; less than 0: not stated. */
  maxError: number;
  lossless: boolean;
  /** Bytes can come in any order: `view` tells which do. */
  hasIndex: boolean;
  /** Side of the spatial regions in samples; 0: none. */
  regions: number;
  textureRegions: number;
  hasVoids: boolean;
  /** False: bytes of the mask of voids are missing, and some voids may be shown as ground. */
  voidsKnown: boolean;
  hasGeotransform: boolean;
  /** As GDAL's, on a forest that of the grid that was resampled; of the texture where
   * textureHasGeotransform. */
  geotransform: number[];
  textureHasGeotransform: boolean;
  textureGeotransform: number[];
  domain: Domain;
  textureDomain: Domain;
  unit: string;
  verticalDatum: string;
  crs: string;
  textureCrs: string;
  /** What a GeoTIFF of the heights says beyond `crs`, as docs/FORMAT.md writes it. */
  geoKeys: string;
  /** Longitudes and latitudes of CRSs that this package does not know, as docs/FORMAT.md writes
   * them; null: there are none. */
  positions: Uint8Array | null;
  texturePositions: Uint8Array | null;
  [field: string]: unknown;
}

export interface Mesh {
  /** Vertex i lies on sample gridIndex[i] = row * info.width + column. */
  gridIndex: Uint32Array;
  /** In info.unit. */
  heights: Float32Array;
  /** Three indices each, counter-clockwise seen from above with rows towards the viewer. */
  triangles: Uint32Array;
  /** x along a row, y up, z down the rows; for isotropic metres. */
  normals?: Float32Array;
}

/** Closed round a globe, but for voids and where rows end before a pole. It is cut open along the
 * seam and at the poles: vertices there are several, at positions that are equal to the last bit.
 */
export interface Globe {
  /** x, y, z of each vertex in metres from the centre: x towards longitude and latitude 0, y
   * towards longitude 90, z towards the north pole. */
  positions: Float64Array;
  /** Column and row of each on the grid; (0.5, 0.5) is the middle of the first sample. */
  pixels: Float64Array;
  /** In info.unit, not exaggerated. */
  heights: Float32Array;
  /** Three indices each, counter-clockwise seen from outside. */
  triangles: Uint32Array;
  /** As positions; those of vertices at one position are equal. */
  normals?: Float32Array;
}

/** The surface of an object, cut open between the patches of its texture, or along the seams of
 * triangles that are coded as they are: vertices there are several, at positions that are equal to
 * the last bit. */
export interface ObjectMesh {
  /** A point in info.unit, the same in all frames of an open stream; [0, 0, 0] of what has the
   * origin in its box. */
  centre: [number, number, number];
  /** x, y, z of each vertex as the mesh that was encoded has them, less `centre`. */
  positions: Float32Array;
  /** Of each vertex on the texture of this frame, or of one with as many `texels`: from (0, 0), the
   * corner of the first texel, to (1, 1), or beyond them where it repeats. Absent: there is no
   * texture. */
  texcoords?: Float32Array;
  /** Three indices each, counter-clockwise seen from outside. */
  triangles: Uint32Array;
  /** As positions; those of vertices at one position are equal. Along an edge of more than 40
   * degrees between triangles that are coded as they are each side has vertices and normals of its
   * own. */
  normals?: Float32Array;
}

export interface Raster<T> {
  /** Mip level: 1 / 2^level of the full resolution. */
  level: number;
  width: number;
  height: number;
  /** Of an atlas there is none. */
  geotransform?: number[];
  /** Of an atlas: texels around each patch. */
  gutter?: number;
  /** True where meshes have places beyond its corners, for which it is there again. */
  repeats?: boolean;
  data: T;
}

/** Maps as glTF has them: tangent-space normals; roughness (green) and metalness (blue), with
 * occlusion in red where info.material has an occlusionTexture and no map holds it; occlusion
 * (red); emitted light. */
export type MapName = 'normal' | 'metallic_roughness' | 'occlusion' | 'emissive';

export interface MaterialMap extends Raster<Uint8ClampedArray> {
  /** As info.texturePsnr. */
  psnr: number;
}

export interface Frame {
  /** Its number in the sequence, or in the stream. */
  number: number;
  /** In ticks of the clock; of a stream its number. */
  time: number;
  bytes: number;
  /** These are all bytes of the stream; of a sequence, of the group that holds the frame. */
  complete: boolean;
  info: TerrainInfo;
  mesh?: Mesh;
  /** In the place of `mesh`, where `globe` was asked for. */
  globe?: Globe;
  /** In the place of `mesh`, of a stream with info.isObject. */
  object?: ObjectMesh;
  /** RGBA; of an object with heights an atlas: its patches in rows and columns, each with a gutter
   * of one texel that repeats its border. */
  texture?: Raster<Uint8ClampedArray>;
  /** Of an object whose stream has maps of a material: those of which the bytes tell something. */
  maps?: Partial<Record<MapName, MaterialMap>>;
  /** In info.unit; voids are NaN. */
  surface?: Surface;
}

export interface Surface extends Raster<Float32Array> {
  spacingX: number;
  spacingY: number;
  /** Of each sample, as those of a mesh; where `mesh` was false, with `normals`. */
  normals?: Float32Array;
}

/** What the times of frames mean: a tick lasts numerator / denominator seconds, and tick 0 is the
 * epoch. */
export interface Clock {
  numerator: number;
  denominator: number;
  /** As RFC 3339 or CF has it; '': unknown. */
  epoch: string;
  /** Of CF: 'noleap', '360_day'; '': that of everyday life. */
  calendar: string;
}

/** Frames that are coded together: [firstFrame, endFrame). */
export interface FrameGroup {
  firstFrame: number;
  endFrame: number;
  /** Of its stream. */
  bytes: number;
}

export interface Terrain {
  /** Of the frame of most bytes so far: of its first bytes alone after open(), of all of the stream
   * after a decode() of all. What frames state of themselves is their own `info`. */
  readonly info: TerrainInfo;
  /** `ranges`: which bytes are here, [begin, end) each. */
  readonly loaded: {requests: number; bytes: number; ranges: [number, number][]};
  /** Of a file of groups of frames; `frames` of a stream may be several as well. */
  readonly isSequence: boolean;
  /** Frames have the numbers from `firstFrame` on, 0 of most, to below `frames`. */
  readonly firstFrame: number;
  readonly frames: number;
  /** null: nobody knows what a tick is. */
  readonly clock: Clock | null;
  /** By the numbers of frames, in ticks (exact below 2^53); of a sequence at a URL, those of groups
   * that were asked for. */
  readonly times: readonly (number | undefined)[];
  /** The last frame whose time is not after this one, in ticks; before all frames the first. */
  at(time: number, options?: Pick<FrameOptions, 'signal'>): Promise<number>;
  /** The group that holds a frame. */
  group(frame: number, options?: Pick<FrameOptions, 'signal'>): Promise<FrameGroup>;
  /** The file ends before the stream does: frames are good, but not complete. */
  readonly truncated: boolean;
  /** Of the file, once its size is known; Infinity before. */
  readonly fileBytes: number;
  /** Fetches until `bytes` bytes are here, without decoding: the first ones of the stream, or those
   * that help a view most. Resolves to how many there are. Fewer: the file ends, no other byte
   * helps the view, or what is left of `bytes` is worth no request (`requestBytes`). Where nothing
   * came, another call with this view brings nothing either. */
  load(bytes: number,
    options?: Pick<FrameOptions,
      'signal' | 'view' | 'globe' | 'triangles' | 'frame' | 'component'>):
    Promise<number>;
  /** One frame of `bytes` bytes; fetches those that are missing, as load(). */
  decode(options?: FrameOptions): Promise<Frame>;
  /** Frames of bytes that grow, from those that are there to `bytes`, or to what the view needs.
   * All these are fetched meanwhile: each frame takes what is here by then, but at least four times
   * as many bytes as the one before it. To leave the loop ends the fetching. */
  refine(options?: RefineOptions): AsyncGenerator<Frame, void, void>;
  /** Which bytes, [begin, end) each, a window of samples or texels takes; needs an index. Of one in
   * pages it fetches those of the window. */
  needed(options: {
    part?: 'heights' | 'texture'; window: {x: number; y: number; width: number; height: number};
    frame?: number; component?: ComponentChoice | null; signal?: AbortSignal;
  }): Promise<[number, number][]>;
  dispose(): void;
  [Symbol.dispose](): void;
}

/** A terrain whose frames come in groups, each of which is fetched and decoded when a frame of it
 * is asked for. Two groups are held at a time, so that one can be made while frames of the other
 * are shown. `info`, `loaded` and `truncated`, and bytes of calls, are those of one group, which
 * was asked for last; until then `info` of a live one is null. */
export interface Sequence extends Terrain {
  /** Of openLive(): takes the bytes that follow those before, and resolves to `frames`. A group
   * shows all its frames once its header is there. What is no group, or does not follow, is refused
   * (`corrupt`), and so is all behind it. */
  append(bytes: Uint8Array): Promise<number>;
  /** Of openLive(): gives up all groups that end before a frame and that its group does not go on
   * from, so that memory stays where it was. The numbers of frames stay. */
  forget(frame: number): void;
}

/** What a receiver tells a server that it wants. */
export interface Wants {
  /** The frame that is shown; those behind it come ahead of time. 'newest' (default): whichever
   * that is. */
  frame?: number | 'newest';
  /** What is looked at: its bytes come first. Default: all ground counts alike. */
  view?: View | null;
  /** Of the meshes that are drawn: heights that these do not show are not sent. Default: any
   * number. */
  triangles?: number;
  /** Bytes a second of the link, of which each group gets its share. Default, null: as fast as
   * answers come. */
  link?: number | null;
}

export interface ReceiveOptions extends Omit<OpenOptions, 'requestBytes'>, Wants {
  /** So many frames stay behind the wanted one; the others are given up. Default 256. */
  keep?: number;
  /** Messages may fail for so many milliseconds, in which a server can restart. Then no more is
   * asked for. Default 30000. */
  patience?: number;
  /** So many milliseconds without a byte of an answer are a failure. Default 15000. */
  timeout?: number;
}

/** A sequence that `tetrakis serve` serves. Frames come as they help what is wanted. Numbers of
 * frames, `frame` of calls included, are those of the server; `frame` is by default the newest one
 * that is here, and one that is not here is asked for. decode() takes what is here, whatever
 * `bytes` says; load() and refine() wait for more, as long as more helps. */
export interface Reception extends Terrain {
  readonly isSequence: true;
  readonly isLive: true;
  /** How many frames the server has. Those from `firstFrame` to below `frames` are here, but some
   * between them may be missing. */
  readonly sourceFrames: number;
  /** Why no more comes; null: it does. What is here can be decoded in any case. */
  readonly error: TksError | null;
  /** Says what is wanted from now on; what is not given stays as it is. */
  want(wants: Wants): void;
  /** Resolves when the next answer has come, and rejects when no other will. */
  changed(options?: Pick<FrameOptions, 'signal'>): Promise<void>;
  /** The newest frame that is here, again and again: as soon as it can be decoded, and as more of
   * it comes. Who is slow misses frames between. */
  newest(options?: FrameOptions): AsyncGenerator<Frame, never, void>;
}

/** Where adapters put a stream on the globe. Default: where it says, if this package knows its CRS
 * (degrees, web Mercator, UTM) or the stream has positions. */
export interface Placing {
  /** West, south, east, north in degrees; across 180° as [170, -10, -170, 10]. */
  bounds?: [number, number, number, number];
  /** From coordinates of the stream's CRS to [longitude, latitude] in degrees; `crs` as in `info`.
   * By proj4: `const {forward} = proj4(definition, 'EPSG:4326')` and
   * `project: (x, y) => forward([x, y])`. */
  project?: (x: number, y: number, crs: string) => [number, number];
}

/** Options of `decode` for a frame that is to be soon: what the first bytes tell. */
export const FIRST_FRAME: {bytes: number; triangles: number; texels: number};

export function open(
  input: string | URL | ArrayBuffer | ArrayBufferView | Blob, options?: OpenOptions,
): Promise<Terrain>;

/** A sequence whose bytes come from somewhere else, in pieces of any size. */
export function openLive(options?: Omit<OpenOptions, 'request' | 'signal'>): Promise<Sequence>;

/** Receives a sequence from an address that `tetrakis serve` prints, once there is a frame. */
export function receive(url: string | URL, options?: ReceiveOptions): Promise<Reception>;

/**
 * Metres of one unit of height, of one column and of one row: as the stream states them, or as its
 * place tells, of degrees and of web Mercator, whose metres are longer than the ground's, in the
 * middle of the ground. An unknown spacing counts as 30 m, an unknown unit of height as metres.
 */
export function groundScale(info: TerrainInfo): {height: number; x: number; y: number};

/** Whether the columns of the heights go once round 360 degrees, so that they have a globe. */
export function goesRound(info: TerrainInfo): boolean;

/**
 * Which way rows and columns of the heights run on the ground, as directions of length 1: parts to
 * the east and to the south of a step along a row, and of one down a column. [1, 0] and [0, 1]
 * where the first sample is the north-western one, or nothing says a place. Where along[0] *
 * down[1] - along[1] * down[0] < 0 (south-up), triangles run clockwise on the ground.
 */
export function groundAxes(info: TerrainInfo): {along: [number, number]; down: [number, number]};
