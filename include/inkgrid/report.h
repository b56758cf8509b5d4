// What happened on the way: sizes, decisions, soft problems.  Nothing here changes the result.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace inkgrid {

struct Report {
  // ink (section 5)
  double threshold = 0;     // grey level actually used; pixels below it are ink (the mean one where it is local)
  bool inverted = false;    // light lines on dark paper
  double faintest = 0;      // of full ink: what is paler is none
  bool ruled = false;       // the paper is, and its lines are left out
  double stroke_width = 0;  // px, the paper's omega-bar
  long ink_pixels = 0;
  double softening = 0;  // px: by how much the picture was softened first, as its strokes were broken by grain
  int enlargement = 1;   // how many times the picture of a fine pen was enlarged first; all else is in px of the drawing
  int fills = 0;         // filled areas, which are not among the strokes
  // what `auto` chose
  std::string preset;  // "clean" or "rough"
  double reach = 0;    // stroke widths, the paper's beta
  double spacing = 0;  // stroke widths, the paper's lambda
  double gap = 0;      // stroke widths
  int bundles = 0;     // pairs of strokes, seen from both sides, that were joined as one line
  // band mesh
  int vertices = 0;
  int triangles = 0;
  int components = 0;
  int holes = 0;
  // field and charts (section 6.1)
  int field_rounds = 0;
  double degenerate_fraction = 0;
  int singularities = 0;
  int cuts = 0;
  // grid map (section 6.2)
  int cut_integers = 0;
  int snapping_integers = 0;
  double alignment_energy = 0;
  double snapping_energy = 0;
  int fallback_components = 0;  // components whose solve failed: their ink is marked straight, and a warning says so
  // curves (section 6.3)
  int nodes = 0;
  int edges = 0;
  int curves = 0;
  int segments = 0;

  std::vector<std::pair<std::string, double>> seconds;  // stage name, wall seconds, in pipeline order
  std::vector<std::string> warnings;                    // one sentence each
};

}  // namespace inkgrid
