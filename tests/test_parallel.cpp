#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <vector>

#include "base/parallel.h"

namespace inkgrid {
namespace {

TEST(ForRanges, VisitsEachNumberOnce) {
  for (const int threads : {0, 1, 2, 5})
    for (const int count : {0, 1, 7, 100, 1001})
      for (const int grain : {1, 7, 5000}) {
        std::vector<int> visits(static_cast<std::size_t>(count), 0);
        for_ranges(threads, count, grain, [&](int first, int last) {
          EXPECT_LT(first, last);
          EXPECT_LE(last - first, grain);
          for (int i = first; i < last; ++i) ++visits[static_cast<std::size_t>(i)];
        });
        EXPECT_EQ(visits, std::vector<int>(visits.size(), 1)) << threads << ' ' << count << ' ' << grain;
      }
}

TEST(ForRanges, AnExceptionReachesTheCaller) {
  for (const int threads : {1, 3}) {
    std::atomic<int> ranges = 0;
    EXPECT_THROW(for_ranges(threads, 1000000, 1,
                            [&](int first, int) {
                              ++ranges;
                              if (first == 10) throw std::runtime_error("ten");
                            }),
                 std::runtime_error);
    EXPECT_LT(ranges, 1000000) << "goes on after it";
  }
}

TEST(ForEachLargestFirst, TakesEachOnceByFallingSizeAndThenByNumber) {
  const std::vector<int> sizes{3, 9, 3, 0, 9, 1};
  std::vector<int> order;
  for_each_largest_first(
      1, 6, [&](int i) { return sizes[static_cast<std::size_t>(i)]; }, [&](int i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<int>{1, 4, 0, 2, 5, 3}));
}

TEST(ForRanges, SeveralThreadsTakePart) {
  std::atomic<int> waiting = 0;
  // Ends only when both ranges are being worked on at the same time.
  for_ranges(2, 2, 1, [&](int, int) {
    ++waiting;
    while (waiting < 2) std::this_thread::yield();
  });
  EXPECT_EQ(waiting, 2);
}

TEST(AtOnce, CallsBothAndTellsOfExceptions) {
  for (const int threads : {1, 2}) {
    int first = 0, second = 0;
    at_once(
        threads, [&] { ++first; }, [&] { ++second; });
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 1);
    EXPECT_THROW(at_once(
                     threads, [] {}, [] { throw std::runtime_error("second"); }),
                 std::runtime_error);
  }
}

TEST(AtOnce, IsAtTheSameTime) {
  std::atomic<int> waiting = 0;
  const auto wait_for_the_other = [&] {
    ++waiting;
    while (waiting < 2) std::this_thread::yield();
  };
  at_once(2, wait_for_the_other, wait_for_the_other);
  EXPECT_EQ(waiting, 2);
}

}  // namespace
}  // namespace inkgrid
