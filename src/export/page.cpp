#include "export/page.h"

namespace inkgrid {
namespace {

std::string operands(std::initializer_list<Vec2> points) {
  std::string text;
  for (const Vec2 p : points) text += coordinate(p.x) + ' ' + coordinate(p.y) + ' ';
  return text;
}

std::string path(const Curve& curve) {
  std::string text = operands({curve.segments.front().p0}) + "m\n";
  for (const Cubic& c : curve.segments) text += operands({c.p1, c.p2, c.p3}) + "c\n";
  return text + (curve.closed ? "h " : "");
}

}  // namespace

Page page_of(const Drawing& drawing, const ExportOptions& options) {
  constexpr int kScalePlaces = 9;
  const Paper paper = paper_of(drawing, options);
  Page page{paper.points_a_pixel * drawing.width, paper.points_a_pixel * drawing.height, "q\n1 J 1 j\n"};
  const std::string scale = decimal(paper.points_a_pixel, kScalePlaces);
  page.content += scale + " 0 0 -" + scale + " 0 " + decimal(page.height, kScalePlaces) + " cm\n";
  for (const Fill& fill : drawing.fills) {
    for (const Curve& outline : fill.outlines) page.content += path(outline);
    page.content += "f*\n";
  }
  for (const Curve& curve : drawing.curves)
    page.content += coordinate(stroke_width(curve, options, paper)) + " w\n" + path(curve) + "S\n";
  page.content += "Q\n";
  return page;
}

std::string parenthesised(const std::string& text) {
  std::string result = "(";
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') result += '\\';
    if (c >= ' ' && c <= '~') result += c;
  }
  return result + ")";
}

}  // namespace inkgrid
