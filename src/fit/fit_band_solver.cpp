#include "fit/fit_band_solver.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"

namespace inkgrid {

BandSystem::BandSystem(int count, const std::vector<std::array<int, 8>>& groups) {
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < n; ++i) first_.push_back(i);
  for (const auto& group : groups) {
    std::size_t least = n;
    for (const int unknown : group)
      if (unknown >= 0) least = std::min(least, static_cast<std::size_t>(unknown));
    for (const int unknown : group)
      if (unknown >= 0) first_[at(unknown)] = std::min(first_[at(unknown)], least);
  }
  std::size_t size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    start_.push_back(size);
    size += i + 1 - first_[i];
  }
  values_.assign(size, 0);
  right_.assign(n, 0);
}

double& BandSystem::entry(int row, int column) {
  const auto i = static_cast<std::size_t>(std::max(row, column)), j = static_cast<std::size_t>(std::min(row, column));
  return values_[start_[i] + j - first_[i]];
}

bool BandSystem::solve(std::vector<double>& solution) {
  const std::size_t n = right_.size();
  solution = right_;
  for (std::size_t i = 0; i < n; ++i) {
    double* row = &values_[start_[i]];
    for (std::size_t j = first_[i]; j <= i; ++j) {
      const double* other = &values_[start_[j]];
      double sum = row[j - first_[i]];
      for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k) sum -= row[k - first_[i]] * other[k - first_[j]];
      if (j == i && !(sum > 0)) return false;
      row[j - first_[i]] = j == i ? std::sqrt(sum) : sum / other[j - first_[j]];
    }
    for (std::size_t k = first_[i]; k < i; ++k) solution[i] -= row[k - first_[i]] * solution[k];
    solution[i] /= row[i - first_[i]];
  }
  for (std::size_t i = n; i-- > 0;) {
    const double* row = &values_[start_[i]];
    solution[i] /= row[i - first_[i]];
    for (std::size_t k = first_[i]; k < i; ++k) solution[k] -= row[k - first_[i]] * solution[i];
  }
  return true;
}

}  // namespace inkgrid
