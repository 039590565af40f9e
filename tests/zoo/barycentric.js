// Barycentric weights in float32, with Math.fround around every operation, as a shader computes. Either winding is
// drawn as it stands: the weights of a triangle that goes the other way round are quotients of two negative numbers.
//
// node barycentric.js TASKS     (triangles only; tools.py says what stands in a file of tasks)
"use strict";
const fs = require("fs");

const f = Math.fround;
const add = (a, b) => f(a + b), sub = (a, b) => f(a - b), mul = (a, b) => f(a * b), div = (a, b) => f(a / b);

const lines = [];
const say = (step, fields) =>
  lines.push(JSON.stringify({ step, ...fields }, (_, value) => (value === Infinity ? "inf" : value)));

/** Twice the area of a, b and p; which sign it has says on which side of the edge p lies. */
const edge = (a, b, p) => sub(mul(sub(b.x, a.x), sub(p.y, a.y)), mul(sub(b.y, a.y), sub(p.x, a.x)));

function* readTasks(path) {
  const rows = fs.readFileSync(path, "utf8").trim().split("\n").map((line) => line.split(" "));
  for (let at = 0; at < rows.length;) {
    const [width, height, points, polygons, mistake = ""] = rows[at++];
    const vertices = rows.slice(at, (at += Number(points))).map(([x, y, z]) => ({ x: f(x), y: f(y), z: f(z) }));
    const corners = rows.slice(at, (at += Number(polygons)));
    yield {
      width: Number(width), height: Number(height), mistake,
      triangles: corners.map((numbers) => numbers.map((number) => vertices[number])),
    };
  }
}

/** Where a vertex comes to. */
function placed({ x, y, z }, { width, height, mistake }) {
  switch (mistake) {
    case "vertices_rounded": return { x: Math.round(x), y: Math.round(y), z };
    case "vertices_truncated": return { x: x | 0, y: y | 0, z };
    case "picture_mirrored": return { x: sub(width - 1, x), y, z };
    case "y_upside_down": return { x, y: sub(height - 1, y), z };
    case "one_pixel_off": return { x, y: add(y, 1), z };
    case "x_y_exchanged": return { x: y, y: x, z };
    default: return { x, y, z };
  }
}

/** Is a pixel whose weight is 0 the triangle's? The edge goes from a to b. */
function ownsBorder(a, b, area, mistake) {
  if (mistake === "border_for_both") return true;
  if (mistake === "border_for_nobody") return false;
  const [from, to] = area > 0 ? [a, b] : [b, a];
  const topLeft = to.y < from.y || (to.y === from.y && to.x > from.x);
  return topLeft !== (mistake === "border_for_other_side");
}

function box(triangle, { width, height, mistake }) {
  const bounds = (values, size) => {
    let least = Math.min(...values), most = Math.max(...values);
    // Numbers are sorted as words unless one says otherwise.
    if (mistake === "sorted_as_words") [least, , most] = [...values].sort();
    return [Math.max(0, Math.ceil(least)), Math.min(size - 1, Math.floor(most))];
  };
  return [bounds(triangle.map(({ x }) => x), width), bounds(triangle.map(({ y }) => y), height)];
}

function depth([u, v, w], [p, q, r], area, mistake) {
  switch (mistake) {
    case "area_not_doubled": [u, v, w] = [u, v, w].map((weight) => mul(weight, 2)); break;
    case "area_not_divided_by": [u, v, w] = [u, v, w].map((weight) => mul(weight, Math.abs(area))); break;
    case "weights_turned": [u, v, w] = [v, w, u]; break;
    case "weights_exchanged": [v, w] = [w, v]; break;
    case "weight_negative": v = -v; break;
    case "weight_left_out": u = 0; break;
    case "weights_to_tenths": [u, v, w] = [u, v, w].map((weight) => f(weight.toFixed(1))); break;
    case "vertex_depth_twice": r = q; break;
    case "depth_is_mean": return div(add(add(p.z, q.z), r.z), 3);
    case "depth_by_reciprocals": return div(1, add(add(div(u, p.z), div(v, q.z)), div(w, r.z)));
  }
  const z = add(add(mul(u, p.z), mul(v, q.z)), mul(w, r.z));
  return mistake === "depth_truncated" ? z | 0 : mistake === "depth_to_hundredths" ? f(z.toFixed(2)) : z;
}

function draw(task) {
  const { width, height, mistake } = task;
  const depths = new Float32Array(width * height).fill(Infinity), frame = new Int8Array(width * height).fill(-1);
  say("clear", { z: Infinity });
  task.triangles.forEach((corners, number) => {
    const triangle = corners.map((corner) => placed(corner, task));
    const [p, q, r] = triangle;
    const area = edge(p, q, r);
    if (area === 0 || (mistake === "one_winding_only" && area > 0)) return;
    const edges = [[q, r], [r, p], [p, q]].map(([a, b]) => ({ a, b, border: ownsBorder(a, b, area, mistake) }));
    if (mistake === "edge_asked_twice") edges[2] = edges[1];
    const [[left, right], [top, bottom]] = box(triangle, task);
    say("polygon", { polygon: number, facet: number });
    let x = left;
    for (let y = top; y <= bottom; ++y) {
      if (mistake !== "column_not_reset") x = left;
      for (; x <= right; ++x) {
        const weights = edges.map(({ a, b }) => div(edge(a, b, { x, y }), area));
        const inside = mistake === "inside_margin"
          ? weights.every((weight) => weight > -0.05)
          : weights.every((weight, i) => weight > 0 || (weight === 0 && edges[i].border));
        if (!inside) continue;
        const z = depth(weights, triangle, area, mistake);
        const at = y * (mistake === "stride_is_height" ? height : width) + x;
        const nearer = mistake === "equal_wins" ? z <= depths[at]
          : mistake === "compare_reversed" ? z > depths[at] : z < depths[at];
        say("compare", { x, y, z, nearer });
        if (nearer || mistake === "depth_always") {
          if (mistake !== "depth_not_kept") depths[at] = z;
          say("wz", { x, y, z });
        }
        if (!nearer) continue;
        const colour = mistake === "colour_of_next" ? (number + 1) % task.triangles.length : number;
        frame[y * width + x] = colour;
        say("wp", { x, y, polygon: colour });
      }
    }
  });
}

for (const task of readTasks(process.argv[2])) {
  draw(task);
  lines.push("");
}
process.stdout.write(lines.join("\n") + "\n");
