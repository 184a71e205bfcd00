/* SPDX-License-Identifier: Apache-2.0
 *
 * Tetrakis: mosaics. C interface.
 *
 * A mosaic is a plane of heights that no machine holds, coded tile by tile by tasks. The plane has
 * one transform: there are no borders between tiles in the stream, and its codewords are those of
 * an encoder that holds the plane. Tasks share nothing but files: they may run on any machines, in
 * any order in which each comes behind those that it needs, and die at any time. The stream does
 * not depend on who ran them.
 *
 *   tks_mosaic_plan   once: reads the source, and makes the plan that all tasks agree on
 *   tks_mosaic_code   for each tile: reads its samples with 128 around them, leaves its parts
 *   tks_mosaic_merge  once: joins the parts into a stream, without ever holding it
 *
 * The trust contract is that of tetrakis.h, which also says what the structs' sizes mean. Parts and
 * plans are checked: damaged ones are missing ones. The library that only decodes lacks all of
 * these functions. C99 or any C++.
 */
#ifndef TETRAKIS_MOSAIC_H
#define TETRAKIS_MOSAIC_H

#include "tetrakis/tetrakis.h"

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif

/* Writes the samples of a window, row by row, in the type of the heights. Returns 0, or anything
 * else if they cannot be read (TKS_IO). */
typedef int (*tks_read_window)(void* user, const tks_window* window, void* samples);

/* The source of a mosaic: as of tks_encode, but its samples come by windows, each of them two or
 * three times. `data` counts for nothing. The domain is a plane of at most 2^32 samples.
 * tks_heights.step: that of the samples; 0: it is found. */
typedef struct tks_mosaic_source {
  size_t size; /* sizeof(tks_mosaic_source) */
  const tks_heights* heights;
  tks_read_window read;
  void* user;
} tks_mosaic_source;

/* Exactly one of the first four is set. */
typedef struct tks_mosaic_options {
  size_t size;      /* sizeof(tks_mosaic_options) */
  uint64_t bytes;   /* of the stream, at most */
  double psnr;      /* of the samples, by their range; by an estimate, which may be a little off */
  double max_error; /* of every sample, in the unit of the heights */
  int lossless;
  uint32_t regions; /* side of the regions that tracks hold, in samples: a power of two from 16 on;
                       0: 512 */
  uint32_t tile;    /* side of the tiles, likewise: at least a region, at most 16384; 0: 4096. A
                       task takes 8 to 11 bytes for each sample of its tile and of the 128 around
                       it, one that restores 11 to 14 for each of its tile and of the regions
                       around it */
} tks_mosaic_options;

/* Makes the plan: some kilobytes that every task is given. It reads the source once, window by
 * window, for the range, the voids and the step of the samples; then nine small windows, by which
 * the filters are chosen. message: as of tks_encode. TKS_USAGE: the target cannot be promised;
 * floats without a common step need two regions or more to be restored to the last bit. */
tks_status tks_mosaic_plan(const tks_mosaic_source* source, const tks_mosaic_options* options,
                           tks_buffer* plan, char* message, size_t message_size);

/* What one task codes: the tile in a column and row of a group of levels. Group 0 holds the finest
 * levels, and reads samples; each further group reads what the group before has left, and has a
 * 64th of its tiles or less. The last one that codes coefficients has one tile, the base. Where
 * corrections follow a cut of the coefficients as many groups follow, from the base to the samples:
 * they restore what decoders will have, and the last one codes the corrections. */
typedef struct tks_tile {
  uint32_t group, column, row;
} tks_tile;

/* Lists all tiles, each behind those that it needs. At most `room` are written; `count` says how
 * many there are. TKS_CORRUPT: `plan` is no plan. TKS_UNSUPPORTED: it is one of another version. */
tks_status tks_mosaic_tiles(const uint8_t* plan, size_t plan_size, tks_tile* tiles, size_t room,
                            size_t* count);

/* Writes how many groups code coefficients. Tiles of further ones restore. */
tks_status tks_mosaic_coding_groups(const uint8_t* plan, size_t plan_size, uint32_t* groups);

/* Lists the tiles whose parts the task of a tile reads. TKS_USAGE: there is no such tile. */
tks_status tks_mosaic_needs(const uint8_t* plan, size_t plan_size, tks_tile tile, tks_tile* tiles,
                            size_t room, size_t* count);

/* Writes which samples the task of a tile reads: of the heights in group 0 and in the last group
 * that restores; in others of the low band of 3 * group levels, or of 3 levels less for each group
 * that restores. */
tks_status tks_mosaic_block(const uint8_t* plan, size_t plan_size, tks_tile tile,
                            tks_window* block);

/* Reads `bytes` bytes of a file from an offset on, or as many as there are, and writes how many
 * that were. Returns 0, or anything else if the file is missing or cannot be read. */
typedef int (*tks_read_file)(void* user, const char* name, uint64_t offset, uint64_t bytes,
                             void* out, uint64_t* read);
/* Writes how long a file is. Returns 0, or anything else if it is missing. */
typedef int (*tks_file_size)(void* user, const char* name, uint64_t* size);
/* Makes a file of these bytes, in the place of one that is there. Whoever reads it meets all of the
 * bytes or none: on a disk write another file and rename it. Returns 0, or anything else. */
typedef int (*tks_write_file)(void* user, const char* name, const void* data, size_t size);

/* The storage that tasks share, such as a folder on a disk of all machines. Names are of letters,
 * digits, '-' and '.'. */
typedef struct tks_mosaic_files {
  size_t size; /* sizeof(tks_mosaic_files) */
  tks_read_file read;
  tks_file_size length;
  tks_write_file write;
  void* user;
} tks_mosaic_files;

/* Codes or restores a tile, proves that its codewords decode to what was coded, or that corrected
 * samples keep what was promised, and leaves "gG-xX-yY.low" for the next group, unless it is the
 * base or the last group, and then "gG-xX-yY.part". source: may be NULL where no heights are read.
 * threads:
 * nothing depends on them; 0 counts as 1. TKS_IO: samples or parts that it needs cannot be read, or
 * its own not be written. TKS_USAGE: a sample that the plan does not allow. TKS_MISMATCH: a fault
 * of the encoder. */
tks_status tks_mosaic_code(const uint8_t* plan, size_t plan_size, tks_tile tile,
                           const tks_mosaic_source* source, const tks_mosaic_files* files,
                           uint32_t threads, char* message, size_t message_size);

/* Writes 1 if the parts of a tile are there, whole and of this plan, else 0: then its task has to
 * run. */
tks_status tks_mosaic_is_done(const uint8_t* plan, size_t plan_size, tks_tile tile,
                              const tks_mosaic_files* files, int* done);

/* Takes bytes of the stream at an offset, the first ones last. Returns 0, or anything else if they
 * cannot be written (TKS_IO). */
typedef int (*tks_write_at)(void* user, uint64_t offset, const void* data, size_t size);

/* In which order the bytes of a mosaic lie. */
typedef enum tks_layout {
  TKS_LAYOUT_PROGRESSIVE = 0, /* by what they are worth: the best prefixes. There is no index */
  TKS_LAYOUT_WINDOWS = 1,     /* each region in one piece, page by page, behind those of coarser
                                 levels: windows take the fewest requests. A prefix has some
                                 regions, and lacks others */
  TKS_LAYOUT_MIXED = 2        /* first a preview by layers of what bytes are worth, which may be cut
                                 anywhere as of PROGRESSIVE; the rest as of WINDOWS */
} tks_layout;

typedef struct tks_merge_options {
  size_t size; /* sizeof(tks_merge_options) */
  tks_layout layout;
  uint64_t preview; /* of TKS_LAYOUT_MIXED: bytes of the preview; 0: a tenth of the stream */
} tks_merge_options;

/* Joins the parts of all tiles into the stream of the plan's target. It holds a kilobyte for each
 * region, never codewords. options: NULL is TKS_LAYOUT_PROGRESSIVE. The other layouts have an
 * index: in front (TKS_INDEX_PACKETS, TKS_INDEX_WINDOWS) while it takes at most 64 kB, else in
 * pages (TKS_INDEX_PAGES). Within a budget they leave out the packets that are worth least. TKS_IO:
 * a part is missing or damaged; the message names it. */
tks_status tks_mosaic_merge(const uint8_t* plan, size_t plan_size, const tks_mosaic_files* files,
                            const tks_merge_options* options, tks_write_at write, void* user,
                            char* message, size_t message_size);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif /* TETRAKIS_MOSAIC_H */
