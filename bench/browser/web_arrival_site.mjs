// SPDX-License-Identifier: Apache-2.0
// The server of bench/web_arrival: pages with their code, bundled, gzipped and cached as sites do,
// and data, which no browser keeps.
import {readFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {createRequire} from 'node:module';
import {gzipSync} from 'node:zlib';

const TYPES = {html: 'text/html', js: 'text/javascript', wasm: 'application/wasm'};
const METHODS = ['tks', 'judge', 'draco', 'meshopt', 'tiles'];
/** What pages fetch before their script runs, as those who care for time have it. */
const EARLY = {
  tks: ['<link rel="preload" as="fetch" crossorigin href="/tetrakis.wasm">'],
  draco: ['wasm_wrapper.js', 'decoder.wasm'].map((name) =>
    `<link rel="preload" as="fetch" crossorigin href="/draco/draco_${name}">`),
};

/** `early`: what the browser is told to fetch at once. */
const pageOf = (method, early) => `<!doctype html><meta charset="utf-8">
<link rel="icon" href="data:,"><style>body { margin: 0 }</style>${early.join('')}
<body></body><script type="module" src="/${method}.js"></script>`;

/** The part of `body` that a Range header asks for. */
function rangeOf(header, length) {
  const [, first, last] = /^bytes=(\d+)-(\d+)$/.exec(header ?? '') ?? [];
  return first === undefined ? null : [Number(first), Math.min(Number(last), length - 1)];
}

export class Site {
  #files = new Map();
  #server;
  /** Bytes of code that went out, as they are on the wire, without headers. */
  code = 0;

  static async open(web) {
    const site = new Site();
    const {build} = createRequire(web + 'package.json')('esbuild');
    const bundled = async (names, options) => (await build({
      entryPoints: names.map((name) =>
        new URL(`web_arrival_page/${name}.js`, import.meta.url).pathname),
      bundle: true, minify: true, format: 'esm', target: 'es2022', outdir: '/', write: false,
      logLevel: 'error', nodePaths: [web + 'node_modules'], ...options,
    })).outputFiles;
    // What draws a stream is loaded while the stream is.
    const parted = await bundled(['tks', 'tks_scene'], {splitting: true, chunkNames: '[name]'});
    const whole = await bundled(METHODS.filter((name) => name !== 'tks'), {});
    const worker = await bundled([], {entryPoints: [web + 'src/worker.js']});
    for (const {path, contents} of [...parted, ...whole, ...worker]) site.#code(path, contents);
    const early = Object.fromEntries(METHODS.map((name) => [name, EARLY[name] ?? []]));
    // What draws comes behind the decoder, which has work to do meanwhile.
    const ahead = parted.filter(({path}) => path !== '/tks_scene.js');
    early.tks = [
      ...early.tks, ...ahead.map(({path}) => `<link rel="modulepreload" href="${path}">`),
    ];
    for (const method of METHODS) site.#code(`/${method}.html`, pageOf(method, early[method]));
    site.#code('/tetrakis.wasm', readFileSync(web + 'dist/tetrakis.wasm'));
    const draco = web + 'node_modules/three/examples/jsm/libs/draco/gltf/';
    for (const name of ['draco_wasm_wrapper.js', 'draco_decoder.wasm']) {
      site.#code(`/draco/${name}`, readFileSync(draco + name));
    }
    await site.#listen();
    return site;
  }

  #code(path, contents) {
    this.#files.set(path, {body: gzipSync(contents, {level: 9}), headers: {
      'content-type': TYPES[path.split('.').at(-1)], 'content-encoding': 'gzip',
      'cache-control': 'max-age=86400',
    }});
  }
  /** Serves data; gzipped where hosts do that. */
  set(path, contents, gzip = false) {
    const body = gzip ? gzipSync(contents, {level: 9}) : contents;
    this.#files.set(path, {body, headers: {
      'content-type': 'application/octet-stream', 'cache-control': 'no-store',
      ...(gzip ? {'content-encoding': 'gzip'} : {}),
    }});
    return path;
  }
  has(path) {
    return this.#files.has(path);
  }

  async #listen() {
    this.#server = createServer((request, response) => this.#answer(request, response));
    await new Promise((resolve) => this.#server.listen(0, '127.0.0.1', resolve));
    this.url = `http://127.0.0.1:${this.#server.address().port}/`;
  }
  async #answer(request, response) {
    const path = new URL(request.url, 'http://x').pathname;
    if (request.method === 'POST') {
      const parts = [];
      for await (const part of request) parts.push(part);
      this.set(`/data${path}`, Buffer.concat(parts));
      return response.end();
    }
    const file = this.#files.get(path);
    if (!file) return response.writeHead(404).end();
    const range = rangeOf(request.headers.range, file.body.length);
    const body = range ? file.body.subarray(range[0], range[1] + 1) : file.body;
    if (file.headers['content-encoding'] && !path.startsWith('/data/')) this.code += body.length;
    response.writeHead(range ? 206 : 200, {...file.headers, 'content-length': body.length,
      ...(range ? {'content-range': `bytes ${range[0]}-${range[1]}/${file.body.length}`} : {})});
    response.end(body);
  }
  close() {
    this.#server.closeAllConnections();
    this.#server.close();
  }
}
