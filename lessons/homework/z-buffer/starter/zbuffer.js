// The Z-buffer with edge table and active edge list.
//
// node zbuffer.js SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.js writes it down.
const fs = require("fs");
const emit = require("./emit.js");

// {width, height, polygons}; a polygon is a list of {number, x, y, z} of its vertices.
function readScene(path) {
  const words = fs.readFileSync(path, "utf8").split(/\s+/).map(Number);
  let at = 0;
  const next = () => words[at++];
  const width = next(), height = next();
  const points = Array.from({ length: next() }, (_, number) => ({ number, x: next(), y: next(), z: next() }));
  const polygons = Array.from({ length: next() }, () => Array.from({ length: next() }, () => points[next()]));
  return { width, height, polygons };
}

const { width, height, polygons } = readScene(process.argv[2]);
const depth = new Array(width * height).fill(Infinity);
emit.clear(Infinity);
polygons.forEach((vertices, polygon) => {
  emit.polygon(polygon, polygon);
  // TODO: the edge table: emit.insert_edge(…) for each edge of the polygon that meets a scan line
  // TODO: for each other edge: emit.skip_edge(…)
  // TODO: for each scan line: emit.scan_line(y)
  // TODO: its active edges: emit.retire_edge(…), emit.step_edge(…), emit.enter_edge(…)
  // TODO: for each pair of them: emit.span(…), and for each of its pixels emit.interpolate_z(…)
  // TODO: for each pixel: emit.compare(…)
  // TODO: where it is nearer: emit.write_depth(…), emit.write_pixel(…)
});
