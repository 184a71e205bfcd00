// SPDX-License-Identifier: Apache-2.0
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';

import {load} from './glb.js';

load((loader) => loader.setMeshoptDecoder(MeshoptDecoder));
