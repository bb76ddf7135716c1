// Opens a glTF file with three.js in a headless browser and keeps the picture:
//   node view.mjs FILE OUT.png [--camera ex,ey,ez,tx,ty,tz | --camera NAME] [--fov DEG] [--size 1280x720] [--silhouette]
//     [--wind SECONDS,FORCE]
// Prints one line of JSON: triangles, meshes, lights, cameras, bounding box, top nodes with their places, times.
// --silhouette draws white on black without light; alpha is still tested.
// --wind draws a file with wind weights at that time in a west wind of that force, 1 is a strong one (wind.js).
// The browser is $CHROMIUM or the system's chromium; drawing is done in software. Nothing leaves this machine: files are
// served from a port of the loopback device.
// Exit status: 0 drawn, 1 the file cannot be shown (message on stderr), 2 usage or no browser.
import { createReadStream, existsSync, statSync, writeFileSync } from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const here = path.dirname(fileURLToPath(import.meta.url));

function fail(status, message) {
  console.error(message);
  process.exit(status);
}

function options() {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: {
      camera: { type: 'string' },
      fov: { type: 'string', default: '40' },
      size: { type: 'string', default: '1280x720' },
      silhouette: { type: 'boolean', default: false },
      wind: { type: 'string' },
    },
  });
  if (positionals.length !== 2) throw new Error('two file names are needed');
  const size = /^(\d+)x(\d+)$/.exec(values.size);
  if (!size) throw new Error(`--size ${values.size} is not like 1280x720`);
  const out = {
    file: path.resolve(positionals[0]), picture: positionals[1], fov: Number(values.fov), width: Number(size[1]),
    height: Number(size[2]), silhouette: values.silhouette,
  };
  if (values.camera !== undefined) {
    const numbers = values.camera.split(',').map(Number);
    if (numbers.length === 6 && numbers.every(Number.isFinite)) out.camera = numbers;
    else out.cameraName = values.camera;
  }
  if (values.wind !== undefined) {
    out.wind = values.wind.split(',').map(Number);
    if (out.wind.length !== 2 || !out.wind.every(Number.isFinite)) throw new Error(`--wind ${values.wind} is not like 1.5,0.5`);
  }
  return out;
}

const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.png': 'image/png',
  '.jpg': 'image/jpeg', '.glb': 'model/gltf-binary', '.gltf': 'model/gltf+json' };

// Serves the page, three.js and the folder of the model.
function serve(folder) {
  const roots = { '/three/': path.join(here, 'node_modules/three'), '/model/': folder };
  const server = http.createServer((request, response) => {
    const where = decodeURIComponent(new URL(request.url, 'http://loopback').pathname);
    const own = { '/': 'viewer.html', '/wind.js': 'wind.js' }[where];
    let file = own ? path.join(here, own) : null;
    for (const [prefix, root] of Object.entries(roots)) {
      if (!where.startsWith(prefix)) continue;
      const inside = path.join(root, where.slice(prefix.length));
      if (inside.startsWith(root + path.sep)) file = inside;
    }
    if (!file || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { 'Content-Type': types[path.extname(file)] ?? 'application/octet-stream',
      'Content-Length': statSync(file).size });
    createReadStream(file).pipe(response);
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

let wanted;
try {
  wanted = options();
} catch (error) {
  fail(2, `${error.message}\nusage: node view.mjs FILE OUT.png [--camera ex,ey,ez,tx,ty,tz | NAME] [--fov DEG] ` +
    '[--size WxH] [--silhouette] [--wind SECONDS,FORCE]');
}
if (!existsSync(wanted.file)) fail(1, `there is no file ${wanted.file}`);
const browserPath = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
  .find((p) => p && existsSync(p));
if (!browserPath) fail(2, 'no browser: apt-get install chromium, or set CHROMIUM to one');
let chromium;
try {
  ({ chromium } = await import('playwright-core'));
} catch {
  fail(2, `playwright-core is not installed: npm ci --prefix ${path.relative(process.cwd(), here) || '.'}`);
}

const server = await serve(path.dirname(wanted.file));
const browser = await chromium.launch({
  executablePath: browserPath,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle', '--enable-unsafe-swiftshader',
    '--disable-dev-shm-usage'],
});
let status = 0;
try {
  const page = await browser.newPage({ viewport: { width: wanted.width, height: wanted.height } });
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(message.text());
  });
  page.setDefaultTimeout(0);
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForFunction('window.ready', null, { timeout: 60000 });
  const url = `/model/${encodeURIComponent(path.basename(wanted.file))}`;
  const { report, picture } = await page.evaluate((o) => window.view(o), { ...wanted, url });
  if (complaints.length > 0) throw new Error(complaints.join('\n'));
  writeFileSync(wanted.picture, Buffer.from(picture.split(',')[1], 'base64'));
  console.log(JSON.stringify(report));
} catch (error) {
  console.error(`${wanted.file}: ${error.message}`);
  status = 1;
} finally {
  await browser.close();
  server.close();
}
process.exit(status);
