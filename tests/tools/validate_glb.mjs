// SPDX-License-Identifier: Apache-2.0
// Runs the Khronos glTF validator over the files named as arguments; exit code 1 if one of them has
// an error or a warning, 2 if a file is missing or the validator (npm: gltf-validator) is not
// installed. It is looked for beside this script, in the working folder, and in $NODE_PATH.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const kShownIssues = 20;

function loadValidator() {
  for (const base of [import.meta.url, join(process.cwd(), 'index.js')]) {
    try {
      return createRequire(base)('gltf-validator');
    } catch (error) {
      if (error.code !== 'MODULE_NOT_FOUND') throw error;
    }
  }
  console.error('gltf-validator is missing: npm install gltf-validator');
  process.exit(2);
}

/// The validator does not know KHR_texture_basisu, and takes its KTX2 images for no images.
function isKtx2Image(issue, info) {
  return (info.extensionsUsed ?? []).includes('KHR_texture_basisu') &&
         /^\/images\/\d+/.test(issue.pointer ?? '') &&
         ['VALUE_NOT_IN_LIST', 'IMAGE_UNRECOGNIZED_FORMAT'].includes(issue.code);
}

/// Of a map of normals without tangents: glTF says which ones programs make.
const isTangentSpace = ({ code }) => code === 'MESH_PRIMITIVE_GENERATED_TANGENT_SPACE';

async function countProblems(validator, path) {
  const bytes = new Uint8Array(await readFile(path));
  const { issues, info } = await validator.validateBytes(bytes, { uri: path });
  const problems = issues.messages.filter(
      (issue) => issue.severity <= 1 &&  // 0 error, 1 warning
          !isKtx2Image(issue, info) && !isTangentSpace(issue));
  for (const issue of problems.slice(0, kShownIssues)) {
    console.log(`${path}: ${issue.code} ${issue.pointer ?? ''} ${issue.message}`);
  }
  console.log(`${path}: ${problems.length} errors and warnings`);
  return problems.length;
}

const paths = process.argv.slice(2);
if (paths.length === 0) {
  console.error('usage: node validate_glb.mjs FILE.glb...');
  process.exit(2);
}
const validator = loadValidator();
let problems = 0;
try {
  for (const path of paths) problems += await countProblems(validator, path);
} catch (error) {
  console.error(error.message ?? String(error));
  process.exit(2);
}
process.exit(problems === 0 ? 0 : 1);
