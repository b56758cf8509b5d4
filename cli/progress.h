// What:   one line on a terminal that says how far a long run is.
// Cost:   a question to the clock a call.
#pragma once

#include <chrono>

namespace inkgrid::cli {

// Silent in the first second, and where standard error is no terminal.  Wipes its line when it is destroyed.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const char* stage, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  bool on_terminal_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace inkgrid::cli
