// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/mosaic/task_list.hpp"

#include <vector>

namespace tetrakis::tools {

namespace {

std::string tileText(const tks_tile& tile) {
  return std::to_string(tile.group) + "," + std::to_string(tile.column) + "," +
         std::to_string(tile.row);
}

/// As make reads a name.
std::string escaped(const std::string& name) {
  std::string out;
  for (const char letter : name) {
    if (letter == ' ' || letter == '#' || letter == ':' || letter == '\\') out += '\\';
    if (letter == '$') out += '$';
    out += letter;
  }
  return out;
}

/// As a shell reads a word, behind make.
std::string word(const std::string& text) {
  std::string out(1, '\'');
  for (const char letter : text) {
    if (letter == '\'') out += "'\\'";
    if (letter == '$') out += '$';
    out += letter;
  }
  out += '\'';
  return out;
}

}  // namespace

Json taskJson(const WorkFolder& folder) {
  Json list = Json::array();
  for (const MosaicTask& task : folder.tasks()) {
    Json needs = Json::array(), outputs = Json::array();
    for (const tks_tile& tile : task.needs) needs.push_back(nameOf(tile));
    const std::string name = nameOf(task.tile);
    outputs.push_back(folder.file(name + ".part").string());
    if (task.leaves_low) outputs.push_back(folder.file(name + ".low").string());
    list.push_back(
        {{"id", name},
         {"group", task.tile.group},
         {"command", {"tetrakis", "mosaic", "code", folder.path(), "--tile", tileText(task.tile)}},
         {"needs", needs},
         {"outputs", outputs}});
  }
  return {{"tasks", list}};
}

std::string taskMakefile(const WorkFolder& folder) {
  const auto part = [&](const tks_tile& tile) {
    return escaped(folder.file(nameOf(tile) + ".part").string());
  };
  std::string text = "TETRAKIS ?= tetrakis\n\n.PHONY: all\nall:";
  for (const MosaicTask& task : folder.tasks()) {
    if (!task.is_last) continue;
    text += ' ';
    text += part(task.tile);
  }
  text += '\n';
  const std::string plan = escaped(folder.file("plan").string());
  for (const MosaicTask& task : folder.tasks()) {
    text += '\n';
    text += part(task.tile);
    text += ": ";
    text += plan;
    for (const tks_tile& needed : task.needs) {
      text += ' ';
      text += part(needed);
    }
    text += "\n\t$(TETRAKIS) -q mosaic code ";
    text += word(folder.path());
    text += " --tile ";
    text += tileText(task.tile);
    text += '\n';
  }
  return text;
}

}  // namespace tetrakis::tools
