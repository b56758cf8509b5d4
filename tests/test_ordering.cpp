#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "numerics/ordering.h"

namespace inkgrid {
namespace {

struct Graph {
  std::vector<int> starts{0};
  std::vector<int> rows;
};

// A strip of squares: node x + length * y, so that the numbering itself fills the whole bandwidth.
Graph strip(int length, int height) {
  Graph graph;
  for (int node = 0; node < length * height; ++node) {
    if (node % length + 1 < length) graph.rows.push_back(node + 1);
    if (node + length < length * height) graph.rows.push_back(node + length);
    graph.starts.push_back(static_cast<int>(graph.rows.size()));
  }
  return graph;
}

// Entries of the factor below the diagonal, by elimination of one node after the other.
long fill(const Graph& graph, const std::vector<int>& places) {
  const std::size_t size = places.size();
  std::vector<std::set<int>> later(size);  // neighbours that are eliminated later
  for (std::size_t j = 0; j < size; ++j)
    for (int k = graph.starts[j]; k < graph.starts[j + 1]; ++k) {
      const int a = places[j], b = places[static_cast<std::size_t>(graph.rows[static_cast<std::size_t>(k)])];
      later[static_cast<std::size_t>(std::min(a, b))].insert(std::max(a, b));
    }
  long entries = 0;
  for (auto& mine : later) {
    entries += static_cast<long>(mine.size());
    if (mine.empty()) continue;
    const int parent = *mine.begin();
    later[static_cast<std::size_t>(parent)].insert(std::next(mine.begin()), mine.end());
  }
  return entries;
}

TEST(Ordering, IsAPermutation) {
  for (const Graph& graph : {strip(1, 1), strip(40, 1), strip(9, 7), Graph{{0, 0, 0, 0}, {}}}) {
    std::vector<int> places = elimination_places(graph.starts, graph.rows);
    ASSERT_EQ(places.size() + 1, graph.starts.size());
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(places[i], static_cast<int>(i));
  }
}

TEST(Ordering, AThinBandFillsInAboutItsWidth) {
  const int length = 300, height = 5;
  const Graph graph = strip(length, height);
  EXPECT_LE(fill(graph, elimination_places(graph.starts, graph.rows)), height * length * height);
}

TEST(Ordering, ATreeDoesNotFillIn) {
  Graph path = strip(50, 1);
  EXPECT_EQ(fill(path, elimination_places(path.starts, path.rows)), 49);
}

}  // namespace
}  // namespace inkgrid
