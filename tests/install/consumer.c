/* SPDX-License-Identifier: Apache-2.0
 * Opens no stream, from C, by what pkg-config says: must be refused. */
#include <tetrakis/tetrakis.h>

int main(void) {
  const unsigned char bytes[4] = {1, 2, 3, 4};
  tks_decoder* decoder = 0;
  return tks_open(bytes, sizeof bytes, 0, &decoder, 0, 0) == TKS_OK;
}
