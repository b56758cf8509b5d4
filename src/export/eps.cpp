// Encapsulated PostScript, level 2.
#include <cmath>

#include "export/page.h"
#include "export/writers.h"

namespace inkgrid {
namespace {

constexpr std::size_t kLongestLine = 255;  // of the structuring conventions

constexpr const char* kProlog =
    "%%BeginProlog\n"
    "/q /gsave load def /Q /grestore load def /cm { 6 array astore concat } bind def\n"
    "/J /setlinecap load def /j /setlinejoin load def /w /setlinewidth load def\n"
    "/m /moveto load def /c /curveto load def /h /closepath load def /S /stroke load def /f* /eofill load def\n"
    "%%EndProlog\n";

std::string whole(double points) {
  return decimal(std::ceil(points), 0);
}

}  // namespace

std::string eps_text(const Drawing& drawing, const ExportOptions& options, const std::string& description) {
  const Page page = page_of(drawing, options);
  std::string text = "%!PS-Adobe-3.0 EPSF-3.0\n";
  text += "%%BoundingBox: 0 0 " + whole(page.width) + ' ' + whole(page.height) + '\n';
  text += "%%HiResBoundingBox: 0 0 " + decimal(page.width, kPagePlaces) + ' ' + decimal(page.height, kPagePlaces) + '\n';
  text += ("%%Creator: " + parenthesised(description)).substr(0, kLongestLine) + '\n';
  text += "%%LanguageLevel: 2\n%%Pages: 1\n%%EndComments\n";
  return text + kProlog + "%%Page: 1 1\n" + page.content + "showpage\n%%EOF\n";
}

}  // namespace inkgrid
