// SPDX-License-Identifier: Apache-2.0
// Grids that go round the Earth, or do not, and a world to put on a cube, for the command line.
#pragma once

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {

using Json = nlohmann::json;

class CliDomain : public CliTest {
 protected:
  tools::HeightFile ground(uint32_t width, double west, double degrees, const char* crs) {
    tools::HeightFile file;
    file.width = width;
    file.height = 3;
    file.sample = TKS_I16;
    file.crs = crs;
    file.geotransform = tools::GeoTransform{west, degrees, 0, 60, 0, -degrees};
    for (uint32_t i = 0; i < 3 * width; ++i) appendSample(file, static_cast<uint16_t>(i % 17));
    return file;
  }
  Outcome encode(const tools::HeightFile& file, const std::string& options = "") {
    EXPECT_TRUE(tools::writeHeights(path("g.tif"), file).ok());
    return cli("encode g.tif --lossless -f -o s.tks" + options);
  }
  std::string domainOf(const char* part = "heights") {
    return Json::parse(cli("info --json s.tks").out)[part]["domain"];
  }
};

class CliCube : public CliDomain {
 protected:
  CliCube() {
    world_.width = 72;
    world_.height = 36;
    world_.sample = TKS_I16;
    world_.crs = "EPSG:4326";
    world_.unit = "m";
    world_.geotransform = tools::GeoTransform{-180, 5, 0, 90, 0, -5};
    for (uint32_t i = 0; i < 72 * 36; ++i)
      appendSample(world_, static_cast<uint16_t>(1000 * std::sin((i / 72 + 0.5) * 0.0872664626) *
                                                     std::cos(i % 72 * 0.0872664626) +
                                                 2000));
  }
  Outcome encodeCube(const std::string& options) {
    EXPECT_TRUE(tools::writeHeights(path("g.tif"), world_).ok());
    const bool other = options.find("--domain") != std::string::npos;
    return cli(std::string("encode g.tif -f -o s.tks") + (other ? "" : " --domain cube") + options);
  }
  tools::HeightFile decoded(const std::string& options = "") {
    EXPECT_EQ(cli("decode s.tks -f --height d.tif" + options).code, 0);
    return *tools::readHeights(path("d.tif"));
  }
  int sampleOf(const tools::HeightFile& file, size_t i) {
    int16_t sample = 0;
    std::memcpy(&sample, file.data.data() + i * sizeof sample, sizeof sample);
    return sample;
  }

  tools::HeightFile world_;
};

}  // namespace tetrakis::test
