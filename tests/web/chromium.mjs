// A Chromium without a window, driven by the protocol of its own tools over two pipes: no library, no port.
import {spawn} from 'node:child_process';
import {createHash} from 'node:crypto';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

export class Browser {
  constructor(program = 'chromium') {
    this.home = mkdtempSync(join(tmpdir(), 'zstep-browser-'));
    this.process = spawn(program, ['--headless=new', '--no-sandbox', '--disable-gpu', '--hide-scrollbars', '--remote-debugging-pipe',
      '--disable-dev-shm-usage', '--no-first-run', `--user-data-dir=${this.home}`, 'about:blank'],
      {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.waiting = new Map();
    this.listeners = [];
    this.next = 1;
    let left = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (text) => {
      const messages = (left + text).split('\0');
      left = messages.pop();
      for (const message of messages) this.hear(JSON.parse(message));
    });
    this.process.on('exit', () => { for (const {reject} of this.waiting.values()) reject(new Error('the browser ended')); });
  }

  hear(message) {
    const waits = this.waiting.get(message.id);
    if (!waits) { for (const listener of this.listeners) listener(message); return; }
    this.waiting.delete(message.id);
    if (message.error) waits.reject(new Error(`${waits.method}: ${message.error.message}`));
    else waits.resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    this.process.stdio[3].write(JSON.stringify({id, method, params, sessionId}) + '\0');
    return new Promise((resolve, reject) => this.waiting.set(id, {resolve, reject, method}));
  }

  async open(url, {width = 1280, height = 720, scale = 1, mobile = false} = {}) {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'});
    const {sessionId} = await this.send('Target.attachToTarget', {targetId, flatten: true});
    const page = new Page(this, targetId, sessionId);
    this.listeners.push((message) => { if (message.sessionId === sessionId) page.hear(message); });
    await page.send('Page.enable');
    await page.send('Runtime.enable');
    await page.send('Log.enable');
    await page.send('Network.enable');
    await page.resize(width, height, scale, mobile);
    await page.go(url);
    return page;
  }

  async close() {
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    await this.send('Browser.close').catch(() => {});
    await ended;
    rmSync(this.home, {recursive: true, force: true, maxRetries: 10, retryDelay: 200});
  }
}

export const digestOf = ({width, height, rgb}) => `${width}x${height} ${createHash('sha256').update(rgb).digest('hex')}`;

export class Page {
  constructor(browser, targetId, sessionId) {
    Object.assign(this, {browser, targetId, sessionId, told: [], requests: []});
  }

  hear({method, params}) {
    if (method === 'Runtime.consoleAPICalled') this.told.push(params.args.map((one) => one.value).join(' '));
    if (method === 'Runtime.exceptionThrown') this.told.push('exception: ' + (params.exceptionDetails.exception?.description ?? params.exceptionDetails.text));
    if (method === 'Log.entryAdded' && params.entry.level === 'error') this.told.push('error: ' + params.entry.text);
    if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
  }

  send(method, params) { return this.browser.send(method, params, this.sessionId); }

  async go(url) { await this.send('Page.navigate', {url}); }

  async ask(expression) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  resize(width, height, scale = 1, mobile = false) {
    return this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: scale, mobile});
  }

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

  async key(key, {code = '', modifiers = 0, keyCode = 0, text = ''} = {}) {
    // As a hand does: what is held goes down before, and up after.
    const held = [['Control', 17, 2], ['Shift', 16, 8]].filter(([, , bit]) => modifiers & bit);
    const one = (type, key, code, keyCode, text = '') => this.send('Input.dispatchKeyEvent',
      {type, key, code, text, modifiers, windowsVirtualKeyCode: keyCode, nativeVirtualKeyCode: keyCode});
    for (const [name, number] of held) await one('rawKeyDown', name, name + 'Left', number);
    await one(text ? 'keyDown' : 'rawKeyDown', key, code, keyCode, text);
    await one('keyUp', key, code, keyCode);
    for (const [name, number] of held) await one('keyUp', name, name + 'Left', number);
  }

  async click(x, y, button = 'left') {
    const what = {x, y, button, clickCount: 1};
    await this.send('Input.dispatchMouseEvent', {type: 'mouseMoved', x, y});
    await this.send('Input.dispatchMouseEvent', {type: 'mousePressed', ...what});
    await this.send('Input.dispatchMouseEvent', {type: 'mouseReleased', ...what});
  }

  /// Fingers that begin at places, go to others and are lifted: [[x, y, to x, to y], ...]; `rests`: milliseconds before that.
  async fingers(ways, {rests = 0, parts = 4} = {}) {
    const at = (share) => ways.map(([x, y, toX = x, toY = y], id) => ({id, x: x + (toX - x) * share, y: y + (toY - y) * share}));
    await this.send('Input.dispatchTouchEvent', {type: 'touchStart', touchPoints: at(0)});
    if (rests) await new Promise((resolve) => setTimeout(resolve, rests));
    if (ways.some((way) => way.length > 2))
      for (let k = 1; k <= parts; ++k) {
        await this.send('Input.dispatchTouchEvent', {type: 'touchMove', touchPoints: at(k / parts)});
        await new Promise((resolve) => setTimeout(resolve, 30));
      }
    await this.send('Input.dispatchTouchEvent', {type: 'touchEnd', touchPoints: []});
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

  close() { return this.browser.send('Target.closeTarget', {targetId: this.targetId}); }
}
