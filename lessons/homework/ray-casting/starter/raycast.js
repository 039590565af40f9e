// Ray casting, polygon by polygon for each ray.
//
// node raycast.js SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.js writes it down.
const fs = require("fs");
const emit = require("./emit.js");

// A polygon is a list of {x, y, z} of its vertices. from and along: X_0 and dX of pixel (0, 0), and how each changes by
// a column and by a row. least and most: of t.
function readScene(path) {
  const words = fs.readFileSync(path, "utf8").split(/\s+/).map(Number);
  let at = 0;
  const next = () => words[at++];
  const triple = () => ({ x: next(), y: next(), z: next() });
  const width = next(), height = next();
  const points = Array.from({ length: next() }, triple);
  const polygons = Array.from({ length: next() }, () => Array.from({ length: next() }, () => points[next()]));
  const background = triple();
  const colors = polygons.map(triple);
  const from = [triple(), triple(), triple()], along = [triple(), triple(), triple()];
  return { width, height, polygons, background, colors, from, along, least: next(), most: next() };
}

const { width, height, polygons, background, colors, from, along, least, most } = readScene(process.argv[2]);
emit.clear(Infinity);
for (let y = 0; y < height; ++y) {
  for (let x = 0; x < width; ++x) {
    // TODO: the ray through the pixel's centre: emit.ray(…)
    // TODO: for each polygon, where the ray meets its plane: emit.plane(…)
    // TODO: where t is within its limits: emit.hit(…)
    // TODO: the nearest: emit.ray_end(…)
    // TODO: where something was met: emit.paint(…)
  }
}
