// SPDX-License-Identifier: GPL-3.0-or-later
// node build.mjs [FILE]: bundles the viewer and the page around it into one file, in which icepost
// fills in title, body and data. Needs `npm ci --ignore-scripts` in this folder before.
// The result (dist/report_template.html) is committed, so that users need no Node.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, 'dist/report_template.html');
const read = (name) => readFileSync(join(here, name), 'utf8');

async function bundle(entry) {
  const result = await build({ entryPoints: [join(here, entry)], bundle: true, minify: true,
    format: 'iife', target: ['es2021'], charset: 'ascii', legalComments: 'inline', write: false,
    logLevel: 'warning' });
  const script = result.outputFiles[0].text.trim();
  // the page is HTML and XML: the script may end neither the element nor the CDATA section
  for (const end of ['</script', ']]>'])
    if (script.includes(end)) throw new Error(`the bundle contains ${end}: escape it`);
  return script;
}

const licences = [['three.js', 'node_modules/three'], ['uPlot', 'node_modules/uplot']]
  .map(([name, folder]) => {
    const { version, homepage } = JSON.parse(read(`${folder}/package.json`));
    return `This page contains ${name} ${version} (${homepage}):\n${read(`${folder}/LICENSE`)}`;
  }).join('\n').trim();
if (licences.includes('--')) throw new Error('a licence contains "--", which ends a comment');

const parts = { LICENCES: licences, STYLE: `${read('node_modules/uplot/dist/uPlot.min.css').trim()}
${read('style.css').trim()}`, TOOLS: await bundle('src/tools.js'),
SCRIPT: await bundle('src/main.js') };
let page = read('index.html');
for (const [name, text] of Object.entries(parts)) page = page.replace(`@${name}@`, () => text);
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, page);
console.log(`${out}: ${Buffer.byteLength(page)} bytes`);
