// What:   what rounding the integers of the grid map costs: the energy of equation (4) without integers, after greedy
//         rounding, and after the local search that follows.
// Source: section 6.2, "Final optimization".
// Cost:   one run of the method for each drawing, and its map once more.
//
//   bench_rounding DRAWING...
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include "images/image_io.h"
#include "map_problems.h"
#include "pipeline.h"

namespace inkgrid {
namespace {

struct Energies {
  double relaxed = 0, greedy = 0, searched = 0;  // half of equation (4), but for a constant
};

Energies energies_of(const Stages& stages) {
  Energies sum;
  for_each_map_problem(stages, [&](const MixedIntegerProblem& problem) {
    const MixedIntegerSolution solution = solve_mixed_integer(problem);
    sum.relaxed += solution.relaxed_energy;
    sum.greedy += solution.greedy_energy;
    sum.searched += solution.energy;
  });
  return sum;
}

void measure(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const Stages stages = run_stages(decode_image(bytes, path), {}, {});
  const Energies e = energies_of(stages);
  const double greedy = e.greedy - e.relaxed, searched = e.searched - e.relaxed;
  std::printf("%-40s %6d integers  greedy +%.3f  searched +%.3f  (%.1f %% less)\n", path,
              stages.report.cut_integers + stages.report.snapping_integers, greedy, searched,
              greedy > 0 ? 100 * (1 - searched / greedy) : 0.0);
}

}  // namespace
}  // namespace inkgrid

int main(int count, char** paths) {
  try {
    for (int i = 1; i < count; ++i) inkgrid::measure(paths[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_rounding: %s\n", error.what());
    return 1;
  }
}
