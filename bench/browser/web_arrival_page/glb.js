// SPDX-License-Identifier: Apache-2.0
// A GLB, by three.js's loader; `prepare` gives it its decoder of meshes.
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

import {material, measure, query} from './scene.js';

export function load(prepare) {
  measure(async function* () {
    const loader = new GLTFLoader();
    prepare(loader);
    let bytes = 0;
    const {scene} = await loader.loadAsync(query.data, ({loaded}) => (bytes = loaded));
    scene.traverse((object) => {
      if (object.isMesh) object.material = material(object.material.map);
    });
    yield {bytes, rounds: 1, show: () => scene};
  });
}
