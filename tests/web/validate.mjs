// Asks the Khronos validator about glTF files:  node validate.mjs [--infos] FILE...
// Prints one line per file and every error and warning; --infos prints the notes too.
// Exit status: 0 no errors and no warnings, 1 some, 2 a file cannot be read.
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const severities = ['error', 'warning', 'info', 'hint'];

async function load() {
  try {
    return (await import('gltf-validator')).default;
  } catch {
    const here = path.dirname(fileURLToPath(import.meta.url));
    console.error(`the validator is not installed: npm ci --prefix ${path.relative(process.cwd(), here) || '.'}`);
    process.exit(2);
  }
}

async function judge(validator, file, shown) {
  const bytes = new Uint8Array(await readFile(file));
  const report = await validator.validateBytes(bytes, {
    uri: path.basename(file),
    maxIssues: 0,  // no limit: it stops there, and notes count too
    writeTimestamp: false,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(path.join(path.dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints, ` +
    `${report.info.totalTriangleCount} triangles, ${report.info.totalVertexCount} vertices`);
  for (const m of messages)
    if (m.severity <= shown) console.log(`  ${severities[m.severity]} ${m.code} ${m.pointer ?? ''} ${m.message}`);
  return numErrors + numWarnings === 0;
}

const files = process.argv.slice(2).filter((a) => a !== '--infos');
const shown = process.argv.includes('--infos') ? 3 : 1;
if (files.length === 0) {
  console.error('usage: node validate.mjs [--infos] FILE...');
  process.exit(2);
}
const validator = await load();
let good = true;
for (const file of files) {
  try {
    good = (await judge(validator, file, shown)) && good;
  } catch (error) {
    console.error(`${file}: ${error.message ?? error}`);
    process.exit(2);
  }
}
process.exit(good ? 0 : 1);
