// SPDX-License-Identifier: Apache-2.0
// The one kind of error that promises of this package are rejected with, apart from the reason of
// an AbortSignal. `code` is for programs, `message` one or two sentences for people.

// The statuses of tetrakis.h.
const CODES = [
  'ok', 'usage', 'io', 'corrupt', 'truncated', 'unsupported', 'limit', 'mismatch', 'memory',
];

/** What the library's sentences name as C and the command line do, by its name here. */
const NAMES = {'max_memory': '`memory`', 'max-error': 'maxError'};

export class TksError extends Error {
  constructor(code, message, options) {
    super(message, options);
    this.name = 'TksError';
    this.code = code;
  }
  static ofStatus(status, message) {
    const named = message.replace(/max_memory|max-error/g, (name) => NAMES[name]);
    return new TksError(CODES[status] ?? 'corrupt', named);
  }
}
