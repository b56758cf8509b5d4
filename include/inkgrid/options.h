// Every parameter of the method, with its default.  Units: px, strokes (multiples of the stroke width), 1.
#pragma once

#include <optional>

namespace inkgrid {

enum class Preset { automatic, clean, rough };

// What becomes of filled areas: outlines in a layer of their own, nothing, or strokes like all ink.
enum class FillMode { layer, drop, trace };

// Strokes drawn side by side for one line: joined in rough drawings where neither reach nor spacing is given, joined,
// or kept apart.
enum class BundleMode { automatic, join, keep };

struct Options {
  Preset preset = Preset::automatic;
  std::optional<double> threshold;  // grey level 0..255; unset: chosen from the drawing (section 5)
  std::optional<double> faintest;   // of full ink, 0..1; unset: 0.15, and more than the lines of ruled paper
  std::optional<double> soften;     // px, standard deviation of the blur before anything else; unset: as its grain needs
  std::optional<double> reach;      // beta, strokes; unset: from the preset (section 5)
  std::optional<double> spacing;    // lambda, strokes; unset: from the preset (section 6.2)
  std::optional<double> gap;        // of paper between ends in line, strokes; unset: from the stroke width

  double details = 20;  // strokes: pieces of ink up to this length that stand alone are as in a clean drawing; 0: none

  FillMode fills = FillMode::layer;
  BundleMode bundles = BundleMode::automatic;

  double tolerance = 0.12;  // of the curve fit, strokes (section 6.3 takes the reach)
  double mesh_size = 0.25;  // largest circumdiameter of a triangle, strokes (section 5)

  double degenerate_angle = 30;       // degrees (section 6.1)
  double degenerate_ratio = 0.1;      // of the two magnitudes of a frame (section 6.1)
  double degenerate_fraction = 0.01;  // stop re-weighting below this (section 6.1)
  int field_rounds = 100;             // at most (section 6.1)

  double label_length = 4;    // of a streamline, strokes (section 6.1)
  double label_ratio = 0.48;  // above it a triangle stays unlabelled (section 6.1)

  double snap = 25;               // mu (section 6.2)
  double snap_sigma = 0.1;        // of the distance to the centre line, 0..1 (section 6.2)
  double damping = 1e-4;          // epsilon (section 6.2)
  double merge_difference = 0.5;  // local estimates closer than this share an integer (section 6.2)

  int coverage_bins = 4;  // all must hold ink (section 6.3)

  int threads = 0;  // 0: as many as the machine has; the result never depends on it
};

}  // namespace inkgrid
