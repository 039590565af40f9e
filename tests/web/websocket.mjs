// As much of a WebSocket (RFC 6455) as a program on this machine needs that speaks text to a browser. Node has one from 22 on.
import {randomBytes} from 'node:crypto';
import {get} from 'node:http';

/// Resolves to {send(text), close()} once it is open; `hear` gets each text, `ended` is called when it is closed.
export const webSocket = (url, hear, ended) => new Promise((resolve, reject) => {
  const headers = {Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': randomBytes(16).toString('base64')};
  const request = get(url.replace(/^ws:/, 'http:'), {headers});
  request.on('error', reject);
  request.on('response', (answer) => reject(new Error(`${url} answers ${answer.statusCode}`)));
  request.on('upgrade', (answer, socket, head) => {
    const send = (kind, bytes) => {
      const size = bytes.length < 126 ? [0x80 | bytes.length] : bytes.length < 65536 ? [0x80 | 126] : [0x80 | 127];
      const length = Buffer.alloc(size[0] === 0xfe ? 2 : size[0] === 0xff ? 8 : 0);
      if (length.length === 2) length.writeUInt16BE(bytes.length);
      if (length.length === 8) length.writeBigUInt64BE(BigInt(bytes.length));
      const mask = randomBytes(4);
      socket.write(Buffer.concat([Buffer.from([0x80 | kind, ...size]), length, mask, bytes.map((byte, at) => byte ^ mask[at % 4])]));
    };
    let buffer = Buffer.alloc(0), parts = [];
    const take = () => {
      if (buffer.length < 2) return false;
      const short = buffer[1] & 0x7f, from = short === 126 ? 4 : short === 127 ? 10 : 2;
      if (buffer.length < from) return false;
      const size = short === 126 ? buffer.readUInt16BE(2) : short === 127 ? Number(buffer.readBigUInt64BE(2)) : short;
      if (buffer.length < from + size) return false;
      const kind = buffer[0] & 0x0f, last = buffer[0] >= 0x80, body = buffer.subarray(from, from + size);
      buffer = buffer.subarray(from + size);
      if (kind === 8) socket.end();
      else if (kind === 9) send(10, body);
      else if (kind < 2) {
        parts.push(body);
        if (last) hear(Buffer.concat(parts.splice(0)).toString('utf8'));
      }
      return true;
    };
    const more = (bytes) => { buffer = Buffer.concat([buffer, bytes]); while (take()); };
    socket.on('data', more).on('close', ended).on('error', ended);
    more(head);
    resolve({send: (text) => send(1, Buffer.from(text)), close: () => socket.end()});
  });
});
