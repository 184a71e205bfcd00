// SPDX-License-Identifier: Apache-2.0
// A static server for tests, with the faults that servers have.
import {once} from 'node:events';
import {createReadStream} from 'node:fs';
import {stat} from 'node:fs/promises';
import {createServer} from 'node:http';
import {extname, join, normalize} from 'node:path';
import {pipeline} from 'node:stream/promises';

const TYPES = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm',
  '.tks': 'application/octet-stream', '.svg': 'image/svg+xml', '.mjs': 'text/javascript',
};

async function sendInTwo(response, file, [start, end], [bytes, ms]) {
  await pipeline(createReadStream(file, {start, end: start + bytes - 1}), response, {end: false});
  await new Promise((resolve) => setTimeout(resolve, ms));
  createReadStream(file, {start: start + bytes, end}).pipe(response);
}

/**
 * Serves `folder`. Of `faults`: noRanges (200 and the whole file), etag (called for each answer),
 * gzip (claims to compress what it sends as it is), headers (of each answer), missing (404 always),
 * types (content types by the ends of names), overstated (ranges are said to end where they were
 * asked to), most (the bytes of an answer to a range, at most), stall (so many bytes of an answer
 * go out, the others never do), pause ([bytes, ms]: behind so many of a part's bytes the server
 * rests), empty (204 always), fail ([n, ms]: the n-th request is answered 500 after so long).
 * A request's `ended` resolves to whether all of its answer went out.
 */
export async function serve(folder, {...faults} = {}) {
  const requests = [];
  // Clients may be busy for longer than the 5 s of Node.
  const server = createServer({keepAliveTimeout: 60000}, async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
    const {headers: asked} = request, noted = {path, range: asked.range, headers: asked};
    noted.ended = once(response, 'close').then(() => response.writableFinished);
    requests.push(noted);
    const file = join(folder, path);
    const size = await stat(file).then((found) => (found.isFile() ? found.size : -1), () => -1);
    if (size < 0 || faults.missing) {
      noted.status = 404;
      response.writeHead(404, {'content-type': 'text/html'});
      return response.end('<!doctype html>nothing here');
    }
    if (faults.empty) return response.writeHead(204).end();
    const [failing, ms] = faults.fail ?? [];
    if (requests.indexOf(noted) + 1 === failing) {
      await new Promise((resolve) => setTimeout(resolve, ms));
      return response.writeHead(500).end();
    }
    const send = (start, last) => {
      const {stall = Infinity} = faults, end = Math.min(last, start + stall - 1);
      if (end < start) return response.flushHeaders();
      const {pause} = faults;
      if (pause && end - start > pause[0]) return sendInTwo(response, file, [start, end], pause);
      createReadStream(file, {start, end}).pipe(response, {end: end === last});
    };
    const type = {...TYPES, ...faults.types}[extname(path)] ?? 'text/plain';
    const headers = {'content-type': type, ...faults.headers};
    if (faults.etag) headers.etag = faults.etag(requests.length);
    const range = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? '');
    if (!range || faults.noRanges) {
      response.writeHead(200, {...headers, 'content-length': size});
      return send(0, size - 1);
    }
    const start = Number(range[1]);
    const end = Math.min(Number(range[2]), size - 1, start + (faults.most ?? Infinity) - 1);
    if (start >= size) {
      response.writeHead(416, {...headers, 'content-range': `bytes */${size}`});
      return response.end();
    }
    response.writeHead(206, {
      ...headers, 'content-length': end - start + 1,
      'content-range': `bytes ${start}-${faults.overstated ? range[2] : end}/${size}`,
    });
    send(start, end);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return {
    url: `http://127.0.0.1:${server.address().port}/`,
    requests,
    faults,
    /** Forgets requests and faults, for others. */
    begin(others = {}) {
      requests.length = 0;
      for (const name of Object.keys(faults)) delete faults[name];
      Object.assign(faults, others);
    },
    close: () => {
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}
