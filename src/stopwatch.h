// What:   the seconds of each stage of a run, its progress, and a place to stop.
// Source: ours.
// Differs: nothing.
// Cost:   nothing.
#pragma once

#include <chrono>
#include <utility>

#include "inkgrid/inkgrid.h"

namespace inkgrid {

class Stopwatch {
 public:
  Stopwatch(const Control& control, Report& report) : control_(control), report_(report) {}

  template <class Stage>
  auto operator()(const char* name, double done, Stage stage) {
    if (control_.stop.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
    if (control_.progress) control_.progress(name, done);
    const auto start = std::chrono::steady_clock::now();
    auto result = stage();
    report_.seconds.emplace_back(name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return result;
  }

 private:
  const Control& control_;
  Report& report_;
};

// A control whose progress fills the stretch between two fractions of the whole.
inline Control part_of(const Control& control, double from, double to) {
  Control part = control;
  if (control.progress)
    part.progress = [&control, from, to](const char* stage, double fraction) {
      control.progress(stage, from + fraction * (to - from));
    };
  return part;
}

}  // namespace inkgrid
