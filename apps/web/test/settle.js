// SPDX-License-Identifier: Apache-2.0
/** Shows a still camera to an object of three.js, `height` pixels high, until what `told` gives of
 * it stays the same for so many times. */
export async function settle(object, camera, {height, told, times, wait}) {
  for (let quiet = 0; quiet < times; ) {
    const before = told(object);
    object.update(camera, height);
    await new Promise((resolve) => setTimeout(resolve, wait));
    quiet = told(object) === before ? quiet + 1 : 0;
  }
}
