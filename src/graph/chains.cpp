#include "graph/chains.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/polyline.h"
#include "base/sample.h"
#include "graph/edge_support.h"

namespace inkgrid {
namespace {

// A piece of an isoline along a stroke, between two nodes (or -1 where it ends freely).
struct Piece {
  int from = -1;
  int to = -1;
  std::vector<Vec2> points;
  bool used = false;
};

// Whether the part lies on strokes, along them or across.
bool on_stroke(const GraphEdge& edge, const BandMesh& mesh, const std::vector<double>& lengths, Interval part) {
  for (std::size_t i = 0; i < edge.faces.size(); ++i)
    if (lengths[i + 1] > part.from && lengths[i] < part.to && !mesh.in_stroke[at(edge.faces[i])]) return false;
  return true;
}

// Keeps what runs along a stroke of each edge; parts that touch neither end become free pieces.
std::vector<Piece> stroke_pieces(const IsolineGraph& graph, const BandMesh& mesh, const std::vector<Label>& labels,
                                 double width) {
  std::vector<Piece> pieces;
  const auto is_node = [&](int node) { return node >= 0 && graph.nodes[at(node)].kind != NodeKind::boundary; };
  for (const auto& edge : graph.edges) {
    const auto lengths = lengths_along(edge.path);
    const double whole = lengths.back();
    auto parts = supported_intervals(edge, mesh, labels, 0.5 * width);
    double covered = 0;
    for (const auto& part : parts) covered += part.to - part.from;
    const bool closed = edge.from < 0 && edge.to < 0;
    const bool linked = is_node(edge.from) && is_node(edge.to);
    if ((closed || linked) && covered >= 0.5 * whole) {
      pieces.push_back({closed ? -1 : edge.from, closed ? -1 : edge.to, edge.path, false});
      continue;
    }
    for (const auto& part : parts) {
      Piece piece;
      if (is_node(edge.from) && part.from <= width && on_stroke(edge, mesh, lengths, {0, part.from})) piece.from = edge.from;
      if (is_node(edge.to) && whole - part.to <= width && on_stroke(edge, mesh, lengths, {part.to, whole})) piece.to = edge.to;
      const Interval kept{piece.from >= 0 ? 0 : part.from, piece.to >= 0 ? whole : part.to};
      if (piece.from < 0 && piece.to < 0 && kept.to - kept.from < width) continue;
      piece.points = cut_out(edge.path, lengths, kept);
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

struct PieceEnd {
  int piece;
  bool at_start;
};

// Joins pieces at nodes of degree two; splits at all others.
class Joiner {
 public:
  Joiner(std::vector<Piece> pieces, const IsolineGraph& graph)
      : pieces_(std::move(pieces)), graph_(graph), at_(graph.nodes.size()) {
    for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
      const auto& p = pieces_[at(i)];
      if (p.from >= 0) at_[at(p.from)].push_back({i, true});
      if (p.to >= 0) at_[at(p.to)].push_back({i, false});
    }
  }

  Chains join() {
    junction_.assign(at_.size(), -1);
    for (std::size_t n = 0; n < at_.size(); ++n) {
      if (at_[n].size() < 3) continue;
      junction_[n] = static_cast<int>(result_.junctions.size());
      result_.junctions.push_back(graph_.nodes[n].position);
    }
    for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
      const auto& p = pieces_[at(i)];
      if (p.used) continue;
      if (!passes_through(p.from))
        follow(i, true);
      else if (!passes_through(p.to))
        follow(i, false);
    }
    for (int i = 0; i < static_cast<int>(pieces_.size()); ++i)
      if (!pieces_[at(i)].used) follow(i, true);
    return std::move(result_);
  }

 private:
  bool passes_through(int node) const { return node >= 0 && at_[at(node)].size() == 2; }

  int junction_at(int node) const { return node >= 0 ? junction_[at(node)] : -1; }

  void follow(int index, bool forward) {
    Chain chain;
    const int first = index;
    const auto& start = pieces_[at(index)];
    chain.start_junction = junction_at(forward ? start.from : start.to);
    for (;;) {
      auto& p = pieces_[at(index)];
      p.used = true;
      auto points = p.points;
      if (!forward) std::reverse(points.begin(), points.end());
      chain.points.insert(chain.points.end(), points.begin() + (chain.points.empty() ? 0 : 1), points.end());
      const int node = forward ? p.to : p.from;
      if (!passes_through(node)) {
        chain.end_junction = junction_at(node);
        chain.closed = node < 0 && chain.points.size() > 2 && chain.points.front() == chain.points.back();
        break;
      }
      const auto& ends = at_[at(node)];
      const PieceEnd next = ends[0].piece == index ? ends[1] : ends[0];
      if (pieces_[at(next.piece)].used) {
        chain.closed = next.piece == first;
        break;
      }
      index = next.piece;
      forward = next.at_start;
    }
    result_.chains.push_back(std::move(chain));
  }

  std::vector<Piece> pieces_;
  const IsolineGraph& graph_;
  std::vector<std::vector<PieceEnd>> at_;
  std::vector<int> junction_;
  Chains result_;
};

}  // namespace

Chains scaled(Chains chains, double factor) {
  for (Vec2& junction : chains.junctions) junction = factor * junction;
  for (Chain& chain : chains.chains) {
    for (Vec2& p : chain.points) p = factor * p;
    chain.width *= factor;
    chain.confirmed *= factor;
  }
  return chains;
}

Chain reversed(Chain chain) {
  std::reverse(chain.points.begin(), chain.points.end());
  std::swap(chain.start_junction, chain.end_junction);
  return chain;
}

bool is_loop(const Chain& chain) {
  return chain.closed || (chain.start_junction >= 0 && chain.start_junction == chain.end_junction);
}

void keep_chains(Chains& chains, const std::vector<std::uint8_t>& kept) {
  std::size_t c = 0;
  std::erase_if(chains.chains, [&](const Chain&) { return kept[c++] == 0; });
}

void keep_junctions(Chains& chains, const std::vector<std::uint8_t>& kept) {
  std::vector<int> numbers(kept.size(), -1);
  std::vector<Vec2> junctions;
  for (std::size_t j = 0; j < kept.size(); ++j)
    if (kept[j]) {
      numbers[j] = static_cast<int>(junctions.size());
      junctions.push_back(chains.junctions[j]);
    }
  for (Chain& chain : chains.chains)
    for (int* const junction : {&chain.start_junction, &chain.end_junction})
      if (*junction >= 0) *junction = numbers[at(*junction)];
  chains.junctions = std::move(junctions);
}

void drop_unused_junctions(Chains& chains) {
  std::vector<std::uint8_t> used(chains.junctions.size());
  for (const Chain& chain : chains.chains)
    for (const int junction : {chain.start_junction, chain.end_junction})
      if (junction >= 0) used[at(junction)] = 1;
  keep_junctions(chains, used);
}

double ink_coverage(const Chain& chain, const Ink& ink) {
  double on = 0;
  for (const Vec2 p : chain.points) on += nearest(ink.mask, p, std::uint8_t{0});
  return on / static_cast<double>(chain.points.size());
}

Chains chain_strokes(const IsolineGraph& graph, const BandMesh& mesh, const std::vector<Label>& labels, const Ink& ink) {
  Chains chains = Joiner(stroke_pieces(graph, mesh, labels, ink.stroke_width), graph).join();
  for (auto& chain : chains.chains) chain.width = ink.stroke_width;
  std::erase_if(chains.chains, [](const Chain& c) { return lengths_along(c.points).back() < 1e-6; });
  return chains;
}

}  // namespace inkgrid
