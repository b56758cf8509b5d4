#include "refine/cuts.h"

#include <algorithm>

#include "base/at.h"

namespace inkgrid {

std::vector<Chain> cut_chain(const Chain& chain, std::vector<Cut> cuts) {
  std::sort(cuts.begin(), cuts.end(),
            [](const Cut& a, const Cut& b) { return a.point != b.point ? a.point < b.point : a.junction < b.junction; });
  if (cuts.empty()) return {chain};
  std::vector<Chain> pieces;
  Chain piece = chain;
  piece.points.clear();
  piece.closed = false;
  piece.end_junction = -1;
  std::size_t next = 0;
  for (int k = 0; k < static_cast<int>(chain.points.size()); ++k) {
    piece.points.push_back(chain.points[at(k)]);
    if (next >= cuts.size() || cuts[next].point != k) continue;
    piece.end_junction = cuts[next].junction;
    if (piece.points.size() > 1) pieces.push_back(piece);
    piece.points = {chain.points[at(k)]};
    piece.start_junction = cuts[next].junction;
    while (next < cuts.size() && cuts[next].point == k) ++next;
  }
  piece.end_junction = chain.end_junction;
  if (piece.points.size() > 1) pieces.push_back(piece);
  if (chain.closed && pieces.size() > 1) {
    // The seam of a loop is no end: the last piece goes on into the first.
    auto& last = pieces.back();
    last.points.insert(last.points.end(), pieces.front().points.begin() + 1, pieces.front().points.end());
    last.end_junction = pieces.front().end_junction;
    pieces.erase(pieces.begin());
  }
  return pieces;
}

}  // namespace inkgrid
