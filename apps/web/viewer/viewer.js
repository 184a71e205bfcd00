// SPDX-License-Identifier: Apache-2.0
// Opens a stream (of start.js, a drop, a file), has it refined, and listens to the panel.
import {MeshLambertMaterial} from 'three';

import {goesRound} from '../src/index.js';
import {TksTerrain, textureOf} from '../src/three.js';
import {nameOf} from './address.js';
import {drawBearings} from './bearings.js';
import {followLink, givenHeight, keepLook} from './camera_link.js';
import {encodedFile, inputOf, isStream} from './coding.js';
import {Comparison} from './comparison.js';
import {FetchMap} from './fetch_map.js';
import {listenToFiles} from './files.js';
import {Globe} from './globe.js';
import {globeDescriber} from './globe_pointer.js';
import {exaggerationOf, globeFor, keepFlat} from './globe_view.js';
import {LiveEdge} from './live_edge.js';
import {listenToLooks, setWireframe} from './looks.js';
import {ViewedObject, hideControls, isInMetres, objectDescriber} from './object_view.js';
import {addressOf, opened} from './opening.js';
import {$, entitle, explainMoves, freeArea, isSmallScreen, tell} from './page.js';
import {decodePlayed, drawPlayed} from './played.js';
import {describer, listenToPointer} from './pointer.js';
import {emptiness, readOut, sizeOf} from './read_out.js';
import {Refiner} from './refiner.js';
import {listenToSaves, offer} from './saving.js';
import {Picture} from './scene.js';
import {readSliders, setSliders} from './sliders.js';
import {listenToSun} from './sun.js';
import {Timeline} from './timeline.js';
import {tinted} from './tint.js';
import {say} from './values.js';
import {Visits} from './visits.js';

const STILL = matchMedia('(prefers-reduced-motion: reduce)');

const picture = new Picture($('picture'), freeArea);
const comparison = new Comparison(picture);
const refiner = new Refiner(picture, {show, fail, signal: () => opening.signal});
const visits = new Visits(picture, () => (object?.frame ? {object, info: terrain.info} : null));
const map = new FetchMap($('fetched'), $('ground'));
const timeline = new Timeline({
  decode: (asked) => decodePlayed({terrain, object}, asked),
  show: showPlayed, fail, onplay: () => refiner.hold(), onrest: restFrame,
});

const edge = new LiveEdge(timeline, (error) => tell(error.message, true));

let terrain = null, object = null;
let opening = new AbortController();
/** What the page calls the terrain that it shows: {name, title, size}. */
let called = null;
/** What it calls nothing. */
const NOTHING = {name: 'Tetrakis', title: 'Tetrakis', size: ''};
/** Opens the terrain that is shown once more. */
let reopen = () => {};
/** The text of a point of the terrain. */
let describe = () => '';

const describerOf = ({isGlobe, isObject}) =>
  (isGlobe ? globeDescriber : isObject ? objectDescriber : describer);

function show(frame) {
  const first = object.frame === null, {surface} = frame;
  object.show(frame, {glide: !STILL.matches});
  if (surface && $('textured').checked) object.setMap(textureOf(tinted(terrain, surface)));
  if (object.isGlobe) picture.globe.keepAbove(object.radius);
  if (first) {
    timeline.reveal();
    exaggerate();
    picture.home();
    $('bearings').hidden = false;
    if (!followLink(picture)) visits.follow();
    if (object.isObject) setWanted();  // the texels that are seen
  }
  const empty = emptiness(frame);
  if (empty) tell(`${empty}: there is nothing to draw.`, true);
  drawShown(frame);
}
/** What the page says of the frame that is shown, and its picture. */
function drawShown(frame) {
  readOut(object.frame, terrain.loaded);
  describe = describerOf(object)(frame.info, object);
  map.draw();
  Object.assign(document.body.dataset, {bytes: frame.bytes, frame: frame.number});
  picture.draw();
}

function showPlayed(frame) {
  drawPlayed({terrain, object}, frame);
  refiner.took(frame);
  drawShown(frame);
}
const keep = () => keepLook(picture, Number($('exaggeration').value), timeline.kept);
/** Where a frame stays, it is refined, and the address keeps it. */
function restFrame() {
  refiner.release();
  keep();
  setWanted();
}

function fail(error) {
  $('coding').hidden = true;
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
  if (terrain && !refiner.isShown) refiner.pump();
}

function setWanted() {
  if (!terrain || timeline.isPlaying) return;
  const height = object.isGlobe ? $('exaggeration').value : 0;  // flat ground is stretched as it is
  refiner.want({...readSliders(terrain.info), height, frame: timeline.number});
}
/** Where the camera rests, the address keeps it, and other bytes may help. */
function rest() {
  if (object?.frame) {
    keep();
    edge.look(object, picture);
  }
  if (object?.isObject) setWanted();
  else refiner.replan();
}
/** Whether a metre of what is shown is known. */
const isMeasured = (info) => (info.isObject ? isInMetres(info)
  : info.hasHeights && (info.spacingX > 0 || info.hasGeotransform));

/** Sliders and switches for what was opened. */
function prepareControls(info) {
  $('panel').hidden = false;
  picture.resize();
  setSliders(info);
  const {hasHeights, hasTexture, isObject} = info;
  const isPresent = {heights: hasHeights, texture: hasTexture, mesh: hasHeights || isObject};
  for (const [part, present] of Object.entries(isPresent)) {
    for (const control of document.querySelectorAll(`.of-${part}`)) control.hidden = !present;
  }
  $('round').hidden = !goesRound(info);
  $('globe').checked = $('fly').parentElement.hidden = object.isGlobe ?? false;
  if (object.isGlobe && $('fly').checked) $('fly').click();
  hideControls(info);
  $('textured-name').textContent = info.hasTexture ? 'Texture' : 'Colours';
  visits.prepare(object, info);
}

/** What draws a stream in the scene. */
function drawnOf(opened) {
  if (opened.info.isObject) return new ViewedObject(opened);
  const material = new MeshLambertMaterial();
  return globeFor(opened.info) ? new Globe(opened, material) : new TksTerrain(opened, {material});
}

/** Ends what was being opened, for something else. */
function beginOpening(stop, names) {
  opening.abort();
  opening = stop;
  tell('');
  $('welcome').hidden = $('coding').hidden = true;
  entitle(names);
  document.body.dataset.state = 'busy';
}

/** `asked`: {stop, terrain, first} of an open() that is under way already, and its first frame. */
async function openInput(input, name, asked, original = null) {
  const stop = asked?.stop ?? new AbortController(), {signal} = stop;
  const title = `${name} – Tetrakis`;
  beginOpening(stop, {name, title, size: 'opening …'});
  try {
    const its = await (asked?.terrain ?? opened(input, {signal}));
    if (signal.aborted) return its.dispose();
    terrain = its;
    map.show(terrain);
    object = drawnOf(terrain);
    setWireframe(object);
    picture.setObject(object);
    const isFlat = !object.isGlobe && !object.isObject;
    comparison.of(isFlat ? original : null, terrain.info);
    $('save').hidden = true;
    prepareControls(terrain.info);
    timeline.begin(terrain);
    refiner.release();
    refiner.begin({terrain, object, first: asked?.first});
    edge.begin(terrain, signal);
    reopen = () => openInput(input, name, null, original);
    called = {name, title, size: sizeOf(terrain.info)};
    entitle(called);
    setWanted();
    if (asked && isFlat) comparison.ofLink(terrain.info, () => terrain === its);
  } catch (error) {
    if (!signal.aborted) failToOpen(error);
  }
}

/** Ends what is being coded. */
function cancel() {
  beginOpening(new AbortController(), called ?? NOTHING);
  $('welcome').hidden = called !== null;
  document.body.dataset.state = 'done';
  if (terrain && !refiner.isShown) refiner.pump();
}

/** Codes heights and an image, or a mesh, which then are what is open. */
async function openSources(files) {
  const stop = new AbortController(), {signal} = stop;
  const name = files.map((file) => file.name).join(' + ');
  beginOpening(stop, {name, title: document.title, size: 'reading …'});
  try {
    const input = await inputOf(files);
    if (signal.aborted) return;
    $('coding').hidden = false;
    const progress = (done) => {
      $('progress').value = done;
      $('size').textContent = `encoding … ${Math.round(100 * done)} %`;
    };
    progress(0);
    const {file, remark} = await encodedFile(input, files[0].name, {signal, progress});
    if (signal.aborted) return;
    await openInput(file, file.name, null, input);
    offer(file);
    if (remark) tell(`${name}: ${remark}.`, true);
  } catch (error) {
    if (!signal.aborted) failToOpen(error);
  }
}

/** A stream, or what can be coded into one. */
async function openFiles(files) {
  const streams = [];
  for (const file of files) if (await isStream(file)) streams.push(file);
  if (streams.length === 0 && files.length > 0) openSources(files);
  else if (files.length === 1) openInput(files[0], files[0].name);
  else if (files.length > 1) {
    failToOpen(new Error(`${streams[0].name} is a stream, which is opened alone. What can be ` +
      'dropped together is a GeoTIFF of heights, or a mesh, and an image over it.'));
  }
}

/** What is higher than wide, often because it states no unit or a wrong one, is flattened. */
function exaggerate() {
  if (!object?.frame) return;
  if (object.isObject) return picture.setExaggeration(1);
  const {tallness} = picture, usual = tallness > 1 ? 1 / (8 * tallness) : 1;
  const {value} = $('exaggeration');
  const times = object.isGlobe ? exaggerationOf(value, terrain.info) : usual * 10 ** (value / 20);
  const text = times.toPrecision(2);
  say('exaggeration', `× ${text}`, `drawn ${text} times as high`);
  if (object.isGlobe) return setWanted();
  picture.setExaggeration(times);
}

function listenToControls() {
  $('bytes').addEventListener('input', setWanted);
  $('triangles').addEventListener('input', setWanted);
  $('exaggeration').addEventListener('input', () => {
    exaggerate();
    rest();
  });
  $('north').addEventListener('click', () => object && picture.faceNorth());
  listenToSaves(() => ({object, terrain, bytes: refiner.shown.bytes, frame: timeline.number,
    name: called.name}));
  $('globe').addEventListener('change', () => {
    keepFlat(!$('globe').checked);
    reopen();
  });
  $('home').addEventListener('click', () => object && picture.home());
  $('cancel').addEventListener('click', cancel);
  $('fold').addEventListener('click', () => {
    const folded = $('panel').classList.toggle('folded');
    $('fold').setAttribute('aria-expanded', String(!folded));
    picture.resize();
  });
}

/** Takes over what the page has asked for already: {input, stop, terrain, first}, or nothing. */
export function begin(asked) {
  picture.onrest = rest;
  picture.ondraw = () => {
    const hasScale = terrain && isMeasured(terrain.info) && !picture.fly.enabled;
    const isGlobe = object?.isGlobe, middle = isGlobe ? picture.globe.below : picture.orbit.target;
    drawBearings(picture.camera, hasScale ? middle : null, isGlobe);
  };
  $('exaggeration').value = givenHeight();
  listenToSun(picture);
  addEventListener('hashchange', () => {
    if (object?.frame) followLink(picture);
    timeline.followLink();
  });
  listenToPointer(picture, (point) => describe(point));
  listenToControls();
  listenToLooks(picture, () => object);
  listenToFiles(openFiles, (address) => openInput(address, nameOf(address)));
  explainMoves($('fly').checked);
  if (isSmallScreen()) $('fold').click();
  const early = [...$('file').files];  // chosen while this script was on its way
  if (early.length > 0) openFiles(early);
  else if (asked) openInput(asked.input, nameOf(addressOf(asked.input)), asked);
  else $('welcome').hidden = false;
}
