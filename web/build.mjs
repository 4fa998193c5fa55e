// Bundles src/ into one HTML file: node build.mjs PAGE. The page carries a content security policy that lets run its own
// script (by hash) and nothing else, and reach nothing.
import {createHash} from 'node:crypto';
import {existsSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import {build} from 'esbuild';
import {marked} from 'marked';

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

// The sections of docs/ that findings name in the program's sources, as they stand there. Their anchors are those that
// report/sheet.cpp links to.
const slug = text => text.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');

function namedSections() {
  const named = new Set();
  for (const room of ['report', 'run', 'study']) {
    for (const file of readdirSync(here(`../src/strandlab/${room}`)).filter(name => name.endsWith('.cpp')).sort()) {
      const source = readFileSync(here(`../src/strandlab/${room}/${file}`), 'utf8');
      for (const [, page, section] of source.matchAll(/"docs\/([\w-]+)\.md, \\"([^"\\]+)\\""/g)) named.add(`${page}\n${section}`);
    }
  }
  return [...named].map(name => name.split('\n'));
}

function sectionOf(page, title) {
  const lines = readFileSync(here(`../docs/${page}.md`), 'utf8').split('\n');
  const first = lines.findIndex(line => /^#{1,3} /.test(line) && line.replace(/^#+ /, '') === title);
  if (first < 0) throw new Error(`docs/${page}.md has no section "${title}"`);
  const end = lines.findIndex((line, i) => i > first && /^#{1,3} /.test(line));
  return lines.slice(first + 1, end < 0 ? undefined : end).join('\n');
}

function background() {
  const html = namedSections().map(([page, title]) => {
    const text = marked.parse(sectionOf(page, title).replace(/!\[[^\]]*\]\([^)]*\)/g, '').replace(/\[([^\]]*)\]\([^)]*\)/g, '$1'))
      .replace(/<h[1-6]>/g, '<h4>').replace(/<\/h[1-6]>/g, '</h4>').replace(/<pre>/g, '<pre tabindex="0">')
      .replace(/<th><\/th>/g, '<td></td>').replace(/<table>/g, '<div class="wide" tabindex="0"><table>').replace(/<\/table>/g, '</table></div>');
    return `<section id="docs-${slug(page)}-${slug(title)}"><h3>${title} <cite>docs/${page}.md</cite></h3>\n${text}</section>`;
  });
  return html.join('\n');
}

const script = await bundle('src/main.ts', {format: 'iife'});
const style = await bundle('src/style.css', {});
const hash = createHash('sha256').update(script, 'utf8').digest('base64');
const values = {style, script, hash, background: background()};
const html = readFileSync(here('src/page.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]);
if (script.includes('</script')) throw new Error('the script would end its own element');
// Left alone where nothing changed: what is built from it is then up to date.
if (!existsSync(page) || readFileSync(page, 'utf8') !== html) writeFileSync(page, html);
