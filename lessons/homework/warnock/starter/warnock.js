// Warnock's algorithm: an area that is simple is drawn; any other is divided into its four quarters.
//
// node warnock.js SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.js writes it down.
const fs = require("fs");
const emit = require("./emit.js");

// {width, height, polygons}; a polygon is a list of {x, y, z} of its vertices.
function readScene(path) {
  const words = fs.readFileSync(path, "utf8").split(/\s+/).map(Number);
  let at = 0;
  const next = () => words[at++];
  const width = next(), height = next();
  const points = Array.from({ length: next() }, () => ({ x: next(), y: next(), z: next() }));
  const polygons = Array.from({ length: next() }, () => Array.from({ length: next() }, () => points[next()]));
  return { width, height, polygons };
}

function settle(left, top, right, bottom) {
  // TODO: emit.area(…)
  // TODO: for each polygon that may be in the area: emit.disjoint(…), emit.contained(…) and so on
  // TODO: the depths by which it is decided: emit.corner_depth(…), emit.center_depth(…)
  // TODO: which case is it? emit.background(…), emit.one_polygon(…), emit.surrounded(…), emit.pixel(…),
  //       emit.front_surrounder(…) or emit.subdivide(…)
  // TODO: for each pixel that is drawn: emit.paint(…)
  // TODO: where the area is divided: settle(…) for each quarter
}

const { width, height, polygons } = readScene(process.argv[2]);
emit.clear(Infinity);
emit.tables(polygons.length);
polygons.forEach((polygon, number) => {
  emit.polygon(number, number);
  emit.make(number, number, -1);
  // TODO: the polygon's plane: emit.plane(…)
});
settle(0, 0, width, height);
