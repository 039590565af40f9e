// The scan-line method: one edge table for all polygons, and an in/out flag for each polygon.
//
// node scanline.js SCENE.txt > SCENE.jsonl
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
emit.clear(Infinity);
emit.tables(polygons.length);
polygons.forEach((vertices, polygon) => {
  emit.polygon(polygon, polygon);
  emit.make(polygon, polygon, -1);
  // TODO: the polygon's plane: emit.plane(…)
});
// TODO: the edge table of all polygons: emit.insert_edge(…) or emit.skip_edge(…) for each edge
// TODO: for each scan line: emit.scan_line(y)
// TODO: its active edges: emit.retire_edge(…), emit.step_edge(…), emit.swap_edges(…), emit.enter_edge(…)
// TODO: for each active edge: emit.flip(…), and up to the next one emit.flags(…)
// TODO: where several flags are in: emit.depth(…), emit.implied_edge(…)
// TODO: what is seen: emit.winner(…)
// TODO: for each of its pixels: emit.paint(…)
