#include "scribbles/parts.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/at.h"
#include "scribbles/graft.h"
#include "scribbles/window.h"

namespace inkgrid {
namespace {

// Distances in strokes.
constexpr double kMargin = 4;                       // from the scribbles: solved anew
constexpr std::array kKept{10.0, 25.0, 60.0};       // beyond it: kept, and looked at; more where less does not do
constexpr double kInnermost = 0.5, kOutermost = 2;  // of what is kept, inside and outside: not for cutting chains
constexpr double kAgreement = 0.1;                  // between old and new chains where they are cut
constexpr double kLeastAgreement = 0.2;             // px

using PartPointer = std::shared_ptr<const SolvedPart>;

// The whole drawing as one part.
TouchedPart everything(const Ink& ink) {
  return {{0, 0, ink.width(), ink.height()}, Raster<float>(ink.width(), ink.height(), 0.0f), ink.width(), ink.height()};
}

bool same(const TouchedPart& a, const TouchedPart& b) {
  return a.box == b.box && a.distance.data == b.distance.data;
}

// A pixel under the scribble.
Vec2 seed_of(const TouchedPart& part) {
  const auto found = std::find(part.distance.data.begin(), part.distance.data.end(), 0.0f) - part.distance.data.begin();
  const auto column = found % part.box.width(), row = found / part.box.width();
  return {part.box.x0 + static_cast<double>(column) + 0.5, part.box.y0 + static_cast<double>(row) + 0.5};
}

class PartsSolver {
 public:
  PartsSolver(const Stages& plain, const SolveWindow& solve) : plain_(plain), solve_(solve) {}

  Scribbled run() {
    for (const TouchedPart& part : parts_at(0)) candidates_.push_back({0, part, nullptr});
    for (;;) {
      Scribbled result{plain_.plain, {}};
      std::vector<std::size_t> failed;
      for (std::size_t i = 0; i < candidates_.size(); ++i) {
        Candidate& candidate = candidates_[i];
        if (!candidate.solved) candidate.solved = solved(candidate);
        auto chains = candidate.solved ? grafted(result.chains, candidate) : std::nullopt;
        if (chains)
          result.chains = std::move(*chains);
        else
          failed.push_back(i);
        result.parts.push_back(candidate.solved);
      }
      if (failed.empty()) return result;
      widen(failed);
    }
  }

 private:
  struct Candidate {
    std::size_t level;  // index into kKept; beyond it, everything
    TouchedPart part;
    PartPointer solved;
  };

  double strokes(double count) const { return count * plain_.ink.stroke_width; }

  // The part of a grid cell or of a streamline may be longer than usual.
  double margin() const { return strokes(std::max(kMargin, 2 * *plain_.inputs.settled.spacing)); }
  double farthest(std::size_t level) const {
    const double least =
        std::max(0.5 * kKept[0] * *plain_.inputs.settled.spacing, 2 * plain_.inputs.settled.label_length + kOutermost);
    return margin() + strokes(std::max(kKept[level], least));
  }

  const std::vector<TouchedPart>& parts_at(std::size_t level) {
    while (levels_.size() <= level)
      levels_.push_back(levels_.size() == kKept.size()
                            ? std::vector{everything(plain_.ink)}
                            : touched_parts(*plain_.inputs.mask, plain_.bundle_scale, covered_ink(plain_),
                                            *plain_.inputs.settled.reach, farthest(levels_.size())));
    return levels_[level];
  }

  // Nothing where it has no solution and may be widened.
  PartPointer solved(const Candidate& candidate) const {
    ScaleMask mask = window_of(*plain_.inputs.mask, candidate.part);
    for (const PartPointer& before : plain_.parts)
      if (same(before->touched, candidate.part) && before->mask.factor == mask.factor) return before;
    try {
      Window window = solve_(mask, candidate.part, margin());
      return std::make_shared<const SolvedPart>(
          SolvedPart{candidate.part, std::move(mask), margin(), candidate.level < kKept.size(), std::move(window)});
    } catch (const Error& error) {
      if (error.code() != ErrorCode::numerics || candidate.level == kKept.size()) throw;
      return nullptr;
    }
  }

  std::optional<Chains> grafted(const Chains& chains, const Candidate& candidate) const {
    const double outer = candidate.level < kKept.size() ? farthest(candidate.level) - strokes(kOutermost) : kUnreached;
    const GraftZone zone{candidate.part, margin() + strokes(kInnermost), outer};
    return graft(chains, candidate.solved->window.stages.plain, zone,
                 {std::max(kLeastAgreement, strokes(kAgreement)), plain_.ink.stroke_width});
  }

  // Those that failed come with more of what is around them, which may hold other parts too.
  void widen(const std::vector<std::size_t>& failed) {
    std::vector<Candidate> wider;
    for (const std::size_t i : failed) {
      const std::size_t level = candidates_[i].level + 1;
      const Vec2 seed = seed_of(candidates_[i].part);
      for (const TouchedPart& part : parts_at(level))
        if (distance_at(part, seed) == 0 &&
            std::none_of(wider.begin(), wider.end(), [&](const Candidate& c) { return same(c.part, part); }))
          wider.push_back({level, part, nullptr});
    }
    std::erase_if(candidates_, [&](const Candidate& candidate) {
      return std::any_of(wider.begin(), wider.end(),
                         [&](const Candidate& c) { return distance_at(c.part, seed_of(candidate.part)) == 0; });
    });
    candidates_.insert(candidates_.end(), wider.begin(), wider.end());
  }

  const Stages& plain_;
  const SolveWindow& solve_;
  std::vector<std::vector<TouchedPart>> levels_;
  std::vector<Candidate> candidates_;
};

}  // namespace

Scribbled solve_scribbles(const Stages& plain, const SolveWindow& solve) {
  return PartsSolver(plain, solve).run();
}

}  // namespace inkgrid
