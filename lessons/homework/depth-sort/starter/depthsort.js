// Depth sort: of a list of polygons, the farthest first, each is painted once no other one must come before it.
//
// node depthsort.js SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.js writes it down.
const fs = require("fs");
const emit = require("./emit.js");

// {width, height, points, polygons}; a polygon is a list of the numbers of its vertices.
function readScene(path) {
  const words = fs.readFileSync(path, "utf8").split(/\s+/).map(Number);
  let at = 0;
  const next = () => words[at++];
  const width = next(), height = next();
  const points = Array.from({ length: next() }, () => ({ x: next(), y: next(), z: next() }));
  const polygons = Array.from({ length: next() }, () => Array.from({ length: next() }, next));
  return { width, height, points, polygons };
}

const { width, height, points, polygons } = readScene(process.argv[2]);
emit.clear(Infinity);
emit.tables(polygons.length);
polygons.forEach((corners, polygon) => {
  emit.polygon(polygon, polygon);
  // TODO: it is a piece: emit.outline(…) for each vertex, emit.make(…), emit.plane(…), emit.extent(…)
});
// TODO: put each piece into the list: emit.insert(…)
// TODO: until the list is empty: hold the first piece P against each other piece Q: emit.pair(…);
//       emit.z_extents(…), or the tests: emit.test_1(…) to emit.test_5(…), up to the first that says yes;
//       where none does: emit.test_3_swapped(…), emit.test_4_swapped(…);
//       if one says yes: emit.take_out(…), emit.move(…), emit.mark(…), and Q is the new P;
//       if not: emit.split(…), emit.cut(…), then emit.outline(…), emit.part(…), emit.plane(…) and emit.extent(…) for
//       each part, emit.remove(…) and emit.insert_part(…), and the first of the list is P;
//       where no Q is in the way: emit.draw(…), emit.paint(…) for each pixel, emit.drawn(…)
