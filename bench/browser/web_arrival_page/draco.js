// SPDX-License-Identifier: Apache-2.0
import {DRACOLoader} from 'three/addons/loaders/DRACOLoader.js';

import {load} from './glb.js';
import {query} from './scene.js';

load((loader) => {
  const draco = new DRACOLoader().setDecoderPath(query.draco);
  draco.preload();
  loader.setDRACOLoader(draco);
});
