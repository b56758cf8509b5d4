#include "scribbles/graft.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/at.h"
#include "base/polyline.h"
#include "base/union_find.h"

namespace inkgrid {
namespace {

constexpr double kLeastRun = 1.0;  // strokes along which old and new must agree around a cut
constexpr double kFade = 2.0;      // strokes over which a new chain is led over into the old one
constexpr double kSameWay = 0.9;   // cosine
constexpr double kNextPoints = 8;  // of a new chain, within which it goes on beside the next point of an old one

enum class Place { inside, between, outside };

// A place on a chain: between points[k] and points[k + 1] for k = floor(at).
struct Spot {
  int chain = -1;
  double at = 0;
  Vec2 point;
  double distance = 0;
};

Vec2 point_on(const std::vector<Vec2>& points, double at) {
  const auto k = std::min(static_cast<std::size_t>(at), points.size() - 2);
  return lerp(points[k], points[k + 1], at - static_cast<double>(k));
}

// Finds the nearest of many segments, no further than `reach`.
class SegmentBins {
 public:
  SegmentBins(const std::vector<Chain>& chains, double reach) : chains_(chains), reach_(reach), cell_(reach + 1) {
    for (int c = 0; c < static_cast<int>(chains.size()); ++c) {
      const auto& points = chains[at(c)].points;
      for (int k = 0; k + 1 < static_cast<int>(points.size()); ++k) add(c, k, points[at(k)], points[at(k + 1)]);
    }
    std::sort(entries_.begin(), entries_.end());
  }

  std::optional<Spot> nearest(Vec2 p) const {
    std::optional<Spot> best;
    for (int y = cell(p.y) - 1; y <= cell(p.y) + 1; ++y)
      for (auto e = std::lower_bound(entries_.begin(), entries_.end(), Entry{y, cell(p.x) - 1, -1, -1});
           e != entries_.end() && e->y == y && e->x <= cell(p.x) + 1; ++e) {
        const Spot spot = spot_on(*e, p);
        if (spot.distance <= (best ? best->distance : reach_)) best = spot;
      }
    return best;
  }

 private:
  struct Entry {
    int y, x, chain, segment;
    auto operator<=>(const Entry&) const = default;
  };

  int cell(double v) const { return static_cast<int>(std::floor(v / cell_)); }

  // In every cell that a point of it lies in, to half a cell.
  void add(int chain, int segment, Vec2 a, Vec2 b) {
    const int steps = 1 + static_cast<int>(2 * norm(b - a) / cell_);
    for (int i = 0; i <= steps; ++i) {
      const Vec2 p = lerp(a, b, static_cast<double>(i) / steps);
      const Entry entry{cell(p.y), cell(p.x), chain, segment};
      if (entries_.empty() || entries_.back() != entry) entries_.push_back(entry);
    }
  }

  Spot spot_on(const Entry& e, Vec2 p) const {
    const auto& points = chains_[at(e.chain)].points;
    const Vec2 a = points[at(e.segment)], b = points[at(e.segment + 1)];
    const double t = nearest_parameter(p, a, b);
    return {e.chain, e.segment + t, lerp(a, b, t), norm(p - lerp(a, b, t))};
  }

  const std::vector<Chain>& chains_;
  double reach_, cell_;
  std::vector<Entry> entries_;
};

// Where an old and a new chain agree and may be cut.
struct Cut {
  int old_chain = -1;
  int old_point = -1;
  Spot fresh;
  bool same_way = true;
};

class Zone {
 public:
  explicit Zone(const GraftZone& zone) : zone_(zone) {}

  Place place_of(Vec2 p) const {
    const double d = distance(p);
    return d < zone_.inner ? Place::inside : d < zone_.outer ? Place::between : Place::outside;
  }

 private:
  // Chains may leave the pixels of the band a little.
  double distance(Vec2 p) const {
    float least = distance_at(zone_.part, p);
    if (least < kUnreached) return static_cast<double>(least);
    for (const Vec2 step : {Vec2{2, 0}, Vec2{-2, 0}, Vec2{0, 2}, Vec2{0, -2}})
      least = std::min(least, distance_at(zone_.part, p + step));
    return static_cast<double>(least);
  }

  const GraftZone& zone_;
};

// A point of an old chain, and where it lies on a new one.
struct Agreement {
  int point;
  Spot spot;
};

std::optional<Spot> agreeing_spot(const std::vector<Vec2>& points, int k, const Chains& new_chains, const SegmentBins& bins,
                                  const Zone& zone) {
  if (zone.place_of(points[at(k)]) != Place::between) return std::nullopt;
  const std::optional<Spot> spot = bins.nearest(points[at(k)]);
  if (!spot) return std::nullopt;
  const auto& fresh = new_chains.chains[at(spot->chain)].points;
  const Vec2 along = tangent_at(points, k, 2, false), other = tangent_at(fresh, static_cast<int>(spot->at), 2, false);
  return std::abs(dot(along, other)) < kSameWay ? std::nullopt : spot;
}

bool goes_on(const Spot& from, const Spot& to) {
  return from.chain == to.chain && std::abs(from.at - to.at) < kNextPoints;
}

// In the middle half of a run that is long enough, where the chains are nearest to each other.
std::optional<Cut> cut_in(const std::vector<Agreement>& run, int old_chain, const std::vector<Vec2>& points,
                          double stroke_width) {
  if (run.size() < 3) return std::nullopt;
  double length = 0;
  for (auto i = run.begin(); i + 1 < run.end(); ++i) length += norm(points[at((i + 1)->point)] - points[at(i->point)]);
  if (length < kLeastRun * stroke_width) return std::nullopt;
  const auto quarter = static_cast<std::ptrdiff_t>(run.size() / 4);
  const auto nearest = std::min_element(run.begin() + quarter, run.end() - quarter,
                                        [](const Agreement& a, const Agreement& b) { return a.spot.distance < b.spot.distance; });
  return Cut{old_chain, nearest->point, nearest->spot, run.back().spot.at > run.front().spot.at};
}

// One in each stretch between inside and outside along which an old chain agrees with one new chain.
std::vector<Cut> find_cuts(const Chains& old_chains, const Chains& new_chains, const Zone& zone, const GraftOptions& options) {
  const SegmentBins bins(new_chains.chains, options.tolerance);
  std::vector<Cut> cuts;
  for (int c = 0; c < static_cast<int>(old_chains.chains.size()); ++c) {
    const auto& points = old_chains.chains[at(c)].points;
    std::vector<Agreement> run;
    const auto close_run = [&] {
      if (const auto cut = cut_in(run, c, points, options.stroke_width)) cuts.push_back(*cut);
      run.clear();
    };
    for (int k = 0; k < static_cast<int>(points.size()); ++k) {
      const std::optional<Spot> spot = agreeing_spot(points, k, new_chains, bins, zone);
      if (!spot || (!run.empty() && !goes_on(run.back().spot, *spot))) close_run();
      if (spot) run.push_back({k, *spot});
    }
    close_run();
  }
  return cuts;
}

// What a piece of a chain ends in.
struct PieceEnd {
  int junction = -1;
  int cut = -1;
  int side = 0;  // of the cut: 0 before it along the old chain, 1 after it
};

struct GraftPiece {
  std::vector<Vec2> points;
  std::array<PieceEnd, 2> ends;
  int chain = -1;
  bool kept = false;
};

// One cut on one chain of one of the networks.
struct ChainCut {
  double at;
  int cut;
  bool forward;  // the chain runs through it from side 0 to side 1
};

// A chain in pieces between its cuts, ascending.
void split(const Chain& chain, int index, const std::vector<ChainCut>& cuts, std::vector<GraftPiece>& pieces) {
  const auto part = [&](double from, double to) {
    std::vector<Vec2> points{point_on(chain.points, from)};
    for (auto k = static_cast<std::size_t>(from) + 1; static_cast<double>(k) < to; ++k) points.push_back(chain.points[k]);
    points.push_back(point_on(chain.points, to));
    return points;
  };
  const auto end_of = [](const ChainCut& cut, bool before) { return PieceEnd{-1, cut.cut, before == cut.forward ? 0 : 1}; };
  const double last = static_cast<double>(chain.points.size() - 1);
  std::size_t first_piece = pieces.size();
  for (std::size_t i = 0; i <= cuts.size(); ++i) {
    GraftPiece piece;
    piece.chain = index;
    piece.points = cuts.empty() ? chain.points : part(i == 0 ? 0 : cuts[i - 1].at, i == cuts.size() ? last : cuts[i].at);
    piece.ends[0] = i == 0 ? PieceEnd{chain.start_junction, -1, 0} : end_of(cuts[i - 1], false);
    piece.ends[1] = i == cuts.size() ? PieceEnd{chain.end_junction, -1, 0} : end_of(cuts[i], true);
    pieces.push_back(std::move(piece));
  }
  if (!chain.closed || cuts.empty() || chain.start_junction >= 0) return;
  // The seam of a loop is no end.
  GraftPiece& seam = pieces.back();
  GraftPiece& start = pieces[first_piece];
  seam.points.insert(seam.points.end(), start.points.begin() + 1, start.points.end());
  seam.ends[1] = start.ends[1];
  pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(first_piece));
}

struct Network {
  const Chains& chains;
  std::vector<GraftPiece> pieces;
};

Network cut_network(const Chains& chains, std::vector<std::vector<ChainCut>> cuts) {
  Network network{chains, {}};
  for (int c = 0; c < static_cast<int>(chains.chains.size()); ++c) {
    auto& here = cuts[at(c)];
    std::sort(here.begin(), here.end(),
              [](const ChainCut& a, const ChainCut& b) { return a.at != b.at ? a.at < b.at : a.cut < b.cut; });
    split(chains.chains[at(c)], c, here, network.pieces);
  }
  return network;
}

// Keeps the connected pieces that come inside, or those that do not; false where some come inside and outside.
bool choose(Network& network, const Zone& zone, bool keep_inside) {
  const int junctions = static_cast<int>(network.chains.junctions.size()), count = static_cast<int>(network.pieces.size());
  UnionFind sets(junctions + count);
  for (int i = 0; i < count; ++i)
    for (const PieceEnd& end : network.pieces[at(i)].ends)
      if (end.junction >= 0) sets.unite(end.junction, junctions + i);
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(junctions + count), 0), outside = inside;
  for (int i = 0; i < count; ++i)
    for (const Vec2 p : network.pieces[at(i)].points) {
      const Place place = zone.place_of(p);
      if (place == Place::inside) inside[at(sets.find(junctions + i))] = 1;
      if (place == Place::outside) outside[at(sets.find(junctions + i))] = 1;
    }
  for (int i = 0; i < count; ++i) {
    const int set = sets.find(junctions + i);
    if (inside[at(set)] && outside[at(set)]) return false;
    network.pieces[at(i)].kept = (inside[at(set)] != 0) == keep_inside;
  }
  return true;
}

// Which network has the piece at each side of each cut: one of the two, else nothing.
std::optional<std::vector<std::array<bool, 2>>> holders(const Network& old_network, const Network& new_network,
                                                        std::size_t cuts) {
  std::vector<std::array<int, 2>> held_by_old(cuts, {0, 0}), held_by_new(cuts, {0, 0});
  const auto count = [](const Network& network, std::vector<std::array<int, 2>>& held) {
    for (const GraftPiece& piece : network.pieces)
      for (const PieceEnd& end : piece.ends)
        if (piece.kept && end.cut >= 0) ++held[at(end.cut)][at(end.side)];
  };
  count(old_network, held_by_old);
  count(new_network, held_by_new);
  std::vector<std::array<bool, 2>> old_holds(cuts);
  for (std::size_t c = 0; c < cuts; ++c)
    for (std::size_t side = 0; side < 2; ++side) {
      if (held_by_old[c][side] + held_by_new[c][side] != 1) return std::nullopt;
      old_holds[c][side] = held_by_old[c][side] == 1;
    }
  return old_holds;
}

struct Networks {
  Network old_network, new_network;
};

std::optional<Networks> cut_both(const Chains& old_chains, const Chains& new_chains, const std::vector<Cut>& cuts,
                                 const Zone& zone) {
  std::vector<std::vector<ChainCut>> of_old(old_chains.chains.size()), of_new(new_chains.chains.size());
  for (int c = 0; c < static_cast<int>(cuts.size()); ++c) {
    const Cut& cut = cuts[at(c)];
    of_old[at(cut.old_chain)].push_back({static_cast<double>(cut.old_point), c, true});
    of_new[at(cut.fresh.chain)].push_back({cut.fresh.at, c, cut.same_way});
  }
  Networks networks{cut_network(old_chains, std::move(of_old)), cut_network(new_chains, std::move(of_new))};
  if (!choose(networks.old_network, zone, false) || !choose(networks.new_network, zone, true)) return std::nullopt;
  return networks;
}

// The cuts where an old chain goes on as a new one; nothing where that is not clear.
std::optional<std::vector<Cut>> cuts_that_count(const Chains& old_chains, const Chains& new_chains, const std::vector<Cut>& cuts,
                                                const Zone& zone) {
  const auto networks = cut_both(old_chains, new_chains, cuts, zone);
  if (!networks) return std::nullopt;
  const auto held = holders(networks->old_network, networks->new_network, cuts.size());
  if (!held) return std::nullopt;
  std::vector<Cut> counting;
  for (std::size_t c = 0; c < cuts.size(); ++c)
    if ((*held)[c][0] != (*held)[c][1]) counting.push_back(cuts[c]);
  return counting;
}

// Leads the piece over into the point, over the length `fade`.
void lead_to(GraftPiece& piece, bool at_start, Vec2 target, double fade) {
  auto& points = piece.points;
  const auto lengths = lengths_along(points);
  const double reach = std::min(fade, 0.5 * lengths.back());
  const Vec2 shift = target - (at_start ? points.front() : points.back());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double away = at_start ? lengths[k] : lengths.back() - lengths[k];
    if (away < reach) points[k] += (1 - away / reach) * shift;
  }
  (at_start ? points.front() : points.back()) = target;
}

// Joins the pieces that are kept over the cuts.
class Assembly {
 public:
  Assembly(Networks networks, const std::vector<Cut>& cuts, const Chains& old_chains, double fade) : links_(cuts.size()) {
    take(networks.old_network, 0);
    const int old_junctions = static_cast<int>(old_chains.junctions.size());
    for (GraftPiece& piece : networks.new_network.pieces)
      for (const int e : {0, 1}) {
        const int cut = piece.ends[at(e)].cut;
        if (piece.kept && cut >= 0)
          lead_to(piece, e == 0, old_chains.chains[at(cuts[at(cut)].old_chain)].points[at(cuts[at(cut)].old_point)], fade);
      }
    take(networks.new_network, old_junctions);
  }

  Chains take_chains() {
    std::vector<std::uint8_t> used(pieces_.size(), 0);
    for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
      if (used[at(i)]) continue;
      const Way way = way_through(i);
      for (const Step& step : way.steps) used[at(step.piece)] = 1;
      result_.chains.push_back(joined(way));
    }
    drop_unused_junctions(result_);
    return std::move(result_);
  }

 private:
  struct Step {
    int piece;
    bool forward;
  };
  struct Way {
    std::vector<Step> steps;
    bool closed = false;
  };
  struct Kept {
    GraftPiece piece;
    const Chain* chain;
  };

  void take(Network& network, int first_junction) {
    for (GraftPiece& piece : network.pieces) {
      if (!piece.kept) continue;
      const int index = static_cast<int>(pieces_.size());
      for (const int e : {0, 1}) {
        PieceEnd& end = piece.ends[at(e)];
        if (end.junction >= 0) end.junction += first_junction;
        if (end.cut >= 0) links_[at(end.cut)][at(end.side)] = {index, e == 0};
      }
      const Chain* const chain = &network.chains.chains[at(piece.chain)];
      pieces_.push_back({std::move(piece), chain});
    }
    result_.junctions.insert(result_.junctions.end(), network.chains.junctions.begin(), network.chains.junctions.end());
  }

  // The step after one that leaves through this end.
  std::optional<Step> beyond(const PieceEnd& end) const {
    if (end.cut < 0) return std::nullopt;
    return links_[at(end.cut)][at(1 - end.side)];
  }

  const PieceEnd& end_of(const Step& step, bool last) const {
    return pieces_[at(step.piece)].piece.ends[at(step.forward == last ? 1 : 0)];
  }

  Way way_through(int piece) const {
    Way way{{{piece, true}}, false};
    while (const auto next = beyond(end_of(way.steps.back(), true))) {
      if (next->piece == piece) {
        way.closed = true;
        return way;
      }
      way.steps.push_back(*next);
    }
    while (const auto next = beyond(end_of(way.steps.front(), false)))
      way.steps.insert(way.steps.begin(), Step{next->piece, !next->forward});
    return way;
  }

  Chain joined(const Way& way) const {
    const Kept& first = pieces_[at(way.steps.front().piece)];
    Chain chain = *first.chain;
    if (way.steps.size() == 1 && !way.closed) {
      chain.points = first.piece.points;
    } else {
      chain.points.clear();
      chain.closed = way.closed;
      double length = 0, weighted = 0;
      chain.confirmed = 0;
      for (const Step& step : way.steps) {
        auto points = pieces_[at(step.piece)].piece.points;
        if (!step.forward) std::reverse(points.begin(), points.end());
        const double here = lengths_along(points).back();
        length += here;
        weighted += here * pieces_[at(step.piece)].chain->width;
        chain.points.insert(chain.points.end(), points.begin() + (chain.points.empty() ? 0 : 1), points.end());
      }
      chain.width = weighted / length;
    }
    chain.start_junction = end_of(way.steps.front(), false).junction;
    chain.end_junction = end_of(way.steps.back(), true).junction;
    return chain;
  }

  std::vector<Kept> pieces_;
  std::vector<std::array<Step, 2>> links_;  // per cut and side: the step that starts there
  Chains result_;
};

}  // namespace

std::optional<Chains> graft(const Chains& old_chains, const Chains& new_chains, const GraftZone& graft_zone,
                            const GraftOptions& options) {
  const Zone zone(graft_zone);
  const auto cuts = cuts_that_count(old_chains, new_chains, find_cuts(old_chains, new_chains, zone, options), zone);
  if (!cuts) return std::nullopt;
  auto networks = cut_both(old_chains, new_chains, *cuts, zone);
  if (!networks) return std::nullopt;
  return Assembly(std::move(*networks), *cuts, old_chains, kFade * options.stroke_width).take_chains();
}

}  // namespace inkgrid
