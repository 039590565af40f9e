// The page around the window: what is shown is drawn by zstep itself (zstep.js, zstep.wasm) into the canvas. Here is what
// a desktop would do for it: links in the address, files, the clipboard, what is kept, what is said.
'use strict';

const canvas = document.getElementById('canvas');
const said = document.getElementById('said');
const notice = document.getElementById('notice');
const tables = document.getElementById('tables');
const commands = document.getElementById('commands');
const filePicker = document.getElementById('file');

// Lists as the window makes them: groups of rows of cells.
const groupsOf = (list) => (list === '' ? [] : list.split('\x1d').map((group) => group.split('\x1e').map((row) => row.split('\x1f'))));

const longestLink = 4096;  // as in sim/words/link.hpp
const largestFile = 512 << 20;
const keptKey = 'zstep-settings';
const keptFolder = '/home/web_user/.config/zstep/';

const warn = (text) => {
  notice.textContent = text;
  notice.hidden = false;
  setTimeout(() => { notice.hidden = true; }, 8000);
};

// --- What is kept. A browser may refuse to keep anything: then it is gone with the page, and the reader is told once.
let keeps = true;
const stored = (key) => {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
};
const store = (key, text) => {
  try {
    localStorage.setItem(key, text);
  } catch {
    if (keeps) warn('This browser keeps nothing for this page: settings and progress are gone when it is closed.');
    keeps = false;
  }
};

// --- The place in the address
let ownLink = '';  // put there by the window, and not by the reader
const isLink = (text) => text.length > 1 && text.length <= longestLink;
const linkNow = () => location.hash;

const page = {
  opened: false,  // the window is there

  address: () => location.href.split('#')[0],

  arrived(link, atStop) {
    if (link === '' || link === linkNow()) return;
    ownLink = link;
    // Each stop is a place to go back to; the steps between are not. Of a page around this one no place is.
    history[atStop && linkNow() !== '' && self === top ? 'pushState' : 'replaceState'](null, '', link);
  },

  openBeside(link) {
    const beside = open(page.address() + link, '_blank');
    if (beside) beside.opener = null;
    else warn('This browser did not let the page open another; its address is ' + page.address() + link);
  },

  typingAt(left, top, right, bottom) {
    line = {left, top, right, bottom};
    Object.assign(typed.style, {left: left + 'px', top: top + 'px', width: right - left + 'px', height: bottom - top + 'px'});
    if (right <= left) typed.blur();
  },

  say(text) {
    if (said.textContent !== text) said.textContent = text;
  },

  showTables(list) {
    const put = (row, cells, kind) => {
      for (const text of cells) Object.assign(row.appendChild(document.createElement(kind)), {textContent: text});
    };
    tables.replaceChildren(...groupsOf(list).map(([[title], headings, ...rows]) => {
      const table = document.createElement('table');
      table.createCaption().textContent = title;
      put(table.createTHead().insertRow(), headings, 'th');
      const body = table.createTBody();
      for (const row of rows) put(body.insertRow(), row, 'td');
      return table;
    }));
  },

  offerCommands(list) {
    commands.replaceChildren(...groupsOf(list).flatMap(([[group], ...rows]) => {
      const heading = document.createElement('h2');
      heading.textContent = group;
      return [heading, ...rows.map(([id, title, keys]) => {
        const button = document.createElement('button');
        button.type = 'button';
        button.textContent = title;
        if (keys) button.append(' ', Object.assign(document.createElement('kbd'), {textContent: keys}));
        button.addEventListener('click', () => Module.ccall('zstep_run', null, ['string'], [id]));
        return button;
      })];
    }));
  },

  copy(text) {
    const refused = () => warn('This browser did not let the page copy; the text is: ' + text);
    if (!navigator.clipboard) return refused();
    navigator.clipboard.writeText(text).catch(refused);
  },

  chooseFile() {
    filePicker.value = '';
    filePicker.click();
  },

  download(name, blob) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  },

  handOver(file) {
    page.download(file.split('/').pop(), new Blob([Module.FS.readFile(file)]));
    Module.FS.unlink(file);
  },

  keep(text) { store(keptKey, text); },

  shown() {
    Module.running = true;
    Module.firstPicture = performance.now();
    if (!inside) bringRest();
  },

  doze(milliseconds) { asleep = setTimeout(wake, milliseconds); },

  closed() {
    Module.running = false;
    warn('zstep is closed. Load the page again to open it.');
  },
};

// --- Nothing is turned while nothing happens.
let asleep = null;
const wake = (event) => {
  if (asleep === null) return;
  clearTimeout(asleep);
  asleep = null;
  Module.ccall('zstep_wake', null, ['number'], [event ? 1 : 0]);
};
for (const type of ['keydown', 'keyup', 'mousemove', 'mousedown', 'mouseup', 'wheel', 'touchstart', 'touchmove', 'touchend', 'click', 'input',
  'paste', 'drop', 'change', 'focus', 'blur', 'resize', 'hashchange', 'popstate'])
  addEventListener(type, wake, true);
document.addEventListener('visibilitychange', wake);

// --- A keyboard on the screen. It comes up when the line that is typed into is touched, types into a field of the page,
// which passes on what changes there, and makes the window as high as what it leaves.
const typed = document.getElementById('typed');
const nothing = ' ';  // so that there is something to take back
let line = {left: 0, top: 0, right: 0, bottom: 0}, passed = nothing;
canvas.addEventListener('touchend', (event) => {
  const {clientX: x, clientY: y} = event.changedTouches[0], near = 12;
  if (line.right <= line.left || event.touches.length > 0) return;
  if (x < line.left - near || x > line.right + near || y < line.top - near || y > line.bottom + near) return;
  typed.value = passed = nothing;
  typed.focus({preventScroll: true});
});
typed.addEventListener('input', () => {
  const now = typed.value;
  let same = 0;
  while (same < Math.min(now.length, passed.length) && now[same] === passed[same]) same += 1;
  Module.ccall('zstep_type', null, ['string', 'number'], [now.slice(same), [...passed.slice(same)].length]);
  passed = now;
  if (now === '') typed.value = passed = nothing;
});
for (const type of ['keydown', 'keypress', 'keyup'])
  typed.addEventListener(type, (event) => {
    // What these do to the field is passed on as a change of it.
    const changes = event.key.length === 1 || ['Backspace', 'Process', 'Unidentified'].includes(event.key);
    if (changes && !event.ctrlKey && !event.metaKey) event.stopPropagation();
  });
if (window.visualViewport)
  visualViewport.addEventListener('resize', () => {
    canvas.style.height = document.activeElement === typed ? visualViewport.height + 'px' : '';
    scrollTo(0, 0);
    dispatchEvent(new Event('resize'));
  });
typed.addEventListener('blur', () => {
  if (canvas.style.height === '') return;
  canvas.style.height = '';
  dispatchEvent(new Event('resize'));
});

if (linkNow().length > longestLink) {
  history.replaceState(null, '', page.address());
  warn(`That link has more than ${longestLink} letters, and was not looked at.`);
}

// --- The program comes in two parts: what the first picture needs, and the rest, which is fetched after it. Who calls a
// function of the rest before it is there waits for it.
const rest = 'zstep.rest.wasm';
const first = {exports: null, alone: true, broughtNow: false};
const instantiated = async (file, imports) => {
  const answer = await fetch(file);
  if (!answer.ok) throw new Error(`${file}: ${answer.status}`);
  if (answer.headers.get('Content-Type') === 'application/wasm') return WebAssembly.instantiateStreaming(answer, imports);
  return WebAssembly.instantiate(await answer.arrayBuffer(), imports);
};
const lost = (file) => (error) => warn(`${file} could not be loaded (${error.message}); load the page again.`);
const bringRest = async () => {
  if (first.alone) await instantiated(rest, {primary: first.exports}).then(() => { first.alone = false; }, lost(rest));
};
const bringRestNow = () => {
  const request = new XMLHttpRequest();
  request.open('GET', rest, false);
  request.overrideMimeType('text/plain; charset=x-user-defined');  // bytes as letters
  request.send();
  const bytes = Uint8Array.from(request.responseText, (letter) => letter.charCodeAt(0));
  new WebAssembly.Instance(new WebAssembly.Module(bytes), {primary: first.exports});
  first.alone = false;
  first.broughtNow = true;
};
const instantiateWasm = (imports, done) => {
  // Calls into the rest go through a table, the last one. What stands there until then is asked for by its place.
  const standIn = (place) => (...given) => {
    if (first.alone) bringRestNow();
    return Object.values(first.exports).filter((one) => one instanceof WebAssembly.Table).at(-1).get(Number(place))(...given);
  };
  const placeholder = new Proxy({}, {get: (_, place) => standIn(place)});
  instantiated('zstep.wasm', {...imports, placeholder}).then(async ({instance, module}) => {
    first.exports = instance.exports;
    if (navigator.serviceWorker?.controller) await bringRest();  // it is kept here, and there may be no network
    done(instance, module);
  }, lost('zstep.wasm'));
  return {};
};

// --- The program. A page that holds it in itself has brought it along (packed.js).
const inside = typeof packed === 'object' ? packed : null;
const embedsRun = inside !== null && linkNow() === '#embed=1';
var Module = {
  // `var`: zstep.js looks for it by this name
  canvas,
  page,
  film,
  arguments: embedsRun  ? [...inside.words, '--embed'] :
      isLink(linkNow()) ? [linkNow()] :
      inside            ? inside.words :
                          [],
  noExitRuntime: true,
  print: (text) => console.log(text),
  printErr: (text) => {
    console.warn(text);
    if (!Module.running) warn(text);
  },
  preRun: [() => {
    Module.ENV.HOME = '/home/web_user';
    Module.ENV.ZSTEP_LESSONS = '/lessons';
    // As sim/viewer/settings.hpp writes them: below a name in brackets what the file of that name says.
    const [, ...parts] = (stored(keptKey) ?? '').split(/^\[((?:lessons\/)?[\w-]+\.\w+)\]\n/m);
    if (parts.length > 0) Module.FS.createPath('/', keptFolder + 'lessons', true, true);
    for (let k = 0; k < parts.length; k += 2) Module.FS.writeFile(keptFolder + parts[k], parts[k + 1]);
  }],
  postRun: [() => {
    if (page.opened || linkNow() === '') return;
    // A link that opens nothing has said so; what zstep has is offered instead.
    history.replaceState(null, '', page.address());
    try {
      sessionStorage.setItem('zstep-complaint', notice.textContent);
    } catch {
      // then it is offered without a word
    }
    location.reload();
  }],
  ...inside ? {} : {instantiateWasm},
  onAbort: (what) => warn('zstep ended: ' + what + '. Load the page again.'),
};

const goToAddress = () => {
  const link = linkNow();
  if (link === ownLink) return;
  if (!isLink(link)) return;
  const there = Module.ccall('zstep_go_to_link', 'number', ['string'], [link]);
  if (!there) location.reload();
  ownLink = link;
};
addEventListener('hashchange', goToAddress);
addEventListener('popstate', goToAddress);

// --- Keys that a browser would take for itself, though the window has a use for them
const pageKeys = new Set(['KeyC', 'KeyE', 'KeyG', 'KeyH', 'KeyL', 'KeyO', 'KeyP', 'KeyR', 'KeyS', 'KeyF', 'KeyB', 'KeyD', 'KeyU', 'KeyK', 'Enter',
  'Comma', 'Equal', 'Minus', 'Digit0', 'NumpadAdd', 'NumpadSubtract', 'Numpad0']);
addEventListener('keydown', (event) => {
  if (event.key === 'F6' || (event.key === 'Escape' && commands.contains(event.target))) {  // out of the window, and back
    event.preventDefault();
    event.stopImmediatePropagation();
    (commands.contains(event.target) ? canvas : commands.querySelector('button') ?? canvas).focus();
    return;
  }
  if (commands.contains(event.target)) return event.stopImmediatePropagation();  // theirs
  if ((event.ctrlKey || event.metaKey) && event.code === 'KeyV') {
    // What is pasted comes with the event that follows; the key goes to the window after it.
    event.stopImmediatePropagation();
    return;
  }
  const alone = !event.ctrlKey && !event.metaKey;
  if (alone && event.target === typed && event.key !== 'Tab') return;
  if (!alone && pageKeys.has(event.code)) event.preventDefault();
  if (event.altKey && event.key.startsWith('Arrow')) event.preventDefault();
  if (alone && ['F1', 'F3', 'F10', 'Tab', '/', "'"].includes(event.key)) event.preventDefault();
}, true);
for (const kind of ['keyup', 'keypress']) addEventListener(kind, (event) => { if (commands.contains(event.target)) event.stopImmediatePropagation(); }, true);
addEventListener('paste', (event) => {
  event.preventDefault();
  Module.ccall('zstep_paste', null, ['string'], [event.clipboardData.getData('text/plain').slice(0, 65536)]);
});
canvas.addEventListener('contextmenu', (event) => event.preventDefault());

// --- Files of the reader, which stay on this computer
const take = async (file) => {
  if (file.size > largestFile) return warn(`${file.name} has ${Math.round(file.size / 1048576)} MiB; a page takes up to 512. Open it with zstep itself.`);
  const name = file.name.replace(/[^\w.-]/g, '_');
  Module.FS.createPath('/', 'yours', true, true);
  Module.FS.writeFile('/yours/' + name, new Uint8Array(await file.arrayBuffer()));
  wake('a file');
  Module.ccall('zstep_drop_file', null, ['string'], ['/yours/' + name]);
};
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
  event.preventDefault();
  for (const file of event.dataTransfer.files) take(file);
});
filePicker.addEventListener('change', () => { for (const file of filePicker.files) take(file); });

// --- Hidden or left: what is to be kept is kept
addEventListener('pagehide', () => { if (Module.running) Module.ccall('zstep_keep_now', null, [], []); });

// --- Without a network, after the first visit
if (!inside && 'serviceWorker' in navigator) navigator.serviceWorker.register('worker.js').catch(() => {});

const complaint = (() => {
  try {
    const text = sessionStorage.getItem('zstep-complaint');
    sessionStorage.removeItem('zstep-complaint');
    return text;
  } catch {
    return null;
  }
})();
if (complaint) warn(complaint);

// A page around this one keeps the reader where they are.
const takeFocus = () => { if (self === top) canvas.focus(); };
if (typeof WebAssembly !== 'object') warn('This browser has no WebAssembly, which zstep needs.');
else if (inside) {
  inside.begin(Module).catch((error) => warn(document.characterSet === 'UTF-8'
    ? `This page cannot be unpacked (${error.message}). It may be damaged, or the browser too old.`
    : `The server says that this page is written in ${document.characterSet}; it is UTF-8.`));
  takeFocus();
} else {
  const program = document.createElement('script');
  program.src = 'zstep.js';
  program.onerror = () => warn('zstep.js could not be loaded; load the page again.');
  document.body.append(program);
  takeFocus();
}
