// A film of what the window shows: frames go to the browser's own encoder, and what comes from there into a WebM
// (https://www.webmproject.org/docs/container/), which is a download.
'use strict';

const film = (() => {
  const longestCluster = 30000;  // milliseconds, which 16 bits hold
  let made = null;               // the film that is being made

  // --- A WebM: elements of a name, a size and what they hold.
  const joined = (parts) => {
    const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of parts) all.set(part, at), at += part.length;
    return all;
  };
  const bytesOf = (number, count) => Uint8Array.from({length: count}, (_, k) => Math.floor(number / 2 ** (8 * (count - 1 - k))) % 256);
  const idOf = (id) => bytesOf(id, Math.ceil(Math.log2(id + 1) / 8));
  const element = (id, ...parts) => {
    const body = joined(parts);
    return joined([idOf(id), Uint8Array.of(1), bytesOf(body.length, 7), body]);
  };
  const whole = (id, number) => element(id, bytesOf(number, 4));
  const text = (id, letters) => element(id, new TextEncoder().encode(letters));
  const real = (id, number) => {
    const body = new DataView(new ArrayBuffer(8));
    body.setFloat64(0, number);
    return element(id, new Uint8Array(body.buffer));
  };
  const block = (chunk, since) => {
    const flags = chunk.key ? 0x80 : 0;
    return element(0xA3, Uint8Array.of(0x81), bytesOf(chunk.time - since, 2), Uint8Array.of(flags), chunk.bytes);
  };
  const clusters = (chunks) => {
    const all = [];
    for (const chunk of chunks) {
      if (all.length === 0 || chunk.time - all.at(-1)[0].time > longestCluster) all.push([]);
      all.at(-1).push(chunk);
    }
    return all.map((some) => element(0x1F43B675, whole(0xE7, some[0].time), ...some.map((chunk) => block(chunk, some[0].time))));
  };
  const webm = ({width, height, rate, chunks}) => joined([
    element(0x1A45DFA3, whole(0x4286, 1), whole(0x42F7, 1), whole(0x42F2, 4), whole(0x42F3, 8), text(0x4282, 'webm'), whole(0x4287, 2),
      whole(0x4285, 2)),
    element(0x18538067,
      element(0x1549A966, whole(0x2AD7B1, 1000000), text(0x4D80, 'zstep'), text(0x5741, 'zstep'), real(0x4489, chunks.length * 1000 / rate)),
      element(0x1654AE6B, element(0xAE, whole(0xD7, 1), whole(0x73C5, 1), whole(0x9C, 0), whole(0x83, 1), text(0x86, 'V_VP8'),
        element(0xE0, whole(0xB0, width), whole(0xBA, height)))),
      ...clusters(chunks)),
  ]);

  return {
    begin(name, width, height, rate) {
      if (typeof VideoEncoder === 'undefined') return false;
      const one = {name, rate, stride: width, width: width - width % 2, height: height - height % 2, rows: height, count: 0, chunks: [], wrong: ''};
      one.encoder = new VideoEncoder({
        output(chunk) {
          const bytes = new Uint8Array(chunk.byteLength);
          chunk.copyTo(bytes);
          one.chunks.push({bytes, key: chunk.type === 'key', time: Math.round(chunk.timestamp / 1000)});
        },
        error(error) { one.wrong = error.message; },
      });
      try {
        one.encoder.configure({codec: 'vp8', width: one.width, height: one.height, bitrate: 6 * one.width * one.height, framerate: rate});
      } catch {
        return false;
      }
      made = one;
      return true;
    },

    takesMore: () => made.encoder.encodeQueueSize < 8,

    // `rgb`: where the frame is, row by row, three bytes a pixel.
    frame(memory, rgb) {
      if (made.wrong !== '' || made.encoder.state !== 'configured') return false;
      const pixels = new Uint8Array(4 * made.stride * made.rows);
      for (let from = rgb, to = 0; to < pixels.length; from += 3, to += 4)
        pixels[to] = memory[from], pixels[to + 1] = memory[from + 1], pixels[to + 2] = memory[from + 2], pixels[to + 3] = 255;
      const frame = new VideoFrame(pixels, {
        format: 'RGBX', codedWidth: made.stride, codedHeight: made.rows, timestamp: Math.round(1e6 * made.count / made.rate),
        visibleRect: {x: 0, y: 0, width: made.width, height: made.height},
      });
      made.encoder.encode(frame, {keyFrame: made.count % 50 === 0});
      frame.close();
      made.count += 1;
      return true;
    },

    finish() {
      const one = made;
      made = null;
      one.encoder.flush().then(() => {
        page.download(one.name, new Blob([webm(one)], {type: 'video/webm'}));
        one.encoder.close();
      }).catch((error) => warn(`The film could not be made (${one.wrong || error.message}).`));
    },

    drop() {
      if (made && made.encoder.state !== 'closed') made.encoder.close();
      made = null;
    },
  };
})();
