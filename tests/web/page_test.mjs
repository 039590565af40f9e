// The page in a real browser: node page_test.mjs SITE PICTURES [NAME]. SITE is what ./zstep web made; PICTURES is what
// pictures.sh PROGRAM PICTURES SITE made: what the native program draws, and published pages, with an index.json and a
// pages.json: [{"link": "#lesson=z-buffer&stop=1", "file": "0.png"}, {"page": "place.html", "file": "1.png"}]. NAME runs
// some.
import {createServer} from 'node:http';
import {mkdtempSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {extname, join, normalize, resolve} from 'node:path';
import {gzipSync} from 'node:zlib';

import {Chromium} from './chromium.mjs';
import {Firefox} from './firefox.mjs';
import {digestOf} from './page.mjs';
import {readPng} from './png.mjs';

const [site, pictures, only] = process.argv.slice(2);
const program = process.env.ZSTEP_BROWSER || 'chromium';
const newBrowser = () => new (/firefox/.test(program) ? Firefox : Chromium)(program);
const types = {'.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml',
  '.webmanifest': 'application/manifest+json'};

// From a folder below the root, as a course's server may have it.
const below = '/course/zstep/';
const embedded = '#embed=1&lesson=z-buffer&step=867&pane=slice';
const notes = `<!doctype html><title>Notes</title><input autofocus><iframe src="${below}${embedded}" width="720" height="420"></iframe>`;
let restAfter = 0;  // milliseconds, as over a slow line
const server = createServer(async (request, response) => {
  const path = decodeURIComponent(request.url.split('?')[0]);
  const name = path === below ? 'index.html' : normalize(path.slice(below.length));
  if (path === '/notes.html') return response.writeHead(200, {'Content-Type': 'text/html'}).end(notes);
  try {
    if (!path.startsWith(below) || name.startsWith('..')) throw new Error('elsewhere');
    const body = readFileSync(join(site, name));
    if (name === 'zstep.rest.wasm') await new Promise((resolve) => setTimeout(resolve, restAfter));
    response.writeHead(200, {'Content-Type': types[extname(name)] ?? 'application/octet-stream'}).end(body);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
const address = `http://127.0.0.1:${server.address().port}${below}`;

const shown = 'Module.running === true';
const check = (holds, what) => { if (!holds) throw new Error(what); };
const same = (a, b) => a.width === b.width && a.height === b.height && a.rgb.equals(b.rgb);
const differ = (a, b) => {
  if (a.width !== b.width || a.height !== b.height) return `${a.width}x${a.height} and ${b.width}x${b.height}`;
  let count = 0, first = -1;
  for (let at = 0; at < a.rgb.length; at += 3)
    if (a.rgb.compare(b.rgb, at, at + 3, at, at + 3) !== 0) { count += 1; if (first < 0) first = at / 3; }
  return `${count} pixels differ, first (${first % a.width}, ${Math.floor(first / a.width)})`;
};

// The title of a window has buttons that one without it has not.
const belowTitle = ({width, height, rgb}) => ({width, height: height - 30, rgb: rgb.subarray(30 * width * 3)});

const reload = async (page) => {
  await page.ask('window.before = true, void location.reload()');
  await page.until(`window.before === undefined && ${shown}`);
};

let browser;
const tests = [];
const test = (name, run) => tests.push({name, run});

test('every stop by its link is the native picture to the byte', async () => {
  const index = JSON.parse(readFileSync(join(pictures, 'index.json')));
  let page, lesson = '';
  const wrong = [];
  for (const {link, file} of index) {
    const now = link.split('&')[0];
    if (now !== lesson) {
      await page?.close();
      page = await browser.open(address + link);
      await page.until(shown);
      lesson = now;
    } else await page.ask(`void (location.hash = ${JSON.stringify(link)})`);
    await page.until(`said.textContent !== ''`);
    const native = readPng(join(pictures, file));
    if (await page.digest() !== digestOf(native)) wrong.push(`${link}: ${differ(await page.picture(), native)}`);
  }
  await page?.close();
  console.log(`  ${index.length} pictures`);
  check(wrong.length === 0, `${wrong.length} of ${index.length} differ:\n    ${wrong.slice(0, 12).join('\n    ')}`);
});

test('published pages from disk, and what is embedded, are the native pictures to the byte', async () => {
  const wrong = [];
  for (const {link, page: name, file} of JSON.parse(readFileSync(join(pictures, 'pages.json')))) {
    const url = name ? 'file://' + resolve(pictures, name) : address + link;
    const page = await browser.open(url);
    await page.until(shown);
    let drawn = await page.picture(), native = readPng(join(pictures, file));
    if (!url.includes('embed=1')) [drawn, native] = [drawn, native].map(belowTitle);
    if (!same(drawn, native)) wrong.push(`${name ?? link}: ${differ(drawn, native)}`);
    if (name) {
      console.log(`  ${name}: ${statSync(join(pictures, name.split('#')[0])).size} bytes, first picture after ${Math.round(await page.ask('Module.firstPicture'))} ms`);
      const others = page.requests.filter((one) => one.split('#')[0] !== url.split('#')[0] && !one.startsWith('data:'));
      if (others.length > 0) wrong.push(`${name} asked for ${others.join(' ')}`);
      const complaints = page.told.filter((one) => /^error|^exception|Content Security/.test(one));
      if (complaints.length > 0) wrong.push(`${name} said ${complaints.join(' | ')}`);
      const evaluated = await page.ask(`(() => { const s = document.createElement('script'); s.textContent = 'window.ran = true';
        document.body.append(s); return window.ran === true; })()`);
      if (evaluated) wrong.push(`${name} ran a script that it does not hold`);
    }
    await page.close();
  }
  check(wrong.length === 0, wrong.join('\n    '));
});

test('inside a page of notes it leaves the keyboard and the history of that page alone', async () => {
  const page = await browser.open(new URL('/notes.html', address).href);
  const inside = (what) => `document.querySelector('iframe').contentWindow.${what}`;
  await page.until(inside('Module?.running === true'));
  const length = await page.ask('history.length');
  check(await page.ask(`document.activeElement.tagName === 'INPUT'`), 'the keyboard was taken');
  const {x, y} = JSON.parse(await page.ask(`JSON.stringify(document.querySelector('iframe').getBoundingClientRect())`));
  await page.click(x + 100, y + 100);
  for (let k = 0; k < 3; ++k) await page.key('n', {code: 'KeyN', keyCode: 78, text: 'n'});
  await page.until(inside(`location.hash.includes('step=') && !` + inside(`location.hash.includes('step=867')`)));
  check(await page.ask(inside(`location.hash.includes('embed=1')`)), 'it forgot that it is embedded');
  check(await page.ask('history.length') === length, 'the history of the notes grew');
  await page.close();
});

test('a key steps, the address follows, and back and forward go through the stops', async () => {
  const page = await browser.open(address + '#lesson=z-buffer&stop=2');
  await page.until(shown);
  const step = async () => Number((await page.until(`/[&]step=(\\d+)/.exec(location.hash)?.[1]`)));
  const first = await step();
  await page.key('ArrowRight', {code: 'ArrowRight', keyCode: 39});
  await page.until(`location.hash.includes('step=${first + 1}')`);
  const length = await page.ask('history.length');
  await page.key('n', {code: 'KeyN', keyCode: 78, text: 'n'});
  await page.until(`history.length === ${length} + 1`);
  const third = await step();
  check(third > first + 1, `the next stop is at ${third}`);
  await page.ask('void history.back()');
  await page.until(`location.hash.includes('step=${first + 1}')`);
  await page.until(`said.textContent.startsWith('Step ${first + 1} of')`);  // after its frame, whose tables are shown with it
  await page.ask('void history.forward()');
  await page.until(`location.hash.includes('step=${third}')`);
  await page.close();
});

test('nothing comes from elsewhere, nothing is refused, and nobody complains', async () => {
  const page = await browser.open(address);
  await page.until(shown);
  await page.picture();
  check(page.requests.every((url) => url.startsWith(address) || url.startsWith('blob:')), `asked for ${page.requests.join(' ')}`);
  check(page.told.length === 0, `said: ${page.told.join(' | ')}`);
  const evaluated = await page.ask(`(() => { const s = document.createElement('script'); s.textContent = 'window.ran = true';
    document.body.append(s); return window.ran === true; })()`);
  check(!evaluated, 'a script in the page ran');
  await page.close();
});

test('links from anywhere do no harm, and are told', async () => {
  for (const link of ['#lesson=no-such-lesson', '#scene=../../etc/passwd', '#lesson=z-buffer&step=%00', '#scene=cube&size=99999x99999',
    '#lesson=%3Cimg%20src%3Dx%20onerror%3Dalert(1)%3E', '#scene=pyramid&change=rho+%3D+nan', '#' + 'x'.repeat(9000), '#scene=cube&step=999999999999']) {
    const page = await browser.open(address + link);
    // What opens nothing leads to the start page, with one line that says why.
    await page.until(`${shown} && (said.textContent !== '' || location.hash === '')`);
    check(await page.ask(`document.querySelectorAll('img').length === 0`), `${link} made an image`);
    await page.close();
  }
});

// In the laboratory: a lesson shows no tables but where it is about them.
test('the sentence, the tables and every command are in the accessibility tree, and F6 leads to them', async () => {
  const page = await browser.open(address + '#scene=pyramid&step=300');
  await page.until(shown);
  await page.until(`tables.querySelectorAll('tr').length > 4`);
  for (const table of ['EDGE TABLE', 'ACTIVE EDGES']) check(await page.accessible('table', table) === 1, `no table ${table}`);
  check(await page.accessible('cell', '15.53') > 0, 'no cell of the edge table');
  const buttons = await page.accessible('button');
  check(buttons > 60 && await page.accessible('button', '') === 0, `${buttons} buttons, some without a name`);
  check(await page.isRead('polygon A is at depth 0.2674'), 'the sentence is not told');
  await page.key('F6', {code: 'F6', keyCode: 117});
  check(await page.ask('commands.contains(document.activeElement)'), 'F6 does not leave the window');
  const pressed = (title) => page.ask(`[...commands.querySelectorAll('button')].find((one) => one.textContent.startsWith(${JSON.stringify(title)})).click()`);
  await pressed('One step on');
  await page.until(`location.hash.includes('step=301')`);
  await page.until(`said.textContent.startsWith('Step 301')`);
  await page.key('Enter', {code: 'Enter', keyCode: 13, text: '\r'});  // on the first button
  await page.until(`location.hash.includes('step=302')`);
  await page.key('F6', {code: 'F6', keyCode: 117});
  check(await page.ask('document.activeElement === canvas'), 'F6 does not lead back');
  await page.close();
});

test('without a network after the first visit', async () => {
  let page = await browser.open(address);
  await page.until(shown);
  await page.ask('navigator.serviceWorker.ready.then(() => true)');
  await page.until(`caches.keys().then((names) => names.length > 0)`);
  await page.until('navigator.serviceWorker.controller !== null');
  const before = await page.picture();
  await page.offline();
  await reload(page);
  const now = await page.picture();
  check(same(now, before), `another picture: ${differ(now, before)}`);
  await page.close();
});

test('settings stay, and where a browser refuses to keep them it works and says so', async () => {
  let page = await browser.open(address + '#lesson=z-buffer&stop=1');
  await page.until(shown);
  const light = await page.picture();
  await page.key('t', {code: 'KeyT', keyCode: 84, text: 't'});
  await page.until(`(localStorage.getItem('zstep-settings') ?? '').includes('dark')`);
  const dark = await page.picture();
  const brightness = ({rgb}) => rgb.reduce((sum, one) => sum + one, 0) / rgb.length;
  check(brightness(light) > 150 && brightness(dark) < 100, `light has ${brightness(light)}, dark ${brightness(dark)}`);
  await reload(page);
  check(brightness(await page.picture()) < 100, 'the theme was forgotten');
  await page.ask(`void localStorage.clear()`);
  await page.close();
  page = await browser.open(address + '#lesson=z-buffer&stop=1',
    {before: `Object.defineProperty(window, 'localStorage', {get() { throw new DOMException('refused', 'SecurityError'); }})`});
  await page.until(shown);
  await page.key('t', {code: 'KeyT', keyCode: 84, text: 't'});
  await page.until(`!notice.hidden && notice.textContent.includes('keeps nothing')`);
  await page.close();
  // So where there is no room.
  page = await browser.open(address + '#lesson=z-buffer&stop=1');
  await page.until(shown);
  await page.ask(`(() => { for (let size = 1 << 22; size > 0; size >>= 1)
    try { while (true) localStorage.setItem('full' + size + Math.random(), 'x'.repeat(size)); } catch { /* full */ } })()`);
  await page.key('=', {code: 'Equal', keyCode: 187, modifiers: 2});  // larger text, and a longer number
  await page.until(`!notice.hidden && notice.textContent.includes('keeps nothing')`);
  await page.ask('void localStorage.clear()');
  await page.close();
});

/// Gives the page a file as the reader's dialogue does.
const choose = async (page, name, text) => {
  const folder = mkdtempSync(join(tmpdir(), 'zstep-file-'));
  writeFileSync(join(folder, name), text);
  await page.choose(join(folder, name));
  return folder;
};

test('a file of the reader is opened, and does not leave the computer', async () => {
  const page = await browser.open(address);
  await page.until(shown);
  await page.until('!first.alone');
  const asked = page.requests.length;
  const folder = await choose(page, 'mine.off', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n');
  await page.until(`document.title.includes('mine')`);
  check(page.requests.slice(asked).every((url) => url.startsWith('blob:')), 'something was asked for');
  rmSync(folder, {recursive: true});
  await page.close();
});

test('a run of the reader is checked, and compared with the one that zstep makes', async () => {
  const page = await browser.open(address);
  await page.until(shown);
  const folder = await choose(page, 'mine.jsonl', readFileSync(join(pictures, 'wrong.jsonl')));
  await page.until(`document.title.includes('pyramid-behind')`);
  await page.key('k', {code: 'KeyK', keyCode: 75, modifiers: 2});
  await page.until(`said.textContent.includes('Wrong: ')`);
  await page.key('d', {code: 'KeyD', keyCode: 68, modifiers: 2});
  await page.key('Enter', {code: 'Enter', keyCode: 13, text: '\r'});
  await page.until(`said.textContent.includes('Cause 1 of 1')`);
  check(page.requests.every((url) => url.startsWith(address) || url.startsWith('blob:')), 'something was asked for');
  rmSync(folder, {recursive: true});
  await page.close();
});

test('settings, progress and bookmarks go to another browser in a file', async () => {
  const page = await browser.open(address + '#lesson=bsp&stop=4');
  await page.until(shown);
  await page.key('t', {code: 'KeyT', keyCode: 84, text: 't'});
  await page.key('b', {code: 'KeyB', keyCode: 66, modifiers: 2});
  for (const letter of 'here') await page.key(letter, {code: 'Key' + letter.toUpperCase(), keyCode: letter.toUpperCase().charCodeAt(0), text: letter});
  await page.key('Enter', {code: 'Enter', keyCode: 13, text: '\r'});
  await page.until(`(localStorage.getItem('zstep-settings') ?? '').includes(' here')`);
  await page.ask(`void (Module.page.handOver = (file) => { window.saved = Module.FS.readFile(file, {encoding: 'utf8'}); })`);
  await page.key('E', {code: 'KeyE', keyCode: 69, modifiers: 10});
  const saved = await page.until('window.saved');
  for (const part of ['[viewer.ini]', 'dark = 1', 'lesson bsp = 4', '[lessons/bsp.marks]', ' here'])
    check(saved.includes(part), `${part} is not in ${saved}`);
  await page.close();

  const other = newBrowser();
  const there = await other.open(address + '#lesson=bsp&stop=1');
  await there.until(shown);
  const folder = await choose(there, 'zstep-progress.ini', saved);
  await there.until(`/lesson bsp = 4[^]* here/.test(localStorage.getItem('zstep-settings') ?? '')`);
  check((await there.ask(`localStorage.getItem('zstep-settings')`)).includes('dark = 1'), 'the theme did not come along');
  await reload(there);
  check(await there.ask(`Module.FS.readFile('/home/web_user/.config/zstep/lessons/bsp.marks', {encoding: 'utf8'}).includes(' here')`),
    'the bookmark did not stay');
  rmSync(folder, {recursive: true});
  await other.close();
});

test('resized, zoomed, on a screen of twice the pixels, and upright', async () => {
  const page = await browser.open(address + '#lesson=z-buffer&stop=3');
  await page.until(shown);
  // 1024 by 576 at 1.25 is what a browser's zoom makes of 1280 by 720.
  for (const [width, height, scale] of [[1600, 900, 1], [1024, 576, 1.25], [800, 600, 2], [390, 844, 3], [844, 390, 1]]) {
    await page.resize(width, height, scale);
    await page.until(`canvas.width === ${width * scale} && canvas.height === ${height * scale}`);
    const picture = await page.picture();
    check(new Set(picture.rgb).size > 20, `nothing is drawn at ${width}x${height}`);
  }
  await page.close();
});

test('by fingers on a phone: a step, a right click, a pinch, and the page stays where it is', async () => {
  for (const scale of [1, 3]) {
    const page = await browser.open(address + '#lesson=z-buffer&step=300', {width: 390, height: 844, scale, mobile: true});
    await page.until(`${shown} && canvas.width === 390 * ${scale}`);
    await page.until(`location.hash.includes('step=300')`);
    await page.fingers([[272, 815]]);  // the arrow on
    await page.until(`location.hash.includes('step=301')`);
    const before = await page.picture();
    await page.fingers([[160, 230, 100, 230], [220, 230, 280, 230]]);
    const zoomed = await page.picture();
    check(!same(before, zoomed), 'two fingers did not zoom the frame');
    await page.fingers([[195, 700, 195, 640]]);
    await page.fingers([[195, 230]], {rests: 700});
    const offered = await page.picture();
    check(!same(zoomed, offered), 'a finger that rested offered nothing');
    check(await page.ask('visualViewport.scale === 1 && scrollX === 0 && scrollY === 0'), 'the page itself was zoomed or scrolled');
    check(await page.ask(`location.hash.includes('step=301')`), 'a gesture made a step');
    await page.close();
  }
});

test('a keyboard on the screen comes up for the line that is touched, and types into it', async () => {
  const page = await browser.open(address, {width: 390, height: 844, scale: 2, mobile: true});
  await page.until(shown);
  await page.until('line.right > line.left');
  check(await page.ask('document.activeElement !== typed'), 'the keyboard came unasked');
  const empty = await page.picture();
  const place = await page.ask('line');
  await page.fingers([[(place.left + place.right) / 2, (place.top + place.bottom) / 2]]);
  await page.until('document.activeElement === typed');
  await page.insert('bsp');
  const found = await page.picture();
  check(!same(empty, found), 'what is typed did not arrive');
  // Taken back and typed anew, as a keyboard does that corrects a word.
  for (const now of [' b', ' bsp']) await page.ask(`(typed.value = '${now}', typed.dispatchEvent(new Event('input')))`);
  check(same(found, await page.picture()), 'what was taken back is still there');
  // What the keyboard leaves is the window's.
  await page.resize(390, 500, 2, true);
  await page.until('canvas.height === 1000 && line.bottom < 500 && line.right > line.left');
  await page.key('Enter', {code: 'Enter', keyCode: 13});
  await page.until('document.activeElement !== typed');
  await page.close();
});

test('a film is a download, with a frame for each step', async () => {
  const page = await browser.open(address + '#lesson=z-buffer&stop=3');
  await page.until(shown);
  await page.ask(`void (Module.page.download = async (name, blob) => {
    window.film = {name, bytes: btoa([...new Uint8Array(await blob.arrayBuffer())].map((byte) => String.fromCharCode(byte)).join(''))};
  })`);
  await page.key('F', {code: 'KeyF', keyCode: 70, modifiers: 10});
  for (const letter of '194 214') {
    const digit = letter === ' ' ? 'Space' : 'Digit' + letter;
    await page.key(letter, {code: digit, keyCode: letter.charCodeAt(0), text: letter});
  }
  await page.key('Enter', {code: 'Enter', keyCode: 13, text: '\r'});
  const {name, bytes} = await page.until('window.film', 30);
  check(name === 'zstep-194-214.webm', `it is called ${name}`);
  const film = Buffer.from(bytes, 'base64');
  check(film.subarray(0, 4).equals(Buffer.from('1a45dfa3', 'hex')) && film.includes('V_VP8'), 'it is no WebM');
  if (process.env.ZSTEP_FILM) writeFileSync(process.env.ZSTEP_FILM, film);  // to be looked at
  let frames = 0;
  for (let at = film.indexOf(Buffer.from('1f43b675', 'hex')); (at = film.indexOf(Buffer.from('a301', 'hex'), at)) >= 0; ++at)
    if (film[at + 9] === 0x81 && film.readUInt16BE(at + 10) === 100 * frames) frames += 1;
  check(frames === 21, `it has ${frames} frames`);
  await page.close();
});

test('two tabs beside each other', async () => {
  const one = await browser.open(address + '#lesson=z-buffer&stop=2');
  await one.until(shown);
  const first = await one.picture();
  const two = await browser.open(address + '#lesson=bsp&stop=2');
  await two.until(shown);
  check(!same(first, await two.picture()), 'both show the same');
  await one.front();
  check(same(first, await one.picture()), 'the first came back as another');
  await one.close();
  await two.close();
});

test('a tab in the background does not play on, and goes on where it was', async () => {
  const one = await browser.open(address + '#lesson=z-buffer&step=300');
  await one.until(shown);
  const step = async () => Number(/Step (\d+)/.exec(await one.ask('said.textContent'))?.[1]);
  await one.key(' ', {code: 'Space', keyCode: 32, text: ' '});
  await one.until(`/Step 30[2-9]/.test(said.textContent)`);
  const two = await browser.open(address + '#lesson=bsp&stop=2');
  await two.until(shown);
  await one.until(`document.visibilityState === 'hidden'`);
  const left = await step();
  await new Promise((resolve) => setTimeout(resolve, 3000));
  const meanwhile = await step();
  check(meanwhile <= left + 1, `it played from step ${left} to ${meanwhile}`);
  const began = Date.now();
  await one.front();
  await one.until(`!said.textContent.startsWith('Step ${meanwhile} ')`, 3);
  const back = await step(), most = meanwhile + 1 + Math.ceil(5 * (1 + (Date.now() - began) / 1000));
  check(back > meanwhile && back <= most, `it came back at step ${back} after ${meanwhile}; since then and in one second before it plays to ${most}`);
  await one.close();
  await two.close();
});

test('how long until the first picture, and how much is fetched for it', async () => {
  const times = [];
  for (let k = 0; k < 5; ++k) {  // each time by a browser that knows nothing
    const fresh = newBrowser();
    const page = await fresh.open(address + '#lesson=viewing&stop=1');
    times.push(await page.until('Module.firstPicture'));
    check(await page.ask('first.broughtNow === false'), 'a function of the rest was called before the first picture');
    await fresh.close();
  }
  times.sort((a, b) => a - b);
  let sum = 0;
  for (const name of ['index.html', 'film.js', 'page.js', 'page.css', 'zstep.js', 'zstep.wasm', 'zstep.data']) {
    const bytes = gzipSync(readFileSync(join(site, name)), {level: 9}).length;
    sum += bytes;
    console.log(`  ${name} ${statSync(join(site, name)).size} bytes, with gzip ${bytes}`);
  }
  console.log(`  first picture: median ${Math.round(times[2])} ms of ${times.map(Math.round).join(' ')}; ${sum} bytes with gzip`);
});

test('what the first picture does not need is fetched after it, and waited for by who needs it before', async () => {
  const pictures = [];
  for (const slow of [0, 3000]) {
    restAfter = slow;
    const fresh = newBrowser();  // which has kept nothing
    const page = await fresh.open(address + '#lesson=z-buffer&step=867');
    await page.until(shown);
    if (slow === 0) await page.until('!first.alone');
    check(await page.ask('first.alone') === (slow > 0), 'the rest is there at another time than thought');
    await page.key('k', {code: 'KeyK', keyCode: 75, modifiers: 2});  // judges the run
    await page.key('h', {code: 'KeyH', keyCode: 72, text: 'h'});
    await page.key('n', {code: 'KeyN', keyCode: 78, text: 'n'});
    await page.until(`!first.alone && !location.hash.includes('step=867')`);  // all of them were taken
    pictures.push(await page.picture());
    check(page.told.length === 0, `said: ${page.told.join(' | ')}`);
    await fresh.close();
  }
  restAfter = 0;
  check(same(...pictures), `another picture: ${differ(...pictures)}`);
});

let failed = 0;
for (const {name, run} of tests) {
  if (only && !name.includes(only)) continue;
  browser = newBrowser();
  try {
    await run();
    console.log(`ok      ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name}: ${error.message}`);
  }
  await browser.close();
}
server.close();
process.exit(failed === 0 ? 0 : 1);
