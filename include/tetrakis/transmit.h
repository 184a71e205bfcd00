/* SPDX-License-Identifier: Apache-2.0
 *
 * Tetrakis: system control. C interface.
 *
 * A transmitter holds a sequence (sequence.h), which may grow, and serves many receivers of
 * different links and renderers from the same groups. A receiver tells it by control messages what
 * it looks at, what its link brings and what it draws, and gets answers: the bytes that help it
 * most, and none that it has. Source: Balmelli 2000, 1.2.5 and 1.2.7.
 *
 *   tks_transmitter   takes the bytes of a sequence, and answers control messages
 *   tks_receiver      writes control messages, takes answers, and gives a decoder for any frame
 *
 * What carries messages and answers is the caller's: HTTP, datagrams, a radio. Either may be lost.
 * docs/CONTROL.md has their bytes. The trust contract is that of tetrakis.h, which also says what
 * the structs' sizes mean. The library that only decodes lacks the transmitter and
 * tks_receiver_write. C99 or any C++.
 */
#ifndef TETRAKIS_TRANSMIT_H
#define TETRAKIS_TRANSMIT_H

#include "tetrakis/sequence.h"

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif

/* No control message takes more bytes. */
#define TKS_MOST_CONTROL_BYTES 100
/* Of tks_wants.frame: the newest frame that the transmitter has. */
#define TKS_NEWEST_FRAME (~(uint64_t)0)

/* ---- receivers ------------------------------------------------------------------------------ */

/* What a receiver wants, and what it can take. */
typedef struct tks_wants {
  size_t size;                   /* sizeof(tks_wants) */
  uint64_t frame;                /* the first one that it wants, or TKS_NEWEST_FRAME */
  uint32_t link;                 /* bytes a second that reach it, above 0, below 2^28 */
  uint32_t triangles;            /* of the meshes that it draws, below 2^28; 0: any number */
  const tks_screen_camera* view; /* what it looks at: columns, rows and heights to clip coordinates,
                         whose third row and weight do not count, rounded to floats; NULL: all
                         ground counts alike */
} tks_wants;

typedef struct tks_receiver tks_receiver;

/* An empty receiver. number: by which a transmitter knows it, unlike those of all other receivers:
 * 64 random bits will do. limits: of the decoder of each group; may be NULL. */
tks_status tks_receiver_open(uint64_t number, const tks_limits* limits, tks_receiver** out);
void tks_receiver_close(tks_receiver* receiver);

/* One sentence about the last failure; "" if none. */
const char* tks_receiver_message(const tks_receiver* receiver);

/* Writes a control message of *size bytes: what the receiver wants, and which answers came. */
tks_status tks_receiver_control(tks_receiver* receiver, const tks_wants* wants,
                                uint8_t control[TKS_MOST_CONTROL_BYTES], size_t* size);

/* Takes an answer, all of it, and copies its bytes. Answers may be lost; the next control message
 * says so, and what they held comes again. TKS_CORRUPT, TKS_UNSUPPORTED: it is none, or tells of a
 * group what cannot be; the receiver has taken nothing of it. */
tks_status tks_receiver_take(tks_receiver* receiver, const uint8_t* answer, size_t size);

typedef struct tks_receiver_info {
  size_t size;                     /* sizeof(tks_receiver_info), set by the caller */
  uint64_t first_frame, end_frame; /* that can be decoded are in here: of a group as soon as the
                         header of its stream came. Groups between may lack it */
  uint64_t source_end_frame;       /* the transmitter has frames up to before this one */
  uint64_t answers;                /* that came */
  uint64_t last_pieces;            /* in the last one that came; 0: nothing helped any more */
  uint64_t bytes;                  /* of groups, that came */
  tks_clock clock;                 /* texts belong to the receiver; "": unknown */
} tks_receiver_info;
tks_status tks_receiver_get_info(const tks_receiver* receiver, tks_receiver_info* info);

/* The last frame that can be decoded up to a given one, and its time in ticks. TKS_USAGE: none
 * can. */
tks_status tks_receiver_find(tks_receiver* receiver, uint64_t frame, uint64_t* found,
                             int64_t* time);

/* The decoder of the stream that holds a frame, with that frame set, as of tks_sequence_frame; it
 * is there until the next call of tks_receiver_frame for a frame of another group, _take, _forget
 * or _close. TKS_USAGE: the frame is not there; TKS_TRUNCATED: it goes on from what is not
 * there. */
tks_status tks_receiver_frame(tks_receiver* receiver, uint64_t frame, tks_decoder** decoder);

/* Gives up all groups that end before a frame and that its group does not go on from. The next
 * control message says so. */
tks_status tks_receiver_forget(tks_receiver* receiver, uint64_t frame);

/* Does the same, and hands the groups over as a part of a sequence, which follows those that were
 * handed over before: of each stream the bytes up to the first that is missing. Groups whose stream
 * lacks its header, or what it goes on from, are left out, and there are no indices.
 * TKS_NEWEST_FRAME: all groups. Release `out` with tks_free_buffer. */
tks_status tks_receiver_write(tks_receiver* receiver, uint64_t frame, tks_buffer* out);

/* ---- transmitters --------------------------------------------------------------------------- */

typedef struct tks_transmitter_options {
  size_t size;              /* sizeof(tks_transmitter_options) */
  const tks_limits* limits; /* of the decoder of each group; may be NULL. Copied */
  double seconds;           /* of its link that an answer takes at most; 0: 0.5 */
  uint64_t answer_bytes;    /* that an answer takes at most, whatever its link; 0: 2^20. At least
                               TKS_MOST_CONTROL_BYTES */
  uint32_t receivers;       /* that are remembered, those that were heard last; 0: 64 */
} tks_transmitter_options;

typedef struct tks_transmitter tks_transmitter;

/* options: may be NULL. message: as of tks_encode. */
tks_status tks_transmitter_open(const tks_transmitter_options* options, tks_transmitter** out,
                                char* message, size_t message_size);
void tks_transmitter_close(tks_transmitter* transmitter);

/* As tks_sequence_append and tks_sequence_forget. A group can be sent as far as it is there. */
tks_status tks_transmitter_append(tks_transmitter* transmitter, const uint8_t* data, size_t size,
                                  char* message, size_t message_size);
tks_status tks_transmitter_forget(tks_transmitter* transmitter, uint64_t frame);

/* As tks_sequence_get_info, of what the transmitter holds. */
tks_status tks_transmitter_get_info(const tks_transmitter* transmitter, tks_sequence_info* info);

/* Answers a control message, with nothing but a head where nothing is left that helps. What goes
 * first: what the wanted frame goes on from; of its group, and of those up to 10 s after it, each
 * its share of the link, by what the view shows; then more of them; then what the view does not
 * show. Heights that meshes of so many triangles, rounded up to a power of two, do not show stay:
 * those behind half of the error of the best such mesh. Only a front index
 * (tks_encode_options.index) lets bytes go in another order than they have. Release `out` with
 * tks_free_buffer. The transmitter takes all of it for received, unless a later message says that
 * it was lost, or 32 further answers go and none tells of it. TKS_CORRUPT, TKS_UNSUPPORTED: this is
 * no control message; TKS_USAGE: it tells of answers that were not given, or is older than one
 * before; the receiver's state stays. A receiver that was forgotten begins anew. A frame that is
 * not there yet, or no more, stands for the next or the first one. One call at a time. */
tks_status tks_transmitter_answer(tks_transmitter* transmitter, const uint8_t* control, size_t size,
                                  tks_buffer* out, char* message, size_t message_size);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif

#endif
