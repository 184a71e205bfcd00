// SPDX-License-Identifier: Apache-2.0
// Opens a stream (of start.js, a drop, a file), refines it, and lets its bytes and triangles be
// chosen.
import {MeshLambertMaterial} from 'three';

import {goesRound, open} from '../src/index.js';
import {FIRST_FRAME, TksTerrain, textureOf} from '../src/three.js';
import {nameOf} from './address.js';
import {drawBearings} from './bearings.js';
import {givenHeight, keep, place} from './camera_link.js';
import {encodedFile, inputOf, isStream} from './coding.js';
import {Comparison} from './comparison.js';
import {decoder} from './decoder.js';
import {FetchMap} from './fetch_map.js';
import {listenToFiles} from './files.js';
import {Globe} from './globe.js';
import {globeDescriber} from './globe_pointer.js';
import {exaggerationOf, globeFor, keepFlat} from './globe_view.js';
import {originalInLink} from './original_link.js';
import {$, entitle, explainMoves, freeArea, isSmallScreen, tell} from './page.js';
import {describer, listenToPointer} from './pointer.js';
import {emptiness, formatBytes, formatCount, readOut} from './read_out.js';
import {listenToSaves} from './saving.js';
import {Picture} from './scene.js';
import {listenToSun} from './sun.js';
import {tint} from './tint.js';
import {say} from './values.js';

const STILL = matchMedia('(prefers-reduced-motion: reduce)');
/** What is fetched without being asked for. */
const FREE_BYTES = 8 << 20;
const LEAST_TRIANGLES = 100, MOST_TRIANGLES = 1e6, USUAL_TRIANGLES = 50000;

const picture = new Picture($('picture'), freeArea);
const comparison = new Comparison(picture);
const map = new FetchMap($('fetched'), $('ground'));

let terrain = null, object = null;
let wanted = {};
/** Bytes and triangles of the frame that is shown, of a globe its exaggeration, and whether it has
 * all texels. */
let shown = {};
/** A promise of the first frame, where that is being made already. */
let begun = null;
let opening = new AbortController();
let pumping = false;
/** What the page calls the terrain that it shows: {name, title, size}. */
let called = null;
/** Opens the terrain that is shown once more. */
let reopen = () => {};
/** The text of a point of the terrain. */
let describe = () => '';

/** Sliders are logarithmic: 0 to 1000 for `least` to `most`. */
const fromSlider = (slider, least, most) => least * (most / least) ** (slider.value / 1000);
const toSlider = (value, least, most) => (1000 * Math.log(value / least)) / Math.log(most / least);

function show(frame) {
  const first = object.frame === null;
  object.show(frame, {glide: !STILL.matches});
  if (frame.surface && $('textured').checked) object.setMap(textureOf(tint(frame.surface)));
  if (object.isGlobe) picture.globe.keepAbove(object.radius);
  if (first) {
    exaggerate();
    picture.home();
    $('bearings').hidden = false;
    followLink();
  }
  const empty = emptiness(frame);
  if (empty) tell(`${empty}: there is nothing to draw.`, true);
  readOut(frame, terrain.loaded);
  describe = (object.isGlobe ? globeDescriber : describer)(frame.info);
  map.draw();
  document.body.dataset.bytes = frame.bytes;
  picture.draw();
}

/** Of streams with an index bytes come for what is looked at, on flat ground. */
const isPlanned = () => terrain.info.hasIndex && object.frame !== null && !object.isGlobe;

/** What frames are made of, but for bytes. */
function frameOptions(triangles) {
  return {
    triangles, normals: true, surface: !terrain.info.hasTexture, samples: 1024,
    texels: Math.min(4096, picture.renderer.capabilities.maxTextureSize), signal: opening.signal,
    globe: globeFor(terrain.info, Number($('exaggeration').value)),
  };
}

const isShown = () => shown.isWhole && shown.bytes === wanted.bytes &&
  shown.triangles === wanted.triangles && shown.height === wanted.height;

/** Shows what opening brought, roughly; other bytes come meanwhile. */
async function drawFirst(current) {
  const {info} = current, {texels} = FIRST_FRAME, {height} = wanted;
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
  shown = {bytes: frame.bytes, triangles, height, isWhole};
}

/** Frames of more bytes, until others are wanted. */
async function refine(current) {
  const goal = wanted, view = isPlanned() ? object.viewOf(picture.camera, picture.pixels) : null;
  const options = {...frameOptions(goal.triangles), bytes: goal.bytes, after: shown.bytes, view};
  for await (const frame of current.refine(options)) {
    if (current !== terrain) return;
    show(frame);
    shown = {...goal, bytes: frame.bytes, isWhole: true};
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
  const {bytes, triangles, height} = wanted, here = Math.min(bytes, current.loaded.bytes);
  const kept = bytes === shown.bytes && shown.isWhole ? {texture: false, surface: false} : {};
  const frame = await current.decode({...frameOptions(triangles), bytes: here, ...kept});
  if (current !== terrain) return;
  show(frame);
  shown = {bytes, triangles, height, isWhole: true};
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
  if (called) entitle(called);
  else $('size').textContent = '';
  fail(error);
  if (terrain && !isShown()) pump();
}

/** Looks from where the address says, if it does. */
function followLink() {
  if (!object?.frame || !place('eye') || !place('target')) return;
  picture.look(place('eye'), place('target'));
}

function setWanted() {
  if (!terrain) return;
  wanted = {
    bytes: Math.round(fromSlider($('bytes'), leastBytes(), terrain.info.streamBytes)),
    triangles: Math.round(fromSlider($('triangles'), LEAST_TRIANGLES, mostTriangles())),
    height: object.isGlobe ? $('exaggeration').value : 0,  // flat ground is stretched as it is
  };
  say('bytes', formatBytes(wanted.bytes));
  say('triangles', formatCount(wanted.triangles));
  pump();
}
/** Where the camera rests, the address keeps it, and other bytes may help. */
function rest() {
  if (object?.frame) {
    const {camera: {position}, orbit: {target}} = picture;
    keep(picture.isMoved
      ? {eye: position, target, height: Number($('exaggeration').value)} : null);
  }
  replan();
}
function replan() {
  if (!terrain || !shown.bytes || !isPlanned() || terrain.loaded.bytes >= wanted.bytes) return;
  shown.bytes = terrain.loaded.bytes;
  pump();
}
/** Whether a metre on the ground is known. */
const isMeasured = (info) => info.hasHeights && (info.spacingX > 0 || info.hasGeotransform);
/** Of the header alone there is a surface too. */
const leastBytes = () => Math.min(terrain.info.headerBytes, terrain.info.streamBytes - 1);
const mostTriangles = () => {
  const {width, height} = terrain.info;
  return Math.max(2 * LEAST_TRIANGLES, Math.min(MOST_TRIANGLES, 2 * width * height));
};

/** Sliders and switches for what was opened. */
function prepareControls(info) {
  $('panel').hidden = false;
  picture.resize();
  $('bytes').value =
    toSlider(Math.min(info.streamBytes, FREE_BYTES), leastBytes(), info.streamBytes);
  $('triangles').value = toSlider(Math.min(USUAL_TRIANGLES, mostTriangles()), LEAST_TRIANGLES,
    mostTriangles());
  for (const control of document.querySelectorAll('.of-heights')) control.hidden = !info.hasHeights;
  for (const control of document.querySelectorAll('.of-texture')) control.hidden = !info.hasTexture;
  $('round').hidden = !goesRound(info);
  $('globe').checked = $('fly').parentElement.hidden = object.isGlobe ?? false;
  if (object.isGlobe && $('fly').checked) $('fly').click();
  $('textured-name').textContent = info.hasTexture ? 'Texture' : 'Colours';
}
function sizeOf(info) {
  const sizes = [];
  if (info.hasHeights) sizes.push(`${info.width} × ${info.height} heights`);
  if (info.hasTexture) sizes.push(`${info.textureWidth} × ${info.textureHeight} texels`);
  return sizes.join(' · ');
}

/** Ends what was being opened, for something else. */
function beginOpening(stop, names) {
  opening.abort();
  opening = stop;
  tell('');
  $('welcome').hidden = $('progress').hidden = true;
  entitle(names);
  document.body.dataset.state = 'busy';
}

/** `asked`: {stop, terrain, first} of an open() that is under way already, and its first frame. */
async function openInput(input, name, asked, original = null) {
  const stop = asked?.stop ?? new AbortController(), {signal} = stop;
  const title = `${name} – Tetrakis`;
  beginOpening(stop, {name, title, size: 'opening …'});
  try {
    const opened = await (asked?.terrain ?? open(input, {...decoder, signal}));
    if (signal.aborted) return opened.dispose();
    terrain = opened;
    map.show(terrain);
    shown = {};
    begun = asked?.first ?? null;
    const material = new MeshLambertMaterial();
    object = globeFor(terrain.info)
      ? new Globe(terrain, material) : new TksTerrain(terrain, {material});
    setWireframe();
    picture.setObject(object);
    comparison.of(object.isGlobe ? null : original, terrain.info);
    $('save').hidden = true;
    prepareControls(terrain.info);
    reopen = () => openInput(input, name, null, original);
    called = {name, title, size: sizeOf(terrain.info)};
    entitle(called);
    setWanted();
    if (asked && !object.isGlobe) compareWithLink(terrain);
  } catch (error) {
    if (!signal.aborted) failToOpen(error);
  }
}

/** Fetches what the stream of the page's address was made of, if the address says so. */
async function compareWithLink(opened) {
  try {
    const original = await originalInLink(opened.info);
    if (original && terrain === opened) comparison.of(original, opened.info);
  } catch (error) {
    if (terrain === opened) tell(error.message);
  }
}

/** Codes heights and an image, which then are what is open. */
async function openSources(files) {
  const stop = new AbortController(), {signal} = stop;
  const name = files.map((file) => file.name).join(' + ');
  beginOpening(stop, {name, title: document.title, size: 'reading …'});
  try {
    const input = await inputOf(files);
    $('progress').hidden = false;
    const progress = (done) => {
      $('progress').value = done;
      $('size').textContent = `encoding … ${Math.round(100 * done)} %`;
    };
    progress(0);
    const file = await encodedFile(input, files[0].name, {signal, progress});
    if (signal.aborted) return;
    await openInput(file, file.name, null, input);
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

/** What is higher than wide, often because it states no unit or a wrong one, is flattened. */
function exaggerate() {
  if (!object?.frame) return;
  const {tallness} = picture, usual = tallness > 1 ? 1 / (8 * tallness) : 1;
  const {value} = $('exaggeration');
  const times = object.isGlobe ? exaggerationOf(value, terrain.info) : usual * 10 ** (value / 20);
  const text = times.toPrecision(2);
  say('exaggeration', `× ${text}`, `drawn ${text} times as high`);
  if (object.isGlobe) return setWanted();
  picture.setExaggeration(times);
}

function setWireframe() {
  for (const material of [object?.material ?? []].flat())
    material.wireframe = $('wireframe').checked;
}

function listenToControls() {
  $('bytes').addEventListener('input', setWanted);
  $('triangles').addEventListener('input', setWanted);
  $('exaggeration').addEventListener('input', () => {
    exaggerate();
    rest();
  });
  $('north').addEventListener('click', () => object && picture.faceNorth());
  listenToSaves(() => ({object, terrain, bytes: shown.bytes, name: called.name}));
  $('globe').addEventListener('change', () => {
    keepFlat(!$('globe').checked);
    reopen();
  });
  $('wireframe').addEventListener('change', () => {
    setWireframe();
    picture.draw();
  });
  $('textured').addEventListener('change', () => {
    if (!object) return;
    object.setMap(null);
    const {texture, surface} = object.frame ?? {};
    if ($('textured').checked && texture) object.setMap(textureOf(texture));
    else if ($('textured').checked && surface) object.setMap(textureOf(tint(surface)));
    for (const material of [object.material].flat()) material.needsUpdate = true;
    picture.draw();
  });
  $('shaded').addEventListener('change', () => {
    for (const part of document.querySelectorAll('.of-light')) part.hidden = !$('shaded').checked;
    picture.setShaded($('shaded').checked);
  });
  $('fly').addEventListener('change', () => {
    picture.setFlying($('fly').checked);
    explainMoves($('fly').checked);
    $('picture').focus();
  });
  $('home').addEventListener('click', () => object && picture.home());
  $('fold').addEventListener('click', () => {
    const folded = $('panel').classList.toggle('folded');
    $('fold').setAttribute('aria-expanded', String(!folded));
    picture.resize();
  });
}

/** Takes over what the page has asked for already: {address, stop, terrain, first}, or nothing. */
export function begin(asked) {
  picture.onrest = rest;
  picture.ondraw = () => {
    const hasScale = terrain && isMeasured(terrain.info) && !picture.fly.enabled;
    const isGlobe = object?.isGlobe, middle = isGlobe ? picture.globe.below : picture.orbit.target;
    drawBearings(picture.camera, hasScale ? middle : null, isGlobe);
  };
  $('exaggeration').value = givenHeight();
  listenToSun(picture);
  addEventListener('hashchange', followLink);
  listenToPointer(picture, (point) => describe(point));
  listenToControls();
  listenToFiles(openFiles, (address) => openInput(address, nameOf(address)));
  explainMoves($('fly').checked);
  if (isSmallScreen()) $('fold').click();
  const early = [...$('file').files];  // chosen while this script was on its way
  if (early.length > 0) openFiles(early);
  else if (asked) openInput(asked.address, nameOf(asked.address), asked);
  else $('welcome').hidden = false;
}
