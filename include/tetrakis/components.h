/* SPDX-License-Identifier: Apache-2.0
 *
 * Tetrakis: components. C interface.
 *
 * A stream has up to 16 components: rasters of heights or of texels, each over a ground of its own
 * size. Calls of tetrakis.h decode the first heights and the first texture. Others may be classes
 * of ground, normals, a second image, heights of another year.
 *
 *   tks_get_component      tells the components of a stream
 *   tks_choose_component   takes another one for the heights, or for the texture
 *   tks_combine            makes one stream of the components of several
 *
 * The trust contract is that of tetrakis.h, which also says what the structs' sizes mean. The
 * library that only decodes lacks tks_combine. C99 or any C++.
 */
#ifndef TETRAKIS_COMPONENTS_H
#define TETRAKIS_COMPONENTS_H

#include "tetrakis/tetrakis.h"

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif

typedef enum tks_component_kind {
  TKS_COMPONENT_HEIGHTS = 0,
  TKS_COMPONENT_TEXTURE = 1,
  TKS_COMPONENT_UNKNOWN = 2 /* of a later version, which this library passes over */
} tks_component_kind;

/* One component of a stream. */
typedef struct tks_component {
  size_t size; /* sizeof(tks_component), set by the caller */
  tks_component_kind kind;
  const char* name; /* UTF-8, but not checked; "" when it has none. Owned by the decoder */
  int is_taken;     /* calls decode it, as the heights or as the texture of the stream */
  uint32_t width, height;   /* samples or texels of level 0; 0 of what is unknown */
  tks_domain domain;        /* 0 of what is unknown */
  uint64_t available_bytes; /* of its packets, without their heads, up to the first missing byte */
} tks_component;

/* Tells component `number` of a stream, from 0 to tks_info.components - 1. TKS_USAGE: there is no
 * such component. */
tks_status tks_get_component(const tks_decoder* decoder, uint32_t number, tks_component* out);

/* From now on the decoder takes component `number` for its heights, or for its texture, whichever
 * it is: all calls and tks_info are about it, as if it stood alone beside the other kind. Levels
 * and the frame go back to 0; strings and arrays that the decoder gave are gone. On an error the
 * decoder is as before. What is chosen of a sketch (tks_info.shows_sketch) is chosen of the stream
 * as well, if that has such a component of this number.
 *
 * TKS_USAGE: there is no such component; or the decoder was given bytes by tks_append or tks_put
 * before. TKS_UNSUPPORTED: this library does not know the component's kind or the surface that it
 * lies on; or the frames of the stream go on from those of another one. TKS_CORRUPT, TKS_LIMIT: as
 * of tks_open. */
tks_status tks_choose_component(tks_decoder* decoder, uint32_t number);

/* A stream, or a prefix of one, of which tks_combine takes all components. */
typedef struct tks_combined {
  size_t size; /* sizeof(tks_combined) */
  const uint8_t* data;
  size_t data_size;
  const char* name; /* UTF-8, up to 255 bytes, of its components that have none; NULL: none */
  double weight;    /* what its errors count beside those of others; 0: 1 */
} tks_combined;

typedef struct tks_combine_options {
  size_t size;    /* sizeof(tks_combine_options) */
  uint64_t bytes; /* the stream takes at most so many; 0: all that there is */
  const tks_limits* limits; /* of what is decoded for it; NULL: the defaults */
} tks_combine_options;

/* Makes one stream of several, without coding anything anew. Its heights and its texture are the
 * first ones of the list; the first stream says its metadata, unless it has no heights. Further
 * components keep their names, places and units, and are decoded once they are chosen
 * (tks_choose_component).
 *
 * Packets keep their order within each stream. Among streams they are ordered by what a byte
 * takes off the weighted mean square error, in units of each component's range of values: so
 * prefixes share their bytes among all components. For the ranges a level of at most 2^16
 * samples, or the coarsest one, is decoded of each component. A budget cuts the stream behind so
 * many bytes; then it promises no lossless samples and no largest error any more. With a front
 * index in all streams the result has one.
 *
 * options: NULL: none. TKS_USAGE: a list without streams; more than 16 components; two of a kind
 * with the same name; frames; a mesh of triangles behind the first stream; a grid on a cube behind
 * other heights; a weight that is negative or not finite; a budget that the header alone exceeds.
 * TKS_CORRUPT, TKS_UNSUPPORTED, TKS_LIMIT, TKS_TRUNCATED: as of tks_open, by the first such stream,
 * whose number the message says. */
tks_status tks_combine(const tks_combined* streams, uint32_t count,
                       const tks_combine_options* options, tks_buffer* out, char* message,
                       size_t message_size);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif

#endif
