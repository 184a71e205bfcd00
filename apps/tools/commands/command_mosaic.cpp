// SPDX-License-Identifier: Apache-2.0
// tetrakis mosaic: heights that no machine holds, tile by tile. Each verb below it does one step in
// a folder that all workers share: plan, code, tasks, status, merge, verify; join does all of them.
#include <memory>
#include <string>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/positive.hpp"
#include "apps/tools/mosaic/mosaic_steps.hpp"
#include "apps/tools/mosaic/task_list.hpp"

namespace tetrakis::tools {
namespace {

void tellNotes(const PlanRequest& request, const Notes& notes, bool quiet) {
  for (const Note& note : notes)
    tellNote(quoted(request.sources.front()) + ": " + note.text, quiet);
}

Status planAndTell(const PlanRequest& request, bool quiet) {
  Notes notes;
  const Status status = planMosaic(request, request.output, notes);
  tellNotes(request, notes, quiet);
  return status;
}

Status joinAndTell(const JoinRequest& request, bool quiet) {
  Notes notes;
  const Status status = joinMosaic(request, notes, quiet);
  tellNotes(request.plan, notes, quiet);
  return status;
}

struct TasksRequest {
  std::string work;
  bool make = false, json = false;
};

Status listTasks(const TasksRequest& request) {
  const Result<WorkFolder> folder = WorkFolder::open(request.work);
  if (!folder.ok()) return folder.status();
  if (request.make) return print(taskMakefile(*folder));
  if (request.json) return print(dump(taskJson(*folder)));
  std::string lines;
  for (const MosaicTask& task : folder->tasks()) lines += nameOf(task.tile) + "\n";
  return print(lines);
}

void addWork(CLI::App& verb, std::string& work) {
  verb.add_option("WORK", work, "The folder that all workers share")->required()->type_name("");
}

void addPlanOptions(CLI::App& verb, PlanRequest& given) {
  PlanRequest* const request = &given;
  verb.add_option("SOURCE", request->sources,
                  "A TIFF, FILE.raw:WIDTHxHEIGHT:TYPE, a folder of .tif or .hgt files on one grid, "
                  "or several such files")
      ->required()
      ->type_name("");
  CLI::Option_group& target = *verb.add_option_group("target");
  target.require_option(1);
  target.add_flag("--lossless", request->lossless, "Every sample");
  target.add_option("--max-error", request->max_error, "Every height within that: 0.5, 0.5m, 2ft")
      ->type_name("L");
  addSize(target, "--bytes", request->bytes, "At most so many bytes: 65536, 64k, 1M");
  target.add_option("--psnr", request->psnr, "Heights of that quality, in dB")
      ->check(finite())
      ->type_name("dB");
  verb.add_option("--tile", request->tile, "Side of a tile, in samples (4096)")
      ->check(wholeNumber())
      ->type_name("N");
  verb.add_option("--regions", request->regions, "Side of a region, in samples (512)")
      ->check(wholeNumber())
      ->type_name("N");
  verb.add_option("--step", request->step, "Step of the samples; else it is found")
      ->check(finite())
      ->type_name("S");
  verb.add_option("--nodata", request->nodata, "Sample value of voids")
      ->check(anyNumber())
      ->type_name("V");
  verb.add_option("--unit", request->unit, "Unit of the heights")->type_name("TEXT");
  verb.add_option("--crs", request->crs, "Reference system, as EPSG:CODE or WKT")
      ->type_name("TEXT");
  verb.add_option("--vertical-datum", request->vertical_datum, "Vertical datum")->type_name("TEXT");
}

void addPlanVerb(CLI::App& mosaic, CommandLine& line) {
  const auto request = std::make_shared<PlanRequest>();
  CLI::App& verb = *mosaic.add_subcommand("plan", "Read the source once, and make the plan");
  addPlanOptions(verb, *request);
  verb.add_option("-o,--output", request->output, "The folder that all workers share")
      ->required()
      ->type_name("WORK");
  verb.add_flag("-f,--force", request->force, "Plan a mosaic again that WORK holds already");
  verb.callback([request, &line] {
    line.action = [request, &line] { return planAndTell(*request, line.quiet); };
  });
}

void addCodeVerb(CLI::App& mosaic, CommandLine& line) {
  const auto request = std::make_shared<CodeRequest>();
  request->threads = hardwareThreads();
  CLI::App& verb = *mosaic.add_subcommand("code", "Run the tasks that are not done yet");
  addWork(verb, request->work);
  verb.add_option("--tile", request->tile, "One task alone")->type_name("G,X,Y");
  verb.add_option("--group", request->group, "Tasks of one group; each needs the one before")
      ->check(wholeNumber())
      ->type_name("G");
  verb.add_option("--part", request->part, "Every N-th of them: of N workers the I-th")
      ->type_name("I/N");
  verb.add_option("--threads", request->threads, "Threads of a task")
      ->check(wholeNumber())
      ->type_name("N");
  verb.callback([request, &line] {
    line.action = [request, &line] { return codeMosaic(*request, line.quiet); };
  });
}

void addTasksVerb(CLI::App& mosaic, CommandLine& line) {
  const auto request = std::make_shared<TasksRequest>();
  CLI::App& verb = *mosaic.add_subcommand("tasks", "List the tasks, for engines");
  addWork(verb, request->work);
  CLI::Option* const make = verb.add_flag("--make", request->make, "As rules for make");
  verb.add_flag("--json", request->json, "With commands, needs and outputs")->excludes(make);
  verb.callback([request, &line] { line.action = [request] { return listTasks(*request); }; });
}

struct StatusRequest {
  std::string work;
  bool json = false;
};

void addStatusVerb(CLI::App& mosaic, CommandLine& line) {
  const auto request = std::make_shared<StatusRequest>();
  CLI::App& verb = *mosaic.add_subcommand("status", "Show what is done and what is left");
  addWork(verb, request->work);
  verb.add_flag("--json", request->json, "For programs, with the names of what is left");
  verb.callback([request, &line] {
    line.action = [request] { return showMosaic(request->work, request->json); };
  });
}

void addLayout(CLI::App& verb, LayoutRequest& layout) {
  verb.add_option("--layout", layout.layout,
                  "How bytes lie: progressive (the best prefixes), windows (each region in one "
                  "piece), or mixed: a preview of the first kind, the rest of the second")
      ->check(silent(CLI::IsMember({"progressive", "windows", "mixed"})))
      ->type_name("NAME");
  addSize(verb, "--preview", layout.preview, "Of mixed: so many bytes; a tenth of the stream")
      ->check(positive());
}

void addMergeVerb(CLI::App& mosaic, CommandLine& line) {
  const auto request = std::make_shared<MergeRequest>();
  CLI::App& verb = *mosaic.add_subcommand("merge", "Join all parts into a stream");
  addWork(verb, request->work);
  verb.add_option("-o,--output", request->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  addLayout(verb, request->layout);
  addForce(verb, request->force);
  verb.callback([request, &line] { line.action = [request] { return mergeMosaic(*request); }; });
}

void addJoinVerb(CLI::App& mosaic, CommandLine& line) {
  const auto request = std::make_shared<JoinRequest>();
  request->threads = hardwareThreads();
  CLI::App& verb = *mosaic.add_subcommand(
      "join", "Plan, code and merge at once: files, or streams that adjoin, become one plane");
  addPlanOptions(verb, request->plan);
  verb.add_option("-o,--output", request->plan.output, "Where to write")
      ->required()
      ->type_name("OUT.tks");
  verb.add_option("--threads", request->threads, "Threads of a task")
      ->check(wholeNumber())
      ->type_name("N");
  addLayout(verb, request->layout);
  addForce(verb, request->plan.force);
  verb.callback([request, &line] {
    line.action = [request, &line] { return joinAndTell(*request, line.quiet); };
  });
}

void addVerifyVerb(CLI::App& mosaic, CommandLine& line) {
  const auto request = std::make_shared<VerifyRequest>();
  CLI::App& verb =
      *mosaic.add_subcommand("verify", "Compare every sample of a stream with the source");
  addWork(verb, request->work);
  verb.add_option("IN.tks", request->stream, "The merged stream")->required()->type_name("");
  verb.add_option("--part", request->part, "Every N-th tile: of N workers the I-th")
      ->type_name("I/N");
  verb.callback([request, &line] {
    line.action = [request, &line] { return verifyMosaic(*request, line.quiet); };
  });
}

}  // namespace

void addMosaic(CLI::App& app, CommandLine& line) {
  CLI::App& mosaic =
      *app.add_subcommand("mosaic", "Encode heights that no machine holds, tile by tile");
  mosaic.require_subcommand(1);
  addPlanVerb(mosaic, line);
  addCodeVerb(mosaic, line);
  addTasksVerb(mosaic, line);
  addStatusVerb(mosaic, line);
  addMergeVerb(mosaic, line);
  addVerifyVerb(mosaic, line);
  addJoinVerb(mosaic, line);
}

}  // namespace tetrakis::tools
