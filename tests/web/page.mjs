// A page in a browser, whichever it is: what tests ask of it. chromium.mjs and firefox.mjs say how.
import {createHash} from 'node:crypto';

export const digestOf = ({width, height, rgb}) => `${width}x${height} ${createHash('sha256').update(rgb).digest('hex')}`;

/// What each browser has besides: go(url), ask(expression), resize(width, height, scale, mobile), key(key, {…}),
/// click(x, y), fingers(ways, {…}), insert(text), choose(path), accessible(role, name),
/// isRead(text), offline(), front(), close().
/// `told`: what the page said on its console, and what was wrong with it. `requests`: the addresses it asked for.
export class Page {
  told = [];
  requests = [];

  /// Until the expression is true; its last value is in the error otherwise.
  async until(expression, seconds = 60) {
    const end = Date.now() + seconds * 1000;
    let value;
    while (Date.now() < end) {
      try {
        if ((value = await this.ask(expression))) return value;
      } catch (error) {
        value = error.message;  // between two pages there is nobody to ask
      }
      await new Promise((resolve) => setTimeout(resolve, 30));
    }
    throw new Error(`waited ${seconds} s for: ${expression}; at the end it was ${value}; the page said: ${this.told.join(' | ')}`);
  }

  /// What an expression says of the canvas, as `{width, height, data}`, once that is the same twice.
  async ofCanvas(expression) {
    const one = () => this.ask(`(async () => {
      const {width, height} = canvas, {data} = canvas.getContext('2d').getImageData(0, 0, width, height);
      return JSON.stringify(await (${expression})({width, height, data}));
    })()`);
    let before = await one();
    for (let k = 0; k < 50; ++k) {
      await new Promise((resolve) => setTimeout(resolve, 120));
      const now = await one();
      if (now === before) return JSON.parse(now);
      before = now;
    }
    throw new Error('the picture does not come to rest');
  }

  /// What is on the canvas: {width, height, rgb}.
  async picture() {
    const {width, height, rgb} = await this.ofCanvas(`({width, height, data}) => {
      let text = '';
      for (let at = 0; at < data.length; at += 4) text += String.fromCharCode(data[at], data[at + 1], data[at + 2]);
      return {width, height, rgb: btoa(text)};
    }`);
    return {width, height, rgb: Buffer.from(rgb, 'base64')};
  }

  /// A digest of it, as digestOf() has it of a picture: much less than the picture goes from the page to here.
  async digest() {
    return this.ofCanvas(`async ({width, height, data}) => {
      const rgb = new Uint8Array(width * height * 3);
      for (let from = 0, to = 0; from < data.length; from += 4) rgb[to++] = data[from], rgb[to++] = data[from + 1], rgb[to++] = data[from + 2];
      const sum = new Uint8Array(await crypto.subtle.digest('SHA-256', rgb));
      return width + 'x' + height + ' ' + [...sum].map((byte) => byte.toString(16).padStart(2, '0')).join('');
    }`);
  }
}
