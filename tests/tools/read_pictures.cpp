// SPDX-License-Identifier: Apache-2.0
// read_pictures: reads files as `tetrakis encode` does, without encoding them, which takes a
// hundred times as long. A line of standard input, "texture NAME" or "heights NAME", asks for a
// file; t.tif gets its samples. A line of standard output answers: the status (0 if the file was
// read) and a sentence.
#include <iostream>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {
namespace {

struct Outcome {
  Status status;
  std::string note;
};

Outcome copyTexture(const std::string& name) {
  Outcome outcome;
  Result<ImageFile> image = readImage(name, &outcome.note);
  outcome.status = image.ok() ? writeImage("t.tif", *image) : image.status();
  return outcome;
}

Outcome copyHeights(const std::string& name) {
  Notes notes;
  Result<HeightFile> heights = readHeights(name, {}, &notes);
  Outcome outcome{heights.ok() ? writeHeights("t.tif", *heights) : heights.status(), ""};
  for (const Note& note : notes) outcome.note += note.text + ' ';
  return outcome;
}

}  // namespace
}  // namespace tetrakis::tools

int main() {
  using namespace tetrakis::tools;
  for (std::string part, name; std::cin >> part >> name;) {
    const Outcome outcome = part == "texture" ? copyTexture(name) : copyHeights(name);
    std::cout << static_cast<int>(outcome.status.code()) << ' '
              << (outcome.status.ok() ? outcome.note : outcome.status.message()) << std::endl;
  }
}
