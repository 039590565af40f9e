"""The whole of zstep as one page that opens from disk: one_page.py SITE PROGRAM PAGE TRACE_VERSION.

SITE is the folder of the page's files, PROGRAM the WebAssembly in one piece; PAGE is written beside them. It holds the same film.js, page.js, page.css, program, fonts
and lessons, and a mark at which `zstep publish` puts a run and the words that open it (sim/cli/publish.cpp).
"""
import base64
import gzip
import hashlib
import pathlib
import re
import sys

UNSAFE = b"\x00\r<"  # what HTML may change, or take for its own, inside a script


def seven_bits(data: bytes) -> str:
    """Bytes as text, seven bits a letter (ASCII) and fourteen a letter of two bytes where the first seven would be one
    of UNSAFE. As in sim/pages/seven_bits.cpp; page/packed.js reads it."""
    groups, held, bits = bytearray(), 0, 0
    for byte in data:
        held, bits = held << 8 | byte, bits + 8
        while bits >= 7:
            bits -= 7
            groups.append(held >> bits & 127)
        held &= (1 << bits) - 1
    if bits > 0:
        groups.append(held << (7 - bits) & 127)
    groups.append(0)  # to go with an unsafe last one; stands for no whole byte
    letters, at = [], 0
    while at < len(groups) - 1:
        group = groups[at]
        which = UNSAFE.find(group)
        if which < 0:
            letters.append(chr(group))
            at += 1
        else:
            letters.append(chr(256 + which * 128 + groups[at + 1]))
            at += 2
    return "".join(letters)


def packed(name: str, data: bytes) -> str:
    small = gzip.compress(data, 9, mtime=0)
    return f'<script type="application/gzip" data-name="{name}" data-bytes="{len(small)}">{seven_bits(small)}</script>\n'


def allowed(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def replaced(page: str, pattern: str, now: str) -> str:
    page, count = re.subn(pattern, lambda _: now, page, flags=re.DOTALL)
    if count != 1:
        sys.exit(f"zstep: index.html has {count} of what one_page.py looks for: {pattern}")
    return page


def main():
    site, program, target = (pathlib.Path(one) for one in sys.argv[1:4])
    version = sys.argv[4]

    def text(name):
        return (site / name).read_bytes().decode()

    style, unpacker, script, loader = text("page.css"), text("packed.js"), text("film.js") + text("page.js"), text("zstep.js")
    for name, inside, end in [("page.css", style, "</style"), ("packed.js", unpacker, "</script"), ("page.js", script, "</script")]:
        if end in inside.lower() or "<!--" in inside or "\r" in inside:
            sys.exit(f"zstep: {name} cannot stand inside a page: it has {end}, <!-- or a carriage return")
    scripts = " ".join(allowed(one) for one in (unpacker, script, loader))
    policy = (f"default-src 'none'; script-src {scripts} 'wasm-unsafe-eval'; style-src {allowed(style)}; img-src data: blob:; "
              "base-uri 'none'; form-action 'none'")
    icon = base64.b64encode((site / "zstep.svg").read_bytes()).decode()

    page = text("index.html")
    page = replaced(page, r'(?<=http-equiv="Content-Security-Policy" content=")[^"]*', policy)
    page = replaced(page, r'(?<=<link rel="icon" href=")[^"]*', f"data:image/svg+xml;base64,{icon}")
    page = replaced(page, r'<link rel="manifest"[^>]*>\n', "")
    page = replaced(page, r'<link rel="stylesheet"[^>]*>', f"<style>{style}</style>")
    held = {"zstep.js": site / "zstep.js", "zstep.data": site / "zstep.data", "zstep.wasm": program}
    data = "".join(packed(name, file.read_bytes()) for name, file in held.items())
    page = replaced(page, r'<script src="film.js"></script>\n<script src="page.js"></script>\n',
                    f"<!-- zstep publish {version} -->\n{data}<script>{unpacker}</script>\n<script>{script}</script>\n")
    beside = target.with_name("." + target.name + ".new")
    beside.write_bytes(page.encode())
    beside.replace(target)
    print(f"zstep: {target.name} has {target.stat().st_size} bytes", file=sys.stderr)


if __name__ == "__main__":
    main()
