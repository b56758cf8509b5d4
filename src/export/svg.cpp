// SVG 1.1.
#include "export/paper.h"
#include "export/writers.h"

namespace inkgrid {
namespace {

std::string point(Vec2 p) {
  return coordinate(p.x) + ',' + coordinate(p.y);
}

std::string path_data(const Curve& curve) {
  std::string data = "M" + point(curve.segments.front().p0);
  for (const Cubic& c : curve.segments) data += " C" + point(c.p1) + ' ' + point(c.p2) + ' ' + point(c.p3);
  if (curve.closed) data += " z";
  return data;
}

std::string fills_group(const std::vector<Fill>& fills) {
  if (fills.empty()) return "";
  std::string text = "<g id=\"fills\" fill=\"black\" fill-rule=\"evenodd\" stroke=\"none\">\n";
  int count = 0;
  for (const Fill& fill : fills) {
    std::string data;
    for (const Curve& outline : fill.outlines) data += (data.empty() ? "" : " ") + path_data(outline);
    text += "<path id=\"fill-" + std::to_string(++count) + "\" d=\"" + data + "\"/>\n";
  }
  return text + "</g>\n";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t')
      result += c;
  }
  return result;
}

std::string length(double pixels, const Paper& paper) {
  const double value = pixels * paper.units_a_pixel;
  switch (paper.unit) {
    case LengthUnit::millimetres:
      return coordinate(value) + "mm";
    case LengthUnit::inches:
      return decimal(value, 5) + "in";
    default:
      return coordinate(value);
  }
}

std::string opening_tag(const Drawing& drawing, const Paper& paper) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + coordinate(drawing.width) + ' ' +
         coordinate(drawing.height) + "\" width=\"" + length(drawing.width, paper) + "\" height=\"" +
         length(drawing.height, paper) + "\">\n";
}

}  // namespace

std::string svg_text(const Drawing& drawing, const ExportOptions& options, const std::string& description) {
  const Paper paper = paper_of(drawing, options);
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + opening_tag(drawing, paper);
  text += "<metadata>" + escaped(description) + "</metadata>\n";
  text += fills_group(drawing.fills);
  text += "<g fill=\"none\" stroke=\"black\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  int count = 0;
  for (const Curve& curve : drawing.curves) {
    text += "<path id=\"curve-" + std::to_string(++count) + "\" stroke-width=\"" +
            coordinate(stroke_width(curve, options, paper)) + "\" d=\"" + path_data(curve) + "\"/>\n";
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace inkgrid
