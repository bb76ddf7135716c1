// Draws trees of several programs side by side in three.js, on the same ground under the same sun, each as tall as told:
//   node scripts/compare/lineup.mjs OUT.png HEIGHT_M SOURCE...
// SOURCE is a .glb file or ez:PRESET, a tree that EZ-Tree makes of its preset ("ez:Oak Medium"); for the latter set EZ_TREE to
// the folder that `npm install @dgreenheck/ez-tree` made (node_modules/@dgreenheck/ez-tree). three.js and the browser are those
// of tests/web. Prints triangles, vertices and loading time of each.
import { createReadStream, existsSync, writeFileSync } from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url)), web = path.resolve(process.env.TESTS_WEB ?? path.join(here, '../../tests/web'));
const [picture, height, ...sources] = process.argv.slice(2);
if (sources.length === 0) {
  console.error('usage: node lineup.mjs OUT.png HEIGHT_M SOURCE...');
  process.exit(2);
}
const require = createRequire(path.join(web, 'view.mjs'));
const { chromium } = require('playwright-core');

const types = { '.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
const server = http.createServer((request, response) => {
  const where = decodeURIComponent(new URL(request.url, 'http://loopback').pathname);
  let file = path.join(here, 'lineup.html');
  if (where.startsWith('/three/')) file = path.join(web, 'node_modules/three', where.slice(7));
  else if (where.startsWith('/ez/')) file = path.join(process.env.EZ_TREE ?? '', where.slice(4));
  else if (where.startsWith('/source/')) file = path.resolve(sources[Number(where.slice(8))]);
  if (!existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { 'Content-Type': types[path.extname(file)] ?? 'application/octet-stream' });
  createReadStream(file).pipe(response);
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage'],
});
const page = await browser.newPage({ viewport: { width: 480 * sources.length, height: 560 } });
page.setDefaultTimeout(0);
page.on('pageerror', (error) => console.error(error.message));
await page.goto(`http://127.0.0.1:${server.address().port}/`);
await page.waitForFunction('window.ready');
const { report, image } = await page.evaluate((o) => window.lineup(o), { height: Number(height), sources });
writeFileSync(picture, Buffer.from(image.split(',')[1], 'base64'));
for (const line of report) console.log(JSON.stringify(line));
await browser.close();
server.close();
