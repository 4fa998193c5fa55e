// The picture of README.md: node picture.mjs REPORT PNG, a window of the report with a strand pointed at.
import {resolve} from 'node:path';
import {chromium} from 'playwright-core';

const [report, png] = process.argv.slice(2);
const browser = await chromium.launch({executablePath: process.env.STRANDLAB_CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu']});
const page = await browser.newPage({viewport: {width: 1280, height: 850}});
await page.goto(`file://${resolve(report)}`);
const slider = page.getByRole('slider', {name: 'Compaction'});
await slider.fill(String(Math.round(Number(await slider.getAttribute('max')) / 2)));
await slider.blur();
const box = await page.locator('canvas.section').boundingBox();
await page.locator('canvas.section').hover({position: {x: 0.42 * box.width, y: 0.52 * box.height}});
await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
await page.screenshot({path: png});
await browser.close();
