// SPDX-License-Identifier: Apache-2.0
// What is chosen, typed or dropped on the page.
import {$} from './page.js';

/** Files go to openFiles(), an address to openAddress(). */
export function listenToFiles(openFiles, openAddress) {
  for (const id of ['another', 'choose']) $(id).addEventListener('click', () => $('file').click());
  $('file').addEventListener('change', () => {
    openFiles([...$('file').files]);
  });
  $('address').addEventListener('submit', (event) => {
    event.preventDefault();
    openAddress(new FormData(event.target).get('url'));
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
