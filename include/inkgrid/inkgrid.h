// inkgrid: line drawings to networks of vector centre-line curves.
// "Integer-Grid Sketch Simplification and Vectorization", Stanko et al., SGP 2020, and what this library adds (docs/METHOD.md).
#pragma once

#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "inkgrid/drawing.h"
#include "inkgrid/image.h"
#include "inkgrid/options.h"
#include "inkgrid/report.h"

namespace inkgrid {

// "MAJOR.MINOR.PATCH".
const char* version();

enum class ErrorCode { usage = 1, file = 2, numerics = 3, cancelled = 4 };

// The only exception type that leaves the library; what() is one sentence for a person.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

// What steers one run besides its options.
struct Control {
  const ScaleMask* mask = nullptr;                              // scribbles, of the image's size; none: no local scaling
  std::stop_token stop;                                         // asked between and inside the slow stages: Error{cancelled}
  std::function<void(const char*, double)> progress = nullptr;  // (stage, fraction 0..1), called from the calling thread
};

struct Result {
  Drawing drawing;
  Report report;
};

// The whole method.  Throws Error{usage} for an empty image, a mask of another size or options out of range, Error{numerics}
// where no result exists.  Blank paper gives an empty drawing and a warning in the report.  Deterministic for any thread count.
Result vectorize(const Image& image, const Options& options = {}, const Control& control = {});

}  // namespace inkgrid
