// What:   chains in pieces.
// Source: ours.
// Differs: nothing.
// Cost:   linear in the chain.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// Where a chain ends in a junction and goes on from it.
struct Cut {
  int point;  // index into Chain::points
  int junction;
};

// The pieces share the points at which they are cut; of a closed chain the last goes on into the first.
std::vector<Chain> cut_chain(const Chain& chain, std::vector<Cut> cuts);

}  // namespace inkgrid
