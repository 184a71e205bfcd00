/* SPDX-License-Identifier: Apache-2.0
 *
 * Tetrakis: progressive codec for textured terrain. C interface.
 *
 * One call encodes a height field, a texture or both into one embedded stream (.tks). Any prefix of
 * that stream is legal input to the decoder and yields the best surface and image its bytes buy.
 *
 * Trust contract: every decoding function is safe on untrusted input. It returns TKS_OK and has
 * written its outputs fully, or it returns an error, has left arrays as they were, and has emptied
 * structs that hand over memory. It never prints, exits or throws. Truncation behind the header is
 * no error. All functions are reentrant; one handle serves one thread at a time. Samples and
 * structs that you hand over must be aligned as their type is.
 *
 * Time is bounded as well, whatever the bytes are. Opening takes time in proportion to the bytes,
 * and up to 2^21 steps for lines that repeat others. A call that decodes takes at most 2
 * microseconds for each sample (of a texel, for each channel) that it is asked for, and 2 for each
 * byte of the stream, as processors of 2020 go; meshes take four times as much. A window asks for
 * the regions that reach it. Where one codeword holds the whole plane (coefficients without
 * regions, masks, flat areas, drawings) a window asks for all of it, and for corrections without
 * regions of all rows before it. Masks, the bridges in them, flat areas and priorities then take 4
 * nanoseconds for each sample of the plane, a second for 2^14 x 2^14. Of all others bytes hold few
 * decisions, 91 100 each, which take two milliseconds. Who serves strangers sets
 * tks_limits.max_samples.
 *
 * Structs that begin with their `size` may grow at their end in later versions; programs that were
 * compiled before keep working. Set `size` to sizeof the struct: fields that a shorter struct lacks
 * count as 0, which is every default. A struct that is too short for its first fields (through
 * tks_encode_options.triangles, tks_heights.offset, tks_image.data, tks_limits.size,
 * tks_info.level; all of tks_outliers) gives TKS_USAGE. Of a struct that is longer than this
 * library knows, it sets the unknown fields of tks_info and tks_outliers to 0; in other structs
 * these must be 0, else TKS_UNSUPPORTED.
 *
 * docs/GLOSSARY.md says what the words mean. C99 or any C++.
 */
#ifndef TETRAKIS_TETRAKIS_H
#define TETRAKIS_TETRAKIS_H

#include <stddef.h>
#include <stdint.h>

#define TKS_VERSION_MAJOR 0
#define TKS_VERSION_MINOR 1
#define TKS_VERSION_PATCH 0

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default) /* the library is compiled with hidden symbols */
#endif

/* In C++, too, an enumeration may have any value of an int. Calls refuse values without a name. */
#if defined(__cplusplus) && (__cplusplus >= 201103L || defined(_MSC_VER))
#define TKS_INT : int
#else
#define TKS_INT
#endif

/* Stable numbers; the command line returns them as its exit codes. */
typedef enum tks_status TKS_INT {
  TKS_OK = 0,
  TKS_USAGE = 1,       /* an argument makes no sense: fix the call */
  TKS_IO = 2,          /* a file cannot be read or written (command line only) */
  TKS_CORRUPT = 3,     /* the bytes are not a Tetrakis stream, or break its syntax */
  TKS_TRUNCATED = 4,   /* bytes are missing: of the header, or of what has to be whole */
  TKS_UNSUPPORTED = 5, /* version, profile or feature unknown to this library */
  TKS_LIMIT = 6,       /* a limit of tks_limits would be exceeded */
  TKS_MISMATCH = 7,    /* comparison or verification failed; from tks_encode: a fault of the
                          encoder, which broke a promise and so returns no stream */
  TKS_NO_MEMORY = 8
} tks_status;

typedef enum tks_sample TKS_INT {
  TKS_U8 = 0,
  TKS_I8 = 1,
  TKS_U16 = 2,
  TKS_I16 = 3,
  TKS_U32 = 4,
  TKS_I32 = 5,
  TKS_F32 = 6
} tks_sample;

/* Bytes of one sample: 1, 1, 2, 2, 4, 4, 4. 0 for a value outside the enumeration. */
size_t tks_sample_bytes(tks_sample sample);

/* What samples are to the ground, as GDAL's AREA_OR_POINT. A geotransform does not depend on it. */
typedef enum tks_registration TKS_INT {
  TKS_REGISTRATION_UNKNOWN = 0,
  TKS_REGISTRATION_AREA = 1, /* a sample is the mean of its cell */
  TKS_REGISTRATION_POINT = 2 /* a sample is the value at the middle of its cell */
} tks_registration;

/* What lies beside the columns at the ends of a raster. */
typedef enum tks_domain TKS_INT {
  TKS_DOMAIN_PLANE = 0,    /* nothing */
  TKS_DOMAIN_CYLINDER = 1, /* the last column lies beside the first one, as on a globe: no seam is
                              left between the two. Meshes are those of the plane, but for
                              tks_decode_globe */
  TKS_DOMAIN_FOREST = 2 /* square patches whose sides are glued, as those of a cube: tks_forest */
} tks_domain;

/* A surface of square patches of (2^depth + 1) x (2^depth + 1) samples, of which neighbours share
 * the samples of the sides that are glued. Its raster has 2^depth + 1 columns, and the patches one
 * below the other. Side 4 p + 0 is the first row of patch p, 4 p + 1 its last column, 4 p + 2 its
 * last row, 4 p + 3 its first column. Clockwise round one patch is counterclockwise round the other
 * along a side: sample k of a first row or last column is sample 2^depth - k of another such side,
 * and sample k of a last row or first column, and likewise the other way round. */
#define TKS_BORDER UINT32_MAX /* in the place of a side: nothing is glued here */
typedef struct tks_forest {
  uint32_t depth;        /* 1 to 18 */
  uint32_t patches;      /* to 4096, patches * (2^depth + 1) to 2^20; 0: no forest */
  const uint32_t* sides; /* 4 * patches: for each side the one that it is glued to, or TKS_BORDER */
} tks_forest;

/* The base mesh of an object: a quad for each patch of a forest. Heights of the forest then count
 * along the normals of the quads, which are bent by the normals at their corners, and make the
 * surface of the object (tks_decode_object). Corners are places in a grid of cubic cells: corner
 * (x, y, z) lies at origin + cell * (x, y, z), in the unit of the heights. */
#define TKS_MOST_OBJECT_DEPTH 8
typedef struct tks_base_mesh {
  uint32_t position_bits; /* coordinates of corners are below 2^position_bits, 1 to 20; 0: there is
                             no base mesh */
  double cell;            /* above 0 */
  double origin[3];
  const int32_t*
      corners; /* 12 for each patch: x, y, z of its corners with the first row and column,
                             the first row and last column, the last of both, the last row and first
                             column. What sides share is the same */
} tks_base_mesh;

/* The sides of a cube for tks_forest, 24 numbers. With them a forest is the globe: patches 0 to 3
 * go eastwards round the equator, with longitudes 0, 90, 180 and -90 in their middles and north up;
 * patch 4 has the north pole in its middle and longitude 0 below, patch 5 the south pole and
 * longitude 0 above. Columns and rows of a patch are at equal angles, as seen from the middle of
 * the cube (C. Ronchi and others, "The cubed sphere", 1996). Longitudes and geodetic latitudes are
 * taken for angles on a sphere. */
const uint32_t* tks_cube_sides(void);

/* A height field to encode: width x height samples, row by row, tightly packed, caller's memory.
 * The least size is 1 x 1. One column or row has no area: no mesh can be made of it, and no camera
 * sees it. A sample v stands for the height v * scale + offset in `unit`.
 *
 * Voids: samples equal to `nodata` (if has_nodata), and floats that are NaN, are no heights. Their
 * mask is coded; they take no part in any filter, error or mesh, and come back as `nodata`, without
 * has_nodata as the quiet NaN 7fc00000. There may be any number of them, all samples included.
 * Other samples: an infinite one is refused with its place (unless it is the nodata value);
 * subnormal ones, negative zeros and integers of the full 32 bits are heights like any other.
 *
 * Georeference: kept as given, with every prefix; coding does not depend on it. A geotransform is
 * that of GDAL, in units of the CRS (metres, feet, degrees): column c and row r, where (0, 0) is
 * the outer corner of the first sample and (0.5, 0.5) its middle, lie at
 *     x (easting, longitude)  = geotransform[0] + c * geotransform[1] + r * geotransform[2]
 *     y (northing, latitude)  = geotransform[3] + c * geotransform[4] + r * geotransform[5]
 * whatever the registration. Its numbers must lie within +-2^512, else TKS_USAGE.
 *
 * Area: on a geographic grid the ground of a sample shrinks towards the poles. With the latitudes
 * of its edges bytes go first where there is more ground, if the areas differ so much that it pays:
 * in lossless streams and those within a number of bytes, of heights alone. Beside a texture
 * cameras, told or not, say what comes first; latitudes then count for nothing. A globe takes 1.5
 * to 3.7 % fewer bytes at equal RMSE over the area. PSNR, max_error, and the errors that streams
 * state, count samples. Latitudes must lie within +-180, else TKS_USAGE: rows on a pole have an
 * edge behind it. Streams do not keep them.
 *
 * Texts are UTF-8 of at most 65 535 bytes each, else TKS_USAGE. What decoders give is what streams
 * hold, which may be any bytes. */
typedef struct tks_heights {
  size_t size;            /* sizeof(tks_heights) */
  uint32_t width, height; /* from 1 to 2^20 */
  tks_sample sample;
  const void* data;
  double scale, offset;          /* 1 and 0 when samples are heights; finite, scale not 0 */
  double step;                   /* quantisation step in samples; 0: chosen (exact if possible) */
  double spacing_x, spacing_y;   /* metres per sample; 0: unknown, which pictures take for 30 */
  const char* unit;              /* UTF-8, NULL: unknown; e.g. "m" */
  const char* vertical_datum;    /* UTF-8, NULL: unknown; e.g. "EGM2008", "EPSG:5703" */
  const char* crs;               /* UTF-8 "EPSG:code", WKT or a name, NULL: unknown */
  int has_nodata;                /* non-zero: `nodata` is declared */
  double nodata;                 /* as a sample; one that the type cannot hold meets none */
  double geotransform[6];        /* above; in the order of GDAL */
  int has_geotransform;          /* 0: the place is unknown, and `geotransform` not looked at */
  tks_registration registration; /* 0: unknown */
  const char* description;       /* UTF-8, what GDAL calls the band's description; NULL: none */
  const char* geo_keys;          /* what a GeoTIFF says of its CRS beyond `crs` and
                                     `vertical_datum` ("1024=1 1026=\"my grid\" ...":
                                     docs/FORMAT.md); NULL: nothing */
  const uint8_t* positions;      /* of tks_fit_positions: longitudes and latitudes for receivers
                                     that do not know the CRS; NULL: none */
  size_t positions_size;         /* in bytes */
  tks_domain domain;             /* 0: a plane */
  double first_latitude;         /* in degrees, of the outer edges of the first row and of the */
  double last_latitude;          /* last row of a geographic grid; both 0: unknown */
  tks_forest forest;             /* with TKS_DOMAIN_FOREST: the heights are its raster. Samples
                                     that are shared must be equal bit for bit, and there are no
                                     voids, else TKS_USAGE */
  uint32_t grid_width, grid_height; /* heights on a forest that were resampled from a grid: columns
                                     and rows of the grid, whose place the georeference is then;
                                     0: none */
  tks_base_mesh base_mesh;          /* with TKS_DOMAIN_FOREST, of TKS_MOST_OBJECT_DEPTH at most */
} tks_heights;

/* A texture to encode: channels 1 grey, 2 grey+alpha, 3 RGB, 4 RGBA, interleaved, tightly packed.
 * With `opaque` the last of 2 or 4 is a further colour, such as near infrared, which pictures and
 * meshes leave out. A texture covers the same footprint as the height field. sample: TKS_U8 or
 * TKS_U16. Sizes from 1 x 1 to 32 768 x 32 768, on a forest to those of its raster.
 *
 * Cut-outs: an alpha that is 0 or the largest value, and nothing else, is coded as a mask ahead of
 * the colours and comes back exactly. (Where all is drawn in few colours, alpha is one of their
 * channels: exact in the complete stream, which is sent whole.) Unless the stream is lossless, the
 * colours of texels with alpha 0 are not kept (they come back as the mean of the others) and count
 * in no error. Nor are those of another alpha, which is coded as a channel; they come back as any.
 *
 * Georeference: as that of tks_heights. */
typedef struct tks_image {
  size_t size; /* sizeof(tks_image) */
  uint32_t width, height, channels;
  tks_sample sample;
  const void* data;
  double geotransform[6];        /* of the texels; in the order of GDAL */
  int has_geotransform;          /* 0: nothing but the footprint is known */
  tks_registration registration; /* 0: unknown */
  const char* crs;               /* UTF-8, NULL: that of the heights */
  const char* geo_keys;          /* UTF-8, likewise */
  int opaque;                    /* non-zero: no channel is alpha */
  uint32_t white_level;          /* 0: that of tks_find_white_level */
  const uint8_t* positions;      /* of tks_fit_positions; NULL: none but those of the heights */
  size_t positions_size;
  tks_domain domain; /* 0: a plane, whatever the heights are; beside an object a forest */
  tks_forest forest; /* with TKS_DOMAIN_FOREST, as of heights; beside heights on a forest
                                    of as many patches, whose sides are glued alike */
} tks_image;

/* The white level of a texture is the value that pictures show as white; what lies above it is as
 * white. Errors count as parts of it: on the screen, in a PSNR, and beside the heights. No sample
 * is changed. It is 255 of 8 bits, and 1 to 65535 of 16. This finds one for textures that use a
 * quarter of 16 bits or less, as reflectances and cameras of 12 bits do: where 98 % of the colours
 * other than 0 lie, and a quarter more. It is the largest value of others, and of textures with an
 * alpha of more than two values. 0: image is NULL, or tks_encode would refuse it. */
uint32_t tks_find_white_level(const tks_image* image);

/* Returns 0 to continue, anything else to stop with TKS_USAGE. done is in [0, 1] and never falls;
 * equal steps of it do not take equal times. It is called on any thread of the call, by one thread
 * at a time, and mostly ten times a second. Large planes without regions make pauses of seconds. */
typedef int (*tks_progress)(void* user, double done);

/* How errors of a texture's wavelet are weighed: what counts most comes first, and is kept where
 * bytes are few. The complete stream holds the same. */
typedef enum tks_weights TKS_INT {
  TKS_WEIGHTS_PSNR = 0,  /* their squares */
  TKS_WEIGHTS_VISUAL = 1 /* what an eye sees that has 64 samples in a degree: fine detail counts
                            less, in colour differences much less; costs up to 1.2 dB of PSNR */
} tks_weights;

/* A pinhole camera that looks at the heights with their texture. Its places are in metres: x points
 * east, y up, z south, and the origin is the middle of the heights at height 0. Where the spacing
 * of the heights is unknown, samples are 30 metres apart. */
typedef struct tks_camera {
  const char* name;                /* UTF-8, for messages; NULL: its number, from 1 */
  double eye[3], target[3], up[3]; /* up: not along the line of sight */
  double fov_y;                    /* degrees from lower to upper edge, above 0, below 180 */
  uint32_t width, height;          /* pixels, 1 to 8192 */
  double weight;                   /* of its picture beside others; not negative, 0: it does not
                                      count; one of them is above 0 */
} tks_camera;

/* How far a picture of decoded samples is from that of the original ones. heights: samples as in
 * tks_heights.data; texels: as in tks_image.data. Writes the squared error, summed over pixels and
 * over R, G and B of 0 to 255 each, and of how many such values it is the sum. Returns 0, or
 * anything else if it cannot draw: then the encoder does without pictures. */
typedef int (*tks_picture_error)(void* user, const void* heights, const void* texels,
                                 double* squares, double* values);

/* The index of a stream, by which windows of regions are fetched without the rest. It stands in
 * front, in the header, or in pages. */
typedef enum tks_index TKS_INT {
  TKS_INDEX_NONE = 0,
  TKS_INDEX_PACKETS = 1, /* an index; packets lie by half octaves of what a byte is worth, and
                            region by region within one */
  TKS_INDEX_WINDOWS = 2, /* an index; each region lies in one piece, so that windows take few
                            requests, but a prefix has some regions and lacks others. Only of
                            lossless streams, and of heights alone within max_error */
  TKS_INDEX_PAGES = 3    /* an index in pages, which lie behind the packets: a window takes those of
                            its regions. Mosaics have it (mosaic.h), no others */
} tks_index;

/* What a component is coded as, before a residual corrects it. */
typedef enum tks_base TKS_INT {
  TKS_BASE_STORED = 0,  /* nothing: the samples are stored */
  TKS_BASE_DRAWING = 1, /* shapes of few values */
  TKS_BASE_WAVELET = 2  /* coefficients */
} tks_base;

/* What corrections behind the base restore. */
typedef enum tks_residual TKS_INT {
  TKS_RESIDUAL_NONE = 0,
  TKS_RESIDUAL_WITHIN = 1, /* every sample, but for an error of at most `within` */
  TKS_RESIDUAL_EXACT = 2   /* every step or sample */
} tks_residual;

/* Whether the encoder took a plan, or else why not. */
typedef enum tks_verdict TKS_INT {
  TKS_VERDICT_TAKEN = 0,
  TKS_VERDICT_EXPECTED_LONGER = 1, /* an estimate says that it takes more bytes, or hardly fewer:
                                      it was not coded */
  TKS_VERDICT_LONGER = 2,          /* it takes more bytes than another plan, or as many */
  TKS_VERDICT_MISSES_TARGET = 3,   /* all of its bytes do not reach the error asked for */
  TKS_VERDICT_NO_ROOM = 4,         /* tks_encode_options.bytes does not hold it */
  TKS_VERDICT_WORSE_PREFIXES = 5,  /* prefixes of it lose more than its bytes save */
  TKS_VERDICT_WORSE_IN_BUDGET = 6  /* what the budget holds of it shows more errors, or its end is
                                      of no use there */
} tks_verdict;

/* A plan by which the encoder has coded a component, or thought of coding it. Errors are those of
 * heights in `unit`, or of texels as these are. Texts are English words, for people: later versions
 * may have others. The struct and its texts belong to the library and are there until the call of
 * tks_explain returns. Later versions may append fields: `size` tells which are there. */
typedef struct tks_weighed_plan {
  size_t size;    /* sizeof(tks_weighed_plan) of the library */
  int is_texture; /* 0: it is about the heights */
  tks_verdict verdict;
  tks_base base;
  tks_residual residual;
  double step;           /* of heights, in samples; 0: places in a table, or samples themselves */
  uint32_t table_values; /* of the tables of values, all together; 0: there is none */
  int fractions;         /* non-zero: the wavelet keeps fractions, and does not end exact */
  const char* filters;   /* of level 1, of level 2 and of coarser ones: "six-tap, six-tap, quiet";
                            "": the plan has none, or an estimate did without their choice */
  const char* predictor; /* from which the residual starts: "base", "neighbours", "relative steps",
                            "facets"; "": there is no residual */
  const char* layers;    /* beside the base: "mask, flat areas, regions"; "": none */
  double cut;            /* the RMSE at which the wavelet ends ahead of the residual; < 0: it goes
                            to its end */
  double within;         /* of TKS_RESIDUAL_WITHIN; else 0 */
  double expected_bytes; /* by an estimate of its tracks; < 0: none was made */
  int coded;             /* 0: it was not coded, and what follows is 0 */
  uint64_t coded_bytes;  /* of its tracks; where it had lost, coding may have ended early */
  uint64_t needed_bytes; /* of these, what the target needs; of a plan that was taken, what the
                            stream holds */
  uint64_t header_bytes; /* of the header, which other plans do without */
  double rmse;           /* that all coded bytes leave, as the encoder's account has it: within some
                            per cent, but for the verdict TKS_VERDICT_MISSES_TARGET */
} tks_weighed_plan;

/* Takes one plan; see tks_encode_options.explain. */
typedef void (*tks_explain)(void* user, const tks_weighed_plan* plan);

/* What to optimise. Exactly one of bytes, psnr, max_error, lossless is non-zero. */
typedef struct tks_encode_options {
  size_t size;         /* sizeof(tks_encode_options) */
  uint64_t bytes;      /* the whole stream takes at most this many bytes */
  double psnr;         /* heights (peak: their range) and texture each reach this many dB */
  double max_error;    /* every decoded height is within this distance, in `unit`; guaranteed: the
                        encoder decodes and measures. Finer than 2^26 steps over the range allow:
                        bit for bit. Finer than a `step` that is given: TKS_USAGE */
  int lossless;        /* everything comes back bit for bit, floats by their bit patterns (NaN: see
                        tks_heights) */
  uint32_t triangles;  /* meshes will be drawn with at most this many triangles; 0: no bound */
  uint32_t threads;    /* 0 or 1: one thread; the bytes never depend on it */
  uint32_t regions;    /* side of the regions by which windows can be decoded, in samples of either
                        component: a power of two from 16 to 2^20; 1: none, which tks_info calls 0;
                        0: chosen, none up to 1025 x 1025 heights, 2048² texels, or for windows
                        256 wherever that makes several. Of a forest each patch has its own */
  int index;           /* a tks_index: whether to write the byte ranges of every packet in front */
  tks_weights weights; /* of the texture; targets and stated errors remain squares */
  tks_progress progress;
  void* user;
  const tks_camera* cameras; /* what viewers will see: bytes go where these pictures need them, and
                                ground that they look at comes first. Only where there are both
                                heights and texture; NULL: a mix of views from all sides, for a
                                viewer of whom nothing is known. One that is below the ground,
                                sees none of it or breaks the rules above: TKS_USAGE, with its
                                name */
  uint32_t camera_count;
  tks_picture_error picture_error; /* a renderer that judges about 80 pairs of heights and textures
                                      and so corrects the encoder's own model of the cameras; NULL:
                                      none */
  void* picture_user;
  tks_explain explain; /* is told each plan that was weighed, once: those of the heights in the
                          order in which they were first thought of, then those of the texture. One
                          of each component has TKS_VERDICT_TAKEN. It is called on the thread that
                          called tks_encode, when the stream is made and proved, after which only
                          TKS_NO_MEMORY is left. The stream does not depend on it. NULL: nobody is
                          told */
  void* explain_user;
} tks_encode_options;

/* Bytes allocated by the library; release with tks_free_buffer. */
typedef struct tks_buffer {
  uint8_t* data;
  size_t size;
} tks_buffer;

void tks_free_buffer(tks_buffer* buffer);

/* Writes longitude and latitude, in degrees, of a column and a row, of which (0, 0) is the outer
 * corner of the first sample. Returns 0, or anything else where they are not known. */
typedef int (*tks_locator)(void* user, double column, double row, double* longitude,
                           double* latitude);

/* A raster whose longitudes and latitudes are known to its encoder. */
typedef struct tks_ground {
  size_t size;            /* sizeof(tks_ground) */
  uint32_t width, height; /* samples */
  tks_locator locate;
  void* user;
  double tolerance; /* how far off fitted places may be, in samples; 0: a tenth */
} tks_ground;

/* The most bytes of fitted positions. */
#define TKS_MOST_POSITION_BYTES 200

/* Fits positions to a raster: few bytes that give the longitude and latitude of every column and
 * row within the tolerance, by which receivers place a stream whose CRS they do not know. `out` is
 * what tks_heights.positions and tks_image.positions take. Poles and 180 degrees may lie inside.
 * TKS_UNSUPPORTED: no TKS_MOST_POSITION_BYTES bytes do, or places of the raster have no longitude
 * and latitude; `out` is empty then. The library that only decodes lacks this function. */
tks_status tks_fit_positions(const tks_ground* ground, tks_buffer* out);

/* Encodes heights (NULL: texture only), image (NULL: geometry only), or both.
 * message, if not NULL, receives one sentence of at most message_size - 1 characters on failure:
 * TKS_USAGE for whatever breaks the rules above or cannot be promised, TKS_NO_MEMORY, or
 * TKS_MISMATCH, a fault of the encoder. `out` is empty then. */
tks_status tks_encode(const tks_heights* heights, const tks_image* image,
                      const tks_encode_options* options, tks_buffer* out, char* message,
                      size_t message_size);

/* The most frames of one stream. */
#define TKS_MOST_FRAMES 32

/* Encodes `count` frames, from 2 to TKS_MOST_FRAMES, that follow one another in time into one
 * stream: of heights (NULL: none), of textures (NULL: none), or of both. Arrays hold a struct for
 * each frame, each as long as the size of the first says. Frames differ in their samples alone, so
 * also in their voids; all else is that of the first one. What stands still takes bytes once, and a
 * prefix shows all frames, each about as well as it can. Of `options` these count: one target
 * (bytes of the stream; a PSNR over all frames; a largest error of every height of every frame;
 * lossless), threads, regions, index, progress. Beside heights a texture needs `bytes`, a PSNR or
 * lossless.
 *
 * TKS_USAGE, with a sentence in message: as tks_encode; frames that are not alike, or lie on a
 * forest. TKS_UNSUPPORTED: heights that no steps of one size show as exactly as the target asks
 * for, such as floats that are multiples of nothing, to be lossless: encode each by itself. */
tks_status tks_encode_frames(const tks_heights* heights, const tks_image* images, uint32_t count,
                             const tks_encode_options* options, tks_buffer* out, char* message,
                             size_t message_size);

/* How an object is coded. */
typedef enum tks_object_kind {
  TKS_OBJECT_AUTO = 0,      /* (encoder) in whichever way comes nearer to the mesh */
  TKS_OBJECT_RESAMPLED = 1, /* as heights over a base mesh: scans, sculptures */
  TKS_OBJECT_TRIANGLES = 2  /* as triangles: designed parts, models of few triangles */
} tks_object_kind;

/* In the place of the bytes of a sketch. */
#define TKS_NO_SKETCH UINT64_MAX

/* An image that lies on a mesh as its texture does: a map of its material, or any other one. */
typedef struct tks_object_map {
  size_t size;            /* sizeof(tks_object_map) */
  const char* name;       /* UTF-8, up to 255 bytes, of its component. Maps of a material are
                             normal, metallic_roughness, occlusion and emissive (FORMAT.md,
                             section 2) */
  const tks_image* image; /* 8 or 16 bits, of any size */
  double weight;          /* what its errors, in units of its range of values, count beside those of
                             others; 0: what those of such a map change in a picture */
} tks_object_map;

/* A mesh of triangles to encode as an object: a scan, a sculpture, a designed part. Triangles need
 * not fit together: points at equal places are joined, degenerate and double triangles dropped, and
 * edges of more than two triangles cut. */
typedef struct tks_triangle_mesh {
  size_t size;                           /* sizeof(tks_triangle_mesh) */
  uint32_t vertex_count, triangle_count; /* to 2^26 */
  const double* positions;               /* 3 * vertex_count numbers up to 1e30, in any unit */
  const uint32_t* triangles;             /* 3 * triangle_count, below vertex_count;
                                             counter-clockwise seen from outside */
  const char* unit;                      /* UTF-8, NULL: unknown */
  const char* description;               /* UTF-8, a name; NULL: none */
  const float* texcoords;                /* 6 * triangle_count, beside an image: where corners of
                                            triangles lie on it. (0, 0) is its upper left corner,
                                            (1, 1) its lower right; it repeats beyond these */
  tks_object_kind kind;
  uint64_t sketch_bytes; /* of the sketch that the stream begins with, about; 0: a 32nd part of the
                            stream if nothing would be seen of it for long; TKS_NO_SKETCH: none */
  const char* material; /* UTF-8, what the surface is made of: a glTF material as JSON (FORMAT.md,
                           section 2); NULL: none */
  uint32_t texels;      /* the longest side of the images that tks_combine lays on the triangles
                           later: texcoords are kept as finely as that of these, or of the image,
                           asks for. 0: there are none */
  const tks_object_map* maps; /* beside an image; they have names of their own */
  uint32_t map_count;
} tks_triangle_mesh;

/* A stream of one of the kinds of object, for the target that was asked for. */
typedef struct tks_object_trial {
  uint64_t bytes;     /* 0: the kind was not asked for, or cannot meet the target */
  double psnr;        /* of the surface, as of tks_object_report */
  double screen_psnr; /* dB of R, G and B in the cameras' pictures, over pixels in which the mesh or
                         the object is seen; infinite without error; 0: there is no image */
} tks_object_trial;

/* What became of a mesh. Distances are between its surface and that of the decoded stream, in its
 * unit, of 20 000 places of either. */
typedef struct tks_object_report {
  size_t size;                  /* sizeof(tks_object_report) */
  uint32_t triangles;           /* that are left after cleaning */
  uint32_t dropped_triangles;   /* degenerate or double ones */
  uint32_t cut_edges;           /* of more than two triangles, or of two that cannot face one way */
  uint32_t components, borders; /* connected parts, and closed rings of open edges */
  uint32_t patches, depth;      /* of the forest: samples are (2^depth + 1)^2 a patch */
  double diagonal;              /* of the box around the mesh */
  double resampling_error;      /* of all samples, uncoded: the larger of the two RMS distances */
  double error, largest;        /* of the stream, likewise; and the largest distance */
  double psnr;                  /* 20 log10(diagonal / error) */
  uint32_t texture_depth;       /* of the forest that the texture lies on; 0: there is none */
  tks_object_kind kind;         /* in which way the object was coded. With TKS_OBJECT_TRIANGLES
                                   patches, depths and resampling_error are 0 */
  uint32_t coded_triangles;     /* with TKS_OBJECT_TRIANGLES, else 0 */
  tks_object_trial as_resampled, as_triangles; /* of which `kind` is the better one, before a sketch
                                                  took some bytes */
  uint64_t sketch_bytes; /* that the stream begins with; 0: none */
} tks_object_report;

/* Encodes a mesh as an object, which tks_decode_object makes meshes of, in one of two ways.
 * TKS_OBJECT_RESAMPLED: as heights along the normals of a base mesh (tks_base_mesh). Its triangles
 * do not come back. TKS_OBJECT_TRIANGLES: its triangles with their corners rounded, or fewer
 * triangles where the target takes no more; all of them are in the header, ahead of the texture.
 * Of `options` these count: bytes (the least error is sought), or psnr (of the surface: 20
 * log10(diagonal / error), as tks_object_report has it; the fewest bytes are sought), or max_error
 * (every sample of the base keeps its height within that distance, and the resampling error is at
 * most a third of it; or every corner stays within that distance); index, progress, threads; and
 * cameras, in the axes and the unit of the mesh, which need an image. `report` may be NULL.
 *
 * Nothing of an object is seen before the whole header is there. Where it takes more than 4 kB and
 * more than a 16th of the stream, the stream begins with a sketch: the same object over a coarse
 * base, in a stream of its own. Decoders show it until the header is there.
 *
 * image: the texture of the mesh, which has texcoords, or NULL. With TKS_OBJECT_RESAMPLED its
 * texels are resampled on the same patches, so that receivers need no coordinates, and it has no
 * seams: about as many of them as the mesh uses of the image, or fewer where `bytes` are few. With
 * TKS_OBJECT_TRIANGLES it is coded as it is, all triangles are kept, and texcoords are rounded to
 * halves of a texel. `bytes` is the only target beside an image; the mesh and its image share them
 * by what they take off the errors of pictures, which cameras see or, without any, cameras all
 * around the mesh. Of the image's place nothing counts.
 *
 * Maps become components (components.h) in the one order of packets. With TKS_OBJECT_RESAMPLED they
 * are resampled as the texture is, on a forest of the same depth, which suits the one of all images
 * that the mesh shows most texels of; a map of the name normal is left out, since its normals count
 * from the texture coordinates.
 *
 * TKS_USAGE, with a sentence in message: a mesh, or options, that break the rules; no triangle is
 * left after cleaning; the base mesh would take more than 4096 patches, since there are too many
 * parts, and triangles are not coded either; more than 1048576 triangles would be coded, or they
 * take more than a megabyte; the target cannot be met. */
tks_status tks_encode_object(const tks_triangle_mesh* mesh, const tks_image* image,
                             const tks_encode_options* options, tks_object_report* report,
                             tks_buffer* out, char* message, size_t message_size);

/* Samples that lie farther from all others than these do from each other, so that they can only
 * stand for heights that are missing. Single samples are such only at the ends of an integer type;
 * those of 8 bits, the value 0, and whatever lies beside a single other value, never are. */
typedef struct tks_outliers {
  size_t size;    /* sizeof(tks_outliers) */
  uint64_t count; /* 0: there are none beside the declared nodata value */
  double value;   /* the outermost of them, as a sample */
  int is_fill;    /* all have that value, and files write it where they have no height: -9999 and
                     other rows of nines, -32768, -32767, -2147483648, floats from 1e10 on. Whoever
                     declares it as nodata saves bytes, and most of the error of small streams */
} tks_outliers;

/* Looks for outliers among heights that are not the declared nodata value. tks_encode does not:
 * an undeclared value is a height to it. TKS_USAGE: heights that tks_encode refuses as well. */
tks_status tks_find_outliers(const tks_heights* heights, tks_outliers* out);

/* What a decoder may take. It refuses more with TKS_LIMIT, before it allocates anything. A field of
 * 0 means its default. */
typedef struct tks_limits {
  size_t size;          /* sizeof(tks_limits) */
  uint64_t max_samples; /* heights, refused by tks_open; default 2^28; 32-bit programs: < 2^29 */
  uint64_t max_texels;  /* likewise; default 2^28 */
  uint64_t max_memory;  /* bytes that a decoder and one call together may allocate, the caller's
                           arrays not counted; default 8 GiB, in 32-bit programs 2. Each call is
                           judged by what it is asked for: of a stream that is too large as a
                           whole, levels, windows and meshes of few triangles may fit.
                           tks_check_memory says what calls for its parts take */
} tks_limits;

typedef struct tks_decoder tks_decoder;

/* Opens the first `size` bytes of a stream. The data must outlive the decoder, or its first
 * tks_append or tks_put. A prefix too short to hold the header gives TKS_TRUNCATED with the number
 * of bytes needed in the message. A stream may begin with a sketch (tks_triangle_mesh): as long as
 * bytes of its header are missing, the decoder is one of the sketch (info.shows_sketch), as if that
 * were the stream. The call of tks_append that brings the header makes it one of the stream: with
 * other sizes, a surface of its own, and new texts in tks_info. */
tks_status tks_open(const uint8_t* data, size_t size, const tks_limits* limits, tks_decoder** out,
                    char* message, size_t message_size);
void tks_close(tks_decoder* decoder);

/* Sets *bytes to how many bytes of a stream, of which `size` are there, tks_open needs: those of
 * its header or, with a sketch, of the header of that. TKS_OK: they are there. TKS_TRUNCATED: so
 * many are needed, or more, if that is not known yet (ask again with them). TKS_CORRUPT or
 * TKS_UNSUPPORTED, *bytes 0: this is no stream, or none for this library. */
tks_status tks_header_bytes(const uint8_t* data, size_t size, uint64_t* bytes);

/* Gives the decoder more bytes of the stream: those that follow what it has. The first time it
 * copies all bytes that are there, and no longer needs those given to tks_open; else it takes time
 * for the new bytes alone, however many tracks and packets there are. From then on every call
 * decodes what it would decode of a decoder opened on all bytes. Decoding goes on where it was, so
 * that it takes time for the new bytes and for one inverse transform. For that the decoder keeps
 * the coefficients, about 16 bytes a sample, for all levels together; where limits.max_memory does
 * not allow for them, it decodes from the beginning. tks_get_info tells what is known now.
 * TKS_CORRUPT: these bytes belong to no stream. TKS_LIMIT: as of tks_open. In both cases the
 * decoder goes on with what it had, and takes no more bytes. TKS_NO_MEMORY, of tks_put as well: the
 * decoder is lost, and every later call on it says so; close it. */
tks_status tks_append(tks_decoder* decoder, const uint8_t* data, size_t size);

/* Gives the decoder bytes from anywhere in a stream that has an index (tks_info.index): `size`
 * bytes from `offset` on. Bytes that are there already are left
 * as they are. Each track is decoded up to its first gap. So of a stream in regions any regions may
 * come first: the index tells the byte ranges of their packets, of an index in pages once it has
 * the pages of these regions. The other tracks of a component are
 * decoded once the first one has its masks, and corrections of a region once all coefficients are
 * there that reach into it. info.available_bytes and info.packets count up to the
 * first gap. The first call that leaves a gap reads the index; else this takes time in proportion
 * to the new bytes, in whatever order they come. TKS_CORRUPT: the index does not describe the
 * packets, which only matters where bytes leave gaps. TKS_USAGE: there is no index, and `offset`
 * lies behind a gap. */
tks_status tks_put(tks_decoder* decoder, uint64_t offset, const uint8_t* data, size_t size);

/* Bytes of a stream: `size` of them from `offset` on. */
typedef struct tks_range {
  uint64_t offset, size;
  double gain; /* of tks_plan: what one of its first bytes takes off the squared error of the
                  picture, beside other ranges of the plan; 0: nothing of it is seen */
} tks_range;

/* Does what tks_put does for many ranges, in less time: data[i] holds the ranges[i].size bytes from
 * ranges[i].offset on. The library keeps none of the arrays. After TKS_USAGE it has taken none of
 * the bytes. */
tks_status tks_put_ranges(tks_decoder* decoder, const tks_range* ranges, const uint8_t* const* data,
                          size_t count);

/* One sentence about the last failure of this decoder; "" if none. Owned by the decoder. */
const char* tks_message(const tks_decoder* decoder);

typedef struct tks_info {
  size_t size; /* sizeof(tks_info), set by the caller */
  uint32_t format_version, profile, level;
  uint64_t header_bytes;                  /* bytes before the first packet */
  uint64_t stream_bytes;                  /* what the encoder wrote, header included */
  uint64_t available_bytes;               /* bytes that are there, up to the first missing one */
  uint64_t packets;                       /* packets begun in the available bytes */
  uint64_t geometry_bytes, texture_bytes; /* payload available of either component */
  int has_heights, has_texture;
  uint32_t width, height;  /* heights, of the level that is set; 0 when absent */
  uint32_t coarsest_level; /* of the heights, for tks_set_levels */
  tks_sample sample;
  double scale, offset, step; /* decoded integer q stands for sample q * step + base */
  double base;
  double spacing_x, spacing_y; /* of the level that is set */
  int exact_steps;             /* the step loses nothing */
  int lossless;                /* the complete stream restores every sample */
  int has_voids;               /* some samples may be void */
  int has_nodata;              /* voids come back as `nodata` */
  double nodata;               /* NaN where NaN was declared */
  double max_error;            /* guaranteed for the complete stream, in unit; < 0: not stated */
  uint32_t triangles;          /* the encoder's triangle budget; 0: none */
  uint32_t regions, texture_regions; /* side of the regions; 0: none (of options: 1) */
  uint32_t texture_width, texture_height, texture_channels; /* of the level that is set */
  uint32_t texture_coarsest_level;
  int texture_cutout; /* alpha is 0 or the largest value; 2: and colours where it is 0 are
                              not kept */
  int texture_drawn;  /* 1: colours coded as they are; 2: those of an overlay on a photograph;
                              3: samples stored, because nothing codes them in fewer bytes */
  tks_sample texture_sample;
  double heights_rmse; /* stated by the last complete packet, in unit; < 0: not yet stated */
  double texture_psnr; /* likewise, dB; < 0: not yet stated; infinity: exact */
  const char* unit;    /* "" when unknown; owned by the decoder */
  const char* vertical_datum;
  const char* crs;
  int heights_drawn;      /* 1: values coded as they are, without a wavelet; 3: samples stored,
                              because nothing codes them in fewer bytes */
  int has_geotransform;   /* of the heights; 0: their place is unknown */
  double geotransform[6]; /* of the level that is set (tks_heights says what it is); 0 when
                              unknown. Of a window that begins at column c and row r: [0] and
                              [3] become the x and y of (c, r) */
  tks_registration registration;
  const char* description; /* "" when unknown, as the texts below; owned by the decoder */
  const char* geo_keys;
  int texture_has_geotransform;   /* the texture has a georeference of its own */
  double texture_geotransform[6]; /* of the level that is set */
  tks_registration texture_registration;
  const char* texture_crs; /* that of the heights where the texture's place is known and no
                                   other CRS is stated */
  const char* texture_geo_keys;
  tks_index index;    /* TKS_INDEX_WINDOWS: by how its packets lie */
  int texture_opaque; /* no channel is alpha (tks_image) */
  int voids_known;    /* 0: bytes of the mask of voids are missing, so that some voids may be
                              shown as ground, filled in from around. Where each region has a mask
                              of its own, 0 until all bytes are there */
  uint32_t texture_white_level; /* what pictures show as white (tks_image); 0: no texture */
  const uint8_t* positions;     /* as tks_heights takes them, for tks_locate and for encoders that
                                   keep them; NULL: there are none. Owned by the decoder */
  size_t positions_size;
  const uint8_t* texture_positions; /* of the texture alone */
  size_t texture_positions_size;
  tks_domain domain; /* of the heights */
  tks_domain texture_domain;
  tks_forest forest;                /* with TKS_DOMAIN_FOREST, of the level that is set; owned by
                                       the decoder */
  tks_forest texture_forest;        /* likewise */
  uint32_t grid_width, grid_height; /* as in tks_heights. Above level 0 it is a coarser grid on
                                       the same ground, without a last column that is the first
                                       one again; geotransform is that of the grid */
  tks_base_mesh base_mesh;          /* likewise; owned by the decoder */
  uint32_t object_triangles;        /* of an object whose triangles are coded as they are: all of
                                       them, which tks_decode_object gives; 0: others */
  uint32_t frames;                  /* how many the stream has; 1: it is no group of a sequence */
  uint32_t frame;                   /* the one that is set (tks_set_frame), from 0 */
  uint32_t components;              /* how many the stream has (components.h) */
  int shows_sketch;                 /* the bytes end inside the header, and all fields but
                                       header_bytes, stream_bytes and available_bytes are those of
                                       the sketch that it begins with (tks_triangle_mesh) */
  uint64_t least_bytes;             /* the fewest bytes of the stream that tks_open takes: those of
                                       its header or, with a sketch, of the header of that */
  const char* material;             /* of an object, as tks_triangle_mesh takes it, but not checked;
                                       "": none. Owned by the decoder */
  uint64_t index_bytes;             /* of index pages (TKS_INDEX_PAGES), which lie behind the
                                       stream_bytes of the stream; 0: there are none */
} tks_info;

tks_status tks_get_info(const tks_decoder* decoder, tks_info* info);

/* Sets the mip levels that calls decode from now on. Level k of W x H samples is the image of
 * ceil(W / 2^k) x ceil(H / 2^k) whose sample (x, y) lies on sample (x 2^k, y 2^k), low-pass
 * filtered, of a forest that of each patch; level 0 is the image itself. tks_get_info then tells
 * the level's sizes and spacing. A level takes no inverse transform of the finer ones, and reads
 * the stream only up to the last byte that concerns it. Voids follow the mask at the level's
 * samples. No maximum error is guaranteed above level 0. Calls that make meshes need level 0 of the
 * heights to be set, and choose the level that their triangles can show themselves. TKS_USAGE
 * beyond the coarsest levels (those of a missing part: 0); the levels are then as before. */
tks_status tks_set_levels(tks_decoder* decoder, uint32_t heights, uint32_t texture);

/* Sets the frame that calls decode from now on, of a stream of several (tks_info.frames); at first
 * it is 0. The first call for a view decodes all of its frames, and takes the time and the memory
 * of all of them (tks_check_memory counts it); they are kept, in 4 bytes a sample and frame, so
 * that the others take hardly any time. TKS_USAGE: there is no such frame. */
tks_status tks_set_frame(tks_decoder* decoder, uint32_t frame);

/* Writes width * height samples of info.sample; bytes must be their exact size. Voids: info.nodata,
 * or NaN; see voids_known of tks_info. */
tks_status tks_decode_heights(tks_decoder* decoder, void* out, size_t bytes);

/* Writes width * height heights in info.unit, one float each. Where a prefix says more than whole
 * steps of the sample type can show, the heights lie between the steps: what a renderer should
 * draw. Of a complete stream that is lossless or states a largest error they are those of the
 * samples (at level 0), which keep that. Voids are NaN. */
tks_status tks_decode_surface(tks_decoder* decoder, float* out, size_t count);

/* Writes width * height bytes: 1 where a sample is valid, 0 where it is void. A prefix that ends
 * inside the mask gives it at a coarser resolution; or, where the mask comes late because it is one
 * of many holes, it gives those of them that it knows of (voids_known of tks_info). */
tks_status tks_decode_validity(tks_decoder* decoder, uint8_t* out, size_t count);

/* Writes texture_width * texture_height * texture_channels samples of info.texture_sample. */
tks_status tks_decode_texture(tks_decoder* decoder, void* out, size_t bytes);

/* A rectangle of samples, or of texels, of the level that is set. */
typedef struct tks_window {
  uint32_t x, y, width, height;
} tks_window;

/* These write what tks_decode_heights, _surface, _validity and _texture would write in the window,
 * and nothing else: window->width * window->height samples, row by row. The window must lie inside
 * of the level that is set and hold a sample, else TKS_USAGE. One on a cylinder may reach across
 * its seam: it begins inside, and is no wider than the raster. Of a stream in regions they decode
 * only those that reach the window; with corrections (of a largest error, or of samples that no
 * step restores) those that reach the regions that it meets. Windows of levels above 0 are cut out
 * of the level where there are drawings, frames or repeated lines, and take as long; so do windows
 * of a forest with corrections, voids or a cut-out. */
tks_status tks_decode_heights_window(tks_decoder* decoder, const tks_window* window, void* out,
                                     size_t bytes);
tks_status tks_decode_surface_window(tks_decoder* decoder, const tks_window* window, float* out,
                                     size_t count);
tks_status tks_decode_validity_window(tks_decoder* decoder, const tks_window* window, uint8_t* out,
                                      size_t count);
tks_status tks_decode_texture_window(tks_decoder* decoder, const tks_window* window, void* out,
                                     size_t bytes);

/* A grid whose columns go round the Earth. */
typedef struct tks_geographic_grid {
  size_t size;            /* sizeof(tks_geographic_grid) */
  uint32_t width, height; /* columns, from 1 to 2^20; rows, from 2 to 2^20 */
  double geotransform[6]; /* in degrees, in the order of GDAL: columns go east or west, once round
                              the Earth, where the last one may be the first one again; rows go
                              south or north, and the middles of their samples lie between the
                              poles */
} tks_geographic_grid;

/* The most depth of a cube that is made of a grid, or a grid of it. */
#define TKS_MOST_CUBE_DEPTH 14

/* The depth that suits a grid of so many columns: the least one, from 1 to TKS_MOST_CUBE_DEPTH, at
 * which the equator of the cube has as many samples as a row of the grid. */
uint32_t tks_cube_depth(uint32_t width);

/* Resamples heights of a grid on a cube. cube: 6 * (2^depth + 1)^2 heights, the raster of a forest
 * of six patches with tks_cube_sides, in which shared samples are equal bit for bit. What lies
 * between its samples comes nearest to the heights, by least squares over the area of the Earth: a
 * cube that is coarser than the grid takes means. Where a grid ends more than a row before a pole
 * its last row goes on to the pole, and turns into its mean on the way.
 *
 * largest_error and rmse, unless NULL, become how far tks_grid_from_cube is from the heights: the
 * most, and over the area of the Earth. The result does not depend on the number of threads. It
 * takes some 40 bytes of memory a sample of the grid, and 16 a sample of the cube. TKS_USAGE, with
 * a sentence in message as that of tks_encode: a grid or depth that breaks the rules, heights that
 * are not numbers (voids) or beyond +-1e30. The library that only decodes lacks this function. */
tks_status tks_cube_from_grid(const tks_geographic_grid* grid, const float* heights, uint32_t depth,
                              uint32_t threads, float* cube, double* largest_error, double* rmse,
                              char* message, size_t message_size);

/* Writes the heights of a cube at the samples of a grid, interpolated (bicubic), in any window of
 * the grid, row by row; NULL: all of it. A window begins in the grid, is no wider than it, and may
 * go on behind the last column. cube: as above, whose depth is from 1 to TKS_MOST_CUBE_DEPTH; it
 * may be one that tks_decode_surface has decoded, and hold any floats. Of a stream with
 * tks_info.grid_width the grid has these columns and rows and tks_info.geotransform, in degrees. It
 * takes memory for a column of the cube and a row of the window. TKS_USAGE: a grid, a depth or a
 * window that breaks the rules. */
tks_status tks_grid_from_cube(const float* cube, uint32_t depth, const tks_geographic_grid* grid,
                              const tks_window* window, uint32_t threads, float* out, char* message,
                              size_t message_size);

/* Sets windows, one for each face of a cube of that depth, to those parts of its raster that
 * tks_grid_from_cube reads for a window of a grid; width 0: it reads nothing of the face. */
tks_status tks_cube_windows(uint32_t depth, const tks_geographic_grid* grid,
                            const tks_window* window, tks_window* windows, char* message,
                            size_t message_size);

/* Writes what tks_grid_from_cube makes of the level of the heights that is set, which lie on a
 * cube. It decodes their tks_cube_windows alone, whose ranges tks_needed_ranges tells one by one.
 * count: the samples of the window. */
tks_status tks_decode_grid(tks_decoder* decoder, const tks_geographic_grid* grid,
                           const tks_window* window, float* out, size_t count);

/* What a call decodes. */
typedef enum tks_part TKS_INT {
  TKS_PART_HEIGHTS = 0,    /* tks_decode_heights, tks_decode_surface, and their windows */
  TKS_PART_VALIDITY = 1,   /* tks_decode_validity */
  TKS_PART_TEXTURE = 2,    /* tks_decode_texture, and its window */
  TKS_PART_CODED_MESH = 3, /* tks_decode_mesh and tks_decode_mesh_tree, TKS_MESH_CODED */
  TKS_PART_BUDGET_MESH = 4 /* the same, TKS_MESH_BUDGET */
} tks_part;

/* A column and a row of TKS_PART_HEIGHTS or TKS_PART_TEXTURE, of the level that is set: (0, 0) is
 * the outer corner of the first sample, and (0.5, 0.5) its middle. */
typedef struct tks_pixel {
  tks_part part;
  double column, row;
} tks_pixel;

/* Writes the longitude and the latitude of a pixel in degrees, within the tolerance of those that
 * were fitted. Longitudes are continuous: they go on behind 180 and -180 where the raster does. A
 * texture without positions of its own, but with a geotransform in the CRS of the heights, has
 * theirs. TKS_UNSUPPORTED: the stream holds no positions for this part, which says nothing of its
 * CRS (tks_info.crs). */
tks_status tks_locate(tks_decoder* decoder, const tks_pixel* pixel, double* longitude,
                      double* latitude);

/* Sets *level to the finest mip level of the heights or of the texture that the bytes which are
 * there feed: somewhere a sample of it has an eighth of a bit. Finer ones take longer and show
 * little more. 0: that of a stream that is complete; with no byte it is the coarsest. part:
 * TKS_PART_HEIGHTS or TKS_PART_TEXTURE, else TKS_USAGE, as where the stream has no such part. */
tks_status tks_fed_level(tks_decoder* decoder, tks_part part, uint32_t* level);

/* Says whether tks_limits.max_memory suffices for a call that decodes `part`, before you allocate
 * an array for it. TKS_LIMIT, and a sentence in tks_message: the decoder, the call and `beside`
 * bytes (that array, say) together take more. window: NULL for all of the level that is set.
 * max_triangles: of a budget mesh. *bytes, unless NULL, becomes an upper bound of what the call
 * itself allocates, meshes that it hands over included; more threads take more. Calls check the
 * same with `beside` 0. TKS_USAGE: there is no such part or window. */
tks_status tks_check_memory(tks_decoder* decoder, tks_part part, const tks_window* window,
                            uint32_t max_triangles, uint64_t beside, uint64_t* bytes);

/* Allocated by the library; release with tks_free_ranges. No two of them overlap. */
typedef struct tks_ranges {
  size_t count;
  tks_range* ranges;
} tks_ranges;
void tks_free_ranges(tks_ranges* ranges);

/* Lists which bytes of a stream with an index a call needs, behind the header, to give what it
 * would give of the complete stream: the packets of the tracks that it decodes, in their order.
 * Where the index is in pages, and some of those that tell of these tracks are missing, it lists
 * the pages instead, which lie behind tks_info.stream_bytes: ask again once they are there.
 * Once tks_put_ranges has them the call decodes as if nothing were missing. A window needs some
 * regions; a level from 3 on needs none of the finest levels. For rougher terrain take only what
 * lies before some byte, or, of streams for windows, a first part of each range, which is a region.
 * TKS_USAGE: there is no index, part or window. TKS_LIMIT: as the call. TKS_CORRUPT: a page that is
 * there is damaged. */
tks_status tks_needed_ranges(tks_decoder* decoder, tks_part part, const tks_window* window,
                             tks_ranges* out);

/* How many threads decoding may use from now on: 0 or 1 is one, and the default. What is decoded
 * never depends on it. */
tks_status tks_set_threads(tks_decoder* decoder, uint32_t threads);

/* Checks the whole stream's syntax, and the checksum that lossless streams and those within a
 * largest error have; TKS_TRUNCATED if it is a prefix. */
tks_status tks_verify(tks_decoder* decoder);

typedef enum tks_mesh_kind TKS_INT {
  TKS_MESH_CODED = 0, /* closure of the significant vertices under the parent relation */
  TKS_MESH_BUDGET = 1 /* best mesh of the decoded surface with at most max_triangles: heights of its
                         vertices are fitted (least squares) to all samples, or to those of a mip
                         level with 20 or more a triangle; then nothing finer is decoded */
} tks_mesh_kind;

/* A conforming 4-8 mesh (but for tks_decode_screen_mesh). Vertex i lies on sample grid_index[i]
 * (y * width + x) and has the height height[i] in `unit`. Vertices come in insertion order, parents
 * before children; of a budget mesh the most important ones come first. Triangles are
 * counter-clockwise seen from above with x to the right and y down the rows towards the viewer. No
 * vertex is void and no triangle touches a void sample with a corner; where all samples are void
 * the mesh is empty. */
typedef struct tks_mesh {
  uint32_t vertex_count, triangle_count;
  uint32_t* grid_index;
  float* height;
  uint32_t* triangles; /* 3 * triangle_count indices, all < vertex_count */
} tks_mesh;

/* max_triangles bounds TKS_MESH_BUDGET (0: every sample becomes a vertex) and is ignored for
 * TKS_MESH_CODED. A budget below the base mesh gives the base mesh. TKS_USAGE, from this and all
 * calls that make meshes: there are no heights, or only one column or row of them, which has no
 * area. */
tks_status tks_decode_mesh(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                           tks_mesh* out);
void tks_free_mesh(tks_mesh* mesh);

/* The globe that a grid of longitudes and latitudes lies on. */
typedef struct tks_globe {
  size_t size;         /* sizeof(tks_globe) */
  double semi_major;   /* the ellipsoid's semi-axes in metres, of its equator */
  double semi_minor;   /* and of its poles; WGS 84: 6378137 and 6356752.314245 */
  double degrees;      /* in one unit of the geotransform; 0: 1 */
  double exaggeration; /* what heights are multiplied by; 0: 1 */
} tks_globe;

/* A mesh round a globe, cut open along the seam, or between the patches of a cube, so that a
 * texture can be laid over it. Vertex i lies at column pixel[2 i] and row pixel[2 i + 1] of the
 * grid, counted as in tks_pixel, and at the point position[3 i], in metres from the centre: x
 * towards longitude and latitude 0, y towards longitude 90, z towards the north pole. Vertices of
 * the columns 0.5 and width + 0.5, which are one, have the same position to the last bit; so have
 * those of a pole, which each of its triangles has for itself, and samples that patches share.
 * Taken for one where they are equal, vertices leave no edge open but around voids and where the
 * grid ends before a pole. Triangles are counter-clockwise seen from outside. Every vertex is of a
 * triangle, and none is void. */
typedef struct tks_globe_mesh {
  uint32_t vertex_count, triangle_count;
  double* position;
  double* pixel;
  float* height;       /* in `unit`, not exaggerated */
  uint32_t* triangles; /* 3 * triangle_count indices, all < vertex_count */
} tks_globe_mesh;

/* The mesh of tks_decode_mesh, closed and bent round a globe: triangles join the last column to the
 * first one, and fans the first and last row to the poles, where these lie less than a row beyond;
 * a row on a pole becomes one point. A pole has the mean height of its row. What is farther from a
 * pole stays open: there is no data. So that no edge cuts deep through the globe, the mesh gets all
 * vertices of its coarse levels, which lie on its surface: of TKS_MESH_BUDGET up to half of
 * max_triangles more, or a few hundred, beside those at the seam and at the poles. Heights on a
 * cube (tks_cube_sides) need neither seam nor fans. TKS_USAGE: as tks_decode_mesh; the heights lie
 * on another forest, the stream has no geotransform, its columns do not go once round 360 degrees
 * (whatever its domain), or rows lie beyond a pole; an axis is not above 0, or a number not finite.
 * TKS_LIMIT: as tks_decode_mesh, with 240 bytes more a vertex. */
tks_status tks_decode_globe(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                            const tks_globe* globe, tks_globe_mesh* out);
void tks_free_globe_mesh(tks_globe_mesh* mesh);

/* The mesh of an object. Vertex i lies at the point position[3 i], in `unit`. Triangles are
 * counter-clockwise seen from outside.
 *
 * Of heights over a base mesh (tks_base_mesh) it is sample pixel[2 i], pixel[2 i + 1] of the raster
 * of the forest, counted as in tks_pixel, moved by TKS_MESH_BUDGET to where the triangles come
 * nearest to all samples. Without a texture a sample is one vertex; beside one vertices on sides
 * come once for each patch, with the same position to the last bit. Of fewer triangles than two for
 * each patch a vertex beside a texture has the pixel whose texel it shows, which may be another one
 * than it lies at. Of triangles that are coded as
 * they are vertices come once for each texcoord that they have, and TKS_MESH_BUDGET leaves some of
 * them, where they are. Taken for one where they are equal, vertices leave no edge open but at
 * borders of the object. */
typedef struct tks_object_mesh {
  uint32_t vertex_count, triangle_count;
  double* position;    /* 3 a vertex */
  double* pixel;       /* 2 a vertex; NULL where there is no base mesh */
  double* texcoord;    /* 2 a vertex: its place on the texture, of which (0, 0) is the upper left
                          corner and (1, 1) the lower right one; NULL where there is no texture.
                          With a base mesh it is the middle of a texel of the forest's raster; else
                          the texture repeats beyond its corners */
  float* height;       /* of that sample; NULL where there is no base mesh */
  uint32_t* triangles; /* 3 a triangle */
} tks_object_mesh;

/* The surface of an object as a mesh. TKS_MESH_BUDGET: the best mesh of at most max_triangles
 * triangles, by the squared distance between surfaces; 0: of every sample. Of fewer than two for
 * each patch vertices collapse, as those of kept triangles do, and each triangle that is left shows
 * what it showed of the texture. TKS_MESH_CODED: the vertices whose heights the stream tells.
 * Positions have the same bits on every machine.
 *
 * Of triangles that are coded as they are, TKS_MESH_CODED and 0 give all, and TKS_MESH_BUDGET never
 * gives more than max_triangles: their vertices collapse into neighbours, those first whose
 * triangles move least. Pieces, handles and borders stay what they are, no triangle turns far, and
 * each vertex keeps a texcoord that it had there. Where so few triangles cannot do that, because of
 * many pieces, seams or handles, triangles turn and get texcoords of their neighbours, small pieces
 * vanish, and of the last one the largest triangles are left.
 *
 * TKS_USAGE: the stream is no object. TKS_LIMIT: as tks_decode_mesh, with 100 bytes more a sample
 * and 1600 a patch; or 300 bytes a triangle that is coded as it is. TKS_CORRUPT: these triangles
 * break a rule. */
tks_status tks_decode_object(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                             tks_object_mesh* out);
void tks_free_object_mesh(tks_object_mesh* mesh);

/* A camera that a mesh is made for, as a renderer has it (tks_camera: as people place it). */
typedef struct tks_screen_camera {
  size_t size;            /* sizeof(tks_screen_camera) */
  uint32_t width, height; /* of its picture, in pixels: 1 to 32768 */
  double clip[16];        /* that of tks_view_mesh: columns, rows and heights to clip coordinates,
                             whose y points up in the picture */
  double weight;          /* of its picture beside others; not negative; 0 counts as 1 here */
  const tks_globe* globe; /* what the heights are drawn round: then clip takes metres from its
                             centre, as positions of tks_globe_mesh. NULL: none. Only of tks_plan
                             and tks_reorder */
} tks_screen_camera;

/* What a mesh will be drawn for. */
typedef struct tks_screen {
  size_t size;                      /* sizeof(tks_screen) */
  const tks_screen_camera* cameras; /* `camera_count` of them, each as long as the first one's size
                                       says */
  uint32_t camera_count;            /* 0: no cameras; all ground counts alike, as on a map */
  const tks_image* texture; /* what covers the ground, such as the decoded texture; NULL: unknown,
                                taken for details of a sample's size everywhere */
} tks_screen;

/* The mesh of at most max_triangles > 0 triangles (or the base mesh, where that has more) whose
 * pictures differ least from those of the decoded surface. A height error counts what it costs on
 * the screen: the squared change of each camera's picture where the error moves the ground that it
 * shows (visibility, distance, outlines and what is drawn there included), over the pixels of that
 * picture that show ground. What no camera sees gets few triangles. A camera that sees no ground
 * counts nothing; if none sees any, it is as if there were none. Made of all samples of level 0,
 * whatever the number of triangles: this takes several times as long as a budget mesh, and time for
 * the pixels of the pictures.
 *
 * The vertices are those of a 4-8 mesh, but edges then turn to where the terrain's run: the mesh
 * covers the grid as tks_mesh says, but is none of the lattice. The same bits with every compiler
 * and number of threads. screen NULL: no cameras. Source: Balmelli 2000, 6.1 and figure 6.4 (view
 * dependence); Dyn, Levin and Rippa 1990 (edges).
 *
 * TKS_USAGE: max_triangles is 0, the decoder is set to another level than 0, a matrix or weight is
 * not finite, a weight is negative, a picture has no pixels, or the texture is none that tks_encode
 * would take. TKS_LIMIT: as tks_decode_mesh, with 40 bytes more a sample and 2 bytes a texel of the
 * texture. */
tks_status tks_decode_screen_mesh(tks_decoder* decoder, const tks_screen* screen,
                                  uint32_t max_triangles, tks_mesh* out);

/* What a plan may take. */
typedef struct tks_fetch {
  size_t size;            /* sizeof(tks_fetch) */
  uint64_t bytes;         /* of all ranges together */
  uint32_t triangles;     /* of the mesh that will be drawn; 0: any number */
  uint64_t request_bytes; /* what a request costs beside its bytes: latency times bytes a second,
                             shared by those that go out at a time; 0: nothing */
} tks_fetch;

/* Says what to fetch next: ranges of at most `bytes` bytes that are not there yet and help a view
 * most, the most helpful first. Hand them to tks_put as they come, in any order, and ask again. A
 * stream without a front index (tks_encode_options.index) is fetched in its order. Viewers turn:
 * what other pictures from the same place would show counts as well, a sixteenth of this one, and
 * all other ground a little. This view is served where no gain is left.
 *
 * A packet is worth what the index states, times what errors of its region cost in this picture: a
 * texel by the pixels that show it, a height by the pixels and by how far it moves them, which
 * falls with the parallax and rises as the viewer comes near. Detail finer than a pixel, what lies
 * outside the picture or behind coarse ground, and heights finer than a mesh of `triangles` (0: any
 * number) shows, are worth nothing to this view: their gain is 0. The masks that begin a component
 * come first. Ranges do not overlap; neighbours are one, unless the gain of only one of them is 0.
 * All plans until nothing is missing cover every byte of the stream once.
 *
 * With request_bytes the ranges are fewer: the plan is the one whose worth is greatest beside what
 * its bytes and its requests cost. Ranges then go on over bytes that help little or are there
 * already, and what is worth less than its request comes in a later plan. Where nothing is worth
 * one, the most helpful bytes are the plan. A packet may come before an earlier one of its region:
 * it counts when that has come.
 *
 * view: NULL: all ground counts alike. Its weight is not looked at; its columns and rows are those
 * of the heights, or of a texture without heights; or it looks at a globe, whose far side it does
 * not see. The call decodes a coarse mip level of the heights: what hides what. TKS_USAGE,
 * TKS_UNSUPPORTED: as tks_decode_screen_mesh of a camera, and as tks_decode_globe of its globe. */
tks_status tks_plan(tks_decoder* decoder, const tks_screen_camera* view, const tks_fetch* fetch,
                    tks_ranges* out);

/* Writes the open stream with its packets in the order that helps these cameras most: as tks_plan
 * chooses, by what they see together, with their weights and the stream's own triangle budget. The
 * complete stream decodes to the same samples: in packets only the stated errors change. Every
 * prefix of the result is a stream. If the open stream is a prefix, only what is there is ordered;
 * bytes beyond a gap are left out. TKS_USAGE: there is no front index, or no camera; else as
 * tks_plan. The library that only decodes lacks this function. */
tks_status tks_reorder(tks_decoder* decoder, const tks_screen_camera* cameras,
                       uint32_t camera_count, tks_buffer* out);

/* A mesh kept in a quadtree, about 5 bytes a vertex, to be drawn from many views. It depends on
 * neither the decoder nor its data; several threads may view one tree at a time. */
typedef struct tks_mesh_tree tks_mesh_tree;

/* The mesh that tks_decode_mesh would give. */
tks_status tks_decode_mesh_tree(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                                tks_mesh_tree** out);

/* The part of the mesh that a camera may see. clip: 4 x 4, row by row, takes (column, row, height,
 * 1), the height in `unit`, to clip coordinates; what is seen has -w <= x <= w and -w <= y <= w
 * (the third row is not used). `out` holds every triangle whose ground may be seen at some height
 * of the mesh, and a few beside them; of the vertices those of its triangles, parents before
 * children. With a matrix that does not depend on the height it is the mesh of a map window. It may
 * be empty. TKS_USAGE if the matrix is not finite. Takes time in proportion to what is seen, and to
 * one bit a vertex. */
tks_status tks_view_mesh(const tks_mesh_tree* tree, const double clip[16], tks_mesh* out);
void tks_free_mesh_tree(tks_mesh_tree* tree);

#undef TKS_INT
#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif

#endif
