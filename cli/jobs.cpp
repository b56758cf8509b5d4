#include "jobs.h"

#include <cctype>
#include <filesystem>
#include <map>

#include "inkgrid/inkgrid.h"

namespace inkgrid::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorCode::usage, sentence);
}

// By the extension, where there is one.
const ExportFormat& format_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  if (extension.empty()) return export_formats().front();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const ExportFormat& format : export_formats())
    if ("." + std::string(format.name) == extension) return format;
  refuse("the extension of '" + path + "' is none of " + export_format_names() + "; --format says which of them to write");
}

// `given`: the format that was asked for, or none.
Output output_for(const std::string& source, const std::string& output, const ExportFormat* given) {
  std::error_code ignored;
  const bool into_directory = fs::is_directory(output, ignored);
  const ExportFormat& by_default = given ? *given : export_formats().front();
  if (!into_directory && !output.empty()) return {output, given || output == "-" ? &by_default : &format_of(output)};
  if (!into_directory && source == "-") return {"-", &by_default};
  const fs::path name = fs::path(source == "-" ? "drawing" : source).replace_extension(by_default.name);
  return {into_directory ? (fs::path(output) / name.filename()).string() : name.string(), &by_default};
}

std::vector<Output> outputs_for(const std::string& source, const Arguments& arguments) {
  const ExportFormat* given = arguments.format.empty() ? nullptr : &export_format(arguments.format);
  if (arguments.outputs.empty()) return {output_for(source, "", given)};
  std::vector<Output> outputs;
  for (const std::string& output : arguments.outputs) outputs.push_back(output_for(source, output, given));
  return outputs;
}

// One name for one file, however it is spelled.
std::string identity(const std::string& path) {
  if (path == "-") return path;
  std::error_code failed;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path, failed), failed);
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
  const std::string role = arguments.project.empty() ? "a drawing" : "the project";
  for (const Job& job : jobs)
    if (job.source != "-") roles.read(job.source, role);
  if (!arguments.mask.empty() && arguments.mask != "-") roles.read(arguments.mask, "the mask");
  for (const Job& job : jobs)
    for (const Output& output : job.outputs) roles.write(output.path, "the output of '" + job.source + "'");
  roles.write(arguments.report, "the report");
  roles.write(arguments.save_project, "the saved project");
  roles.write(arguments.stages, "the directory of the stages");
}

std::vector<std::string> sources_of(const Arguments& arguments) {
  if (arguments.project.empty()) {
    if (arguments.drawings.empty()) refuse("no drawing given (see inkgrid --help)");
    return arguments.drawings;
  }
  if (!arguments.drawings.empty()) refuse("--project holds its own drawing: it goes without another");
  return {arguments.project};
}

}  // namespace

std::vector<Job> plan_jobs(const Arguments& arguments) {
  std::vector<Job> jobs;
  for (const std::string& source : sources_of(arguments)) jobs.push_back({source, outputs_for(source, arguments)});
  if (jobs.size() > 1 && !(arguments.mask + arguments.report + arguments.stages + arguments.save_project).empty())
    refuse("--mask, --report, --stages and --save-project go with a single drawing");
  if (arguments.mask == "-" && jobs.front().source == "-") refuse("the drawing and the mask can't both come from standard input");
  refuse_shared_files(arguments, jobs);
  return jobs;
}

}  // namespace inkgrid::cli
