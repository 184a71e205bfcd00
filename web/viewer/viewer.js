// SPDX-License-Identifier: Apache-2.0
// The page: opens a stream (of start.js, a drop, a file), refines it, and lets its bytes and triangles
// be chosen.
import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {FIRST_FRAME, TksTerrain, textureOf} from '../src/three.js';
import {decoder, encoder} from './decoder.js';
import {FetchMap} from './fetch_map.js';
import {Picture} from './scene.js';
import {tint} from './tint.js';

const $ = (id) => document.getElementById(id);
const STILL = matchMedia('(prefers-reduced-motion: reduce)');
/** What is fetched without being asked for. */
const FREE_BYTES = 8 << 20;
const LEAST_TRIANGLES = 100, MOST_TRIANGLES = 1e6, USUAL_TRIANGLES = 50000;

/** As in style.css. */
const SMALL_SCREEN = '(max-width: 640px), (max-height: 520px)';

/** What neither the name nor the panel lies over. */
function freeArea() {
  const margin = 24, name = document.querySelector('header').getBoundingClientRect();
  const panel = $('panel').getBoundingClientRect();
  const isBelow = panel.width >= innerWidth, isBeside = panel.width > 0 && !isBelow;
  return {
    left: margin, right: (isBeside ? panel.left : innerWidth) - margin,
    top: name.bottom + margin, bottom: (isBelow ? panel.top : innerHeight) - margin,
  };
}
const picture = new Picture($('picture'), freeArea);
const map = new FetchMap($('fetched'), $('ground'));
/** What files are coded into: so many bits for each height and texel. */
const BITS = 1, LEAST_BYTES = 32768;

let terrain = null, object = null;
let wanted = {};
/** Bytes and triangles of the frame that is shown, and whether it has all texels. */
let shown = {};
/** A promise of the first frame, where that is being made already. */
let begun = null;
let opening = new AbortController();
let pumping = false;
/** What the page calls the terrain that it shows: {name, title, size}. */
let called = null;

/** Sliders are logarithmic: 0 to 1000 for `least` to `most`. */
const fromSlider = (slider, least, most) => least * (most / least) ** (slider.value / 1000);
const toSlider = (value, least, most) => (1000 * Math.log(value / least)) / Math.log(most / least);

function formatBytes(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  const [value, unit] = bytes < 1e6 ? [bytes / 1e3, 'kB'] : [bytes / 1e6, 'MB'];
  return `${value.toFixed(value < 10 ? 1 : 0)} ${unit}`;
}
const formatCount = (count) => count.toLocaleString('en').replaceAll(',', '\u2009');

function tell(text, isNote = false) {
  $('message').textContent = text;
  $('message').classList.toggle('note', isNote);
  $('message').hidden = !text;
}

function readOut(frame, triangles) {
  const {info} = frame;
  $('bytes-here').textContent = formatBytes(frame.bytes);
  $('bytes-of').textContent = `of ${formatBytes(info.streamBytes)}`;
  $('triangles-here').textContent = formatCount(triangles);
  $('heights-quality').hidden = !info.hasHeights;
  $('texture-quality').hidden = !info.hasTexture;
  // The stream states what its packets in their order bring. Where bytes came for a view, as many
  // or more are here, and the ground that is looked at is better than that.
  const scattered = terrain.loaded.ranges.length > 1;
  const [most, least] = scattered ? ['≤ ', '≥ '] : ['', ''];
  const rmse = info.heightsRmse;
  $('rmse').textContent =
    rmse < 0 ? '–' : rmse === 0 ? 'exact' : `${most}${Number(rmse.toPrecision(2))} ${info.unit}`.trim();
  $('psnr').textContent = info.texturePsnr < 0 ? '–'
    : isFinite(info.texturePsnr) ? `${least}${info.texturePsnr.toFixed(1)} dB` : 'exact';
  const share = (bytes) => `${(100 * bytes) / info.streamBytes}%`;
  $('split-heights').style.width = share(info.geometryBytes);
  $('split-texture').style.width = share(info.textureBytes);
  $('heights-share').textContent = `heights ${formatBytes(info.geometryBytes)}`;
  $('texture-share').textContent = `texture ${formatBytes(info.textureBytes)}`;
  $('heights-share').hidden = !info.hasHeights;
  $('texture-share').hidden = !info.hasTexture;
  const {requests, bytes} = terrain.loaded;
  const how = requests ? `fetched in ${requests === 1 ? '1 request' : `${requests} requests`}` : 'read';
  const where = $('ground').hidden ? '' : ', and for which ground';
  $('fetched-text').textContent = `${formatBytes(bytes)} ${how}${where}`;
  map.draw();
}

/** What leaves the picture empty, if anything does. */
function emptiness({info, mesh, texture, complete}) {
  if (!complete) return '';
  if (info.hasHeights && mesh?.triangles.length === 0) return 'All heights of this stream are voids';
  if (!info.textureCutout || !texture) return '';
  for (let i = 3; i < texture.data.length; i += 4) if (texture.data[i] > 0) return '';
  return 'The cut-out of this stream hides all texels';
}

function show(frame) {
  const first = object.frame === null;
  object.show(frame, {glide: !STILL.matches});
  if (frame.surface && $('textured').checked) object.setMap(textureOf(tint(frame.surface)));
  if (first) {
    exaggerate();
    picture.home();
    if (place('eye') && place('target')) picture.look(place('eye'), place('target'));
  }
  const empty = emptiness(frame);
  if (empty) tell(`${empty}: there is nothing to draw.`, true);
  readOut(frame, frame.mesh ? frame.mesh.triangles.length / 3 : 2);
  document.body.dataset.bytes = frame.bytes;
  picture.draw();
}

/** Of streams with an index bytes come for what is looked at. */
const isPlanned = () => terrain.info.hasIndex && object.frame !== null;

/** What frames are made of, but for bytes. */
function frameOptions(triangles) {
  return {
    triangles, normals: true, surface: !terrain.info.hasTexture, samples: 1024,
    texels: Math.min(4096, picture.renderer.capabilities.maxTextureSize), signal: opening.signal,
  };
}

const isShown = () => shown.isWhole && shown.bytes === wanted.bytes &&
  shown.triangles === wanted.triangles;

/** Shows what opening brought, roughly; other bytes come meanwhile. */
async function drawFirst(current) {
  const {info} = current, {texels} = FIRST_FRAME;
  const bytes = Math.min(wanted.bytes, current.loaded.bytes);
  const triangles = Math.min(wanted.triangles, FIRST_FRAME.triangles);
  const options = frameOptions(triangles);
  if (!info.hasIndex) current.load(wanted.bytes, options).catch(() => {});
  const frame = await (begun ?? current.decode({...options, texels, bytes}));
  await picture.sized();  // the camera is placed for its size, and for what is seen bytes come
  if (current !== terrain) return;
  begun = null;
  show(frame);
  const isWhole = Math.max(info.textureWidth, info.textureHeight) <= texels;
  shown = {bytes: frame.bytes, triangles, isWhole};
}

/** Frames of more bytes, until others are wanted. */
async function refine(current) {
  const goal = wanted, view = isPlanned() ? object.viewOf(picture.camera, picture.pixels) : null;
  const options = {...frameOptions(goal.triangles), bytes: goal.bytes, after: shown.bytes, view};
  for await (const frame of current.refine(options)) {
    if (current !== terrain) return;
    show(frame);
    shown = {bytes: frame.bytes, triangles: goal.triangles, isWhole: true};
    if (goal !== wanted) return;
  }
  const {fileBytes, truncated, info} = current;
  if (truncated && goal.bytes > fileBytes) {
    goal.bytes = fileBytes;
    tell(`The file is cut short: ${formatBytes(fileBytes)} of ` +
      `${formatBytes(info.streamBytes)} are there.`, true);
  }
  shown.bytes = goal.bytes;  // this view needs no more
}

/** One frame of bytes that are here. */
async function redraw(current) {
  const {bytes, triangles} = wanted, here = Math.min(bytes, current.loaded.bytes);
  const kept = bytes === shown.bytes && shown.isWhole ? {texture: false, surface: false} : {};
  const frame = await current.decode({...frameOptions(triangles), bytes: here, ...kept});
  if (current !== terrain) return;
  show(frame);
  shown = {bytes, triangles, isWhole: true};
}

/** Draws until what is shown is what is wanted, or all that this view needs. */
async function pump() {
  if (pumping || !terrain) return;
  pumping = true;
  const current = terrain, {signal} = opening;
  document.body.dataset.state = 'refining';
  try {
    while (current === terrain && !isShown()) {
      if (!shown.bytes) await drawFirst(current);
      else if (wanted.bytes > shown.bytes) await refine(current);
      else await redraw(current);
    }
    document.body.dataset.state = 'done';
  } catch (error) {
    if (current === terrain && !signal.aborted) fail(error);
  } finally {
    pumping = false;
    if (current !== terrain) pump();
  }
}

function call({name, title, size}) {
  $('name').textContent = name;
  document.title = title;
  $('size').textContent = size;
}

function fail(error) {
  $('progress').hidden = true;
  tell(error.message);
  document.body.dataset.state = 'failed';
  if (object?.frame) return;
  $('welcome').hidden = false;
  $('panel').hidden = true;
}

/** Of what is not opened. What is shown stays, as it is called, and goes on. */
function failToOpen(error) {
  if (called) call(called);
  else $('size').textContent = '';
  fail(error);
  if (terrain && !isShown()) pump();
}

function setWanted() {
  if (!terrain) return;
  wanted = {
    bytes: Math.round(fromSlider($('bytes'), leastBytes(), terrain.info.streamBytes)),
    triangles: Math.round(fromSlider($('triangles'), LEAST_TRIANGLES, mostTriangles())),
  };
  pump();
}
/** Where the camera rests, other bytes may help. */
function replan() {
  if (!terrain || !shown.bytes || !isPlanned() || terrain.loaded.bytes >= wanted.bytes) return;
  shown.bytes = terrain.loaded.bytes;
  pump();
}
/** Of the header alone there is a surface too. */
const leastBytes = () => Math.min(terrain.info.headerBytes, terrain.info.streamBytes - 1);
const mostTriangles = () =>
  Math.max(2 * LEAST_TRIANGLES, Math.min(MOST_TRIANGLES, 2 * terrain.info.width * terrain.info.height));

/** Sliders and switches for what was opened. */
function prepareControls(info) {
  $('panel').hidden = false;
  picture.resize();
  $('bytes').value = toSlider(Math.min(info.streamBytes, FREE_BYTES), leastBytes(), info.streamBytes);
  $('triangles').value = toSlider(Math.min(USUAL_TRIANGLES, mostTriangles()), LEAST_TRIANGLES,
    mostTriangles());
  for (const control of document.querySelectorAll('.of-heights')) control.hidden = !info.hasHeights;
  $('textured-name').textContent = info.hasTexture ? 'Texture' : 'Colours';
}
function sizeOf(info) {
  const sizes = [];
  if (info.hasHeights) sizes.push(`${info.width} × ${info.height} heights`);
  if (info.hasTexture) sizes.push(`${info.textureWidth} × ${info.textureHeight} texels`);
  return sizes.join(' · ');
}

/** `asked`: {stop, terrain, first} of an open() that is under way already, and its first frame. */
async function openInput(input, name, asked) {
  opening.abort();
  opening = asked?.stop ?? new AbortController();
  const {signal} = opening;
  tell('');
  $('welcome').hidden = $('progress').hidden = true;
  const title = `${name} – Tetrakis`;
  call({name, title, size: 'opening …'});
  document.body.dataset.state = 'busy';
  try {
    const opened = await (asked?.terrain ?? open(input, {...decoder, signal}));
    if (signal.aborted) return opened.dispose();
    terrain = opened;
    map.show(terrain);
    shown = {};
    begun = asked?.first ?? null;
    object = new TksTerrain(terrain);
    object.material.wireframe = $('wireframe').checked;
    picture.setObject(object);
    $('save').hidden = true;
    prepareControls(terrain.info);
    called = {name, title, size: sizeOf(terrain.info)};
    call(called);
    setWanted();
  } catch (error) {
    if (!signal.aborted) failToOpen(error);
  }
}

/** Codes heights and an image, which then are what is open. */
async function openSources(files) {
  opening.abort();
  opening = new AbortController();
  const {signal} = opening, names = files.map(({name}) => name).join(' + ');
  tell('');
  $('welcome').hidden = $('progress').hidden = true;
  $('name').textContent = names;
  $('size').textContent = 'reading …';
  document.body.dataset.state = 'busy';
  try {
    const {readFiles} = await import('./read_files.js');
    const input = await readFiles(files);
    const samples = [input.heights, input.texture].filter(Boolean)
      .reduce((sum, {width, height}) => sum + width * height, 0);
    const bytes = Math.max(LEAST_BYTES, Math.round((BITS * samples) / 8));
    $('progress').hidden = false;
    const progress = (done) => {
      $('progress').value = done;
      $('size').textContent = `encoding … ${Math.round(100 * done)} %`;
    };
    progress(0);
    const stream = await encode({...input, bytes, index: true}, {...encoder, signal, progress});
    if (signal.aborted) return;
    const file = new File([stream], `${files[0].name.replace(/\.[^.]*$/, '')}.tks`);
    await openInput(file, file.name);
    offer(file);
  } catch (error) {
    if (!signal.aborted) failToOpen(error);
  }
}

/** What was coded can be kept. */
function offer(file) {
  URL.revokeObjectURL($('save').href);
  $('save').href = URL.createObjectURL(file);
  $('save').download = file.name;
  $('save').hidden = false;
}

async function isStream(file) {
  if (/\.tks$/i.test(file.name)) return true;
  const first = await file.slice(0, 3).arrayBuffer().catch(() => new ArrayBuffer(0));
  return new TextDecoder().decode(first) === 'TKS';
}
/** A stream, or what can be coded into one. */
async function openFiles(files) {
  const streams = [];
  for (const file of files) if (await isStream(file)) streams.push(file);
  if (streams.length === 0 && files.length > 0) openSources(files);
  else if (files.length === 1) openInput(files[0], files[0].name);
  else if (files.length > 1) {
    failToOpen(new Error(`${streams[0].name} is a stream, which is opened alone. What can be ` +
      'dropped together is a GeoTIFF of heights and an image over it.'));
  }
}

/** Three numbers of the address. */
function place(name) {
  const numbers = (new URLSearchParams(location.search).get(name) ?? '').split(',').map(Number);
  return numbers.length === 3 && numbers.every(isFinite) ? numbers : null;
}

/** What is higher than wide, often because it states no unit or a wrong one, is flattened. */
function exaggerate() {
  if (!object?.frame) return;
  const {tallness} = picture, usual = tallness > 1 ? 1 / (8 * tallness) : 1;
  const times = usual * 10 ** ($('exaggeration').value / 20);
  $('times').value = times.toPrecision(2);
  picture.setExaggeration(times);
}

function listen() {
  $('bytes').addEventListener('input', setWanted);
  $('triangles').addEventListener('input', setWanted);
  $('exaggeration').addEventListener('input', exaggerate);
  $('wireframe').addEventListener('change', () => {
    if (object) object.material.wireframe = $('wireframe').checked;
    picture.draw();
  });
  $('textured').addEventListener('change', () => {
    if (!object) return;
    object.setMap(null);
    const {texture, surface} = object.frame ?? {};
    if ($('textured').checked && texture) object.setMap(textureOf(texture));
    else if ($('textured').checked && surface) object.setMap(textureOf(tint(surface)));
    object.material.needsUpdate = true;
    picture.draw();
  });
  $('shaded').addEventListener('change', () => picture.setShaded($('shaded').checked));
  $('fly').addEventListener('change', () => {
    picture.setFlying($('fly').checked);
    help();
    $('picture').focus();
  });
  $('home').addEventListener('click', () => object && picture.home());
  $('fold').addEventListener('click', () => {
    const folded = $('panel').classList.toggle('folded');
    $('fold').setAttribute('aria-expanded', String(!folded));
    picture.resize();
  });
  for (const id of ['another', 'choose']) $(id).addEventListener('click', () => $('file').click());
  $('file').addEventListener('change', () => {
    openFiles([...$('file').files]);
  });
  $('address').addEventListener('submit', (event) => {
    event.preventDefault();
    const address = new FormData(event.target).get('url');
    openInput(address, nameOf(address));
  });
  addEventListener('dragover', (event) => {
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) document.body.classList.remove('dropping');
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    openFiles([...event.dataTransfer.files]);
  });
}

/** How to move. */
function help() {
  const [touched, byHand] = $('fly').checked
    ? ['One finger looks around, a second one goes ahead.',
      'A drag looks around. W A S D or arrows go, Q and E sink and rise, Shift hurries.']
    : ['One finger turns, two move and zoom.',
      'A drag turns, with Shift it moves; the wheel zooms. Keys: arrows, + −, Home.'];
  $('help').textContent = matchMedia('(hover: none)').matches ? touched : byHand;
}

/** The last part of an address. */
function nameOf(address) {
  const [path] = String(address).split(/[?#]/), name = path.split('/').pop();
  try {
    return decodeURIComponent(name);
  } catch {
    return name;  // with a stray %
  }
}

/** Takes over what the page has asked for already: {address, stop, terrain, first}, or nothing. */
export function begin(asked) {
  picture.onrest = replan;
  listen();
  help();
  if (matchMedia(SMALL_SCREEN).matches) $('fold').click();
  const early = [...$('file').files];  // chosen while this script was on its way
  if (early.length > 0) openFiles(early);
  else if (asked) openInput(asked.address, nameOf(asked.address), asked);
  else $('welcome').hidden = false;
}
