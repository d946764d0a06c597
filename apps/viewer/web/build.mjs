// SPDX-License-Identifier: GPL-3.0-or-later
// Makes dist/ from src/: viewer.js, all code in one file, and viewer.html, the page around it and the data of a run.
// node build.mjs [FOLDER]: into another folder, for a comparison.
import { build } from 'esbuild';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, 'dist');
const read = (...path) => readFileSync(join(here, ...path), 'utf8');
mkdirSync(out, { recursive: true });

const { outputFiles } = await build({
  absWorkingDir: here, entryPoints: ['src/main.js'], bundle: true, minify: true, format: 'iife', target: 'es2022', charset: 'ascii',
  legalComments: 'none', write: false, logLevel: 'warning',
});
const code = outputFiles[0].text;
if (/<\/script|<!--/i.test(code)) throw new Error('the code holds what ends a script element');
writeFileSync(join(out, 'viewer.js'), code);

const style = (await build({ stdin: { contents: read('node_modules/uplot/dist/uPlot.min.css') + read('src/style.css'), loader: 'css' }, minify: true, write: false })).outputFiles[0].text;
const licences = ['three', 'uplot'].map((name) => {
  const { version } = JSON.parse(read('node_modules', name, 'package.json'));
  return `${name} ${version}\n\n${read('node_modules', name, 'LICENSE').trim()}\n`;
});
writeFileSync(join(out, 'LICENSES.txt'), licences.join('\n\n'));
const notice = `This page contains Plekton (GPL-3.0-or-later) and the following software.\n\n${licences.join('\n\n')}`;
if (notice.includes('--')) throw new Error('a licence holds what ends a comment');
writeFileSync(join(out, 'viewer.html'), read('src/viewer.html')
  .replace('<!--plekton:licences-->', () => `<!--\n${notice}-->`)
  .replace('/*plekton:style*/', () => style.trim()));
