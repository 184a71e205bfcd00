/* SPDX-License-Identifier: Apache-2.0
 * consumer FILE: decodes the heights of a stream, from C, by the decoding half alone. */
#include <stdio.h>
#include <stdlib.h>
#include <tetrakis/tetrakis.h>

static size_t read_file(const char* path, unsigned char* bytes, size_t room) {
  size_t size = 0;
  FILE* file = fopen(path, "rb");
  if (file) {
    size = fread(bytes, 1, room, file);
    fclose(file);
  }
  return size;
}

int main(int argc, char** argv) {
  static unsigned char bytes[1 << 20];
  const size_t size = argc == 2 ? read_file(argv[1], bytes, sizeof bytes) : 0;
  tks_decoder* decoder = NULL;
  tks_info info;
  float* heights = NULL;
  int failed = 1;
  info.size = sizeof info;
  if (tks_open(bytes, size, NULL, &decoder, NULL, 0) == TKS_OK &&
      tks_get_info(decoder, &info) == TKS_OK) {
    const size_t count = (size_t)info.width * info.height;
    heights = malloc(count * sizeof *heights);
    failed = !heights || tks_decode_surface(decoder, heights, count) != TKS_OK;
  }
  free(heights);
  tks_close(decoder);
  return failed;
}
