// SPDX-License-Identifier: Apache-2.0
// The one kind of error that promises of this package are rejected with, apart from the reason of
// an AbortSignal. `code` is for programs, `message` one or two sentences for people.

// The statuses of tetrakis.h.
const CODES = [
  'ok', 'usage', 'io', 'corrupt', 'truncated', 'unsupported', 'limit', 'mismatch', 'memory',
];

export class TksError extends Error {
  constructor(code, message, options) {
    super(message, options);
    this.name = 'TksError';
    this.code = code;
  }
  static ofStatus(status, message) {
    return new TksError(CODES[status] ?? 'corrupt', message);
  }
}
