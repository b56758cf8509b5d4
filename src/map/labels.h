// What:   which of the two directions of its frame the stroke follows, for each triangle on ink.
// Source: section 6.1, "Orientation labeling".
// Cost:   a streamline of some stroke widths for each triangle on ink.
#pragma once

#include <cstdint>
#include <vector>

#include "inkgrid/options.h"
#include "map/charts.h"

namespace inkgrid {

enum class Label : std::uint8_t {
  none,     // off the ink, or undecided
  along_s,  // the stroke runs along s: v is constant on it, and v is what snaps
  along_t,  // the stroke runs along t: u is constant on it, and u is what snaps
};

struct LabelOptions {
  double length = Options{}.label_length;  // of a streamline, strokes
  double ratio = Options{}.label_ratio;    // above it the triangle stays unlabelled
  int threads = 0;                         // 0: as many as the machine has
};

// Labels carried from the ink over the paper between strokes of one line (faces in_stroke), breadth first through the charts.
std::vector<Label> spread_labels(const BandMesh& mesh, const Charts& charts, std::vector<Label> labels);

struct Known;

// Labels that are known stay.
std::vector<Label> label_strokes(const BandMesh& mesh, const Charts& charts, const Ink& ink, const LabelOptions& options,
                                 const Known* known = nullptr);

}  // namespace inkgrid
