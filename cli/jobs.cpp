#include "jobs.h"

#include <filesystem>
#include <map>

#include "inkgrid/inkgrid.h"

namespace inkgrid::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorCode::usage, sentence);
}

std::string output_for(const std::string& drawing, const std::string& output) {
  std::error_code ignored;
  const bool into_directory = fs::is_directory(output, ignored);
  if (!output.empty() && !into_directory) return output;
  if (drawing == "-" && !into_directory) return "-";
  const fs::path name = drawing == "-" ? fs::path("drawing.svg") : fs::path(drawing).replace_extension(".svg");
  return into_directory ? (fs::path(output) / name.filename()).string() : name.string();
}

// One name for one file, however it is spelled.
std::string identity(const std::string& path) {
  if (path == "-") return path;
  std::error_code failed;
  const fs::path canonical = fs::weakly_canonical(path, failed);
  return failed ? path : canonical.string();
}

// Remembers the role of each file of the run, so that none has two.
class Roles {
 public:
  void read(const std::string& path, const std::string& role) { roles_.emplace(identity(path), role); }

  void write(const std::string& path, const std::string& role) {
    if (path.empty()) return;
    // Standard input and standard output are both called "-" and differ.
    const auto [known, fresh] = (path == "-" ? streams_ : roles_).emplace(identity(path), role);
    if (!fresh) refuse("'" + path + "' would be both " + known->second + " and " + role);
  }

 private:
  std::map<std::string, std::string> roles_;
  std::map<std::string, std::string> streams_;
};

void refuse_shared_files(const Arguments& arguments, const std::vector<Job>& jobs) {
  Roles roles;
  for (const Job& job : jobs)
    if (job.drawing != "-") roles.read(job.drawing, "a drawing");
  if (!arguments.mask.empty() && arguments.mask != "-") roles.read(arguments.mask, "the mask");
  for (const Job& job : jobs) roles.write(job.output, "the output of '" + job.drawing + "'");
  roles.write(arguments.report, "the report");
}

}  // namespace

std::vector<Job> plan_jobs(const Arguments& arguments) {
  if (arguments.drawings.empty()) refuse("no drawing given (see inkgrid --help)");
  std::vector<Job> jobs;
  for (const std::string& drawing : arguments.drawings) jobs.push_back({drawing, output_for(drawing, arguments.output)});
  if (jobs.size() > 1 && !(arguments.mask + arguments.report + arguments.stages).empty())
    refuse("--mask, --report and --stages go with a single drawing");
  if (arguments.mask == "-" && jobs.front().drawing == "-")
    refuse("the drawing and the mask can't both come from standard input");
  refuse_shared_files(arguments, jobs);
  return jobs;
}

}  // namespace inkgrid::cli
