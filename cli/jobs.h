// What:   which file becomes which, and whether the command line contradicts itself.
// Cost:   a few questions to the file system.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"

namespace inkgrid::cli {

struct Output {
  std::string path;  // "-" is standard output
  const ExportFormat* format;
};

struct Job {
  std::string source;  // a drawing or a project; "-" is standard input
  std::vector<Output> outputs;
};

// One job a drawing, or one for the project.  Throws Error{usage} when there is neither, two files of the run are one, or an
// extension names no format.
std::vector<Job> plan_jobs(const Arguments& arguments);

}  // namespace inkgrid::cli
