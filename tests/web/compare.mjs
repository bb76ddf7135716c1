// Decodes a glTF file with code that is not ours (glTF-Transform, meshoptimizer's own decoder), expands its instances and
// compares every triangle with those of a plain file:  node compare.mjs PLAIN OTHER...
// For each node of the scene, by name: as many triangles; each has its own counterpart, with corners within half a step
// of the quantization (or 0.1 mm, of instances 1 mm), normals within 2 degrees (not those of instances, which are a
// card's), texture coordinates within 1/900, colours within 1.5/255, wind weights equal. Of levels (NAME_LOD0, ...) the finest is compared.
// The decoded file, without its compression, must also please the Khronos validator.
// Prints one line of JSON a file. Exit status: 0 equal, 1 not (message on stderr), 2 usage or a missing package.
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
let NodeIO, ALL_EXTENSIONS, MeshoptDecoder, validator;
try {
  ({ NodeIO } = await import('@gltf-transform/core'));
  ({ ALL_EXTENSIONS } = await import('@gltf-transform/extensions'));
  ({ MeshoptDecoder } = await import('meshoptimizer'));
  validator = (await import('gltf-validator')).default;
} catch {
  console.error(`the judges are not installed: npm ci --prefix ${path.relative(process.cwd(), here) || '.'}`);
  process.exit(2);
}
await MeshoptDecoder.ready;

// MSFT_lod is no extension that glTF-Transform knows; its nodes are orphans then, as in a plain viewer.
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({ 'meshopt.decoder': MeshoptDecoder });

const multiply = (a, b) => {
  const out = new Array(16).fill(0);
  for (let c = 0; c < 4; ++c)
    for (let r = 0; r < 4; ++r)
      for (let k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return out;
};
const compose = ([tx, ty, tz], [x, y, z, w], [sx, sy, sz]) => [
  (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
  2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
  2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0,
  tx, ty, tz, 1];
const point = (m, p) => [0, 1, 2].map((r) => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r]);
const direction = (m, v) => {
  const d = [0, 1, 2].map((r) => m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2]);
  const length = Math.hypot(...d) || 1;
  return d.map((x) => x / length);
};

// The transforms of a node's instances, [identity] without any.
function instances(node) {
  const extension = node.getExtension('EXT_mesh_gpu_instancing');
  if (!extension) return [{ matrix: compose([0, 0, 0], [0, 0, 0, 1], [1, 1, 1]), colour: [1, 1, 1] }];
  const [places, turns, sizes, colours] = ['TRANSLATION', 'ROTATION', 'SCALE', '_COLOR_0']
    .map((name) => extension.getAttribute(name));
  const count = (places ?? turns ?? sizes).getCount();
  const out = [];
  for (let i = 0; i < count; ++i) {
    const turn = turns ? turns.getElement(i, []) : [0, 0, 0, 1];
    const length = Math.hypot(...turn);
    if (Math.abs(length - 1) > 1e-3) throw new Error(`instance ${i} of ${node.getName()}: a rotation of length ${length}`);
    out.push({
      matrix: compose(places ? places.getElement(i, []) : [0, 0, 0], turn.map((x) => x / length),
        sizes ? sizes.getElement(i, []) : [1, 1, 1]),
      colour: colours ? colours.getElement(i, []) : [1, 1, 1],
    });
  }
  return out;
}

function addTriangles(node, world, soup) {
  const mesh = node.getMesh();
  if (!mesh) return;
  const instanced = node.getExtension('EXT_mesh_gpu_instancing') !== null;
  for (const primitive of mesh.listPrimitives()) {
    const [position, normal, uv, colour, wind] = ['POSITION', 'NORMAL', 'TEXCOORD_0', 'COLOR_0', '_WIND']
      .map((name) => primitive.getAttribute(name));
    const indices = primitive.getIndices().getArray();
    const whole = position.getComponentType() !== 5126;
    for (const instance of instances(node)) {
      const matrix = multiply(world, instance.matrix);
      const tolerance = whole ? 0.501 * node.getScale()[0] + 2e-6 : instanced ? 1e-3 : 1e-4;
      for (let t = 0; t + 2 < indices.length; t += 3) {
        const corners = [0, 1, 2].map((k) => {
          const v = indices[t + k], tint = colour ? colour.getElement(v, []) : [1, 1, 1];
          return {
            p: point(matrix, position.getElement(v, [])),
            n: normal ? direction(matrix, normal.getElement(v, [])) : null,
            uv: uv ? uv.getElement(v, []) : null,
            c: [0, 1, 2].map((k) => tint[k] * instance.colour[k]),
            wind: wind ? wind.getElement(v, []) : [],
          };
        });
        soup.push({ corners, tolerance, instanced, whole, material: primitive.getMaterial()?.getName() ?? '' });
      }
    }
  }
}

// Triangles by the name of the scene's nodes; coarser levels left out.
function triangles(document) {
  const scene = document.getRoot().getDefaultScene(), byName = new Map();
  for (const top of scene.listChildren()) {
    const soup = [];
    const walk = (node, above) => {
      if (/_LOD[1-9]/.test(node.getName())) return;
      const world = multiply(above, compose(node.getTranslation(), node.getRotation(), node.getScale()));
      addTriangles(node, world, soup);
      for (const child of node.listChildren()) walk(child, world);
    };
    walk(top, compose([0, 0, 0], [0, 0, 0, 1], [1, 1, 1]));
    if (soup.length > 0) byName.set(top.getName(), soup);
  }
  return byName;
}

const near = (a, b, most) => a.every((x, k) => Math.abs(x - b[k]) <= most);
// Images repeat; packed leaves stand on 1/256 of theirs.
const sameTexel = (a, b, most) => a.every((x, k) => Math.abs(x - b[k] - Math.round(x - b[k])) <= most);
const kCosine = Math.cos(2 * Math.PI / 180);

function sameCorner(a, b, other) {
  if (!near(a.p, b.p, other.tolerance)) return false;
  if (!other.instanced && a.n && (!b.n || a.n[0] * b.n[0] + a.n[1] * b.n[1] + a.n[2] * b.n[2] < kCosine)) return false;
  if (a.wind.length !== b.wind.length || !near(a.wind, b.wind, 1e-6)) return false;
  return (!a.uv || (b.uv !== null && sameTexel(a.uv, b.uv, other.whole ? 1 / 510 : 1 / 900))) && near(a.c, b.c, 1.5 / 255);
}

// Each triangle of `plain` with one of `other` that no other one has; the corners may be turned.
function match(name, plain, other) {
  if (plain.length !== other.length) throw new Error(`${name}: ${other.length} triangles, plain ${plain.length}`);
  const cell = 4 * Math.max(...other.map((t) => t.tolerance));
  const centre = (t) => [0, 1, 2].map((k) => (t.corners[0].p[k] + t.corners[1].p[k] + t.corners[2].p[k]) / 3);
  const key = (x, y, z) => `${x},${y},${z}`;
  const grid = new Map();
  for (const t of other) {
    const k = key(...centre(t).map((x) => Math.floor(x / cell)));
    if (grid.has(k)) grid.get(k).push(t);
    else grid.set(k, [t]);
  }
  let worst = 0;
  for (const a of plain) {
    const c = centre(a).map((x) => x / cell), low = c.map((x) => Math.floor(x - 0.3)), high = c.map((x) => Math.floor(x + 0.3));
    let found = null;
    for (let x = low[0]; x <= high[0] && !found; ++x)
      for (let y = low[1]; y <= high[1] && !found; ++y)
        for (let z = low[2]; z <= high[2] && !found; ++z) {
          const list = grid.get(key(x, y, z)) ?? [];
          const at = list.findIndex((b) => a.material === b.material && [0, 1, 2].some((turn) =>
            a.corners.every((corner, k) => sameCorner(corner, b.corners[(k + turn) % 3], b))));
          if (at >= 0) [found] = list.splice(at, 1);
        }
    if (!found) throw new Error(`${name}: no counterpart of the triangle at ${centre(a).map((x) => x.toFixed(4))}`);
    worst = Math.max(worst, found.tolerance);
  }
  return worst;
}

async function judge(plain, file) {
  const document = await io.read(file);
  const required = document.getRoot().listExtensionsRequired().map((e) => e.extensionName);
  const other = triangles(document);
  let count = 0, tolerance = 0;
  for (const name of new Set([...plain.keys(), ...other.keys()])) {
    if (!plain.has(name) || !other.has(name)) throw new Error(`node ${name} is in one of the files only`);
    tolerance = Math.max(tolerance, match(name, plain.get(name), other.get(name)));
    count += plain.get(name).length;
  }
  for (const extension of document.getRoot().listExtensionsUsed())
    if (extension.extensionName === 'EXT_meshopt_compression') extension.dispose();
  const [buffer, ...more] = document.getRoot().listBuffers();
  for (const accessor of document.getRoot().listAccessors()) accessor.setBuffer(buffer);
  for (const empty of more) empty.dispose();
  const report = await validator.validateBytes(await io.writeBinary(document), { writeTimestamp: false });
  if (report.issues.numErrors + report.issues.numWarnings > 0)
    throw new Error(`decoded: ${JSON.stringify(report.issues.messages.filter((m) => m.severity < 2).slice(0, 5))}`);
  console.log(JSON.stringify({ file: path.basename(file), triangles: count, tolerance, required }));
}

const [plainFile, ...files] = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node compare.mjs PLAIN OTHER...');
  process.exit(2);
}
try {
  const plain = triangles(await io.read(plainFile));
  for (const file of files) {
    try {
      await judge(plain, file);
    } catch (error) {
      console.error(`${file}: ${error.message ?? error}`);
      process.exit(1);
    }
  }
} catch (error) {
  console.error(`${plainFile}: ${error.message ?? error}`);
  process.exit(1);
}
