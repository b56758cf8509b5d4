#include "progress.h"

#include <unistd.h>

#include <cstdio>

namespace inkgrid::cli {

Progress::Progress() : on_terminal_(::isatty(STDERR_FILENO) != 0), next_(Clock::now() + std::chrono::seconds(1)) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show(const char* stage, double fraction) {
  if (!on_terminal_ || Clock::now() < next_) return;
  std::fprintf(stderr, "\rinkgrid: %s %.0f %%\033[K", stage, 100 * fraction);
  shown_ = true;
  next_ = Clock::now() + std::chrono::milliseconds(100);
}

}  // namespace inkgrid::cli
