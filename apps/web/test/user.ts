// SPDX-License-Identifier: Apache-2.0
// What users write in TypeScript; types.test.js has it checked, nobody runs it.
import type {Scene as Globe} from '@cesium/engine';
import {load, loadInBatches} from '@loaders.gl/core';
import {Map as WebMap, addProtocol} from 'maplibre-gl';
import {
  FIRST_FRAME, TksError, goesRound, groundAxes, groundScale, open, openLive, receive,
  type Frame, type Reception, type Sequence,
} from 'tetrakis';
import {TksTerrainProvider} from 'tetrakis/cesium';
import {TksLoader as DeckLoader, imageOf, meshOf} from 'tetrakis/deck';
import {encode, encodeObject} from 'tetrakis/encode';
import {TksProtocol} from 'tetrakis/maplibre';
import {TksLoader, textureOf, type TksObject, type TksTerrain} from 'tetrakis/three';
import {PerspectiveCamera, Scene, Vector3} from 'three';

export async function core(): Promise<Frame> {
  const {signal} = new AbortController();
  const terrain = await open('a.tks', {signal, worker: false, request: {credentials: 'include'}});
  try {
    for await (const frame of terrain.refine({triangles: 20000, bytes: 1e6, signal})) {
      console.log(frame.mesh?.triangles.length, frame.texture?.data, frame.info.heightsRmse);
    }
    const view = {clip: new Float32Array(16), width: 640, height: 480};
    const normals = terrain.info.components.find(({name, kind}) => name && kind === 'texture');
    if (normals?.taken === false) await terrain.decode({component: ['before', normals.number]});
    return await terrain.decode({...FIRST_FRAME, normals: true, view});
  } catch (error) {
    if (error instanceof TksError && error.code === 'memory') console.log(error.message);
    throw error;
  } finally {
    console.log(groundScale(terrain.info).x, groundAxes(terrain.info).down[1]);
    console.log(terrain.loaded.ranges[0], terrain.truncated, terrain.fileBytes);
    terrain.dispose();
  }
}

export async function three(scene: Scene, camera: PerspectiveCamera): Promise<void> {
  const loader = new TksLoader().setTerrainOptions({triangles: 50000}).preload();
  const terrain: TksTerrain = await loader.loadAsync('a.tks');
  terrain.addEventListener('frame', ({frame}) => console.log(frame.bytes));
  terrain.addEventListener('error', ({error}) => console.error(error.code, error.message));
  const middle: Vector3 = terrain.fit(camera, new Vector3(0, -1, -1));
  camera.position.y = terrain.heightAt(middle.x, middle.z) + 2;
  scene.add(terrain);
  terrain.update(camera, 480);
  if (terrain.frame?.texture) terrain.material.needsUpdate = textureOf(terrain.frame.texture).flipY;
}

export async function scan(scene: Scene, camera: PerspectiveCamera): Promise<void> {
  const object = await new TksLoader<TksObject>().loadAsync('scan.tks');
  object.position.copy(object.centre);
  camera.lookAt(object.fit(camera));
  scene.add(object);
  object.update(camera, 480);
  const {object: mesh, info} = await object.terrain.decode({texels: 2048, normals: true});
  console.log(info.isObject, info.objectTriangles, info.unit);
  console.log(mesh?.texcoords?.length, mesh?.centre[2]);
}

export async function maplibre(map: WebMap): Promise<void> {
  const protocol = new TksProtocol();
  addProtocol('tks', protocol.tile);
  const alps = await protocol.add('alps', 'a.tks', {project: (x, y) => [x / 1e5, y / 1e5]});
  if (alps.heights) map.addSource('dem', alps.heights);
  if (alps.texture) map.addSource('imagery', alps.texture);
  await alps.refine(map, {bytes: 2e6});
}

export async function deck(): Promise<void> {
  const mesh = await load('a.tks', DeckLoader, {tks: {origin: [8.2, 46.5], triangles: 50000}});
  for await (const batch of await loadInBatches('a.tks', DeckLoader)) console.log(batch);
  const frame = await core();
  console.log(mesh.texture?.width, meshOf(frame, {origin: [0, 0]}), imageOf(frame.texture!));
}

export async function cesium(scene: Globe): Promise<void> {
  const alps = await TksTerrainProvider.fromUrl('a.tks', {
    heightOffset: 52, bounds: [8, 46, 9, 47],
  });
  scene.terrainProvider = alps;
  if (alps.imagery) scene.imageryLayers.addImageryProvider(alps.imagery);
  await alps.refine(scene, {bytes: 2e6});
}

export async function round(): Promise<Float64Array | undefined> {
  const earth = await open('earth.tks');
  if (!goesRound(earth.info)) return undefined;
  return (await earth.decode({globe: {exaggeration: 15}, normals: true})).globe?.positions;
}

export async function played(terrain: TksTerrain): Promise<number> {
  const {clock, firstFrame, frames, times} = terrain.terrain;
  const ahead = await terrain.terrain.decode({...terrain.playing, frame: firstFrame});
  terrain.play(ahead);
  await terrain.setFrame(await terrain.terrain.at(12.5));
  console.log(times[frames - 1], clock?.epoch, ahead.number, ahead.time);
  console.log(ahead.surface?.normals?.length, terrain.number);
  return (await terrain.terrain.group(firstFrame)).endFrame;
}

export async function live(body: AsyncIterable<Uint8Array>): Promise<Sequence> {
  const sequence = await openLive({memory: 2 ** 28});
  for await (const bytes of body) {
    const frames = await sequence.append(bytes);
    if (frames > 0) await sequence.decode({frame: frames - 1, surface: true, mesh: false});
    sequence.forget(frames - 1);
  }
  return sequence;
}

export async function scoped(): Promise<number> {
  using terrain = await open(new Blob([]));
  return terrain.info.streamBytes;
}

export function coded(image: ImageData): Promise<Uint8Array> {
  const project = (x: number, y: number): [number, number] => [x / 1e5, y / 1e5];
  const heights = {data: new Int16Array(4), width: 2, height: 2, unit: 'm', spacing: 30,
    crs: 'my grid', geotransform: [0, 1, 0, 0, 0, -1], project};
  return encode({heights, texture: image, bytes: 2e5, index: true}, {progress: console.log});
}

export async function codedScan(texture: ImageData): Promise<Uint8Array> {
  const positions = new Float32Array(9), texcoords = new Float32Array(6);
  const mesh = {positions, triangles: [0, 1, 2], texcoords};
  const {stream, report} = await encodeObject({...mesh, texture, unit: 'mm', bytes: 2e4});
  console.log(report.kind, report.error, report.droppedTriangles);
  return stream;
}

export async function served(url: URL, signal: AbortSignal): Promise<Reception> {
  const reception = await receive(url, {
    signal, frame: 'newest', link: 32000, keep: 64, patience: 5000, timeout: 1000, worker: false,
    request: {headers: {Authorization: 'Bearer abc'}},
  });
  reception.want({frame: 12, triangles: 5000, view: null, link: null});
  await reception.changed({signal});
  for await (const {number, time} of reception.newest({signal, texture: false})) {
    if (number + 1 === reception.sourceFrames && time > 0 && !reception.error) break;
  }
  return reception;
}
