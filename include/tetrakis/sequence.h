/* SPDX-License-Identifier: Apache-2.0
 *
 * Tetrakis: sequences. C interface.
 *
 * A sequence is a file of frames of heights, of textures, or of both, that grows at its end: groups
 * of frames, one behind the other, each with a head that says which frames it has and when they
 * are, and the stream of these frames (tks_encode_frames). A group that is cut shows all its
 * frames, each about as well as it can.
 *
 *   tks_sequence_encoder   takes frame by frame, and hands over the bytes of each group
 *   tks_sequence           takes bytes, and gives a decoder (tetrakis.h) for any of their frames
 *   tks_sequence_locate    finds a frame or a time in a file by ranges of its bytes
 *
 * The trust contract is that of tetrakis.h, which also says what the structs' sizes mean. The
 * library that only decodes lacks the encoder. C99 or any C++.
 */
#ifndef TETRAKIS_SEQUENCE_H
#define TETRAKIS_SEQUENCE_H

#include "tetrakis/tetrakis.h"

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif

/* What the times of the frames of a sequence mean: a tick lasts numerator / denominator seconds,
 * and tick 0 is the epoch. */
typedef struct tks_clock {
  size_t size;                     /* sizeof(tks_clock) */
  uint64_t numerator, denominator; /* both 0: it is not known what a tick is */
  const char* epoch; /* UTF-8, as RFC 3339 ("2019-03-01T00:00:00Z") or CF has it; NULL: unknown */
  const char* calendar; /* UTF-8, of CF: "noleap", "360_day"; NULL: that of everyday life */
} tks_clock;

/* Of tks_sequence_options.reference: all bytes of a group. */
#define TKS_ALL_BYTES (~(uint64_t)0)
/* The most groups between a group and the one that it is decoded from. */
#define TKS_MOST_DEPTH 63

/* How a sequence is encoded. */
typedef struct tks_sequence_options {
  size_t size;    /* sizeof(tks_sequence_options) */
  uint32_t group; /* frames that are coded together, from 1 to TKS_MOST_FRAMES, which is the
                           latency; 0: 16. Larger groups take fewer bytes */
  const tks_encode_options* encode; /* for each group as tks_encode_frames takes them, but that
                           `bytes` counts a frame: a group of n frames takes at most n times as
                           many, head and index included. Copied; cameras and callbacks outlive the
                           encoder */
  tks_clock clock;                  /* copied */
  int no_index; /* non-zero: groups have no index, which saves some bytes of each; a reader
                           of the file then passes over all groups before the one it looks for */
  uint64_t reference; /* bytes of each frame of a group that every receiver is known to have. The
                           next group goes on from what these bytes show of the last frame, so that
                           what stands still takes next to no bytes, and is decoded only with the
                           groups before it. 0: each group stands by itself; TKS_ALL_BYTES: all */
  uint32_t entry; /* beside a reference: at least every so manyth group stands by itself, from 1
                           to TKS_MOST_DEPTH + 1; 0: 16. Receivers begin there */
} tks_sequence_options;

/* Encodes frames as they come into a sequence: groups of frames, one behind the other. What it has
 * written is never changed, so that a file grows at its end, and one that was cut is read up to its
 * last whole bytes. It takes memory for one group and the frame that the next one goes on from, and
 * 50 bytes for each group before. */
typedef struct tks_sequence_encoder tks_sequence_encoder;

/* message: as of tks_encode. */
tks_status tks_sequence_encoder_open(const tks_sequence_options* options,
                                     tks_sequence_encoder** out, char* message,
                                     size_t message_size);
void tks_sequence_encoder_close(tks_sequence_encoder* encoder);

/* Lets an encoder that has taken no frame go on behind a sequence that was written before: its
 * bytes follow those of that one. TKS_USAGE, with a sentence in message: the sequence ends inside a
 * group (keep its first tks_sequence_info.whole_bytes), groups of it are missing or forgotten, its
 * clock is another one; the encoder has taken frames. */
typedef struct tks_sequence tks_sequence;
tks_status tks_sequence_encoder_continue(tks_sequence_encoder* encoder,
                                         const tks_sequence* written, char* message,
                                         size_t message_size);

/* Takes one frame, which it copies, at a time in ticks after that of the frame before, within
 * +-2^61. The last frame of a group is pushed when the group is encoded. All frames of a sequence
 * are alike, as those of tks_encode_frames. Where frames together cannot be coded as the target
 * asks for, or take more bytes to be lossless or within a largest error than one by one, each is a
 * group by itself. TKS_USAGE, with a sentence in message: as tks_encode; the
 * frame is not like the first one, or is not later than the one before. The frame then is not
 * taken. */
tks_status tks_sequence_push(tks_sequence_encoder* encoder, const tks_heights* heights,
                             const tks_image* image, int64_t time, char* message,
                             size_t message_size);

/* Encodes the frames that are no whole group yet. Further frames begin a new one. */
tks_status tks_sequence_flush(tks_sequence_encoder* encoder, char* message, size_t message_size);

/* Hands over the bytes that are ready and follow those that were taken before; there may be none.
 * Release them with tks_free_buffer. */
tks_status tks_sequence_take(tks_sequence_encoder* encoder, tks_buffer* out);

/* A tks_sequence decodes a sequence, or any prefix of it, or any groups of it in their order. This
 * makes an empty one. limits: of the decoder of each group; may be NULL. */
tks_status tks_sequence_open(const tks_limits* limits, tks_sequence** out);
void tks_sequence_close(tks_sequence* sequence);

/* One sentence about the last failure; "" if none. */
const char* tks_sequence_message(const tks_sequence* sequence);

/* Gives it more bytes: those that follow what it has, which it copies. TKS_CORRUPT,
 * TKS_UNSUPPORTED: no group begins where one should; the groups before stay as they are, and no
 * more bytes are taken. */
tks_status tks_sequence_append(tks_sequence* sequence, const uint8_t* data, size_t size);

/* Gives up the bytes of all groups that end before a frame and that its group does not go on from,
 * and forgets these frames: their numbers stay. A player of a live sequence takes no more memory
 * with it however long that is. */
tks_status tks_sequence_forget(tks_sequence* sequence, uint64_t frame);

typedef struct tks_sequence_info {
  size_t size;                     /* sizeof(tks_sequence_info), set by the caller */
  uint64_t first_frame, end_frame; /* frames that can be decoded: from the first one to before the
                                       end. Of a group that is cut all frames can be, once the
                                       header of its stream is there */
  uint64_t groups;                 /* that hold these */
  uint64_t bytes;                  /* that were given to it */
  uint64_t whole_bytes;            /* of these, up to the end of the last whole group */
  tks_clock clock;                 /* texts belong to the sequence; "": unknown */
} tks_sequence_info;
tks_status tks_sequence_get_info(const tks_sequence* sequence, tks_sequence_info* info);

/* The time of a frame in ticks, and the last frame whose time is not after a given one. TKS_USAGE:
 * there is no such frame. */
tks_status tks_sequence_time(const tks_sequence* sequence, uint64_t frame, int64_t* time);
tks_status tks_sequence_find(const tks_sequence* sequence, int64_t time, uint64_t* frame);

/* What there is of a group: where its bytes lie among those given. */
typedef struct tks_group {
  size_t size; /* sizeof(tks_group), set by the caller */
  uint64_t first_frame, frames;
  uint64_t offset, bytes; /* of the whole group, whether it is all there or not */
  uint64_t stream_offset; /* of its stream */
  uint64_t stream_bytes;
  uint64_t available_bytes; /* of the group */
  uint32_t depth;           /* so many groups before it, which follow one another and begin
                               `bytes_back` before `offset`, have to be there as well; 0: none */
  uint64_t bytes_back;
} tks_group;
/* The group of a frame. TKS_USAGE: there is no such frame. */
tks_status tks_sequence_group(const tks_sequence* sequence, uint64_t frame, tks_group* out);

/* The decoder of the stream that holds a frame, with that frame set (tks_set_frame): all calls of
 * decoders show it. It belongs to the sequence, keeps its levels and threads while it stays the
 * same, and is there until the next call of tks_sequence_frame for a frame of another group,
 * tks_sequence_append, _forget or _close. The first call that decodes a group of tks_group.depth >
 * 0, and be it a window, decodes all of the last frame of each of so many groups before it as well,
 * unless it comes behind the call for the group before. TKS_USAGE: there is no such frame;
 * TKS_TRUNCATED: the frame goes on from a group that is not there; else as tks_open. */
tks_status tks_sequence_frame(tks_sequence* sequence, uint64_t frame, tks_decoder** decoder);

/* Writes a sequence for a thinner channel: of each whole group at most so many bytes a frame, head
 * and index included, but the header of its stream and what the next group goes on from stay.
 * Frames are what they were but for the bytes that are gone. Release `out` with tks_free_buffer.
 * TKS_USAGE: there is no whole group, or groups are missing or forgotten. */
tks_status tks_sequence_thin(const tks_sequence* sequence, uint64_t frame_bytes, tks_buffer* out,
                             char* message, size_t message_size);

/* What to read of a sequence on a host that gives ranges of bytes, to find a frame or a time: begin
 * with its last bytes (64 kB reach), and go on with the range that this gives, at most twice. tail:
 * bytes that end with a group, or with a cut one, at the offset `end` of the file. by_time: 0:
 * `place` is a frame; else it is a time in ticks. range: the group that holds the place, if *found
 * becomes 1; else the end of another group, for the next call, whose tail then ends where the range
 * does. Places before the first frame or after the last one are those. TKS_USAGE: there is no index
 * in these bytes. */
tks_status tks_sequence_locate(const uint8_t* tail, size_t size, uint64_t end, int by_time,
                               int64_t place, tks_range* range, int* found);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif

#endif
