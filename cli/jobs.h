// What:   which file becomes which, and whether the command line contradicts itself.
// Cost:   a few questions to the file system.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"

namespace inkgrid::cli {

struct Job {
  std::string drawing;  // "-" is standard input
  std::string output;   // "-" is standard output
};

// One job a drawing.  Throws Error{usage} when there is no drawing, or two files of the run are one.
std::vector<Job> plan_jobs(const Arguments& arguments);

}  // namespace inkgrid::cli
