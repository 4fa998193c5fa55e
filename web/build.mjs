// Bundles src/ into one HTML file: node build.mjs PAGE. The page carries a content security policy that lets run its own
// script (by hash) and nothing else, and reach nothing.
import {createHash} from 'node:crypto';
import {readFileSync, writeFileSync} from 'node:fs';
import {build} from 'esbuild';

const page = process.argv[2];
if (!page) throw new Error('usage: node build.mjs PAGE');
const here = name => new URL(name, import.meta.url).pathname;

async function bundle(entry, options) {
  const result = await build({
    entryPoints: [here(entry)], bundle: true, minify: true, write: false, charset: 'utf8', target: ['es2020'],
    legalComments: 'none', logLevel: 'warning', ...options,
  });
  return result.outputFiles[0].text.trim();
}

const script = await bundle('src/main.ts', {format: 'iife'});
const style = await bundle('src/style.css', {});
const hash = createHash('sha256').update(script, 'utf8').digest('base64');
const values = {style, script, hash};
const html = readFileSync(here('src/page.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]);
if (script.includes('</script')) throw new Error('the script would end its own element');
writeFileSync(page, html);
