// The BSP tree: polygons divide space, and what is on the far side of each is drawn before it.
//
// node bsp.js SCENE.txt > SCENE.jsonl
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
  // TODO: it is a piece: emit.make(…)
});
// TODO: build the tree: emit.node(…) for the first piece of the list
// TODO: its plane: emit.plane(…)
// TODO: the sides of the others: emit.vertex_side(…), emit.side(…)
// TODO: where one lies in the plane: emit.add(…)
// TODO: where one crosses it: emit.cut(…), emit.part(…)
// TODO: then the same of those in front, and of those behind
// TODO: go through the tree: first the far side, then the node, then the near side
// TODO: which side is the far one? emit.eye_side(…); for each piece of the node: emit.draw(…)
// TODO: for each pixel of the piece: emit.paint(…)
