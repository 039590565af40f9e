// A page that holds all of zstep in itself, and mostly a run (sim/web/one_page.py, zstep publish): here it is unpacked.
// Each part is a script element of no type that a browser runs: gzip, as seven bits a letter.
'use strict';

var packed = (() => {
  const part = (name) => [...document.querySelectorAll('script[data-name]')].find((one) => one.dataset.name === name);

  /// The inverse of seven_bits() of one_page.py.
  const bytesOf = (text, count) => {
    const bytes = new Uint8Array(count), unsafe = [0, 13, 60];
    let held = 0, bits = 0, at = 0;
    const put = (group) => {
      held = held << 7 | group;
      bits += 7;
      if (bits < 8) return;
      bits -= 8;
      if (at < count) bytes[at++] = held >> bits;
      held &= (1 << bits) - 1;
    };
    for (let k = 0; k < text.length; ++k) {
      const code = text.charCodeAt(k);
      if (code < 128) put(code);
      else if (code >= 256 && code < 640) put(unsafe[code - 256 >> 7]), put(code & 127);
      else throw new Error('damaged');
    }
    if (at < count) throw new Error('damaged');
    return bytes;
  };

  /// What is in a part, which is gone from the page then.
  const unpacked = async (name) => {
    const element = part(name);
    const bytes = bytesOf(element.textContent, Number(element.dataset.bytes));
    element.remove();
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
  };

  const published = document.getElementById('published');
  const {words, files} = published ? JSON.parse(published.textContent) : {words: [], files: []};

  return {
    words,

    /// Gives the module its parts, and the program to the page.
    async begin(module) {
      const [program, data, wasm, ...runs] =
        await Promise.all(['zstep.js', 'zstep.data', 'zstep.wasm', ...files].map(unpacked));
      module.getPreloadedPackage = () => data;
      module.wasmBinary = new Uint8Array(wasm);
      module.preRun.push(() => {
        module.FS.mkdir('/published');
        module.FS.chdir('/published');
        files.forEach((name, k) => module.FS.writeFile(name, new Uint8Array(runs[k])));
      });
      const script = document.createElement('script');
      script.textContent = new TextDecoder().decode(program);
      document.body.append(script);
    },
  };
})();
