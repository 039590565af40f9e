// A PNG of 8-bit RGB as zstep writes it, as {width, height, rgb}.
import {readFileSync} from 'node:fs';
import {inflateSync} from 'node:zlib';

export const readPng = (path) => {
  const bytes = readFileSync(path);
  let at = 8, width = 0, height = 0;
  const data = [];
  while (at < bytes.length) {
    const length = bytes.readUInt32BE(at), type = bytes.toString('latin1', at + 4, at + 8), body = bytes.subarray(at + 8, at + 8 + length);
    if (type === 'IHDR') {
      [width, height] = [body.readUInt32BE(0), body.readUInt32BE(4)];
      if (body[8] !== 8 || body[9] !== 2 || body[12] !== 0) throw new Error(`${path}: no plain 8-bit RGB`);
    }
    if (type === 'IDAT') data.push(body);
    at += 12 + length;
  }
  const rows = inflateSync(Buffer.concat(data)), stride = width * 3, rgb = Buffer.alloc(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = rows[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x >= 3 ? rgb[y * stride + x - 3] : 0, up = y > 0 ? rgb[(y - 1) * stride + x] : 0;
      const corner = x >= 3 && y > 0 ? rgb[(y - 1) * stride + x - 3] : 0;
      const p = left + up - corner, [a, b, c] = [left, up, corner].map((one) => Math.abs(p - one));
      const guess = [0, left, up, (left + up) >> 1, a <= b && a <= c ? left : b <= c ? up : corner][filter];
      rgb[y * stride + x] = (rows[y * (stride + 1) + 1 + x] + guess) & 255;
    }
  }
  return {width, height, rgb};
};
