// A Firefox without a window, driven by WebDriver BiDi (https://www.w3.org/TR/webdriver-bidi/), which it speaks itself.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

import {Page} from './page.mjs';
import {webSocket} from './websocket.mjs';

const prefs = {
  'app.update.auto': false,
  'browser.shell.checkDefaultBrowser': false,
  'datareporting.policy.dataSubmissionEnabled': false,
  'dom.w3c_touch_events.enabled': 1,
  'services.settings.server': 'data:,',
  'toolkit.telemetry.enabled': false,
};

// Keys that are no letters: https://www.w3.org/TR/webdriver2/#keyboard-actions
const keys = {Enter: '\uE007', Shift: '\uE008', Control: '\uE009', ArrowLeft: '\uE012', ArrowRight: '\uE014', F6: '\uE036'};

export class Firefox {
  constructor(program) {
    this.home = mkdtempSync(join(tmpdir(), 'zstep-browser-'));
    writeFileSync(join(this.home, 'user.js'), Object.entries(prefs).map((pair) => `user_pref(${pair.map((one) => JSON.stringify(one)).join(', ')});\n`).join(''));
    this.process = spawn(program, ['--headless', '--no-remote', '--remote-debugging-port', '0', '--profile', this.home],
      {stdio: ['ignore', 'ignore', 'pipe']});
    this.waiting = new Map();
    this.pages = [];
    this.next = 1;
    this.ready = this.connect();
    this.ready.catch(() => {});  // who opens a page is told
  }

  async connect() {
    const port = await new Promise((resolve, reject) => {
      let said = '';
      this.process.stderr.setEncoding('utf8').on('data', (text) => {
        const found = /listening on (ws:\/\/\S+)/.exec(said += text);
        if (found) resolve(found[1]);
      });
      this.process.once('exit', () => reject(new Error(`the browser ended: ${said}`)));
    });
    const ended = () => { for (const {reject} of this.waiting.values()) reject(new Error('the browser ended')); };
    this.socket = await webSocket(port + '/session', (text) => this.hear(JSON.parse(text)), ended);
    await this.post('session.new', {capabilities: {}});
    await this.post('session.subscribe', {events: ['log.entryAdded', 'network.beforeRequestSent']});
  }

  hear(message) {
    if (message.type === 'event') { for (const page of this.pages) page.hear(message); return; }
    const waits = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.type === 'error') waits?.reject(new Error(`${waits.method}: ${message.error}: ${message.message}`));
    else waits?.resolve(message.result);
  }

  post(method, params = {}) {
    const id = this.next++;
    this.socket.send(JSON.stringify({id, method, params}));
    return new Promise((resolve, reject) => this.waiting.set(id, {resolve, reject, method}));
  }

  /// `before`: a script that runs before those of the page.
  async open(url, {width = 1280, height = 720, scale = 1, before} = {}) {
    await this.ready;
    const {context} = await this.post('browsingContext.create', {type: 'tab'});
    const page = new FirefoxPage(this, context);
    this.pages.push(page);
    await page.resize(width, height, scale);
    if (before) await this.post('script.addPreloadScript', {functionDeclaration: `() => { ${before} }`, contexts: [context]});
    await page.go(url);
    return page;
  }

  async close() {
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    await this.ready.then(() => this.post('browser.close')).catch(() => this.process.kill());
    await ended;
    rmSync(this.home, {recursive: true, force: true, maxRetries: 10, retryDelay: 200});
  }
}

class FirefoxPage extends Page {
  constructor(browser, context) {
    super();
    Object.assign(this, {browser, context});
  }

  hear({method, params}) {
    if ((params.context ?? params.source?.context) !== this.context) return;
    if (method === 'log.entryAdded') this.told.push((params.type === 'javascript' ? 'exception: ' : '') + params.text);
    if (method === 'network.beforeRequestSent') this.requests.push(params.request.url);
  }

  send(method, params) { return this.browser.post(method, {context: this.context, ...params}); }

  async go(url) { await this.send('browsingContext.navigate', {url, wait: 'none'}); }

  async ask(expression) {
    const {type, result, exceptionDetails} = await this.browser.post('script.evaluate', {
      expression: `(async () => JSON.stringify(await (${expression})))()`, target: {context: this.context}, awaitPromise: true});
    if (type === 'exception') throw new Error(exceptionDetails.text);
    return result.value === undefined ? undefined : JSON.parse(result.value);
  }

  resize(width, height, scale = 1) {
    return this.send('browsingContext.setViewport', {viewport: {width, height}, devicePixelRatio: scale});
  }

  act(actions) { return this.send('input.performActions', {actions}); }

  async key(key, {modifiers = 0} = {}) {
    const held = [['Control', 2], ['Shift', 8]].filter(([, bit]) => modifiers & bit).map(([name]) => keys[name]);
    const typed = keys[key] ?? key;
    await this.act([{type: 'key', id: 'keyboard', actions: [...held, typed].map((value) => ({type: 'keyDown', value}))
      .concat([typed, ...held].map((value) => ({type: 'keyUp', value})))}]);
  }

  async click(x, y) {
    await this.act([{type: 'pointer', id: 'mouse', actions: [{type: 'pointerMove', x, y}, {type: 'pointerDown', button: 0}, {type: 'pointerUp', button: 0}]}]);
  }

  /// Fingers that begin at places, go to others and are lifted: [[x, y, to x, to y], ...]; `rests`: milliseconds before that.
  async fingers(ways, {rests = 0, parts = 4} = {}) {
    const moves = ways.some((way) => way.length > 2) ? [...Array(parts)].map((_, k) => (k + 1) / parts) : [];
    await this.act(ways.map(([x, y, toX = x, toY = y], id) => ({type: 'pointer', id: 'finger' + id, parameters: {pointerType: 'touch'}, actions: [
      {type: 'pointerMove', x: Math.round(x), y: Math.round(y)}, {type: 'pointerDown', button: 0}, {type: 'pause', duration: rests},
      ...moves.map((share) => ({type: 'pointerMove', x: Math.round(x + (toX - x) * share), y: Math.round(y + (toY - y) * share), duration: 30})),
      {type: 'pointerUp', button: 0}]})));
  }

  /// As a keyboard on the screen types.
  async insert(text) { await this.ask(`document.execCommand('insertText', false, ${JSON.stringify(text)})`); }

  /// Gives the page a file as the reader's dialogue does.
  async choose(path) {
    const [{sharedId}] = await this.located({type: 'css', value: '#file'});
    await this.send('input.setFiles', {element: {sharedId}, files: [path]});
  }

  /// How many have a role in the accessibility tree, and this name, where one is given.
  async accessible(role, name) {
    return (await this.located({type: 'accessibility', value: name === undefined ? {role} : {role, name}})).length;
  }

  /// Whether it is read in what is not hidden: BiDi tells no text of that tree.
  isRead(text) {
    return this.ask(`[...document.body.querySelectorAll('*')].some((one) => one.checkVisibility() && !one.closest('[aria-hidden=true]')
      && one.textContent.includes(${JSON.stringify(text)}))`);
  }

  async located(locator) { return (await this.send('browsingContext.locateNodes', {locator})).nodes; }

  offline() {
    return this.browser.post('emulation.setNetworkConditions', {networkConditions: {type: 'offline'}, contexts: [this.context]});
  }

  front() { return this.send('browsingContext.activate'); }

  close() { return this.send('browsingContext.close'); }
}
