// SPDX-License-Identifier: Apache-2.0
// make_vectors OUTDIR: encodes every vector case, writes streams into OUTDIR/vectors and sequences
// into OUTDIR/sequences, each with a manifest, and prints the rows of README.md's tables. The
// decoder under test makes the digests, so run it only when a change of the format is intended,
// and review the difference. A stream that has other tools than its vector states, or lacks one,
// is told, and no manifest is written.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "conformance/cases/stream_tools.hpp"
#include "conformance/cases/vector_cases.hpp"
#include "conformance/decode_cut.hpp"
#include "conformance/manifest.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {
namespace {

/// Of a stream that does not open: where statuses change, and every byte of its end.
std::vector<size_t> cutsOfRefused(size_t size) {
  std::vector<size_t> cuts{0, 1, 4, 5, 7, 8, 9};
  for (size_t back = 16; back-- > 0;) cuts.push_back(size - back);
  return cuts;
}

/// Around the header's end, then evenly and oddly through the payload, then everything.
std::vector<size_t> cutsOf(std::span<const uint8_t> stream, bool dense) {
  const size_t size = stream.size();
  const auto decoder = Decoder::open(stream);
  if (!decoder) return cutsOfRefused(size);
  const size_t header = static_cast<size_t>(decoder->info().header_bytes);
  std::vector<size_t> cuts{header - 1, header, header + 1, header + 7};
  const size_t parts = dense ? 96 : 8;
  const size_t least = static_cast<size_t>(decoder->info().least_bytes);
  for (size_t part = 0; least < header && part <= parts; ++part)
    cuts.push_back(least - 1 + (header - least) * part / parts);
  for (size_t part = 1; part < parts; ++part)
    cuts.push_back(header + (size - header) * part / parts);
  cuts.push_back(size - 1);
  cuts.push_back(size);
  std::erase_if(cuts, [size](size_t cut) { return cut > size; });
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

/// Within heads, streams and indices of groups.
std::vector<size_t> cutsOfSequence(size_t size) {
  std::vector<size_t> cuts;
  for (size_t part = 0; part <= 24; ++part) cuts.push_back(size * part / 24);
  cuts.push_back(size - 1);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// All mip levels of the whole stream, and every other one of three fifths of it.
void addLevels(std::span<const uint8_t> stream, Vector& vector) {
  const auto decoder = Decoder::open(stream);
  if (!decoder) return;
  const tks_info info = decoder->info();
  const int coarsest = static_cast<int>(std::max(info.coarsest_level, info.texture_coarsest_level));
  for (int level = 1; level <= coarsest; level += 2)
    vector.cuts.push_back(decodeCut(stream.first(stream.size() * 3 / 5), level));
  for (int level = 1; level <= coarsest; ++level) vector.cuts.push_back(decodeCut(stream, level));
}

/// Quarters of the stream, for each component that decoders take only if they are asked to.
void addComponents(std::span<const uint8_t> stream, Vector& vector) {
  const auto decoder = Decoder::open(stream);
  if (!decoder) return;
  const size_t header = static_cast<size_t>(decoder->info().header_bytes);
  for (uint32_t i = 0; i < decoder->info().components; ++i) {
    const tks_component one = *decoder->component(i);
    if (one.is_taken || one.kind == TKS_COMPONENT_UNKNOWN) continue;
    for (size_t part = 0; part <= 4; ++part) {
      const size_t cut = header + (stream.size() - header) * part / 4;
      vector.cuts.push_back(decodeCut(stream.first(cut), 0, i));
    }
    vector.cuts.push_back(decodeCut(stream, 1, i));
  }
}

Result<Vector> makeVector(const VectorCase& vector_case, const std::string& directory) {
  const auto stream = encodeCase(vector_case);
  if (!stream.ok()) return stream.status();
  if (Status tools = checkTools(vector_case.name, *stream); !tools.ok()) return tools;
  Vector vector{vector_case.name, vector_case.name + ".tks", vector_case.purpose, {}};
  for (const size_t cut : cutsOf(*stream, vector_case.dense))
    vector.cuts.push_back(decodeCut(std::span(*stream).first(cut)));
  addLevels(*stream, vector);
  addComponents(*stream, vector);
  const Status written =
      writeFile(directory + "/" + vector.file, std::string(stream->begin(), stream->end()));
  if (!written.ok()) return written;
  return vector;
}

Result<Vector> makeSequence(const VectorCase& vector_case, const std::string& directory) {
  const std::vector<uint8_t>& stream = vector_case.stream;
  if (stream.empty()) return Status(TKS_MISMATCH, vector_case.name + " was not encoded.");
  Vector vector{vector_case.name, vector_case.name + ".tks", vector_case.purpose, {}};
  for (const size_t cut : cutsOfSequence(stream.size()))
    vector.cuts.push_back(decodeCut(std::span(stream).first(cut)));
  for (const int level : {1, 2, 3}) vector.cuts.push_back(decodeCut(stream, level));
  const Status written =
      writeFile(directory + "/" + vector.file, std::string(stream.begin(), stream.end()));
  if (!written.ok()) return written;
  return vector;
}

/// make: makeVector() or makeSequence().
template <class Make>
Status makeAll(const std::vector<VectorCase>& cases, const std::string& directory,
               const Make& make) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) return {TKS_IO, "Cannot make '" + directory + "': " + error.message() + "."};
  std::vector<Vector> vectors;
  Status failed;
  for (const VectorCase& vector_case : cases) {
    auto vector = make(vector_case, directory);
    if (!vector.ok()) {
      failed = vector.status();
      std::cerr << failed.message() << "\n";
      continue;
    }
    std::cout << "| `" << vector->name << "` | " << vector->cuts.back().bytes << " | "
              << vector->purpose << " |\n";
    vectors.push_back(std::move(*vector));
  }
  return failed.ok() ? writeManifest(directory, vectors) : failed;
}

Status makeVectors(const std::string& directory) {
  Status status = makeAll(vectorCases(), directory + "/vectors", makeVector);
  if (!status.ok()) return status;
  return makeAll(sequenceCases(), directory + "/sequences", makeSequence);
}

}  // namespace
}  // namespace tetrakis::conformance

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::cerr << "usage: make_vectors OUTDIR\n";
    return TKS_USAGE;
  }
  const tetrakis::Status status = tetrakis::conformance::makeVectors(argv[1]);
  if (!status.ok()) std::cerr << "make_vectors: " << status.message() << "\n";
  return status.code();
}
