// What:   curves and fills in the operators that PDF and PostScript share: q cm J j w m c h S f*.
// Source: ISO 32000-1, section 8; in PostScript a prolog defines the same names.
// Differs: we write the operators ourselves, because cairo rounds coordinates to 1/256 point and puts the date into its files.
// Cost:   linear in the number of segments.
#pragma once

#include <string>

#include "export/paper.h"

namespace inkgrid {

inline constexpr int kPagePlaces = 6;

struct Page {
  double width;  // points of 1/72 inch
  double height;
  std::string content;  // coordinates in pixels, after a matrix that scales them and turns y up
};

Page page_of(const Drawing& drawing, const ExportOptions& options);

// Printable ASCII between the parentheses of a PDF or PostScript string; what would end it is escaped, what is else is left out.
std::string parenthesised(const std::string& text);

}  // namespace inkgrid
