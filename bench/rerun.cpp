// What:   how much of a run a change of scribbles or options costs.
// Source: section 7, "User control", calls local changes future work.
// Cost:   some runs of the method for each drawing.
//
//   bench_rerun [--scribbles N] [--seed S] [--threads N] DRAWING...
//
// Seconds of the clock and of the processors.  Each scribble is drawn on ink, alone, on the drawing as it was without; "local"
// are those that were solved with their surroundings kept.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "images/image_io.h"
#include "options.h"
#include "pipeline.h"
#include "scribbles/parts.h"
#include "scribbles/scribbles.h"

namespace inkgrid {
namespace {

constexpr double kRadius = 10, kStep = 8;  // px
constexpr int kSteps = 12;
constexpr int kRepeats = 5;  // of a run and of a change of an option, of which the median counts

// Seconds.
struct Times {
  double clock, processors;

  friend Times operator-(const Times& a, const Times& b) { return {a.clock - b.clock, a.processors - b.processors}; }
};

Times now() {
  const auto read = [](clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  return {read(CLOCK_MONOTONIC), read(CLOCK_PROCESS_CPUTIME_ID)};
}

Times timed(const std::function<void()>& action) {
  const Times start = now();
  action();
  return now() - start;
}

// The one of that rank of each; both medians by default.
Times ranked(const std::vector<Times>& times, double rank = 0.5) {
  const auto of = [&](double Times::*kind) {
    std::vector<double> values;
    for (const Times& t : times) values.push_back(t.*kind);
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(rank * static_cast<double>(values.size() - 1))];
  };
  return {of(&Times::clock), of(&Times::processors)};
}

// The median of some turns, each prepared first.
Times usual_time(const std::function<void()>& prepare, const std::function<void()>& action) {
  std::vector<Times> times;
  for (int k = 0; k < kRepeats; ++k) {
    prepare();
    times.push_back(timed(action));
  }
  return ranked(times);
}

void print(const char* change, const Times& times, const Times& full) {
  std::printf("  %-18s %8.3f s  %6.3f of the run; processors %8.3f s  %6.3f", change, times.clock, times.clock / full.clock,
              times.processors, times.processors / full.processors);
}

Image read(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return decode_image(bytes, path);
}

// A winding stroke of either kind that starts on ink.
Scribble random_scribble(const Ink& ink, std::mt19937& random) {
  const auto uniform = [&](double low, double high) { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; };
  Vec2 p;
  do p = {uniform(0, ink.width()), uniform(0, ink.height())};
  while (!ink.mask(static_cast<int>(p.x), static_cast<int>(p.y)));
  Scribble scribble{random() % 2 ? ScribbleKind::less : ScribbleKind::more, kRadius, {}};
  double angle = uniform(0, 2 * std::numbers::pi);
  for (int i = 0; i < kSteps; ++i) {
    scribble.points.push_back(p);
    p += kStep * Vec2{std::cos(angle), std::sin(angle)};
    angle += uniform(-0.4, 0.4);
  }
  return scribble;
}

bool is_local(const Stages& stages) {
  return std::all_of(stages.parts.begin(), stages.parts.end(), [](const auto& part) { return part->local; });
}

void measure_scribbles(const Image& image, const Options& options, const Stages& plain, const Times& full, int count,
                       unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Times> times;
  int local = 0;
  for (int k = 0; k < count; ++k) {
    const Scribble scribble = random_scribble(plain.ink, random);
    ScaleMask mask{image.width, image.height, std::vector<float>(image.grey.size(), 1)};
    paint_scribbles(mask, {&scribble, 1});
    Control control;
    control.mask = &mask;
    Stages stages = plain;
    times.push_back(timed([&] { rerun_stages(stages, image, options, control); }));
    local += is_local(stages);
  }
  print("scribble", ranked(times), full);
  const Times longest = ranked(times, 1);
  std::printf("  (longest %.3f s, processors %.3f s; %d of %d local)\n", longest.clock, longest.processors, local, count);
}

std::string settled_text(const Stages& stages, const OptionRow& row, double factor) {
  const double value = std::stod(option_text(stages.inputs.settled, row)) * factor;
  return std::to_string(value).substr(0, row.name == "coverage-bins" ? 1 : 8);
}

// As a slider is dragged: the value is given already, and becomes another one.
void measure_options(const Image& image, const Options& options, const Stages& plain, const Times& full) {
  const std::pair<const char*, double> kChanges[] = {{"reach", 1.1}, {"spacing", 1.1}, {"coverage-bins", 2}, {"tolerance", 1.1}};
  for (const auto& [name, factor] : kChanges) {
    const OptionRow& row = option_row(name);
    Options given = options, changed = options;
    set_option(given, row, settled_text(plain, row, 1));
    set_option(changed, row, settled_text(plain, row, factor));
    Stages before = plain, stages;
    rerun_stages(before, image, given, {});
    print(name, usual_time([&] { stages = before; }, [&] { rerun_stages(stages, image, changed, {}); }), full);
    std::printf(":");
    for (const auto& [stage, seconds] : stages.report.seconds)
      if (seconds > 0.001) std::printf(" %s %.3f", stage.c_str(), seconds);
    std::printf("\n");
  }
}

void measure(const char* path, int scribbles, unsigned seed, int threads) {
  const Image image = read(path);
  Options options;
  options.threads = threads;
  Stages plain;
  const Times full = usual_time([] {}, [&] { plain = run_stages(image, options, {}); });
  std::printf("%s: %d x %d px, %d curves\n", path, image.width, image.height, plain.report.curves);
  print("the whole run", full, full);
  std::printf("\n");
  measure_scribbles(image, options, plain, full, scribbles, seed);
  measure_options(image, options, plain, full);
}

}  // namespace
}  // namespace inkgrid

int main(int argc, char** argv) {
  int scribbles = 20, threads = 1;
  unsigned seed = 1;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--scribbles" && i + 1 < argc)
        scribbles = std::max(1, std::atoi(argv[++i]));
      else if (word == "--threads" && i + 1 < argc)
        threads = std::atoi(argv[++i]);
      else if (word == "--seed" && i + 1 < argc)
        seed = static_cast<unsigned>(std::atoi(argv[++i]));
      else
        inkgrid::measure(argv[i], scribbles, seed, threads);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_rerun: %s\n", error.what());
    return 1;
  }
}
