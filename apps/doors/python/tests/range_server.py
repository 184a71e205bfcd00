# SPDX-License-Identifier: Apache-2.0
"""A web server of one file, which counts what it is asked for."""

import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


class Server:
    """Serves `body`, with ranges or without, and counts."""

    def __init__(self, body, ranges=True):
        self.body, self.sent, self.requests, self.etag = body, 0, 0, '"one"'
        outer = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self):
                outer.requests += 1
                part, status = outer.body, 200
                asked = self.headers.get("Range")
                if ranges and asked:
                    first, last = (int(n) for n in asked[len("bytes=") :].split("-"))
                    part, status = outer.body[first : last + 1], 206
                    if not part:
                        self.send_error(416)
                        return
                outer.sent += len(part)
                self.send_response(status)
                self.send_header("ETag", outer.etag)
                if status == 206:
                    places = f"{first}-{first + len(part) - 1}"
                    self.send_header("Content-Range", f"bytes {places}/{len(outer.body)}")
                self.send_header("Content-Length", str(len(part)))
                self.end_headers()
                self.wfile.write(part)

            def log_message(self, *_):
                pass

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self._server.server_port}/a.tks"

    def __enter__(self):
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self._server.shutdown()
        self._server.server_close()
