// Which functions of the page's program are called until its first pictures are there:
//   node first_functions.mjs FOLDER WATCHED PROFILE [LINK]
// FOLDER has zstep.js and zstep.data, WATCHED is the program as `wasm-split --instrument` makes it; PROFILE is written. The
// program draws into a window that is none: whatever it asks of a page is answered by something that does nothing.
import {readFileSync, writeFileSync} from 'node:fs';
import vm from 'node:vm';

const [folder, watched, profile, link = ''] = process.argv.slice(2);
const width = 1280, height = 720;

const nothing = new Proxy(function () {}, {
  get: (_, name) => (name === Symbol.toPrimitive ? () => 0 : [Symbol.iterator, 'then', 'length'].includes(name) ? undefined : nothing),
  set: () => true,
  apply: () => nothing,
  construct: () => nothing,
});
const orNothing = (own) => new Proxy(own, {get: (_, name) => (name in own ? own[name] : nothing)});
const pixels = (width, height) => ({width, height, data: new Uint8ClampedArray(4 * width * height)});
const listeners = [];
const canvas = orNothing({
  addEventListener: (type, heard) => { if (type === 'mousemove') listeners.push(heard); },
  id: 'canvas', width, height, clientWidth: width, clientHeight: height, style: {},
  getContext: () => ({createImageData: pixels, getImageData: (x, y, width, height) => pixels(width, height), putImageData() {}}),
  getBoundingClientRect: () => ({left: 0, top: 0, width, height}),
});

let exports;
const instantiate = WebAssembly.instantiate;
WebAssembly.instantiate = async (binary, imports) => {
  const made = await instantiate(binary, imports);
  exports = made.instance.exports;
  return made;
};

const writeProfile = () => {
  const memory = Object.values(exports).find((one) => one instanceof WebAssembly.Memory);
  const bytes = exports.__write_profile(0, 0), at = memory.buffer.byteLength;
  memory.grow(Math.ceil(bytes / 65536));
  exports.__write_profile(at, bytes);
  writeFileSync(profile, new Uint8Array(memory.buffer, at, bytes));
  process.exit(0);
};

Object.defineProperty(globalThis, 'navigator', {value: orNothing({}), configurable: true});  // which newer ones of node have

// It dozes once nothing moves any more; the mouse moves, and it dozes again.
let dozed = 0;
const doze = () => setTimeout(() => {
  if (++dozed === 2) writeProfile();
  for (const heard of listeners) heard(orNothing({type: 'mousemove', clientX: 100, clientY: 100, target: canvas}));
  Module._zstep_wake(1);
}, 1);
setTimeout(() => { console.error(`${link}: never at rest`); process.exit(1); }, 60000);
Object.assign(globalThis, {
  window: globalThis, innerWidth: width, innerHeight: height, devicePixelRatio: 1, screen: {width, height},
  location: {pathname: '/', href: 'http://localhost/'},
  document: orNothing({currentScript: null, querySelector: () => canvas, getElementById: () => canvas}),
  addEventListener() {}, removeEventListener() {},
  requestAnimationFrame: (next) => setTimeout(() => next(performance.now()), 1),
  Module: {
    canvas, page: orNothing({doze}), noExitRuntime: true, arguments: link === '' ? [] : [link],
    wasmBinary: readFileSync(watched),
    getPreloadedPackage: () => new Uint8Array(readFileSync(`${folder}/zstep.data`)).buffer,
    preRun: [() => Object.assign(Module.ENV, {HOME: '/home/web_user', ZSTEP_LESSONS: '/lessons'})],
  },
});
vm.runInThisContext(readFileSync(`${folder}/zstep.js`, 'utf8'));
