// What:   loops whose turns do not depend on each other, on several threads.
// Source: -
// Differs: -
// Cost:   that of the loop, and of starting the threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

namespace inkgrid {

// How many threads are meant: 0 stands for as many as the machine has.
inline int thread_count(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Calls work(first, last) for the ranges of at most `grain` numbers that make up 0 .. count - 1, on the calling thread and
// others. Each range must write only what is its own; then the result is the same for any number of threads.  An exception ends
// the loop and reaches the caller.
template <class Work>
void for_ranges(int threads, int count, int grain, Work work) {
  std::atomic<int> next = 0;
  std::mutex mutex;
  std::exception_ptr error;
  const auto take_ranges = [&] {
    try {
      for (int first; (first = next.fetch_add(grain)) < count;) work(first, std::min(count, first + grain));
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!error) error = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> helpers;
    const int ranges = (count + grain - 1) / grain;
    while (static_cast<int>(helpers.size()) + 1 < std::min(thread_count(threads), ranges)) helpers.emplace_back(take_ranges);
    take_ranges();
  }
  if (error) std::rethrow_exception(error);
}

// Both are called, at the same time where there are two threads; neither may write what the other reads.
template <class First, class Second>
void at_once(int threads, const First& first, const Second& second) {
  for_ranges(threads, 2, 1, [&](int begin, int end) {
    if (begin == 0) first();
    if (end == 2) second();
  });
}

// Calls work(i) for 0 .. count - 1 as for_ranges does one by one, where size(i) is largest first: what is begun last keeps
// the others waiting.
template <class Size, class Work>
void for_each_largest_first(int threads, int count, const Size& size, const Work& work) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size(a) > size(b); });
  for_ranges(threads, count, 1, [&](int first, int last) {
    for (int k = first; k < last; ++k) work(order[static_cast<std::size_t>(k)]);
  });
}

}  // namespace inkgrid
