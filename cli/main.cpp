// inkgrid: the program.  Reads drawings, runs the method, writes curves; everything it says of itself goes to standard error.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "arguments.h"
#include "compare_command.h"
#include "files.h"
#include "images/image_io.h"
#include "jobs.h"
#include "manual.h"
#include "pictures/stage_pictures.h"
#include "progress.h"
#include "project/project.h"
#include "report_json.h"
#include "studio/studio.h"

namespace inkgrid::cli {
namespace {

void say(const std::string& sentence) {
  std::fprintf(stderr, "inkgrid: %s\n", sentence.c_str());
}

std::string shown(const std::string& path) {
  return path == "-" ? "standard input" : path;
}

// The project, or what makes one of a drawing, with what else was given.
Project read_project(const Arguments& arguments, const Job& job) {
  Project project;
  if (arguments.project.empty())
    project.drawing = {shown(job.source), read_bytes(job.source)};
  else
    project = parse_project(read_bytes(arguments.project), shown(arguments.project));
  if (!arguments.mask.empty()) project.mask = ImageFile{shown(arguments.mask), read_bytes(arguments.mask)};
  apply_given(arguments, project.options);
  return project;
}

// Says which project is meant where a file in it is not what it should be.
template <class Action>
auto inside_project(const Arguments& arguments, Action action) {
  try {
    return action();
  } catch (const Error& error) {
    if (arguments.project.empty() || error.code() != ErrorCode::file) throw;
    throw Error(error.code(), "'" + shown(arguments.project) + "': " + error.what());
  }
}

// The stages are kept only where pictures of them are asked for.
Result run_with_progress(const Arguments& arguments, const Project& project, const Image& image) {
  Progress progress;
  Control control;
  control.progress = [&](const char* stage, double fraction) { progress.show(stage, fraction); };
  if (arguments.stages.empty()) return solve_project(project, image, control);
  Stages stages = run_project(project, image, control);
  write_stage_pictures(arguments.stages, image, stages);
  return {std::move(stages.drawing), std::move(stages.report)};
}

void tell(const Arguments& arguments, const Options& options, const Report& report) {
  if (arguments.quiet) return;
  if (options.preset == Preset::automatic && !report.preset.empty()) say(choice_text(report));
  for (const std::string& warning : report.warnings) say(warning);
}

// Nothing is written before all formats are made.
void write_outputs(const Arguments& arguments, const Job& job, const Drawing& drawing, const std::string& description) {
  std::vector<std::string> contents;
  for (const Output& output : job.outputs)
    contents.push_back(export_drawing(drawing, *output.format, arguments.export_options, description));
  for (std::size_t i = 0; i < contents.size(); ++i) write_file(job.outputs[i].path, contents[i]);
}

// Without the directories of this machine.
std::string portable_text(Project project) {
  const auto shorten = [](std::string& name) { name = std::filesystem::path(name).filename().string(); };
  shorten(project.drawing.name);
  if (project.mask) shorten(project.mask->name);
  return project_text(project);
}

void do_job(const Arguments& arguments, const Job& job) {
  const Project project = read_project(arguments, job);
  const Image image = inside_project(arguments, [&] { return project_image(project); });
  const auto [drawing, report] = inside_project(arguments, [&] { return run_with_progress(arguments, project, image); });
  tell(arguments, project.options, report);
  if (!arguments.report.empty()) write_file(arguments.report, report_json(project.options, report));
  if (!arguments.save_project.empty()) write_file(arguments.save_project, portable_text(project));
  write_outputs(arguments, job, drawing, run_description(project.options, report));
}

// The exit code of what `action` does: 0, or that of the error it ended with, told in one sentence.
template <class Action>
int exit_code_of(Action action) {
  try {
    action();
    return 0;
  } catch (const Error& error) {
    say(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    say("there is not enough memory for this drawing");
  } catch (const std::exception& error) {
    say(error.what());
  }
  return static_cast<int>(ErrorCode::numerics);
}

// Drawings after one that fails are still made; the exit code is that of the first failure.
int do_jobs(const Arguments& arguments) {
  const std::vector<Job> jobs = plan_jobs(arguments);
  for (const Job& job : jobs)
    for (const Output& output : job.outputs) check_writable(output.path);
  for (const std::string& path : {arguments.report, arguments.save_project})
    if (!path.empty()) check_writable(path);
  if (!arguments.stages.empty()) check_writable_directory(arguments.stages);
  int first_failure = 0;
  for (const Job& job : jobs) {
    const int code = exit_code_of([&] { do_job(arguments, job); });
    if (first_failure == 0) first_failure = code;
  }
  return first_failure;
}

int run(int count, const char* const* words) {
  if (count > 1 && std::string_view(words[1]) == "studio") return exit_code_of([&] { studio::run(count - 1, words + 1); });
  if (count > 1 && words[1] == kCompareCommand) return exit_code_of([&] { run_compare(count - 1, words + 1); });
  int code = 0;
  const int failure = exit_code_of([&] {
    const Arguments arguments = parse_arguments(count, words);
    if (arguments.help)
      write_file("-", help_text());
    else if (arguments.version)
      write_file("-", std::string("inkgrid ") + version() + "\n");
    else if (arguments.man)
      write_file("-", manual_page());
    else
      code = do_jobs(arguments);
  });
  return failure != 0 ? failure : code;
}

}  // namespace
}  // namespace inkgrid::cli

int main(int count, char** words) {
  inkgrid::cli::remove_temporary_on_signals();
  return inkgrid::cli::run(count, words);
}
