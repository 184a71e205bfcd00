// SPDX-License-Identifier: Apache-2.0
// Tells emscripten's linker which functions a module imports from its loader.
mergeInto(LibraryManager.library, {web_degrees: () => {}, web_progress: () => {}});
