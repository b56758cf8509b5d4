#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "chain_checks.h"
#include "graph/chains.h"
#include "graph/edge_support.h"
#include "pipeline.h"
#include "refine/ownership.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::chain_along;
using testing::ink_of;
using testing::paint;

// A strip of faces 0..n-1, all in a stroke; only what supported_intervals reads.
BandMesh strip(int faces) {
  BandMesh mesh;
  mesh.faces.resize(static_cast<std::size_t>(faces));
  mesh.in_stroke.assign(static_cast<std::size_t>(faces), 1);
  return mesh;
}

// An edge of family 0 (u constant) that crosses the faces of the strip, 1 px each.
GraphEdge straight_edge(int faces) {
  GraphEdge edge;
  for (int f = 0; f <= faces; ++f) edge.path.push_back({double(f), 0});
  for (int f = 0; f < faces; ++f) edge.faces.push_back(f);
  edge.family.assign(static_cast<std::size_t>(faces), 0);
  return edge;
}

TEST(EdgeSupport, OnlyFacesWhoseLabelAgreesCount) {
  BandMesh mesh = strip(10);
  std::vector<Label> labels(10, Label::along_t);  // along t: u is constant, as on the edge
  labels[4] = labels[5] = labels[6] = Label::along_s;
  labels[0] = Label::none;
  mesh.in_stroke[9] = 0;
  const auto parts = supported_intervals(straight_edge(10), mesh, labels, 0);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_DOUBLE_EQ(parts[0].from, 0);
  EXPECT_DOUBLE_EQ(parts[0].to, 4);
  EXPECT_DOUBLE_EQ(parts[1].from, 7);
  EXPECT_DOUBLE_EQ(parts[1].to, 9);
  EXPECT_EQ(supported_intervals(straight_edge(10), mesh, labels, 3).size(), 1u);
}

TEST(EdgeSupport, CutOutKeepsTheInnerPoints) {
  const GraphEdge edge = straight_edge(5);
  const auto part = cut_out(edge.path, {0, 1, 2, 3, 4, 5}, {0.5, 3.25});
  ASSERT_EQ(part.size(), 5u);
  EXPECT_DOUBLE_EQ(part.front().x, 0.5);
  EXPECT_DOUBLE_EQ(part[1].x, 1);
  EXPECT_DOUBLE_EQ(part.back().x, 3.25);
}

TEST(Ownership, PixelsOfOpenInkBelongToTheNearestPoint) {
  Image image = blank(120, 120);
  paint(image, {{60, 60}, {60.1, 60}}, 100);
  const Ink ink = ink_of(image);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(30, 90);
  std::vector<Chain> chains;
  for (int k = 0; k < 6; ++k) {
    const Vec2 from{place(random), place(random)}, to{place(random), place(random)};
    chains.push_back(chain_along({from, to}, 6));
  }
  const InkBand band(ink, 0);
  const Ownership owned = assign_ink(chains, band);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      if (!ink.mask(x, y)) {
        ASSERT_LT(owned.owner(x, y), 0);
        continue;
      }
      double best = 1e9;
      for (const auto& c : chains)
        for (const Vec2 p : c.points) best = std::min(best, norm(p - Vec2{x + 0.5, y + 0.5}));
      const auto s = owned.samples[static_cast<std::size_t>(owned.owner(x, y))];
      const Vec2 mine = chains[static_cast<std::size_t>(s.chain)].points[static_cast<std::size_t>(s.point)];
      // Spreading from pixel to pixel can miss the nearest by a fraction of a pixel.
      ASSERT_LT(norm(mine - Vec2{x + 0.5, y + 0.5}), best + 0.5) << x << ", " << y;
    }
}

Chains chains_of(const Image& image) {
  Options options;
  options.preset = Preset::clean;
  options.spacing = 0.7;  // slims no strokes
  options.reach = 0.3;
  const Stages s = run_stages(image, options, {});
  return chain_strokes(s.graph, s.mesh, spread_labels(s.mesh, s.charts, s.labels), s.slim);
}

double longest(const Chains& chains) {
  double length = 0;
  for (const auto& c : chains.chains) length = std::max(length, lengths_along(c.points).back());
  return length;
}

TEST(Chains, ALineIsOneLongChainFromCapToCap) {
  Image image = blank(200, 100);
  paint(image, {{30, 40}, {170, 60}}, 6);
  EXPECT_GT(longest(chains_of(image)), norm(Vec2{140, 20}));
}

TEST(Chains, ACrossingHasAJunctionThatItsChainsShareExactly) {
  Image image = blank(200, 200);
  paint(image, {{30, 40}, {170, 160}}, 6);
  paint(image, {{30, 160}, {170, 40}}, 6);
  const Chains chains = chains_of(image);
  ASSERT_GE(chains.junctions.size(), 1u);
  std::vector<int> ends(chains.junctions.size(), 0);
  for (const auto& c : chains.chains) {
    if (c.start_junction >= 0) {
      ++ends[static_cast<std::size_t>(c.start_junction)];
      EXPECT_TRUE(c.points.front() == chains.junctions[static_cast<std::size_t>(c.start_junction)]);
    }
    if (c.end_junction >= 0) {
      ++ends[static_cast<std::size_t>(c.end_junction)];
      EXPECT_TRUE(c.points.back() == chains.junctions[static_cast<std::size_t>(c.end_junction)]);
    }
  }
  EXPECT_GE(*std::max_element(ends.begin(), ends.end()), 3);
}

TEST(Chains, ACircleIsOneChainAllAround) {
  Image image = blank(200, 200);
  paint(image, testing::circle({100, 100}, 60), 6);
  const Chains chains = chains_of(image);
  EXPECT_GT(longest(chains), 0.9 * 2 * 3.14159 * 60);
}

}  // namespace
}  // namespace inkgrid
