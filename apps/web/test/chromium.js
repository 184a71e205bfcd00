// SPDX-License-Identifier: Apache-2.0
// Headless Chromium whose page is used by one test after the other: a new page would take seconds
// to start a process and to compile scripts, modules and shaders anew.
import {chromium} from 'playwright-core';

/** As a new page is: nothing listens, nothing is asked for, the pointer lies in a corner. */
async function emptied(page) {
  page.removeAllListeners();
  await page.unrouteAll();
  await page.emulateMedia({reducedMotion: null});
  await page.mouse.move(0, 0);
  await page.goto('about:blank');
  return page;
}

/** `viewport`: of pages that are told no other. */
export async function launch(viewport = {width: 1000, height: 600}) {
  const browser =
    await chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
  let idle = null;
  return {
    /** A page of its own, with Playwright's options; the caller closes it. */
    newPage: (options) => browser.newPage({viewport, ...options}),
    /** Calls use(page) with an empty page, which another test may have used; one of its own if
     * there are `options`, or after a failure. */
    async withPage(use, options) {
      const page = (options ? null : idle) ?? await this.newPage(options);
      let isKept = false;
      if (page === idle) idle = null;
      try {
        const result = await use(page);
        if (!options && !idle) {
          idle = await emptied(page);
          isKept = true;
        }
        return result;
      } finally {
        if (!isKept) await page.close();
      }
    },
    close: () => browser.close(),
  };
}
