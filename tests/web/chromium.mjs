// A Chromium without a window, driven by the protocol of its own tools over two pipes: no library, no port.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

import {Page} from './page.mjs';

export class Chromium {
  constructor(program) {
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

  /// `mobile`: as on a phone, with fingers. `before`: a script that runs before those of the page.
  async open(url, {width = 1280, height = 720, scale = 1, mobile = false, before} = {}) {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'});
    const {sessionId} = await this.send('Target.attachToTarget', {targetId, flatten: true});
    const page = new ChromiumPage(this, targetId, sessionId);
    this.listeners.push((message) => { if (message.sessionId === sessionId) page.hear(message); });
    await page.send('Page.enable');
    await page.send('Runtime.enable');
    await page.send('Log.enable');
    await page.send('Network.enable');
    await page.resize(width, height, scale, mobile);
    if (mobile) await page.send('Emulation.setTouchEmulationEnabled', {enabled: true, maxTouchPoints: 5});
    if (before) await page.send('Page.addScriptToEvaluateOnNewDocument', {source: before});
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

class ChromiumPage extends Page {
  constructor(browser, targetId, sessionId) {
    super();
    Object.assign(this, {browser, targetId, sessionId});
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

  /// As a keyboard on the screen types.
  insert(text) { return this.send('Input.insertText', {text}); }

  /// Gives the page a file as the reader's dialogue does.
  async choose(path) {
    const {root} = await this.send('DOM.getDocument');
    const {nodeId} = await this.send('DOM.querySelector', {nodeId: root.nodeId, selector: '#file'});
    await this.send('DOM.setFileInputFiles', {nodeId, files: [path]});
  }

  /// How many have a role in the accessibility tree, and this name, where one is given.
  async accessible(role, name) {
    const nodes = (await this.accessibilityTree()).filter((node) => node.role?.value === role);
    return nodes.filter((node) => name === undefined || (node.name?.value ?? '') === name).length;
  }

  /// Whether it is read in that tree.
  async isRead(text) { return (await this.accessibilityTree()).some((node) => (node.name?.value ?? '').includes(text)); }

  async accessibilityTree() { return (await this.send('Accessibility.getFullAXTree')).nodes.filter((node) => !node.ignored); }

  offline() {
    return this.send('Network.emulateNetworkConditions', {offline: true, latency: 0, downloadThroughput: -1, uploadThroughput: -1});
  }

  front() { return this.send('Page.bringToFront'); }

  close() { return this.browser.send('Target.closeTarget', {targetId: this.targetId}); }
}
