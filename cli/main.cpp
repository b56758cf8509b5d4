// inkgrid: the program.  Reads drawings, runs the method, writes curves; everything it says of itself goes to standard error.
#include <cstdio>
#include <exception>
#include <new>
#include <optional>

#include "arguments.h"
#include "compare_command.h"
#include "export/export.h"
#include "files.h"
#include "image_io.h"
#include "jobs.h"
#include "manual.h"
#include "pipeline.h"
#include "progress.h"
#include "report_json.h"
#include "stage_pictures.h"
#include "studio/studio.h"

namespace inkgrid::cli {
namespace {

void say(const std::string& sentence) {
  std::fprintf(stderr, "inkgrid: %s\n", sentence.c_str());
}

Image read_drawing(const std::string& path) {
  return decode_image(read_bytes(path), path == "-" ? "standard input" : path);
}

std::optional<ScaleMask> read_mask(const std::string& path) {
  if (path.empty()) return std::nullopt;
  return decode_mask(read_bytes(path), path == "-" ? "standard input" : path);
}

Stages run_with_progress(const Image& image, const Options& options, const std::optional<ScaleMask>& mask) {
  Progress progress;
  Control control;
  control.mask = mask ? &*mask : nullptr;
  control.progress = [&](const char* stage, double fraction) { progress.show(stage, fraction); };
  return run_stages(image, options, control);
}

void tell(const Arguments& arguments, const Report& report) {
  if (arguments.quiet) return;
  if (arguments.options.preset == Preset::automatic && !report.preset.empty()) say(choice_text(report));
  for (const std::string& warning : report.warnings) say(warning);
}

void vectorize_file(const Arguments& arguments, const Job& job) {
  const Image image = read_drawing(job.drawing);
  const std::optional<ScaleMask> mask = read_mask(arguments.mask);
  const Stages stages = run_with_progress(image, arguments.options, mask);
  tell(arguments, stages.report);
  if (!arguments.stages.empty()) write_stage_pictures(arguments.stages, image, stages);
  if (!arguments.report.empty()) write_file(arguments.report, report_json(arguments.options, stages.report));
  write_file(job.output,
             export_drawing(stages.drawing, export_formats().front(), {}, run_description(arguments.options, stages.report)));
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
int vectorize_files(const Arguments& arguments) {
  const std::vector<Job> jobs = plan_jobs(arguments);
  for (const Job& job : jobs) check_writable(job.output);
  if (!arguments.report.empty()) check_writable(arguments.report);
  if (!arguments.stages.empty()) check_writable_directory(arguments.stages);
  int first_failure = 0;
  for (const Job& job : jobs) {
    const int code = exit_code_of([&] { vectorize_file(arguments, job); });
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
      code = vectorize_files(arguments);
  });
  return failure != 0 ? failure : code;
}

}  // namespace
}  // namespace inkgrid::cli

int main(int count, char** words) {
  inkgrid::cli::remove_temporary_on_signals();
  return inkgrid::cli::run(count, words);
}
