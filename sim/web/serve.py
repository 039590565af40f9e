"""Serves a folder at http://localhost:PORT/, with the types and headers that the page needs: serve.py FOLDER PORT."""
import functools
import http.server
import sys

TYPES = {".wasm": "application/wasm", ".data": "application/octet-stream", ".webmanifest": "application/manifest+json"}


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, **TYPES}

    def end_headers(self):
        self.send_header("Cache-Control", "no-cache")  # what is built anew is seen at once
        self.send_header("X-Content-Type-Options", "nosniff")
        super().end_headers()

    def log_message(self, *_):
        pass


def main():
    folder, port = sys.argv[1], int(sys.argv[2])
    try:
        server = http.server.ThreadingHTTPServer(("127.0.0.1", port), functools.partial(Handler, directory=folder))
    except OSError as error:
        sys.exit(f"zstep: port {port} cannot be had ({error.strerror}); name another one: ./zstep web --serve {port + 1}")
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass


main()
