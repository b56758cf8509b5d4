// What:   chains that say nothing of their own are dropped: weakly covered ones, spurs inside a junction, links shorter than a
// stroke is wide. Source: section 6.3, "Curve fitting" (coverage by a histogram); spurs and links are ours. Differs:
// docs/METHOD.md, "Chains". Cost:   linear in the length of the chains.
#pragma once

#include "chains.h"

namespace inkgrid {

// Section 6.3: each stroke pixel counts for its nearest chain, in a histogram over the chain's parameter; a chain with an empty
// bin is dropped.
Chains drop_uncovered(Chains chains, const Ink& ink, int bins);

// Chains with one free end, shorter than `spur` px, hanging on a junction, are dropped; junctions linked by chains shorter than
// `link` px become one; junctions that are none any more are dissolved.
Chains merge_junctions(Chains chains, double spur, double link);

}  // namespace inkgrid
