// The floating horizon: the curves of a surface y = f(x, z), from the nearest to the farthest.
//
// node horizon.js SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.js writes it down.
const fs = require("fs");
const emit = require("./emit.js");

// rows: of samples [x_w, y_w, z_w]; view: the three rows of T_v; lens: d, w_y, n, f.
function readScene(path) {
  const words = fs.readFileSync(path, "utf8").split(/\s+/).map(Number);
  let at = 0;
  const numbers = (count) => words.slice(at, (at += count));
  const [width, height, rowCount, columnCount] = numbers(4);
  const rows = Array.from({ length: rowCount }, () => Array.from({ length: columnCount }, () => numbers(3)));
  const view = [numbers(4), numbers(4), numbers(4)];
  return { width, height, rows, view, lens: numbers(4) };
}

const { width, height, rows, view, lens } = readScene(process.argv[2]);
emit.clear(Infinity);
// TODO: each sample: emit.view_vertex(…), emit.project(…), emit.to_viewport(…)
const upper = new Array(width).fill(Infinity), lower = new Array(width).fill(-Infinity);
// TODO: the horizons of each column: emit.clear_horizons(…) twice
// TODO: each curve, from the nearest to the farthest: emit.curve(…)
// TODO: from sample to sample: emit.segment(…)
// TODO: at each column in between: emit.test(…)
// TODO: what is visible since the column before, from or up to where it crosses a horizon: emit.cross(…)
// TODO: for each pixel that is drawn: emit.draw(…)
// TODO: where the curve is visible here, the horizons move: emit.move(…)
